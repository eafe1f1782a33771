// What falls and is thrown up again is not gone for good.
import { engineering } from '../text/format.js';

/**
 * How a last contact ends: for good, or until its weight has brought back what strikes.
 * @param {number} weight  by which it is accelerated towards what it struck [m/s2]
 * @param {boolean} held  whether that stays where it is
 * @param {number} leaves  its velocity, less than nothing away from there [m/s]
 */
export function endsOf(weight, held, leaves) {
  const falls = held && weight > 0 && leaves < 0;
  return { last: falls ? 'falls' : true, again: falls ? engineering((-2 * leaves) / weight, 's', 2) : '' };
}
