// Places along the axes of a map: equal steps are equal shares of what a choice can be, logarithmic where a slider is.
// The ends of what it can be are places of the lattice at every level.
import { pretty, raised } from '../text/format.js';

/** @import { Axis } from './axes.js' */

const LINEAR = 4; // units of a linear axis
const USUAL = 3; // decades that are shown at first
const DIGITS = 12;
const DIGITS_WRITTEN = 4;

/** @param {Axis} axis  how many units it is long, of about a decade each */
export const longOf = ({ high, log, low }) => (log ? Math.max(1, Math.round(Math.log10(high / low))) : LINEAR);

/**
 * @param {Axis} axis
 * @param {number} value
 */
export function placeOf(axis, value) {
  const { high, log, low } = axis;
  return longOf(axis) * (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
}

/**
 * @param {Axis} axis
 * @param {number} place  within its ends
 */
export function valueAt(axis, place) {
  const { high, log, low, whole } = axis;
  const share = Math.min(Math.max(place / longOf(axis), 0), 1);
  if (share === 0 || share === 1) return share ? high : low;
  const value = log ? low * (high / low) ** share : low + share * (high - low);
  return whole ? Math.round(value) : Number(value.toPrecision(DIGITS));
}

/**
 * A value as a hand sets it: no more digits than a pixel tells apart.
 * @param {Axis} axis
 * @param {number} place
 */
export const roundAt = (axis, place) => Number(valueAt(axis, place).toPrecision(DIGITS_WRITTEN));

/**
 * The stretch of an axis that is shown at first: some decades about the present value.
 * @param {Axis} axis
 * @param {number} value
 * @returns {[from: number, to: number]}  places
 */
export function usualRange(axis, value) {
  const long = longOf(axis);
  if (!axis.log || long <= USUAL) return [0, long];
  const half = USUAL / 2;
  const middle = Math.min(Math.max(placeOf(axis, value), half), long - half);
  return [middle - half, middle + half];
}

/**
 * Where an axis has marks: place, the value that stands there if one does, whether it is a main one.
 * @param {Axis} axis
 * @param {[from: number, to: number]} range  places
 * @param {number} room  pixels
 * @returns {{ place: number, value: number, named: boolean, main: boolean }[]}
 */
export function marksOf(axis, [from, to], room) {
  const [low, high] = [from, to].map((place) => valueAt({ ...axis, whole: false }, place) / axis.factor);
  const mark = (/** @type {number} */ shown, /** @type {boolean} */ named, /** @type {boolean} */ main) => {
    const value = shown * axis.factor;
    return { place: placeOf(axis, value), value, named, main };
  };
  const inside = ({ place = 0 }) => place > from - 1e-9 && place < to + 1e-9;
  const decades = Math.log10(high / low);
  if (!axis.log || decades < 0.7) {
    const rough = ((high - low) * 70) / room;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = ([1, 2, 5].find((each) => each * power >= rough) ?? 10) * power;
    const first = Math.ceil(low / step - 1e-9);
    const count = Math.max(0, Math.floor(high / step + 1e-9) - first + 1);
    return Array.from({ length: count }, (_, k) => mark((first + k) * step, true, true)).filter(inside);
  }
  const each = room / decades; // pixels of a decade
  const heads = each > 170 ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(46 / each));
  const made = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++)
    for (let head = 1; head < 10; head++)
      made.push(mark(head * 10 ** power, heads.includes(head) && power % every === 0, head === 1));
  return made.filter(inside);
}

/**
 * A value of an axis, in its unit.
 * @param {Axis} axis
 * @param {number} value
 */
export const writtenOn = ({ factor, whole }, value) => {
  const shown = value / factor; // rounded once
  return whole ? String(Math.round(shown)) : pretty(shown).replace(/^(.+)e(-?\d+)$/, tens);
};

/**
 * A value that lies between two places, with no more digits than are sure.
 * @param {Axis} axis
 * @param {number} low
 * @param {number} high
 */
export function sureOf(axis, low, high) {
  const ends = [low, high].map((place) => valueAt(axis, place) / axis.factor);
  for (let digits = DIGITS_WRITTEN; digits > 0; digits--) {
    const [a, b] = ends.map((value) => Number(value.toPrecision(digits)));
    if (a === b) return writtenOn(axis, a * axis.factor);
  }
  return ends.map((value) => writtenOn(axis, value * axis.factor)).join('–');
}

/**
 * A number such as 2e10 by powers of ten.
 * @param {string} _
 * @param {string} digits
 * @param {string} power
 */
const tens = (_, digits, power) => `${digits === '1' ? '' : `${digits}·`}10${raised(Number(power))}`;
