// How many modes or elements are enough, and for what: two solutions that differ in nothing else.
import { percent } from '../text/format.js';
import { text } from '../text/catalogue.js';

/**
 * What is asked of both numbers: error of the last velocity as a share of the impact speed, of impulse and peak force.
 * @typedef {{ count: number, velocity: number, impulse: number, force: number, contacts: number }} Miss
 */

export const ENOUGH = 0.01; // error that is small enough

/**
 * The smaller number that is enough, or that none is.
 * @param {Miss[]} misses  the one of fewer first
 * @param {(miss: Miss) => boolean} fits
 */
const enoughOf = (misses, fits) => {
  const found = misses.find(fits);
  const { count } = found ?? misses[misses.length - 1];
  return text('compare.verdict.enough', { count, how: found ? 'found' : misses.length > 1 ? 'both' : 'judged' });
};

/**
 * @param {Miss[]} misses
 * @param {number} contacts  that there are
 * @param {string} what  modes, elements
 * @param {boolean} [jumps]  whether the force does, so that its peak does not settle
 * @param {boolean} [grazing]  whether the contacts are too near to another number of them to be judged by
 */
export function verdict(misses, contacts, what, jumps = false, grazing = false) {
  const velocity = enoughOf(misses, (miss) => miss.velocity <= ENOUGH);
  const impulse = enoughOf(misses, (miss) => miss.impulse <= ENOUGH);
  const found = enoughOf(misses, (miss) => miss.contacts === contacts);
  const force = enoughOf(misses, (miss) => miss.force <= ENOUGH);
  return text('compare.verdict.enough-for', { what, velocity, impulse, contacts: found, force, grazing, jumps });
}

/**
 * How far either is from the exact solution.
 * @param {Miss[]} misses
 * @param {string} what
 * @param {boolean} [grazing]
 */
export const listed = (misses, what, grazing = false) =>
  misses
    .map(({ contacts, count, force, impulse, velocity }) => {
      const by = { velocity: percent(velocity), impulse: percent(impulse), force: percent(force) };
      return text('compare.verdict.miss', { contacts, count, grazing, what, ...by });
    })
    .join(' ');
