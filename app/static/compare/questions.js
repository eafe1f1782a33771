// Comparisons that are ready made: two settings of this impact, the first of which is kept.

import { family } from '../text/catalogue.js';

/** @import { Frame } from '../messages.js' */

const ASKED = family('compare.question');

/**
 * Those that can be asked of this impact, the most telling first; of a visitor's scene those that there are words for.
 * @param {Frame} frame
 */
export const questionsOf = (frame) => frame.opens.compare.filter(({ question }) => question in ASKED);
