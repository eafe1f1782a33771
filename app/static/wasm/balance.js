// Repeated balances of impulse and momentum, of the browser's own answers: of a mass and a rod beside the waves in it.
import { between } from '../charts/scale.js';
import { figuresOf } from './figures.js';
import { rowsOf } from './kernels.js';
import { FIELD, ROOM } from './room.js';

/** @import { AxialFigures, AxialFrame } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */
/** @typedef {NonNullable<ReturnType<typeof balanceImpact>>} Balanced */

const CONTACT = 5; // numbers of a contact: as in solvers/numerics/balance_histories.py
const MOST_SHOWN = 1200; // balances: as in app/messages/encoding.py
const FIELDS = ['fieldStress', 'fieldVelocity', 'fieldDisplacement'];

/**
 * Whether the method beside is by balances of a rod.
 * @param {AxialFrame} frame
 */
export const byBalance = ({ balance, exact, other }) => Boolean(balance && exact.travelling && other);

/**
 * A mass that is balanced against what is struck, in units T, v and Z v.
 * @param {Kernels} kernels
 * @param {AxialFrame} made  with its scales
 * @param {number} duration  [T]; 0: until the bodies have parted for good
 */
export function balanceImpact(kernels, made, duration) {
  const { balance, balanceShapes, balanceStresses, chosen, forceUnit, impactor, speed, stressUnit, target } = made;
  if (!balance || !kernels.roomFor('balance')) return null;
  const { atContact, frequencies, located, means, resolved, step } = balance;
  const { trip } = made;
  const unit = (forceUnit * trip) / speed; // of masses
  const root = Math.sqrt(unit);
  const grown = (/** @type {Iterable<number>} */ values, /** @type {number} */ times) =>
    [...values].map((v) => v * times);
  const give = (/** @type {'modes' | 'shapes' | 'stresses'} */ name, /** @type {number[]} */ values) =>
    kernels.array('balance', name, ROOM.balance[name]).set(values);
  give('modes', [...grown(frequencies, trip), ...grown(atContact, root), ...grown(means, root)]);
  give('shapes', grown(balanceShapes ?? [], root));
  give('stresses', grown(balanceStresses ?? [], (root * speed * trip) / stressUnit));
  const whole = target.held ? Infinity : target.mass / unit;
  const restitution = Number(chosen.restitution);
  const bodies = [impactor.mass / unit, whole, frequencies.length];
  const called = kernels.call(
    'balance',
    ...[...bodies, Number(located), step / trip, resolved / trip, restitution, duration],
  );
  if (!called) return null;
  const { figures, read } = called;
  const { apart, balances, compressing, contacts, dissipated, energy, final, impulse, points, steps } = figures;
  const half = ROOM.balance.time / 2;
  const events = read('event');
  const third = ROOM.balance.event / 3;
  return {
    ...{ apart, balances, compressing, dissipated, duration: figures.duration, energy, final, impulse, steps },
    ...{ target: figures.target, cycle: null, local: 0 },
    contacts: rowsOf(CONTACT, contacts, read).map(([start, end, push, peak, after]) => {
      return { start, end, push, peak, after };
    }),
    ...{ mass: read('impactor'), end: read('face'), time: read('time', points) },
    force: read('time').slice(half, half + points),
    ...{ balanceTime: events.slice(0, balances), impulses: events.slice(third, third + balances) },
    ...{ stress: read('stress'), velocity: read('velocity'), displacement: read('displacement') },
  };
}

/**
 * Figures of such an impact.
 * @param {AxialFrame} made
 * @param {AxialFigures} before  of another
 * @param {Balanced} found
 * @param {number} begun  when it was asked for [ms]
 */
export function balancedFigures(made, before, found, begun) {
  const at = (/** @type {number} */ time) => between(found.time, found.force, time);
  const figures = figuresOf(made, before, found, at);
  const { balances, steps } = found;
  const wall_time = (performance.now() - begun) / 1e3;
  return { ...figures, diagnostics: { ...figures.diagnostics, balances, steps, wall_time } };
}

/**
 * The method beside an impact that was found here. Nothing where there is no room, or where its bodies still touch as
 * the time ends: then the server solves both for longer.
 * @param {Kernels} kernels
 * @param {AxialFrame} made  with its scales, and the method beside of other choices
 * @returns {Partial<AxialFrame> | null}
 */
export function besideByBalance(kernels, made) {
  const begun = performance.now();
  const { balance, duration, other, shapes, trip } = made;
  const found = other && balanceImpact(kernels, made, duration);
  if (!found || !balance || found.contacts[found.contacts.length - 1].end >= duration * (1 - 1e-12)) return null;
  const figures = balancedFigures(made, other, found, begun);
  const { balanceTime, impulses } = found;
  const shown = balance.shown && {
    balanceTime: balanceTime.slice(0, MOST_SHOWN),
    balanceForce: impulses.slice(0, MOST_SHOWN).map((impulse) => (impulse * trip) / balance.step),
  };
  return {
    ...{ otherMass: found.mass, otherEnd: found.end, otherTime: found.time, otherForce: found.force },
    ...{ fieldStress: found.stress, fieldVelocity: found.velocity, fieldDisplacement: found.displacement },
    ...shown,
    shapes: { ...shapes, ...Object.fromEntries(FIELDS.map((name) => [name, FIELD])) },
    other: { ...figures, diagnostics: { ...figures.diagnostics, estimated_error: null } },
  };
}
