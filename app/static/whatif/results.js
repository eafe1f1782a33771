// What is found of an impact, as a map shows it: which number of those that are found, its unit and its colours.
import { text } from '../text/catalogue.js';
import { engineering, figures, localised, scaled } from '../text/format.js';
import { COLUMNS } from '../wasm/columns.js';

/** @typedef {Exclude<Mapped, 'model'>} Result */
/** @typedef {keyof typeof RESULTS} Mapped  what a map shows */
/**
 * @typedef {object} Shown
 * @property {string} unit
 * @property {'heat' | 'cold' | 'steel' | 'steps' | 'models'} colours
 * @property {boolean} [log]
 * @property {boolean} [whole]
 * @property {boolean} [nought]  nought belongs to its scale
 */

/** @satisfies {Record<string, Shown>} */
export const RESULTS = {
  peak_force: { unit: 'N', colours: 'heat', log: true },
  impactor_velocity: { unit: 'm/s', colours: 'cold' },
  vibration: { unit: '%', colours: 'heat', nought: true },
  contacts: { unit: '', colours: 'steps', whole: true },
  contact_time: { unit: 's', colours: 'steel', log: true },
  peak_stress: { unit: 'Pa', colours: 'heat', log: true },
  target_velocity: { unit: 'm/s', colours: 'cold' },
  newton: { unit: '', colours: 'cold' },
  peak_indentation: { unit: 'm', colours: 'heat', log: true },
  dissipated: { unit: '%', colours: 'heat', nought: true },
  model: { unit: '', colours: 'models', whole: true }, // the smallest that is enough for another
};
export const NAMES = /** @type {Result[]} */ (Object.keys(RESULTS).filter((name) => name !== 'model'));

/** Places of the numbers that are found. */
export const PLACE = /** @type {Record<string, number>} */ (
  Object.fromEntries(COLUMNS.map((/** @type {string} */ name, /** @type {number} */ k) => [name, k]))
);
export const WIDTH = COLUMNS.length;

/** @param {Mapped} name */
export const shownOf = (name) => /** @type {Shown} */ (RESULTS[name]);

/** @param {Result} name */
export const titleOf = (name) => text(`whatif.result.${name}`);

/** @param {Result} name */
export const shortOf = (name) => text(`whatif.short.${name}`);

/**
 * The value of a result in a row of numbers; shares in percent.
 * @param {Mapped} name
 * @param {ArrayLike<number>} found
 * @param {number} at  where its row begins
 */
export const valueOf = (name, found, at = 0) => found[at + PLACE[name]] * (RESULTS[name].unit === '%' ? 100 : 1);

/**
 * A value with its unit.
 * @param {Mapped} name
 * @param {number} value
 */
export function written(name, value) {
  const { unit, whole } = shownOf(name);
  if (!Number.isFinite(value)) return '–';
  if (whole) return String(Math.round(value));
  if (unit === 'N' || unit === 'Pa' || unit === 's' || unit === 'm') return engineering(value, unit);
  return unit ? `${figures(value)} ${unit}` : figures(value);
}

/**
 * A unit of a handy size for a scale, and how many of it one is.
 * @param {Mapped} name
 * @param {[low: number, high: number]} domain  logarithms where the scale is
 * @returns {[factor: number, unit: string]}
 */
export function unitFor(name, [low, high]) {
  const { log, unit } = shownOf(name);
  const most = log ? 10 ** ((low + high) / 2) : Math.max(Math.abs(low), Math.abs(high));
  if (unit === 's') return most < 2e-3 ? [1e6, 'µs'] : most < 2 ? [1e3, 'ms'] : [1, 's'];
  return unit === '%' || unit === 'm/s' || !unit ? [1, unit] : scaled(most, unit);
}

/** @param {number} value  round */
export const plain = (value) => localised(String(Number(value.toPrecision(3)))).replace('-', '−');
