// What happens in a frame, by the names that lesson files have; what it is worth, and its curves.
import { forceOf } from '../axial/force.js';
import { fallOf } from '../fall/fall.js';
import { between } from '../charts/scale.js';
import { cross, dot } from '../space/vectors.js';

/** @import { AxialFrame, BendingFrame, Contact, Energies, Frame, SpaceFrame } from '../messages.js' */
/** @import { Samples } from '../charts/scale.js' */

/** @typedef {Record<string, number>} Events  times [T] by name, as app/lessons/events.py has them */

const MOST = 9; // of one kind
const IMPACT = 2; // of bodies in space: how far their clock runs through the impulse

/** @param {Frame} frame @returns {SpaceFrame | null} */
const spaceOf = (frame) => ('sliding' in frame ? frame : null);

/** @param {Frame} frame @returns {BendingFrame | null} */
const bendingOf = (frame) => ('main' in frame ? frame : null);

/** @param {Frame} frame @returns {AxialFrame | null} */
const axialOf = (frame) => ('exact' in frame ? frame : null);

/**
 * How many units of the page's clock a T is.
 * @param {Frame} frame
 */
export const unitOf = (frame) => bendingOf(frame)?.period ?? 1;

/**
 * @param {string} kind
 * @param {number} number
 */
const named = (kind, number) => (number === 1 ? kind : `${kind}-${number}`);

/**
 * Contacts, on the page's clock.
 * @param {Frame} frame
 * @returns {Contact[]}
 */
const contactsOf = (frame) => axialOf(frame)?.exact.contacts ?? bendingOf(frame)?.contacts ?? [];

/**
 * @param {Frame} frame
 * @returns {Events}
 */
export function eventsOf(frame) {
  const space = spaceOf(frame);
  if (space) return overImpulse(space);
  /** @type {Events} */
  const found = {};
  const unit = unitOf(frame);
  contactsOf(frame)
    .slice(0, MOST)
    .forEach(([start, end], k) => {
      found[named('touch', k + 1)] = start / unit;
      found[named('part', k + 1)] = end / unit;
    });
  const rods = axialOf(frame)?.rods ?? [];
  if (rods.length !== 1 || !rods[0].mirror) return found; // nothing comes back
  for (let number = 1; number <= MOST; number++) {
    found[named('wall', number)] = number - 0.5;
    found[named('back', number)] = number;
  }
  found.second = found['back-2'];
  return found;
}

/**
 * Of what is dropped, from the release on [s]; nothing of other frames.
 * @param {Frame} frame
 * @returns {Events | null}
 */
export function fallenOf(frame) {
  const fall = axialOf(frame) && fallOf(/** @type {AxialFrame} */ (frame));
  if (!fall) return null;
  const named_ = fall.bounces.slice(0, MOST).flatMap(({ t }, k) => [
    [named('touch', k + 1), t],
    [named('part', k + 1), t],
  ]);
  return Object.fromEntries(named_);
}

/**
 * Of bodies in space, on the clock of their impulse; nothing of those that do not meet.
 * @param {SpaceFrame} frame
 */
function overImpulse({ impulse, sliding }) {
  /** @type {Events} */
  const found = impulse > 0 ? { touch: 0, part: IMPACT } : {};
  const most = sliding.at(-1)?.until ?? 1;
  sliding.slice(1).forEach(({ kind }, k) => {
    if (impulse > 0 && kind !== 'slip') found[kind] ??= (IMPACT * sliding[k].until) / most;
  });
  return found;
}

/**
 * A time of a lesson file [T].
 * @param {number | string} time
 * @param {Events} events
 */
export const timeOf = (time, events) => (typeof time === 'number' ? time : (events[time] ?? NaN));

/** @typedef {{ quantity: string, relation: string, value: number }} Goal */

/** @param {Energies} energy */
const lostOf = ({ dissipated, initial }) => dissipated / initial;

/** @type {Record<string, (frame: AxialFrame) => number | null>} */
const ALONG = {
  contacts: ({ exact }) => exact.contacts.length,
  peak_force: ({ exact }) => exact.peakForce,
  impulse: ({ exact }) => exact.contacts.reduce((sum, [, , impulse]) => sum + impulse, 0),
  restitution: ({ exact }) => exact.restitution.newton,
  contact_time: ({ exact, trip }) => exact.contacts.reduce((sum, [start, end]) => sum + (end - start) * trip, 0),
  impactor_velocity: ({ exact, speed }) => (exact.final === null ? null : exact.final * speed),
  target_velocity: ({ exact, speed }) => exact.targetFinal * speed,
  peak_indentation: ({ exact }) => exact.peakIndentation,
  energy_lost: ({ exact }) => lostOf(exact.energy),
};
/** @type {Record<string, (frame: BendingFrame) => number | null>} */
const ACROSS = {
  contacts: ({ main }) => main.contacts,
  peak_force: ({ main }) => main.peakForce,
  impulse: ({ main }) => main.impulse,
  restitution: ({ main }) => main.restitution.newton,
  contact_time: ({ span }) => span.real,
  impactor_velocity: ({ main }) => main.final,
  target_velocity: ({ main }) => main.targetFinal,
  peak_indentation: ({ main }) => main.peakIndentation,
  energy_lost: ({ main }) => lostOf(main.energy),
};
/**
 * About the line towards who looks at the picture.
 * @param {'impactor' | 'target'} body
 * @returns {(frame: SpaceFrame) => number}
 */
const spinOf =
  (body) =>
  ({ across, bodies, up }) =>
    dot(bodies[body].after.spin, cross(across, up));
/** @type {Record<string, (frame: SpaceFrame) => number | null>} */
const IN_SPACE = {
  impulse: ({ impulse }) => impulse,
  impactor_spin: spinOf('impactor'),
  target_spin: spinOf('target'),
  energy_lost: ({ figures }) => {
    const known = new Map(figures.map(([name, value]) => [name, Number(value)]));
    const lost = (known.get('energy-lost') ?? 0) + (known.get('energy-rubbed') ?? 0);
    return lost / (known.get('energy-before') ?? NaN);
  },
  sticks: ({ sliding }) => sliding.filter(({ kind }) => kind === 'stick').length,
};

/**
 * What a goal can be about; the same as app/lessons/solving.py finds.
 * @param {Frame} frame
 * @param {string} quantity
 */
export function quantityOf(frame, quantity) {
  const [axial, bending, space] = [axialOf(frame), bendingOf(frame), spaceOf(frame)];
  if (axial) return ALONG[quantity]?.(axial) ?? null;
  if (bending) return ACROSS[quantity]?.(bending) ?? null;
  return (space && IN_SPACE[quantity]?.(space)) ?? null;
}

const SLIGHT = 1e-6; // of it, which methods may be wrong by
/** @type {Record<string, number>} */
const SIZES = { restitution: 1, energy_lost: 1, impactor_spin: 1, target_spin: 1 }; // of what is zero

/**
 * Whether a frame meets a goal, by more than its methods may be wrong: a ball that stops does not go on.
 * @param {Frame} frame
 * @param {Goal} goal
 */
export function meets(frame, { quantity, relation, value }) {
  const is = quantityOf(frame, quantity);
  if (is === null) return false;
  if (relation === '=') return is === value;
  const size = quantity.endsWith('_velocity') ? Number(frame.chosen?.speed ?? 0) : (SIZES[quantity] ?? 0);
  const beyond = relation === '<' ? value - is : is - value;
  return beyond > SLIGHT * Math.max(Math.abs(value), Math.abs(is), size);
}

/**
 * The last contact: when it begins and ends, on the page's clock, and its peak [N].
 * @param {Frame} frame
 */
export function lastContact(frame) {
  const [start, end, , peak] = contactsOf(frame).at(-1) ?? [0, 0, 0, 0];
  return { start, end, peak: peak ?? 0 };
}

/**
 * The force that is to be drawn, in a unit so many of which one of SI is; of an impact along an axis.
 * @param {Frame} frame
 * @param {number} factor
 * @returns {Samples}
 */
export function curveOf(frame, factor) {
  const axial = axialOf(frame);
  if (!axial) return { x: [], y: [] };
  const { x, y } = forceOf(axial);
  return { x, y: Array.from(y, (force) => force * axial.forceUnit * factor) };
}

/**
 * Its value at an instant.
 * @param {Samples} curve
 * @returns {(t: number) => number}
 */
export const valueOf =
  ({ x, y }) =>
  (t) =>
    x.length ? between(x, y, t) : 0;
