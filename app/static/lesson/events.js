// What happens in a frame, by the names that lesson files have; what it is worth, and its curves.
import { between } from '../charts/scale.js';

/** @import { AxialFrame, Frame } from '../messages.js' */
/** @import { Samples } from '../charts/scale.js' */

/** @typedef {Record<string, number>} Events  times [T] by name, as app/lessons/events.py has them */

const MOST = 9; // of one kind

/**
 * Of an impact along an axis; of others, which a lesson does not name events of, none.
 * @param {Frame} frame
 * @returns {AxialFrame | null}
 */
const axialOf = (frame) => ('exact' in frame && 'forceUnit' in frame ? /** @type {AxialFrame} */ (frame) : null);

/**
 * @param {string} kind
 * @param {number} number
 */
const named = (kind, number) => (number === 1 ? kind : `${kind}-${number}`);

/**
 * @param {Frame} frame
 * @returns {Events}
 */
export function eventsOf(frame) {
  const axial = axialOf(frame);
  /** @type {Events} */
  const found = {};
  if (!axial) return found;
  axial.exact.contacts.slice(0, MOST).forEach(([start, end], k) => {
    found[named('touch', k + 1)] = start;
    found[named('part', k + 1)] = end;
  });
  const { rods } = axial;
  if (rods.length !== 1 || !rods[0].mirror) return found; // nothing comes back
  for (let number = 1; number <= MOST; number++) {
    found[named('wall', number)] = number - 0.5;
    found[named('back', number)] = number;
  }
  found.second = found['back-2'];
  return found;
}

/**
 * A time of a lesson file [T].
 * @param {number | string} time
 * @param {Events} events
 */
export const timeOf = (time, events) => (typeof time === 'number' ? time : (events[time] ?? NaN));

/** @typedef {{ quantity: string, relation: string, value: number }} Goal */

/** @type {Record<string, (frame: AxialFrame) => number | null>} */
const QUANTITIES = {
  contacts: ({ exact }) => exact.contacts.length,
  peak_force: ({ exact }) => exact.peakForce,
  impulse: ({ exact }) => exact.contacts.reduce((sum, [, , impulse]) => sum + impulse, 0),
  restitution: ({ exact }) => exact.restitution.newton,
  contact_time: ({ exact, trip }) => exact.contacts.reduce((sum, [start, end]) => sum + (end - start) * trip, 0),
  impactor_velocity: ({ exact, speed }) => (exact.final === null ? null : exact.final * speed),
  target_velocity: ({ exact, speed }) => exact.targetFinal * speed,
};

/**
 * Whether a frame meets a goal.
 * @param {Frame} frame
 * @param {Goal} goal
 */
export function meets(frame, { quantity, relation, value }) {
  const axial = axialOf(frame);
  const is = axial && QUANTITIES[quantity]?.(axial);
  if (is === null || is === undefined) return false;
  return relation === '=' ? is === value : relation === '<' ? is < value : is > value;
}

/**
 * The last contact: when it begins and ends [T], and its peak [N].
 * @param {Frame} frame
 */
export function lastContact(frame) {
  const [start, end, , peak] = axialOf(frame)?.exact.contacts.at(-1) ?? [0, 0, 0, 0];
  return { start, end, peak: peak ?? 0 };
}

/**
 * The force that is to be drawn, in a unit so many of which one of SI is.
 * @param {Frame} frame
 * @param {number} factor
 * @returns {Samples}
 */
export function curveOf(frame, factor) {
  const axial = axialOf(frame);
  if (!axial) return { x: [], y: [] };
  return { x: axial.exactTime, y: Array.from(axial.exactForce, (force) => force * axial.forceUnit * factor) };
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
