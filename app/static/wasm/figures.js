// Figures of the browser's own answers, as the server gives them.

/** @import { AxialFigures, AxialFrame, BeamFigures } from '../messages.js' */
/** @import { Contact, Impact } from './kernels.js' */

/**
 * @typedef {'apart' | 'compressing' | 'dissipated' | 'duration' | 'energy' | 'final' | 'impulse' | 'target'} Same
 * @typedef {Pick<Impact, Same> & { contacts: Contact[], local: number, cycle: Dent | null } & Partial<Parts>} Found
 * @typedef {{ first: number, striker: number, wholes: number }} Parts  energies of rods that strike, or of several
 * @typedef {{ deepest: number, dent: number }} Dent  [v T]
 * @typedef {Pick<Impact, 'compressing' | 'duration' | 'final' | 'impulse' | 'target'> &
 *   { apart: number | null, contacts: { end: number, peak: number }[], cycle: Dent | null }} Common
 */

const CUT = { before: 0.02, share: 0.1 }; // of T, and of the peak: what a force still is that a wave cuts off

/**
 * @param {AxialFrame} frame  with its scales
 * @param {AxialFigures} before  of another impact by the same method
 * @param {Found} found
 * @param {(time: number) => number} force  [Z v] over time [T]
 * @returns {AxialFigures}
 */
export function figuresOf(frame, before, found, force) {
  const { contacts, dissipated, energy, final, local } = found;
  const { forceUnit, impactor, speed, target, trip } = frame;
  const targetFinal = target.held ? 0 : found.target;
  const moving = (/** @type {number} */ mass, /** @type {number} */ v) => 0.5 * mass * (speed * v) ** 2;
  const unit = forceUnit * speed * trip;
  const of = (/** @type {number | undefined} */ part, /** @type {() => number} */ known) =>
    part === undefined ? known() : unit * part;
  const whole = of(found.wholes, () => (target.held ? 0 : moving(target.mass, targetFinal)));
  const energies = {
    initial: of(found.first, () => moving(impactor.mass, 1)),
    ...{ impactor: of(found.striker, () => moving(impactor.mass, final)), target_rigid: whole },
    ...{ target_vibration: unit * energy - whole, local: unit * local, dissipated: unit * dissipated },
  };
  return {
    ...commonOf(before, { ...found, target: targetFinal }, energies, forceUnit, speed * trip),
    contacts: contacts.map(({ start, end, peak, push }) => [start, end, forceUnit * trip * push, forceUnit * peak]),
    cutOff: contacts.map((contact) => cutOff(contact, force)),
    left: contacts.map(({ after }) => after),
    ...{ final, targetFinal },
  };
}

/**
 * Those of an impact along an axis and across alike.
 * @template {AxialFigures | BeamFigures} F
 * @param {F} before  of another impact by the same method
 * @param {Common} found
 * @param {AxialFigures['energy']} energies  [J]
 * @param {number} force  unit of forces [N]
 * @param {number} length  and of indentations [m]
 * @returns {F}
 */
export function commonOf(before, found, energies, force, length) {
  const { apart, compressing, contacts, cycle, duration, final, impulse, target } = found;
  const { initial, ...parts } = energies;
  const off = Object.values(parts).reduce((sum, part) => sum + part, -initial) / initial;
  const { end } = contacts[contacts.length - 1];
  const together = end >= duration * (1 - 1e-12); // nothing is restored yet
  return {
    ...before,
    stillTouching: end >= duration * (1 - 1e-9),
    peakForce: force * Math.max(...contacts.map(({ peak }) => peak)),
    peakIndentation: cycle && length * cycle.deepest,
    residualIndentation: cycle && length * cycle.dent,
    restitution: {
      newton: together ? null : target - final,
      poisson: !together && compressing > 0 ? impulse / compressing - 1 : null,
      newton_at_contact: together ? null : apart,
    },
    energy: energies,
    diagnostics: { ...before.diagnostics, energy_error: off },
    notes: [],
  };
}

/**
 * What the impulse is off by, as a share of what the striker brings: by its own loss, and by what the target has.
 * @param {AxialFrame} frame  with its scales
 * @param {Impact} found
 */
export function unbalanced({ forceUnit, impactor, speed, target, trip }, found) {
  const lost = 1 - found.final;
  const pushed = (forceUnit * trip * found.impulse) / (impactor.mass * speed);
  const gained = target.held ? lost : (target.mass * found.target) / impactor.mass;
  return Math.max(Math.abs(lost - pushed), Math.abs(gained - lost));
}

/**
 * Whether the force was taken away at once by an arriving wave, rather than fading to zero.
 * @param {Contact} contact
 * @param {(time: number) => number} force  [Z v], as the peak
 */
function cutOff({ start, end, peak }, force) {
  const before = end - CUT.before;
  return end >= 1 - 1e-9 && before > start && force(before) > CUT.share * peak;
}
