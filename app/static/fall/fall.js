// What a message says of a body that is dropped: its bounces, and its height over time.
/** @import { AxialFrame } from '../messages.js' */

/**
 * @typedef {object} Fall  SI units
 * @property {number} height
 * @property {number} gravity
 * @property {number | null} rest
 * @property {number} end  of what is shown
 * @property {ArrayLike<number>} x  times
 * @property {ArrayLike<number>} y  heights
 * @property {Bounce[]} bounces
 */
/** @typedef {{ t: number, impulse: number, height: number, restitution: number }} Bounce */

/**
 * What a message says of it; nothing of what is not dropped.
 * @param {AxialFrame} frame
 * @returns {Fall | null}
 */
export function fallOf({ bounces: rows, fall, fallHeight: y, fallTime: x }) {
  if (!fall || !rows || !x || !y) return null;
  const bounces = Array.from({ length: rows.length / 4 }, (_, k) => {
    const [t, impulse, height, restitution] = rows.subarray(4 * k);
    return { t, impulse, height, restitution };
  });
  const end = fall.rest === null ? x[x.length - 1] : 1.06 * fall.rest;
  return { ...fall, bounces, end, x, y };
}
