// The wall that a rod is fixed to at its far end.
import { text } from '../text/catalogue.js';

/** @import { AxialFrame } from '../messages.js' */
/** @import { Support } from '../charts/supports.js' */

/**
 * It bears what the rod presses there; of a rod that turns the axis does, which is another chart's.
 * @param {AxialFrame} frame
 * @returns {Support[]}
 */
export function wallOf({ forceUnit, rods, target }) {
  const last = rods.at(-1);
  if (!last || target.support !== 'fixed' || target.rotation) return [];
  return [{ name: text('support.wall'), place: last.to, force: ['stress', last.area * forceUnit] }];
}
