// What a chart of a spectrum shows.
import { text } from '../text/catalogue.js';
import { called } from '../text/words.js';

/** @import { Content, Series } from './chart.js' */

/**
 * @typedef {object} Held
 * @property {number[]} frequency  [Hz]
 * @property {{ name: string, modes: number | null, values: number[] }[]} lines
 * @property {number[]} natural  [Hz]
 * @property {string} unit  of the values
 */

const KILO = 1e4; // Hz, from which on frequencies are in kHz
const MUCH = 0.03; // of the largest value
const ROOM = 1.2; // of frequencies beyond the last that has so much
/** @type {Series['style'][]} */
const STYLES = ['exact', 'other'];

/**
 * Up to where there is much to be seen.
 * @param {ArrayLike<number>} x
 * @param {ArrayLike<number>} y
 */
export function heldUpTo(x, y) {
  const values = Array.from(y);
  const least = MUCH * Math.max(...values);
  const last = values.findLastIndex((value) => value > least);
  return Math.min(ROOM * (x[last] || Infinity), x[x.length - 1]);
}

/**
 * What the chart shows: a curve for each solution, an upright line for each natural frequency.
 * @param {Held} found
 * @returns {Content}
 */
export function contentOf({ frequency, lines, natural, unit }) {
  const large = frequency[frequency.length - 1] >= KILO;
  const shown = (/** @type {number[]} */ values) => (large ? values.map((each) => each / 1000) : values);
  const x = shown(frequency);
  const most = Math.max(...lines.flatMap(({ values }) => values));
  /** @type {Series[]} */
  const curves = lines.map(({ values: y, ...line }, k) => ({ x, y, name: called(line), style: STYLES[k] }));
  const name = text('spectrum.natural');
  const upright = shown(natural).map((at) => {
    const line = { x: [at, at], y: [0, 2 * most], path: true, reach: 0, name };
    return /** @type {Series} */ ({ ...line, style: 'dots' });
  });
  return { series: [...curves, ...upright], unit, xUnit: large ? 'kHz' : 'Hz' };
}
