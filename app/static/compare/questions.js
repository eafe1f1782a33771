// Comparisons that are ready made: two settings of this impact, the first of which is kept.

/** @import { Frame } from '../messages.js' */

/**
 * Those that can be asked of this impact, the most telling first.
 * @param {Frame} frame
 */
export const questionsOf = (frame) => frame.opens.compare;
