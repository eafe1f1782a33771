// Numbers as the page writes them: a true minus sign, as many digits as are meant, units of a handy size.
import { CATALOGUE } from './came.js';

const { language } = CATALOGUE;
export const DECIMAL =
  new Intl.NumberFormat(language).formatToParts(0.5).find(({ type }) => type === 'decimal')?.value ?? '.';

/**
 * A number as JavaScript writes it, with the decimal sign of the language.
 * @param {string} number
 */
export const localised = (number) => (DECIMAL === '.' ? number : number.replace('.', DECIMAL));

const GROUPED = new Intl.NumberFormat(language); // made once, as are others below: that takes longer than to use it
/**
 * Thousands apart.
 * @param {number} value
 */
export function grouped(value) {
  const written = GROUPED.format(value);
  return DECIMAL === '.' ? written : written.replaceAll('.', '\u202f'); // which would be read as a decimal sign
}

/** @type {Record<number, Intl.NumberFormat>} */
const FORMATS = {}; // for each number of digits
/** @param {number} digits */
const formatOf = (digits) =>
  (FORMATS[digits] ??= new Intl.NumberFormat(language, { maximumSignificantDigits: digits, useGrouping: false }));

/**
 * So many significant digits; what is smaller than 1e-12 is nought.
 * @param {number} value
 */
export const figures = (value, digits = 3) =>
  Math.abs(value) < 1e-12 ? '0' : formatOf(digits).format(value).replace('-', '−');

/**
 * Four digits; very large and very small numbers by powers of ten, as a field takes them back.
 * @param {number} value
 */
export function pretty(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3)
    return localised(
      value
        .toExponential(2)
        .replace(/\.?0+e/, 'e')
        .replace('e+', 'e'),
    );
  return localised(String(Number(value.toPrecision(4))));
}

/**
 * Three digits; very large and very small numbers with an exponent.
 * @param {number} value
 */
export const brief = (value) => {
  const size = Math.abs(value);
  const plain = value === 0 || (size < 1e5 && size >= 1e-3);
  return localised(plain ? String(Number(value.toPrecision(3))) : value.toExponential(2)).replaceAll('-', '−');
};

/**
 * So many digits after the point; no minus before what rounds to nought.
 * @param {number} value
 */
export const signed = (value, digits = 3) =>
  `${value < 0 && Number(value.toFixed(digits)) !== 0 ? '−' : ''}${localised(Math.abs(value).toFixed(digits))}`;

/** @param {number} part */
export const percent = (part) => `${localised((100 * part).toFixed(Math.abs(part) < 0.0995 ? 2 : 1))} %`;

/**
 * An error as a share of what is right.
 * @param {number} error
 */
export const share = (error) =>
  error === 0 ? '0 %' : error < 5e-8 ? '< 10⁻⁵ %' : error > 10 ? '> 1000 %' : `${figures(100 * error, 2)} %`;

const DIGITS = '⁰¹²³⁴⁵⁶⁷⁸⁹';
/** @param {number} power */
export const raised = (power) =>
  `${power < 0 ? '⁻' : ''}${[...String(Math.abs(power))].map((digit) => DIGITS[Number(digit)] ?? '·').join('')}`;
/**
 * A power of ten, given by its exponent.
 * @param {number} power
 */
export const decade = (power) =>
  power >= -3 && power <= 3 ? localised(String(Number((10 ** power).toPrecision(1)))) : `10${raised(power)}`;
/**
 * A share as a percentage, 10^-2 as "1 %".
 * @param {number} power
 */
export const percentDecade = (power) => `${decade(power + 2)} %`;
/**
 * Numbers such as 1.9e+10 in a sentence as powers of ten.
 * @param {string} text
 */
export const powered = (text) =>
  text.replace(
    /(\d[\d.]*)e([+-]\d+)/g,
    (said, digits, power) => `${digits === '1' ? '' : `${digits}·`}10${raised(Number(power))}`,
  );

const UNITS = /(?<=[\d⁰¹²³⁴⁵⁶⁷⁸⁹∞]) (?=(?:[GMkmµn]?(?:N|Pa|m|s|J|Hz|g)|rad|T|v|%)(?![\p{L}\d]))/gu;
const PRODUCTS = /(?<=[\d⁰¹²³⁴⁵⁶⁷⁸⁹∞][ \u00a0][GMkmµn]?N(?:[ \u00a0]m)?) (?=[ms](?![\p{L}\d]))/gu;
/**
 * Lines do not break between a number and its unit, nor within one as N s.
 * @param {string} words
 */
export const unbroken = (words) => words.replace(UNITS, '\u00a0').replace(PRODUCTS, '\u00a0');

const PREFIXED = new Set(['N', 'Hz', 'Pa']);

/**
 * A scale for numbers of this size: factor and prefix of the unit.
 * @param {number} size
 * @returns {[factor: number, prefix: string]}
 */
export const prefixed = (size) =>
  size >= 2e6 ? [1e-6, 'M'] : size >= 2e3 ? [1e-3, 'k'] : size < 0.5 && size > 0 ? [1e3, 'm'] : [1, ''];

/**
 * The same for a unit: factor and name. Most lengths [m] are small here.
 * @param {number} size
 * @param {string} unit
 * @returns {[factor: number, name: string]}
 */
export function scaled(size, unit) {
  if (unit === 'm' && size >= 1) return [1, 'm'];
  if (unit === 'm') return size > 3e-3 ? [1e3, 'mm'] : size > 3e-7 || size === 0 ? [1e6, 'µm'] : [1e9, 'nm'];
  const [factor, prefix] = PREFIXED.has(unit) ? prefixed(size) : [1, ''];
  return [factor, `${prefix}${unit}`];
}

/** By a thousand each. */
export const PREFIXES = { n: 1e-9, µ: 1e-6, m: 1e-3, '': 1, k: 1e3, M: 1e6, G: 1e9 };
const SIGNS = Object.keys(PREFIXES);

/**
 * A value in SI units with the prefix that suits it: 100 µs rather than 0.0001 s. As in solvers/text/messages.py.
 * @param {number} value
 * @param {string} unit
 */
export function engineering(value, unit, digits = 3) {
  const rounded = Number(value.toPrecision(digits));
  if (!rounded) return `0 ${unit}`;
  const power = Number(rounded.toExponential().split('e')[1]);
  const step = Math.min(Math.max(Math.floor(power / 3), -3), 3);
  return `${figures(rounded / 1000 ** step, digits)} ${SIGNS[step + 3]}${unit}`;
}

/** @param {number} seconds */
export const duration = (seconds) => engineering(seconds, 's');
/** @param {number} v */
export const speed = (v) => `${figures(v)} m/s`;
/** @param {number} m */
export const length = (m) => engineering(m, 'm');
