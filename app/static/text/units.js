// The units in which numbers are shown and can be typed, and what was typed as a number in the unit that is sent. What
// columns of records can be in, which Python alone reads, is said in solvers/records/files.py.

import { DECIMAL, PREFIXES } from './format.js';

/** @typedef {{ sign: string, factor: number }} Unit  what is shown times the factor is in SI units */

const MULTIPLES = { ...PREFIXES, c: 1e-2 };
const [INCH, FOOT, POUND, GRAVITY] = [0.0254, 0.3048, 0.45359237, 9.80665];
const POUND_FORCE = POUND * GRAVITY;

/**
 * A unit with these prefixes, itself where there is a blank among them.
 * @param {string} prefixes
 * @param {string} unit
 * @param {number} [factor]  of the unit alone
 * @param {number} [power]  in which the prefix counts
 */
const prefixed = (prefixes, unit, factor = 1, power = 1) =>
  Object.fromEntries(
    [...prefixes].map((prefix) => {
      const times = prefix === ' ' ? 1 : MULTIPLES[/** @type {keyof typeof MULTIPLES} */ (prefix)];
      return [`${prefix.trim()}${unit}`, Number((factor * times ** power).toPrecision(15))];
    }),
  );

/**
 * By the unit that is sent: signs, and how many of it each is.
 * @type {Record<string, Record<string, number>>}
 */
const UNITS = {
  m: { ...prefixed('µmc k', 'm'), in: INCH, ft: FOOT },
  'm²': { ...prefixed('mc ', 'm²', 1, 2), 'in²': INCH ** 2, 'ft²': FOOT ** 2 },
  'm⁴': { ...prefixed('mc ', 'm⁴', 1, 4), 'in⁴': INCH ** 4 },
  kg: { ...prefixed('m k', 'g', 1e-3), t: 1e3, oz: POUND / 16, lb: POUND },
  Pa: { ...prefixed(' kMG', 'Pa'), 'N/mm²': 1e6, bar: 1e5, psi: POUND_FORCE / INCH ** 2 },
  N: { ...prefixed('m kM', 'N'), lbf: POUND_FORCE },
  'N/m': { ...prefixed(' kM', 'N/m'), 'N/mm': 1e3, 'kN/mm': 1e6, 'N/µm': 1e6, 'lbf/in': POUND_FORCE / INCH },
  'kg/m³': { 'kg/m³': 1, 'g/cm³': 1e3, 'lb/in³': POUND / INCH ** 3, 'lb/ft³': POUND / FOOT ** 3 },
  'm/s': { ...prefixed('mc k', 'm/s'), 'km/h': 1 / 3.6, mph: (5280 * FOOT) / 3600, 'in/s': INCH, 'ft/s': FOOT },
  'm/s²': { 'm/s²': 1, g: GRAVITY, 'ft/s²': FOOT },
  s: { ...prefixed('nµm ', 's'), min: 60 },
  '°': { '°': 1, deg: 1, rad: 180 / Math.PI },
  1: { '%': 0.01 }, // a share
  'm/m': prefixed('µ', 'm/m'),
};
/**
 * By SI unit: the units that a value is shown in, each from a size on.
 * @type {Record<string, [sign: string, from: number][]>}
 */
const SHOWN = {
  m: Object.entries({ µm: 0, mm: 1e-4, m: 1 }),
  'm²': Object.entries({ 'mm²': 0, 'm²': 0.1 }),
  'm⁴': Object.entries({ 'mm⁴': 0, 'cm⁴': 1e-7, 'm⁴': 1e-2 }),
  kg: Object.entries({ mg: 0, g: 1e-3, kg: 1 }),
  Pa: Object.entries({ MPa: 0, GPa: 5e9 }),
  'N/m': Object.entries({ 'N/m': 0, 'kN/m': 1e3, 'MN/m': 1e6 }),
  s: Object.entries({ µs: 0, ms: 1e-3, s: 1 }),
};
/** @type {Record<string, string>} */
const ALSO = { '"': 'in', '″': 'in', inch: 'in', inches: 'in', "'": 'ft', '′': 'ft', feet: 'ft', foot: 'ft' };
Object.assign(ALSO, { lbs: 'lb', kph: 'km/h', kmh: 'km/h' });

const NUMBER = String.raw`(?:\d+(?:\.\d*)?|\.\d+)(?:e[+-]?\d+)?`;
const GIVEN = new RegExp(String.raw`^([+-]?${NUMBER})(?:\s*/\s*(${NUMBER}))?\s*([^\s\d.]\S*)?$`, 'i');
const DIGITS = 12; // that are sent

/**
 * Signs and factors of the units that go with the one that is sent: that one alone where no other is known.
 * @param {string} si
 * @returns {Record<string, number>}
 */
const unitsOf = (si) => (Object.hasOwn(UNITS, si) ? UNITS[si] : si ? { [si]: 1 } : {});

/**
 * How many of the unit that is sent this one is.
 * @param {string} si
 * @param {string} sign
 */
export const factorOf = (si, sign) => unitsOf(si)[sign] ?? 1;

/**
 * The unit in which a value of this size is shown.
 * @param {string} si
 * @param {number} size
 * @returns {Unit}
 */
export function shownUnit(si, size) {
  const [sign] = (SHOWN[si] ?? []).findLast(([, from]) => Math.abs(size) >= from * (1 - 1e-9)) ?? [si];
  return { sign, factor: factorOf(si, sign) };
}

/**
 * The units that a refusal offers.
 * @param {string} si
 */
export const signsOf = (si) => Object.keys(unitsOf(si));

/** @param {string} sign */
const plain = (sign) => {
  const spelled = sign.replace('^', '').replace(/^[uμ]|(?<=\/)[uμ]/, 'µ');
  const raised = spelled.replace(/[234]$/, (power) => '²³⁴'['234'.indexOf(power)]);
  return Object.hasOwn(ALSO, raised) ? ALSO[raised] : raised;
};

const FOREIGN = DECIMAL === '.' ? ',' : '.';
const THOUSANDS = new RegExp(String.raw`(?<![\d.,])[1-9]\d{0,2}[${FOREIGN}]\d{3}(?!\d)`);

/**
 * Whether a number may be meant with a decimal sign or with thousands apart, as "1,000".
 * @param {string} given
 */
export const ambiguous = (given) => THOUSANDS.test(given);

/**
 * What was typed, in the unit that is sent: a number or a fraction, in the unit of the field or with another one behind
 * it. NaN where it is none, or may be two.
 * @param {string} given
 * @param {string} si  the unit that is sent; none of a plain number
 * @param {number} [factor]  of the unit of the field
 */
export function typed(given, si, factor = 1) {
  const [, number, by = '1', sign = ''] = GIVEN.exec(given.trim().replaceAll(',', '.').replace('−', '-')) ?? [];
  const [units, unit] = [unitsOf(si), plain(sign)];
  const times = !sign ? factor : Object.hasOwn(units, unit) ? units[unit] : NaN;
  if (ambiguous(given)) return NaN;
  const value = (Number(number) / Number(by)) * times;
  return Number.isFinite(value) ? Number(value.toPrecision(DIGITS)) : NaN;
}
