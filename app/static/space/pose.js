// Where a body is and how it is turned at an instant.
import { add, dot, times, triple } from './vectors.js';

/** @import { Numbers, Vector } from '../messages.js' */

/** @typedef {{ centre: Vector, turned: (v: Vector) => Vector }} Pose */

/**
 * Between samples straight.
 * @param {Numbers} path  centres (time, 3), flat, from -1 to 1
 * @param {Numbers} turn  (time, 3, 3), flat
 * @param {number} t  from -1 to 1
 * @returns {Pose}
 */
export function poseAt(path, turn, t) {
  const last = path.length / 3 - 1;
  const place = ((t + 1) / 2) * last;
  const k = Math.min(Math.floor(place), last - 1);
  const part = place - k;
  const mix = (/** @type {Vector} */ a, /** @type {Vector} */ b) => add(times(a, 1 - part), b, part);
  const row = (/** @type {number} */ r) => mix(triple(turn, 9 * k + r), triple(turn, 9 * k + 9 + r));
  const rows = [row(0), row(3), row(6)];
  return {
    centre: mix(triple(path, 3 * k), triple(path, 3 * k + 3)),
    turned: (v) => [dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)],
  };
}
