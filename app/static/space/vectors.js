// Vectors in space.

/** @import { Vector } from '../messages.js' */

/**
 * @param {Vector} a
 * @param {Vector} b
 */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/**
 * @param {Vector} a
 * @param {Vector} b
 * @returns {Vector}
 */
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/**
 * a + f b
 * @param {Vector} a
 * @param {Vector} b
 * @param {number} [f]
 * @returns {Vector}
 */
export const add = (a, b, f = 1) => [a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]];

/**
 * @param {Vector} a
 * @param {number} f
 * @returns {Vector}
 */
export const times = (a, f) => [f * a[0], f * a[1], f * a[2]];

/** @param {Vector} a */
export const size = (a) => Math.hypot(...a);

/**
 * Three numbers in a row of many.
 * @param {ArrayLike<number>} values
 * @param {number} k
 * @returns {Vector}
 */
export const triple = (values, k) => [values[k], values[k + 1], values[k + 2]];
