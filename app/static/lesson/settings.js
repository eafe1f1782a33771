// What a sketch is called, and a line over two settings, in shares of what is shown of them: their values, their words,
// the numbers at their axes.
import { ticks } from '../charts/scale.js';
import { pretty, raised } from '../text/format.js';
import { family, text } from '../text/catalogue.js';
import { LABELS } from '../text/words.js';

/** @import { Mark, Marks } from './drawing.js' */
/** @import { Part } from './questions.js' */
/** @typedef {0 | 1} Way  across or upwards */

const TRACKS = family('lesson.track');
const ABOUT = 6; // numbers at an axis that goes by steps
const HEADS = [1, 2, 5]; // and of a decade
const POWER = /^(.+)e(-?\d+)$/;

/** @param {number} value  By powers of ten, where it is far from 1. */
const written = (value) =>
  pretty(value).replace(POWER, (_, digits, power) => `${digits === '1' ? '' : `${digits}·`}10${raised(Number(power))}`);

/**
 * @param {Part} part
 * @param {Way} way
 * @param {number} share
 */
export function settingAt({ logs, ranges }, way, share) {
  const [low, high] = ranges[way];
  return logs[way] ? low * (high / low) ** share : low + share * (high - low);
}

/**
 * @param {Part} part
 * @param {Way} way
 * @param {number} value
 */
export function shareOf({ logs, ranges }, way, value) {
  const [low, high] = ranges[way];
  return logs[way] && value > 0 ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}

/**
 * The value at a share, with its unit.
 * @param {Part} part
 * @param {Way} way
 * @param {number} share
 */
export function settingWords(part, way, share) {
  const { unit = '' } = LABELS[part.settings[way]];
  return `${written(Number(settingAt(part, way, share).toPrecision(3)))} ${unit}`.trim();
}

/** @param {string} name  A setting, with its unit. */
function titleOf(name) {
  const { title, unit } = LABELS[name];
  return unit ? `${title} [${unit}]` : title;
}

/**
 * @param {Part} part
 * @param {Way} way
 * @returns {Mark[]}
 */
function marksAlong(part, way) {
  const [low, high] = part.ranges[way];
  const values = [];
  if (part.logs[way])
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high) + 1e-9; power++)
      values.push(...HEADS.map((head) => head * 10 ** power));
  else values.push(...ticks(low, high, ABOUT).found);
  const all = values.map((value) => ({ share: shareOf(part, way, value), words: written(value) }));
  return all.filter(({ share }) => share > -1e-9 && share < 1 + 1e-9);
}

/**
 * Numbers at the axes of a boundary; none of a line over time.
 * @param {Part} part
 * @returns {Marks | null}
 */
export const marksOf = (part) =>
  part.settings
    ? { across: marksAlong(part, 0), upwards: marksAlong(part, 1), titles: part.settings.map(titleOf) }
    : null;

/** @param {Part} part  What is drawn, with its axes. */
export function nameOf({ contacts, settings, track, unit }) {
  if (!settings) return text('lesson.axis', { track: TRACKS[track], unit });
  const [across, upwards] = settings.map((/** @type {string} */ name) => LABELS[name].title);
  return text('lesson.boundary', { contacts, across, upwards });
}
