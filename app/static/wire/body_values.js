// Values of bodies: as one text of keys and SI values, in units that a person uses, and in words.
import { family, named, text } from '../text/catalogue.js';
import { engineering, figures, localised } from '../text/format.js';
import { shownUnit, signsOf, typed } from '../text/units.js';
import { jointOf } from '../text/words.js';

/** @import { Frame, PartRecord } from '../messages.js' */
/** @import { Unit } from '../text/units.js' */

const PART = /^(impactor|target(?:\.(?:rods|links|joints)\.\d+)?)\.(.+)$/;
const DIGITS = 6; // of a value in its field
const SI = family('body.unit');
/**
 * Of a joint; 0 is no small length of it.
 * @param {string} quantity
 */
export const isCoordinate = (quantity) => quantity === 'x' || quantity === 'y';

/** @param {string} key */
function partsOfKey(key) {
  const [, part = '', quantity = ''] = PART.exec(key) ?? [];
  return { part, quantity };
}

/**
 * Keys and values of all that is changed.
 * @param {unknown} bodies
 * @returns {[key: string, value: string][]}
 */
export const entriesOf = (bodies) =>
  String(bodies ?? '')
    .split(' ')
    .filter(Boolean)
    .map((each) => /** @type {[string, string]} */ (each.split('=')));

/** @param {[key: string, value: string][]} entries */
export const textOf = (entries) => entries.map((entry) => entry.join('=')).join(' ');

/** @param {string} key */
export const isBodyKey = (key) => PART.test(key);

/** @param {string} quantity */
export const siOf = (quantity) => SI[quantity] ?? '';

/**
 * The unit in which a quantity of this size is shown.
 * @param {string} quantity
 * @param {number} size
 * @returns {Unit}
 */
export const unitOf = (quantity, size) => shownUnit(siOf(quantity), size || (isCoordinate(quantity) ? 1e-3 : 0));

/**
 * A number for a field, in this unit.
 * @param {number} value
 * @param {Unit} unit
 */
export const inUnit = (value, { factor }) => localised(String(Number((value / factor).toPrecision(DIGITS))));

/**
 * A value with its unit.
 * @param {string} quantity
 * @param {number} value
 */
export function written(quantity, value) {
  const si = SI[quantity] ?? '';
  if (si === 's' || si === 'N') return engineering(value, si);
  const { sign, factor } = unitOf(quantity, value);
  return [figures(value / factor, 4), sign].filter(Boolean).join(' ');
}

/**
 * What was typed, in SI units: a number in this unit, or with another one behind it. NaN where it is neither.
 * @param {string} given
 * @param {string} quantity
 * @param {Unit} unit
 */
export const read = (given, quantity, { factor }) => typed(given, SI[quantity] ?? '', factor);

/**
 * The units that a quantity can be typed in.
 * @param {string} quantity
 */
export const unitsFor = (quantity) => signsOf(SI[quantity] ?? '');

/**
 * Which part of a body this is, of a chain or a mechanism.
 * @param {string} key
 * @param {PartRecord[]} parts
 */
export function placeOf(key, parts) {
  const [body, kind = 'none', number = ''] = key.split('.');
  const count = parts.filter((each) => each.key.startsWith(`${body}.${kind}.`)).length;
  return { kind, number, count, part: jointOf((parts.find((each) => each.key === key)?.name ?? number).split(' – ')) };
}

/**
 * What is changed, in words: "Length 600 mm (body 2)".
 * @param {Frame} frame
 */
export const wordsOf = ({ chosen, parts }) =>
  entriesOf(chosen.bodies)
    .map(([key, value]) => {
      const { part, quantity } = partsOfKey(key);
      const shown = quantity === 'material' ? named('material', value) : written(quantity, Number(value));
      const name = text(`body.value.${quantity}`);
      const body = part.startsWith('impactor') ? 1 : 2;
      return text('bodies.changed', { name, shown, body, ...placeOf(part, parts) });
    })
    .join(', ');
