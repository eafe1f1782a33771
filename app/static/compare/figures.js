// Figures of a solution in SI units, and how far two solutions lie apart, in percent and in words.
import { engineering, figures as digits, percent } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { roomOf } from './kinds.js';
import { kindsOf } from '../form/settings.js';

/** @import { Frame } from '../messages.js' */
/** @import { Figure, Size } from './figure.js' */

const UNITS = { time: 's', force: 'N', stress: 'Pa', impulse: 'N s', length: 'm' };
const SAME = 5e-4; // difference of two figures, as a share, that is none
const WORTH = 5e-3; // difference that is worth a word
const TIMES = 2; // from which one is said to be so many times the other

/**
 * Which of the two solutions of an impact along an axis is compared: the other method where only the way in which the
 * impact is solved differs.
 * @param {Frame} now
 * @param {Frame} kept
 * @returns {'exact' | 'other'}
 */
export function comparedOf(now, kept) {
  const { impact, how } = kindsOf(now, kept);
  const both = [now, kept].every((frame) => 'other' in frame && frame.other);
  return how && !impact && both ? 'other' : 'exact';
}

/**
 * @param {Frame} frame
 * @param {'exact' | 'other'} which
 * @returns {Figure[]}
 */
export function figuresOf(frame, which) {
  return roomOf(frame).figures(frame, which);
}

/**
 * Figures of solutions side by side. Where bodies touch but once in all of them, the time from the first touch to the
 * last parting is that in contact, and said once.
 * @param {[Frame, 'exact' | 'other'][]} solutions
 */
export function sideBySide(solutions) {
  const all = solutions.map(([frame, which]) => figuresOf(frame, which));
  const timeOf = (/** @type {Figure[]} */ figures, /** @type {string} */ name) =>
    figures.find(({ key }) => key === name)?.value ?? 0;
  const once = all.every((each) => timeOf(each, 'apparent') - timeOf(each, 'real') <= SAME * timeOf(each, 'apparent'));
  return once ? all.map((each) => each.filter(({ key }) => key !== 'apparent')) : all;
}

/**
 * A figure with its unit.
 * @param {Figure} figure
 */
export function written({ size, value, unit = '' }) {
  if (value === null) return '–';
  if (size === 'count') return String(value);
  if (size === 'share') return percent(value);
  if (size === 'velocity') return `${digits(value)} m/s`;
  if (size === 'number') return digits(value);
  if (size === 'other') return `${digits(value, 4)} ${unit}`.trim();
  return engineering(value, UNITS[size]);
}

/**
 * How far a figure lies from another, as a share of that; null where a share says nothing.
 * @param {Figure} one
 * @param {Figure | undefined} from
 */
export function shareOf({ size, value }, from) {
  if (value === null || !from || from.value === null || size === 'share') return null;
  const base = from.value;
  if (!base || value < 0 !== base < 0) return value === base ? 0 : null;
  return value / base - 1;
}

/**
 * The difference for a table: in percent, of shares in points of a percent.
 * @param {Figure} one
 * @param {Figure | undefined} from
 */
export function difference(one, from) {
  if (one.value === null || from?.value === null || !from) return '';
  if (one.size === 'share') return points(one.value - from.value);
  if (one.size === 'count') return one.value === from.value ? '=' : signedOf(one.value - from.value, '');
  const share = shareOf(one, from);
  if (share === null) return '';
  return Math.abs(share) < SAME ? '=' : signedOf(100 * share, ' %');
}

/** @param {number} change */
const points = (change) => (Math.abs(change) < SAME ? '=' : signedOf(100 * change, ' pp'));

/**
 * @param {number} value
 * @param {string} unit
 */
function signedOf(value, unit) {
  const size = Math.abs(value);
  return `${value < 0 ? '−' : '+'}${digits(size, size < 99.5 ? 2 : 3)}${unit}`;
}

/**
 * What differs between the figures of two solutions, in words; the most telling first.
 * @param {Figure[]} now
 * @param {Figure[]} kept
 */
export function sentences(now, kept) {
  return now.flatMap((one) => {
    const from = kept.find(({ key }) => key === one.key);
    if (!from || one.value === null || from.value === null || one.value === from.value) return [];
    const share = shareOf(one, from);
    if (share !== null && Math.abs(share) < WORTH) return [];
    if (one.size === 'share' && Math.abs(one.value - from.value) < WORTH) return [];
    const values = { figure: one.name, now: bound(written(one)), kept: bound(written(from)) };
    return [text('compare.differs', { ...values, change: changeOf(one.size, share) })];
  });
}

/**
 * How little two solutions differ: the largest difference of a figure that has a share.
 * @param {Figure[]} now
 * @param {Figure[]} kept
 */
export function leastSaid(now, kept) {
  const shares = now.map((one) => {
    const from = kept.find(({ key }) => key === one.key);
    return { name: one.name, share: Math.abs(shareOf(one, from) ?? 0) };
  });
  const most = shares.reduce((a, b) => (b.share > a.share ? b : a));
  return text('compare.alike', { figure: most.name, percent: rounded(100 * most.share) });
}

/** @param {number} value */
const rounded = (value) => Number(value.toPrecision(2));

/**
 * A number and its unit stay on one line.
 * @param {string} words
 */
export const bound = (words) => words.replaceAll(' ', '\u00a0');

/**
 * Some percent more or less; so many times, where it is a multiple.
 * @param {Size} size
 * @param {number | null} share
 */
function changeOf(size, share) {
  if (share === null || size === 'count') return '';
  const ratio = rounded(1 + share);
  if (ratio >= TIMES) return text('compare.times', { ratio });
  const percents = { percent: rounded(100 * Math.abs(share)) };
  return text(share > 0 ? 'compare.more-percent' : 'compare.less-percent', percents);
}
