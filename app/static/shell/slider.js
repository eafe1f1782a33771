// A choice that is a number: a slider, linear or logarithmic, and a field for the exact value.
import { family, text } from '../text/catalogue.js';
import { pretty } from '../text/format.js';
import { signsOf, typed } from '../text/units.js';
import { make } from './dom.js';

/** @import { Label } from '../text/words.js' */
/** @import { Bounds } from './model.js' */

const STEPS = 1000;
const FAR = 100; // times the lowest value: a slider that reaches so far is logarithmic
/** @type {Record<string, number>} */
const ARROWS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };

export class Slider {
  held = false; // by a hand
  value = NaN; // that the server holds

  /**
   * @param {string} name
   * @param {Label} label
   * @param {Bounds} bounds
   * @param {(value: number) => void} send
   * @param {(sentence: string) => void} complain
   */
  constructor(name, { title, unit = '', beside = unit }, bounds, send, complain) {
    this.name = name;
    this.unit = unit;
    this.beside = beside;
    this.title = title;
    this.log = bounds.low > 0 && bounds.high >= FAR * bounds.low;
    this.bounds = bounds;
    this.send = send;
    this.complain = complain;
    const id = `choice-${name}`;
    this.range = make('input', { type: 'range', id, min: 0, max: STEPS, step: 1 });
    this.number = make('input', { type: 'text', inputMode: 'decimal', className: 'number', maxLength: 24 });
    this.number.autocomplete = 'off';
    this.number.ariaLabel = text('controls.exact-value', { title });
    this.range.oninput = () => this.#moved(this.#toValue(Number(this.range.value)));
    this.range.onchange = () => (this.held = false);
    this.range.onkeydown = (event) => this.#key(event);
    this.number.onchange = () => this.#typed();
    const label = make('label', { htmlFor: id, textContent: title });
    const head = make('div', { className: 'field-head' }, label, this.number);
    head.append(make('span', { className: 'unit', textContent: beside }));
    head.dataset.term = name;
    this.range.dataset.term = name;
    this.root = make('div', { className: `field field-${name}` }, head, this.range);
    const { low, high } = family(`ends.${name}`);
    if (low && high) this.root.append(make('p', { className: 'ends' }, make('span', {}, low), make('span', {}, high)));
  }
  /** @param {number} place */
  #toValue(place) {
    const { low, high, whole } = this.bounds;
    const share = place / STEPS;
    const value = this.log ? low * (high / low) ** share : low + (high - low) * share;
    return whole ? Math.round(value) : Number(value.toPrecision(this.log ? 3 : 12));
  }
  /** @param {number} value */
  #toPlace(value) {
    const { low, high } = this.bounds;
    const share = this.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return Math.round(STEPS * share);
  }
  /** @param {number} value */
  #write(value) {
    const { beside, number, range } = this;
    number.value = this.bounds.whole ? String(value) : pretty(value);
    range.ariaValueText = `${number.value} ${beside}`;
    range.style.setProperty('--fill', `${(this.#toPlace(value) / STEPS) * 100}%`);
  }
  /** @param {number} value */
  #moved(value) {
    this.held = true;
    this.#write(value);
    this.send(value);
  }
  /**
   * Whole numbers move by whole numbers, also where the scale is logarithmic.
   * @param {KeyboardEvent} event
   */
  #key(event) {
    const { low, high, whole } = this.bounds;
    const way = ARROWS[event.key];
    if (!whole || !way) return;
    event.preventDefault();
    const value = Math.min(Math.max(Number(this.number.value) + way, low), high);
    this.range.value = String(this.#toPlace(value));
    this.#write(value);
    this.send(value);
  }
  #typed() {
    const { low, high, whole } = this.bounds;
    const given = this.number.value.trim();
    const value = typed(given, this.unit);
    if (whole ? Number.isInteger(value) : !Number.isNaN(value)) {
      this.send(value);
      return;
    }
    const said = { control: this.title, value: `“${given.slice(0, 24)}”`, whole, low, high, unit: this.unit || 'none' };
    this.complain(text('refused.typed', { ...said, units: signsOf(this.unit) }));
    this.#write(this.value);
  }
  /**
   * @param {number} value
   * @param {boolean} refused  also where the hand still holds the slider
   */
  set(value, refused) {
    this.value = value;
    if (refused) this.held = false;
    if (this.held) return;
    this.range.value = String(this.#toPlace(value));
    this.#write(value);
  }
}
