// How thick rods are drawn and how high, so that what is said above and below them has room where they lead.
import { scale as zoom } from '../charts/canvas.js';

const WORDS = { above: 24, below: 42 }; // pixels: where the front is; what colours mean
const LEAST = 14; // pixels of a rod
const LEADS = { share: 0.42, most: 132 };
const USUAL = { share: 0.3, most: 56 };
const MIDDLE = 0.47; // of the height, from above
const HUNG = 0.68; // where a pendulum strikes, so that it is seen

/**
 * @param {number} height  [px]
 * @param {boolean} leads  the picture leads
 * @param {boolean} rods  whether any are drawn
 */
export function thickOf(height, leads, rods) {
  const { most, share } = leads ? LEADS : USUAL;
  const words = leads && rods ? (WORDS.above + WORDS.below) * zoom : 0;
  return Math.min(share * height, most, Math.max(height - words, LEAST));
}

/**
 * @param {number} height  [px]
 * @param {number} thick  [px]
 * @param {boolean} leads
 * @param {boolean} rods
 * @param {boolean} hangs  a pendulum strikes
 */
export function middleOf(height, thick, leads, rods, hangs) {
  if (hangs) return HUNG * height;
  return leads && rods ? Math.min(MIDDLE * height, height - WORDS.below * zoom - thick / 2) : MIDDLE * height;
}
