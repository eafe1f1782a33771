// What the page draws of a mass across what bends, by the browser's own answer: a message like that of the server.
import { commonOf } from './figures.js';
import { cycleOf, felt, lawFor, setsLaw, takesRestitution, withLaw } from './law.js';

/** @import { BeamFigures, BeamFrame, Chosen, Contact, MarchRecord } from '../messages.js' */
/** @import { BentImpact, Kernels } from './kernels.js' */

const FOLLOWED = ['mass_ratio', 'speed'];
/** Of other solutions, which only the server has. */
const BESIDE = [
  ...['referenceImpactorPath', 'referenceStruckPath', 'referenceTime', 'referenceForce'],
  ...['staticTime', 'staticPath', 'staticModel', 'halfTime', 'halfForce', 'mainTime', 'mainForce'],
];

/**
 * Choices that it follows.
 * @param {BeamFrame} frame
 * @param {string} name
 */
export const follows = (frame, name) =>
  FOLLOWED.includes(name) || setsLaw(frame, name) || (name === 'restitution' && takesRestitution(frame));

/**
 * Whether an answer of the server has all that the same impact with other choices takes.
 * @param {BeamFrame} frame
 */
export const isBent = ({ chosen, draft, laws, main, march, stretch }) =>
  Boolean(march && !draft && !stretch && main.name === chosen.method && laws.some(({ name }) => name === chosen.law));

/**
 * What these choices make of an answer: who strikes what, and through which law; nothing where the server alone knows.
 * @param {Kernels} kernels
 * @param {BeamFrame} from
 * @param {Chosen} chosen
 */
export function strikingAcross(kernels, from, chosen) {
  const { beam, march } = from;
  if (!march) return null;
  const same = chosen.mass_ratio === from.chosen.mass_ratio;
  const mass = same ? from.impactor.mass : beam.mass / Number(chosen.mass_ratio);
  const speed = Number(chosen.speed);
  const law = lawFor(kernels, from, chosen, speed / from.speed, felt(mass, beam) / felt(from.impactor.mass, beam));
  if (!law) return null;
  const [rigidMass, whole] = [from.rigidMass ?? Infinity, march.whole ?? Infinity];
  const struck = { damping: from.damping ?? 0, duration: march.duration ?? 0, march, mass, rigidMass, whole };
  return { law, march, mass, same, speed, struck };
}

/**
 * The same impact with other choices.
 * @param {Kernels} kernels
 * @param {BeamFrame} from  the server's answer to the last ones
 * @param {Chosen} chosen  that differ in what is followed alone
 * @returns {BeamFrame | null}
 */
export function beamWith(kernels, from, chosen) {
  const begun = performance.now();
  const striking = strikingAcross(kernels, from, chosen);
  if (!striking) return null;
  const { law, march, mass, same, speed, struck } = striking;
  const rigid = !law.constants.length;
  const found = kernels.beam(struck, law);
  if (!found) return null;
  const { contacts, cycle, duration, step, steps } = found;
  const grown = (/** @type {Float64Array} */ values) => values.map((value) => value * speed);
  const { damps, exponent, name, yields } = law;
  const { acting, ...kept } = withLaw(from, law, chosen);
  const made = {
    ...kept,
    ...Object.fromEntries(BESIDE.filter((each) => each in from).map((each) => [each, undefined])),
    ...{ chosen, duration, speed, step, reference: null },
    impactor: { ...from.impactor, mass },
    law: { name, damps, yields, rigid, exponent },
    smoothing: Math.max((2 * duration) / steps, rigid ? found.window : 0),
    span: spanOf(found, same ? from.span.half : found.half),
    acting: [...acting.filter((each) => each !== 'restitution'), ...(damps ? ['restitution'] : [])],
    contacts: contacts.map(({ start, end, push, peak }) => {
      return /** @type {Contact} */ ([start, end, push * speed, peak * speed]);
    }),
    time: found.time,
    ...{ impactorPath: grown(found.impactor), struckPath: grown(found.struck) },
    ...{ impactorRate: grown(found.impactorRate), struckRate: grown(found.struckRate) },
    ...{ rates: grown(found.rates), modalForce: grown(found.force) },
  };
  if (!rigid) Object.assign(made, cycleOf({ ...made, forceUnit: speed, trip: 1 }, found, cycle));
  const main = bentFigures(made, from.main, found, march);
  const unchanged = Object.keys(chosen).every((each) => Object.is(chosen[each], from.chosen[each]));
  if (unchanged) main.notes = from.main.notes;
  main.diagnostics.wall_time = (performance.now() - begun) / 1e3;
  return /** @type {BeamFrame} */ ({ ...made, main });
}

/**
 * @param {BentImpact} found
 * @param {number | null} half
 */
function spanOf({ contacts }, half) {
  const apparent = contacts[contacts.length - 1].end - contacts[0].start;
  return { apparent, real: contacts.reduce((sum, { start, end }) => sum + end - start, 0), half };
}

/**
 * @param {BeamFrame} frame
 * @param {BeamFigures} before  of another impact
 * @param {BentImpact} found
 * @param {MarchRecord} march
 * @returns {BeamFigures}
 */
function bentFigures({ beam, impactor, law, rigidMass, speed }, before, found, march) {
  const { contacts, dissipated, energy, final, impulse, local } = found;
  const target = beam.held ? 0 : found.target;
  const unit = speed ** 2;
  const whole = 0.5 * (rigidMass ?? 0) * (found.target / march.mean) ** 2;
  const energies = {
    ...{ initial: 0.5 * impactor.mass * unit, impactor: 0.5 * impactor.mass * unit * final ** 2 },
    ...{ target_rigid: unit * whole, target_vibration: unit * (energy - whole) },
    ...{ local: unit * local, dissipated: unit * dissipated },
  };
  const known = { ...found, target, ...(law.rigid ? { apart: null, cycle: null } : { cycle: found }) };
  const figures = commonOf(before, known, energies, speed, speed);
  return {
    ...figures,
    restitution: { ...figures.restitution, ...(march.turns ? { poisson: null } : {}) },
    diagnostics: {
      ...{ ...figures.diagnostics, momentum_error: 1 - final - impulse / impactor.mass },
      ...{ steps: found.steps, raw_contacts: found.touches, raw_peak_force: speed * found.highest },
    },
    contacts: contacts.length,
    ...{ final: speed * final, targetFinal: speed * target, impulse: speed * impulse },
  };
}
