// Numbers as the page writes them: a true minus sign, as many digits as are meant, units of a handy size.

/** @type {Record<number, Intl.NumberFormat>} */
const FORMATS = {}; // made once for each number of digits: to make one takes longer than to use it
/** @param {number} digits */
const formatOf = (digits) =>
  (FORMATS[digits] ??= new Intl.NumberFormat('en', { maximumSignificantDigits: digits, useGrouping: false }));

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
    return value
      .toExponential(2)
      .replace(/\.?0+e/, 'e')
      .replace('e+', 'e');
  return String(Number(value.toPrecision(4)));
}

/**
 * Three digits; very large and very small numbers with an exponent.
 * @param {number} value
 */
export const brief = (value) => {
  const size = Math.abs(value);
  const plain = value === 0 || (size < 1e5 && size >= 1e-3);
  return (plain ? String(Number(value.toPrecision(3))) : value.toExponential(2)).replace('-', '−');
};

/**
 * So many digits after the point; no minus before what rounds to nought.
 * @param {number} value
 */
export const signed = (value, digits = 3) =>
  `${value < 0 && Number(value.toFixed(digits)) !== 0 ? '−' : ''}${Math.abs(value).toFixed(digits)}`;

/**
 * @param {number} n
 * @param {string} word
 */
export const count = (n, word) => `${n} ${word}${n === 1 ? '' : 's'}`;
/** @param {number} share */
export const percent = (share) => `${(100 * share).toFixed(Math.abs(share) < 0.0995 ? 2 : 1)} %`;

/**
 * An error as a share of what is right.
 * @param {number} error
 */
export const share = (error) =>
  error === 0 ? 'nothing' : error < 5e-8 ? '< 10⁻⁵ %' : error > 10 ? '> 1000 %' : `${figures(100 * error, 2)} %`;

const DIGITS = '⁰¹²³⁴⁵⁶⁷⁸⁹';
/** @param {number} power */
export const raised = (power) =>
  `${power < 0 ? '⁻' : ''}${[...String(Math.abs(power))].map((digit) => DIGITS[Number(digit)]).join('')}`;
/**
 * A power of ten, given by its exponent.
 * @param {number} power
 */
export const decade = (power) =>
  power >= -3 && power <= 3 ? String(Number((10 ** power).toPrecision(1))) : `10${raised(power)}`;
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

const PREFIXED = new Set(['N', 'Hz']);

/**
 * A scale for numbers of this size: factor and prefix of the unit.
 * @param {number} size
 * @returns {[factor: number, prefix: string]}
 */
export const prefixed = (size) =>
  size >= 2e6 ? [1e-6, 'M'] : size >= 2e3 ? [1e-3, 'k'] : size < 0.5 && size > 0 ? [1e3, 'm'] : [1, ''];

/**
 * The same for a unit: factor and name. Lengths [m] are small here.
 * @param {number} size
 * @param {string} unit
 * @returns {[factor: number, name: string]}
 */
export function scaled(size, unit) {
  if (unit === 'm') return size > 3e-3 ? [1e3, 'mm'] : size > 3e-7 || size === 0 ? [1e6, 'µm'] : [1e9, 'nm'];
  const [factor, prefix] = PREFIXED.has(unit) ? prefixed(size) : [1, ''];
  return [factor, `${prefix}${unit}`];
}

/**
 * A time [ms], a speed [m/s] and a length [m] in words.
 * @param {number} ms
 */
export const duration = (ms) =>
  ms === 0
    ? 'no time'
    : Math.abs(ms) < 0.9995
      ? `${figures(ms * 1e3)} µs`
      : Math.abs(ms) < 999.5
        ? `${figures(ms)} ms`
        : `${figures(ms / 1e3)} s`;
/** @param {number} v */
export const speed = (v) => `${figures(v)} m/s`;
/** @param {number} m */
export const length = (m) => (Math.abs(m) < 1e-3 ? `${figures(m * 1e6)} µm` : `${figures(m * 1e3)} mm`);

/**
 * A time below a second [s] with the unit that suits it.
 * @param {number} value
 */
export function shortTime(value) {
  const [times, unit] = value < 1e-6 ? [1e9, 'ns'] : value < 1e-3 ? [1e6, 'µs'] : value < 1 ? [1e3, 'ms'] : [1, 's'];
  return `${Number((times * value).toPrecision(3))} ${unit}`;
}
