// A choice that is a number: a slider, linear or logarithmic, and a field for the exact value.
import { family, text } from '../text/catalogue.js';
import { pretty } from '../text/format.js';
import { make } from '../browser/dom.js';
import { NumberField } from './number_field.js';
import { slides } from './swipe.js';

/** @import { Label } from '../text/words.js' */
/** @import { Bounds } from '../wire/model.js' */

const STEPS = 1000;
const FAR = 10; // times the lowest value: a slider that reaches so far is logarithmic
/** @type {Record<string, number>} */
const ARROWS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };

export class Slider {
  held = false; // by a hand
  shown = NaN; // value

  /**
   * @param {string} name
   * @param {Label} label
   * @param {Bounds} bounds
   * @param {(value: number) => void} send
   */
  constructor(name, { title, unit = '', beside = unit }, bounds, send) {
    this.beside = beside;
    this.bounds = bounds;
    this.send = send;
    const id = `choice-${name}`;
    this.range = make('input', { type: 'range', id, min: 0, max: STEPS, step: 1 });
    const { whole } = bounds;
    const shown = (/** @type {number} */ value) => (whole ? String(value) : pretty(value));
    const ends = () => /** @type {[low: number, high: number]} */ ([this.bounds.low, this.bounds.high]);
    this.number = new NumberField({ control: title, sign: unit, whole }, ends, shown, send);
    const { input, wrong, complain } = this.number;
    this.complain = complain;
    input.ariaLabel = text('controls.exact-value', { title });
    slides(this.range, () => this.#moved(this.#toValue(Number(this.range.value))));
    this.range.onchange = () => {
      this.held = false;
    };
    this.range.onkeydown = (event) => this.#key(event);
    const label = make('label', { htmlFor: id, textContent: title });
    const exact = make('span', { className: 'exact' }, input, make('span', { className: 'unit' }, beside));
    const head = make('div', { className: 'field-head' }, label, exact);
    head.dataset.term = name;
    this.range.dataset.term = name;
    this.root = make('div', { className: `field field-${name}` }, head, wrong, this.range);
    const { low, high } = family(`ends.${name}`);
    if (!low || !high) return;
    this.root.append(make('p', { className: 'ends' }, make('span', {}, low), make('span', {}, high)));
    this.root.classList.add('ended');
  }
  get log() {
    return this.bounds.low > 0 && this.bounds.high >= FAR * this.bounds.low;
  }
  /**
   * Other ends, between which what is shown is found again.
   * @param {Bounds} bounds
   */
  reach(bounds) {
    this.bounds = bounds;
    this.held = false;
    if (!Number.isNaN(this.shown)) this.set(this.shown, false);
  }
  /** @param {number} place */
  #toValue(place) {
    const { low, high, whole } = this.bounds;
    const share = place / STEPS;
    const value = this.log ? low * (high / low) ** share : low + (high - low) * share;
    const rounded = whole ? Math.round(value) : Number(value.toPrecision(this.log ? 3 : 12));
    return Math.min(Math.max(rounded, low), high); // also where an end has more digits
  }
  /** @param {number} value */
  #toPlace(value) {
    const { low, high } = this.bounds;
    const share = this.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return Math.round(STEPS * share);
  }
  /** @param {number} value */
  #write(value, always = true) {
    const { beside, number, range } = this;
    this.shown = value;
    number.set(value, always);
    range.ariaValueText = `${number.last} ${beside}`;
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
    const value = Math.min(Math.max(this.shown + way, low), high);
    this.range.value = String(this.#toPlace(value));
    this.#write(value);
    this.send(value);
  }
  /**
   * @param {number} value
   * @param {boolean} refused  also where the hand still holds the slider
   */
  set(value, refused) {
    if (refused) this.held = false;
    if (this.held) return;
    this.range.value = String(this.#toPlace(value));
    this.#write(value, refused);
  }
}
