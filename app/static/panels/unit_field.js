// Fields for numbers in the unit that a visitor thinks in.
import { make } from '../browser/dom.js';
import { NumberField } from '../form/number_field.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';
import { factorOf } from '../text/units.js';

/**
 * @typedef {object} Unit
 * @property {string} sign
 * @property {string} many  "percent", of the label
 * @property {string} [si]  the unit that is sent, where it is another one
 */

/**
 * @typedef {object} UnitField
 * @property {HTMLElement} root
 * @property {(value: number) => void} set  show a value, unless the visitor is writing one
 */

/**
 * A number from `low` to `high` that is shown in another unit than the one that is sent.
 * @param {string} control
 * @param {Unit} unit
 * @param {number} low
 * @param {number} high
 * @param {(value: number) => void} send
 * @returns {UnitField}
 */
export function unitField(control, { sign, many, si = sign }, low, high, send) {
  const factor = factorOf(si, sign);
  const written = (/** @type {number} */ value) => localised(String(Number((value / factor).toPrecision(4))));
  const field = new NumberField({ control, sign, si, factor }, () => [low, high], written, send);
  field.input.ariaLabel = text('panel.field', { label: control, unit: many });
  const unit = make('span', { className: 'unit', textContent: sign });
  const label = make('label', { className: 'part' }, control, field.input, unit);
  const root = make('div', { className: 'asked' }, label, field.wrong);
  return { root, set: (/** @type {number} */ value) => field.set(value) };
}

/**
 * A share, shown as a percentage.
 * @param {string} label
 * @param {number} low
 * @param {number} high
 * @param {(value: number) => void} send
 */
export const percentField = (label, low, high, send) =>
  unitField(label, { sign: '%', many: text('panel.percent'), si: '1' }, low, high, send);

/**
 * A time [s], shown in milliseconds.
 * @param {string} label
 * @param {number} low
 * @param {number} high
 * @param {(value: number) => void} send
 */
export const msField = (label, low, high, send) =>
  unitField(label, { sign: 'ms', many: text('panel.milliseconds'), si: 's' }, low, high, send);
