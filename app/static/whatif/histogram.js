// How often a result has which value, by the number of contacts, with what lies between 5 % and 95 %.
import { letters, scale } from '../charts/canvas.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';
import { COLOR, disc, mark, word } from './ink.js';
import { plain, shownOf, unitFor, written } from './results.js';
import { binsOf, quantilesOf, shareAbove } from './spread.js';

/** @import { Context } from './ink.js' */
/** @import { Result } from './results.js' */
/** @import { Samples } from './tolerance_jobs.js' */

const BINS = { wide: 64, narrow: 40 };
const PAD = 0.06; // of the range, on either side
export const TONES = ['#a9b8c5', '#e0703f', '#a62c1c', '#3d040a']; // of one contact, of two, …
const BAND = '#eef2f5';
const TICK = 90; // pixels from one value to the next, at least

/** @param {number} contacts  Those of counts beside each other differ, however many there are. */
export const toneOf = (contacts) => TONES[(Math.max(contacts, 1) - 1) % TONES.length];

/**
 * @typedef {object} Shown
 * @property {Samples} samples
 * @property {Result} result
 * @property {number} here
 * @property {number | null} wanted
 * @property {boolean} narrow
 */

/**
 * The range that is shown: of whole numbers, one more half on either side.
 * @param {ArrayLike<number>} sorted
 * @param {boolean} whole
 * @returns {[low: number, high: number]}
 */
export function rangeOf(sorted, whole) {
  const [low, high] = [sorted[0], sorted[sorted.length - 1]];
  if (whole) return [low - 0.5, high + 0.5];
  const long = high - low > 1e-9 * Math.abs(high) ? high - low : 0.02 * Math.abs(high) || 1;
  return [low - PAD * long, high + PAD * long];
}

/**
 * @param {Context} c
 * @param {number} width
 * @param {number} height
 * @param {Shown} shown
 */
export function drawHistogram(c, width, height, { here, narrow, result, samples, wanted }) {
  const { contacts, sorted, values } = samples.column(result);
  if (!sorted.length) return;
  const whole = Boolean(shownOf(result).whole);
  const range = rangeOf(sorted, whole);
  const [low, high] = range;
  const [left, right] = narrow ? [16, width - 16] : [24, width - 24];
  const [top, base] = [(narrow ? 92 : 78) * scale, height - 30 * scale];
  const xOf = (/** @type {number} */ value) => left + ((value - low) / (high - low)) * (right - left);
  const parts = whole ? Math.round(high - low) : narrow ? BINS.narrow : BINS.wide;
  const bins = binsOf(values, contacts, range, parts);
  const counts = [...new Set(contacts)].sort((a, b) => a - b);
  const quantiles = quantilesOf(sorted, [0.05, 0.5, 0.95]);
  c.fillStyle = BAND;
  if (!whole)
    c.fillRect(xOf(quantiles[0]), top - 10, Math.max(xOf(quantiles[2]) - xOf(quantiles[0]), 1), base - top + 10);
  drawBars(c, bins, counts, [left, right], [top, base]);
  c.fillStyle = COLOR.soft;
  c.fillRect(left, base, right - left, 1);
  drawTicks(c, result, range, xOf, (right - left) / TICK / scale, width, base);
  if (!whole) drawQuantiles(c, result, quantiles, xOf, [top, base], [left, right], narrow);
  const key = drawKey(c, contacts, counts, left, narrow);
  if (wanted !== null && wanted > low && wanted < high) {
    c.strokeStyle = COLOR.accent;
    c.lineWidth = 1.5;
    c.setLineDash([6, 4]);
    mark(c, xOf(wanted), top - 10, 0, base - top + 10);
    c.setLineDash([]);
  }
  if (wanted !== null) {
    const free = /** @type {[number, number]} */ ([narrow ? left : key, right]);
    drawShare(c, shareAbove(sorted, wanted), written(result, wanted), xOf(wanted), free, narrow);
  }
  if (!(here >= low && here <= high)) return;
  c.strokeStyle = COLOR.accent;
  c.lineWidth = 2;
  if (!whole) mark(c, xOf(here), top - 10, 0, base - top + 10);
  disc(c, xOf(here), base, 5.5, COLOR.accent);
  c.strokeStyle = COLOR.ring;
  c.stroke();
}

/**
 * @param {Context} c
 * @param {Map<number, number>[]} bins
 * @param {number[]} counts  of contacts, the fewest below
 * @param {[left: number, right: number]} across
 * @param {[top: number, base: number]} down
 */
export function drawBars(c, bins, counts, [left, right], [top, base]) {
  const most = Math.max(...bins.map((bin) => [...bin.values()].reduce((sum, count) => sum + count, 0)));
  const wide = (right - left) / bins.length;
  const gap = wide > 60 ? 0.3 * wide : wide > 5 ? 1.5 : 0; // of whole numbers, or of many
  bins.forEach((bin, k) => {
    let y = base;
    for (const count of counts) {
      const high = ((bin.get(count) ?? 0) / most) * (base - top);
      c.fillStyle = toneOf(count);
      c.fillRect(left + k * wide + gap / 2, y - high, wide - gap, high);
      y -= high;
    }
  });
}

/**
 * @param {Context} c
 * @param {Result} result
 * @param {[low: number, high: number]} range
 * @param {(value: number) => number} xOf
 * @param {number} room  values that there is room for
 * @param {number} wide  pixels of the whole
 * @param {number} base
 */
function drawTicks(c, result, [low, high], xOf, room, wide, base) {
  const { log, whole } = shownOf(result);
  const [factor, unit] = unitFor(result, log ? [Math.log10(high), Math.log10(high)] : [low, high]);
  const rough = ((high - low) * factor) / Math.max(room, 2);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = whole ? 1 : ([1, 2, 5].find((each) => each * power >= rough) ?? 10) * power;
  const [first, last] = [Math.ceil((low * factor) / step), Math.floor((high * factor) / step)];
  const digits = Math.max(3, Math.ceil(Math.log10(Math.max(Math.abs(first), Math.abs(last), 1) + 1)));
  for (let k = first; k <= last; k++) {
    const value = Number((k * step).toPrecision(12));
    const words = digits > 3 ? localised(String(Number(value.toPrecision(digits)))).replace('-', '−') : plain(value);
    const said = `${words} ${k === last ? unit : ''}`.trim();
    c.font = letters(13);
    const half = c.measureText(said).width / 2;
    const x = xOf(value / factor);
    if (x > half && x < wide - half) word(c, said, x, base + 16 * scale, { color: COLOR.soft });
  }
}

/**
 * @param {Context} c
 * @param {Result} result
 * @param {number[]} quantiles
 * @param {(value: number) => number} xOf
 * @param {[top: number, base: number]} down
 * @param {[left: number, right: number]} across
 * @param {boolean} narrow
 */
function drawQuantiles(c, result, [p5, p50, p95], xOf, [top, base], [left, right], narrow) {
  c.strokeStyle = COLOR.soft;
  c.lineWidth = 1;
  for (const value of [p5, p95]) mark(c, Math.round(xOf(value)) + 0.5, top - 10, 0, base - top + 10);
  const wide = 104 * scale;
  const middle = Math.min(Math.max(xOf(p50), left + 1.5 * wide), right - 1.5 * wide);
  const [size, y] = narrow ? [14, top - 38 * scale] : [16, top - 36 * scale];
  const places = /** @type {const} */ ([
    [p5, Math.max(left + wide / 2, Math.min(xOf(p5), middle - wide)), text('whatif.below')],
    [p50, middle, text('whatif.median')],
    [p95, Math.min(right - wide / 2, Math.max(xOf(p95), middle + wide)), text('whatif.beyond')],
  ]);
  for (const [value, x, words] of places) {
    word(c, written(result, value), x, y, { size, weight: '650 ' });
    word(c, words, x, y + 17 * scale, { size: 12, color: COLOR.soft });
  }
}

/**
 * What the tones are.
 * @param {Context} c
 * @param {Float64Array} contacts
 * @param {number[]} counts
 * @param {number} left
 * @param {boolean} narrow
 * @returns {number} where it ends
 */
function drawKey(c, contacts, counts, left, narrow) {
  if (counts.length < 2) return left;
  let x = left;
  const y = 13 * scale;
  const frequent = counts.map((count) => contacts.filter((each) => each === count).length / contacts.length);
  counts.slice(0, narrow ? 2 : 4).forEach((count, k) => {
    c.fillStyle = toneOf(count);
    c.beginPath();
    c.roundRect(x, y - 6, 12, 12, 3);
    c.fill();
    const words = text('whatif.contacts-share', { count, share: plain(Math.round(100 * frequent[k])) });
    word(c, words, x + 18, y, { align: 'left' });
    c.font = letters(13);
    x += 18 + c.measureText(words).width + 16;
  });
  return x;
}

/**
 * @param {Context} c
 * @param {number} share
 * @param {string} value
 * @param {number} x
 * @param {[left: number, right: number]} across
 * @param {boolean} narrow
 */
function drawShare(c, share, value, x, [left, right], narrow) {
  const words = text('whatif.above', { share: percentOf(share), value });
  c.font = letters(14, '600 ');
  const half = c.measureText(words).width / 2;
  const at = Math.min(Math.max(x, left + half), right - half);
  word(c, words, at, (narrow ? 34 : 14) * scale, { size: 14, weight: '600 ', color: COLOR.accent });
}

/**
 * A share as it is said: less than one in a hundred as that.
 * @param {number} share
 */
export const percentOf = (share) => {
  if (share > 0 && share < 0.005) return '< 1';
  return share < 1 && share > 0.995 ? '> 99' : String(Math.round(100 * share));
};
