// What the page draws of rods one behind the other, by the browser's own answer: a message like that of the server.
import { between } from '../charts/scale.js';
import { chainImpact } from './chain_kernel.js';
import { figuresOf } from './figures.js';
import { withLaw } from './law.js';
import { predicted } from './rod.js';

/** @import { AxialFigures, AxialFrame, ChainRecord, Chosen, Gap } from '../messages.js' */
/** @import { ChainImpact } from './chain_kernel.js' */
/** @import { Kernels } from './kernels.js' */

const FOLLOWED = ['mass_ratio', 'restitution', 'speed'];
const ERROR = { left: 1e-6, step: 1e-12 }; // the least that is claimed: what is still to come, and of a step

/**
 * Choices that it follows: the speed of a chain that stays as stiff only sets the scale, but for its gaps.
 * @param {AxialFrame} frame
 * @param {string} name
 */
export const follows = (frame, name) => FOLLOWED.includes(name) && (name !== 'mass_ratio' || !frame.other);

/**
 * Whether an answer of the server is one of these impacts.
 * @param {AxialFrame} frame
 */
export function isChain({ chain, chosen, draft, exact, fall, impactor, other, stretch }) {
  const shown = [exact.name, other?.name].includes(String(chosen.method));
  return Boolean(chain && shown && impactor.mass > 0) && !draft && !fall && !stretch;
}

/**
 * The same impact with other choices.
 * @param {Kernels} kernels
 * @param {AxialFrame} from  the server's answer to the last ones
 * @param {Chosen} chosen  that differ in what is followed alone
 * @returns {AxialFrame | null}
 */
export function chainWith(kernels, from, chosen) {
  const begun = performance.now();
  const { rods, target, trip } = from;
  const speed = Number(chosen.speed);
  const times = speed / from.speed;
  const heavy = chosen.mass_ratio === from.chosen.mass_ratio;
  const mass = heavy ? from.impactor.mass : target.mass / Number(chosen.mass_ratio);
  const scales = { speed, forceUnit: from.forceUnit * times, stressUnit: from.stressUnit * times };
  const unit = (scales.forceUnit * trip) / speed; // of masses
  const first = /** @type {ChainRecord} */ (from.chain);
  const chain = { ...first, gaps: first.gaps.map((gap) => gap / times) };
  const striking = rods[0].from < 0;
  const found = chainImpact(kernels, rods, chain, striking ? 0 : mass / unit, target.endMass / unit);
  if (!found) return null;
  const { duration, force, forceTime, waves } = found;
  const own = rods[striking ? 1 : 0].drift;
  const { impactor: after, target: gone } = predicted(target.mass / mass, target.held, Number(chosen.restitution));
  const sent = waves.flatMap(([time, wave], k) => {
    const name = `${k % 2 ? 'g' : 'f'}${k >> 1}`;
    return /** @type {[string, Float64Array][]} */ ([[`${name}Time`, time], [name, wave]]); // prettier-ignore
  });
  const made = {
    ...withLaw(from, from.laws[0], chosen),
    ...scales,
    ...Object.fromEntries(sent),
    ...{ chain, chosen, duration, gaps: /** @type {Gap[]} */ (found.gaps) },
    impactor: { ...from.impactor, mass },
    prediction: from.prediction && { impactor: after + own, target: target.held ? gone : gone + own },
    motionTime: found.mass.map((_, k, all) => (k / (all.length - 1)) * duration),
    ...{ exactMass: found.mass, exactEnd: found.end, exactTime: forceTime, exactForce: force },
    exactWhole: from.exactWhole && found.whole,
  };
  const at = (/** @type {number} */ time) => between(forceTime, force, time);
  const exact = figuresOf(made, from.exact, { ...found, dissipated: 0, local: 0, cycle: null }, at);
  const momenta = unbalanced(made, found, striking ? rods[0].drift : own + 1, own);
  const missing = Math.abs(exact.diagnostics.energy_error) + momenta;
  Object.assign(exact.diagnostics, {
    ...{ steps: found.steps, estimated_error: Math.max(missing, found.faded ? ERROR.left : ERROR.step) },
    wall_time: (performance.now() - begun) / 1e3,
  });
  if (heavy && times === 1) exact.notes = from.exact.notes;
  const other = from.other && faster(from.other, times);
  return { ...made, exact, other, match: exact.restitution.newton };
}

/**
 * What the impulse is off by, as a share of what the striker brings.
 * @param {AxialFrame} frame  with its scales
 * @param {ChainImpact} found
 * @param {number} striker  velocity before the impact [v]
 * @param {number} struck  and of the target
 */
function unbalanced({ forceUnit, impactor, speed, target, trip }, found, striker, struck) {
  const lost = striker - found.final;
  const pushed = (forceUnit * trip * found.impulse) / (impactor.mass * speed);
  const gained = target.held ? lost : (target.mass * (found.target - struck)) / impactor.mass;
  return Math.max(Math.abs(lost - pushed), Math.abs(gained - lost));
}

/**
 * The method beside, of an impact that is so many times as fast: as nothing gives way but the rods, all is the same.
 * @param {AxialFigures} figures
 * @param {number} times
 * @returns {AxialFigures}
 */
function faster(figures, times) {
  if (times === 1) return figures;
  const { contacts, diagnostics, energy, peakForce } = figures;
  const { raw_peak_force: highest } = /** @type {Record<string, any>} */ (diagnostics);
  return {
    ...figures,
    contacts: contacts.map(([start, end, push, peak]) => [
      start,
      end,
      push * times,
      peak === null ? peak : peak * times,
    ]),
    peakForce: peakForce === null ? peakForce : peakForce * times,
    energy: /** @type {typeof energy} */ (
      Object.fromEntries(Object.entries(energy).map(([name, value]) => [name, value * times ** 2]))
    ),
    diagnostics: { ...diagnostics, ...(highest === undefined ? {} : { raw_peak_force: highest * times }) },
    notes: [],
  };
}
