// What the page draws of two bodies that move as wholes, by the browser's own answer: a message like the server's.
import { between } from '../charts/scale.js';
import { figuresOf } from './figures.js';
import { cycleOf, felt, lawFor, setsLaw, takesRestitution, withLaw } from './law.js';
import { predicted } from './rod.js';

/** @import { AxialFrame, Chosen } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

const FOLLOWED = ['mass_ratio', 'restitution', 'speed'];

/**
 * Choices that it follows.
 * @param {AxialFrame} frame
 * @param {string} name
 */
export const follows = (frame, name) =>
  setsLaw(frame, name) || (FOLLOWED.includes(name) && (name !== 'restitution' || takesRestitution(frame)));

/**
 * Whether an answer of the server is one of these impacts.
 * @param {AxialFrame} frame
 */
export const isCompact = ({ chosen, compact, draft, fall, laws, other, stretch }) =>
  Boolean(compact && !draft && !fall && !stretch && other?.name === chosen.method) &&
  laws.some(({ name }) => name === chosen.law);

/**
 * The same impact with other choices.
 * @param {Kernels} kernels
 * @param {AxialFrame} from  the server's answer to the last ones
 * @param {Chosen} chosen  that differ in what is followed alone
 * @returns {AxialFrame | null}
 */
export function compactWith(kernels, from, chosen) {
  const begun = performance.now();
  const { compact, target } = from;
  const change = Number(chosen.mass_ratio) === Number(from.chosen.mass_ratio);
  const mass = change ? from.impactor.mass : target.mass / Number(chosen.mass_ratio);
  const speed = Number(chosen.speed);
  const heavier = felt(mass, target) / felt(from.impactor.mass, target);
  const law = lawFor(kernels, from, chosen, speed / from.speed, heavier);
  const found = law && kernels.compact(mass, target.held ? Infinity : target.mass, law, Boolean(compact?.sine));
  if (!found || !from.other) return null;
  const { cycle, duration, exact, other, trip } = found;
  const forceUnit = (felt(mass, target) / trip) * speed;
  const made = {
    ...withLaw(from, law, chosen),
    ...{ damps: law.damps, exponent: law.exponent, nominal: law.nominal, yields: law.yields, rigid: false },
    ...{ chosen, duration, forceUnit, speed, stressUnit: forceUnit, trip },
    impactor: { ...from.impactor, mass },
    prediction: from.prediction && predicted(target.mass / mass, target.held, Number(chosen.restitution)),
    motionTime: found.impactor.map((_, k, all) => (k / (all.length - 1)) * duration),
    ...{ exactMass: found.impactor, exactEnd: found.face, exactTime: found.forceTime, exactForce: found.force },
    ...{ otherMass: found.otherImpactor, otherEnd: found.otherFace },
    ...{ otherTime: found.otherTime, otherForce: found.otherForce },
  };
  const inSeconds = exact.contacts.map((each) => ({ ...each, start: each.start * trip, end: each.end * trip }));
  const pressing = { contacts: inSeconds, duration: duration * trip };
  Object.assign(made, cycleOf({ ...made, forceUnit: speed, trip: 1 }, pressing, cycle));
  if (other.contacts[0].end >= duration) return null; // then the server solves both for longer
  const energyOf = (/** @type {number} */ v) => (target.held ? 0 : (0.5 * target.mass * v ** 2) / felt(mass, target));
  const marched = { ...exact, duration, energy: energyOf(exact.target) };
  const closed = { ...other, duration, energy: energyOf(other.target) };
  const at = (/** @type {Float64Array} */ x, /** @type {Float64Array} */ y) => (/** @type {number} */ t) =>
    between(x, y, t);
  const figures = {
    exact: figuresOf(made, from.exact, marched, at(found.forceTime, found.force)),
    other: figuresOf(made, from.other, closed, at(found.otherTime, found.otherForce)),
  };
  Object.assign(figures.exact.diagnostics, {
    ...{ raw_contacts: exact.touches, raw_peak_force: exact.highest * forceUnit, steps: exact.steps },
    wall_time: (performance.now() - begun) / 1e3,
  });
  Object.assign(figures.other.diagnostics, { delivered_restitution: other.apart, steps: other.steps });
  const same = Object.keys(chosen).every((name) => Object.is(chosen[name], from.chosen[name]));
  if (same) for (const name of /** @type {const} */ (['exact', 'other'])) figures[name].notes = from[name]?.notes ?? [];
  return { ...made, ...figures, match: figures.exact.restitution.newton };
}
