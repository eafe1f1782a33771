// Fields for numbers in the unit that a visitor thinks in.
import { make } from '../shell/dom.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';
import { signsOf, typed } from '../text/units.js';

/**
 * @typedef {object} Unit
 * @property {string} sign
 * @property {string} many  "percent", of the label
 * @property {number} times  what is shown over what is sent
 * @property {string} [si]  the unit that is sent, where it is another one
 */

/**
 * @typedef {object} UnitField
 * @property {HTMLElement} root
 * @property {(value: number) => void} set  show a value, unless the visitor is writing one
 */

/**
 * A number from `low` to `high` that is shown in another unit than the one that is sent.
 * @param {string} label
 * @param {Unit} unit
 * @param {number} low
 * @param {number} high
 * @param {(value: number) => void} send
 * @param {(sentence: string) => void} complain
 * @returns {UnitField}
 */
export function unitField(label, { sign, many, times, si = sign }, low, high, send, complain) {
  const input = make('input', { type: 'text', inputMode: 'decimal', className: 'number', maxLength: 24 });
  input.autocomplete = 'off';
  input.ariaLabel = text('panel.field', { label, unit: many });
  let last = '';
  input.onchange = () => {
    const value = typed(input.value, si, 1 / times);
    if (value >= low && value <= high) {
      send(value);
      return;
    }
    const range = { low: times * low, high: times * high, unit: sign, units: signsOf(si), whole: false };
    complain(text('refused.typed', { control: label, value: `“${input.value.slice(0, 24)}”`, ...range }));
    input.value = last;
  };
  const root = make(
    'label',
    { className: 'part' },
    label,
    input,
    make('span', { className: 'unit', textContent: sign }),
  );
  const set = (/** @type {number} */ value) => {
    last = localised(String(Number((times * value).toPrecision(4))));
    if (!input.matches(':focus')) input.value = last;
  };
  return { root, set };
}

/**
 * A share, shown as a percentage.
 * @param {string} label
 * @param {number} low
 * @param {number} high
 * @param {(value: number) => void} send
 * @param {(sentence: string) => void} complain
 */
export const percentField = (label, low, high, send, complain) =>
  unitField(label, { sign: '%', many: text('panel.percent'), times: 100, si: '1' }, low, high, send, complain);

/**
 * A time [s], shown in milliseconds.
 * @param {string} label
 * @param {number} low
 * @param {number} high
 * @param {(value: number) => void} send
 * @param {(sentence: string) => void} complain
 */
export const msField = (label, low, high, send, complain) =>
  unitField(label, { sign: 'ms', many: text('panel.milliseconds'), times: 1000, si: 's' }, low, high, send, complain);
