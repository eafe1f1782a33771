// One value that is known only to some percent: the percentage, to be set, and what it has to do with a result.
import { cleared } from '../charts/canvas.js';
import { NumberField } from '../form/number_field.js';
import { pretty } from '../text/format.js';
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { nameOf } from './sentence.js';

/** @import { Axis } from './axes.js' */

const STEPS = [0, 0.1, 0.2, 0.5, 1, 2, 3, 5, 10, 20, 30, 50]; // %
const MOST = 90; // %
const EVERY = 10; // %, that all values are offered at once
const DOTS = 900; // impacts at most

export class ToleranceRow {
  bar = make('i');
  share = make('strong');
  effect = make('span');
  canvas = make('canvas');

  /**
   * @param {Axis} axis
   * @param {(part: number) => void} set  1 is all of the value
   */
  constructor(axis, set) {
    this.axis = axis;
    const control = nameOf(axis);
    const name = make('span', { className: 'name', textContent: control, title: control });
    const take = (/** @type {number} */ percent) => set(percent / 100);
    this.number = new NumberField({ control, sign: '%' }, () => [0, MOST], pretty, take);
    this.number.input.ariaLabel = text('whatif.tolerance-of', { name: control });
    this.percent = NaN;
    const next = (/** @type {number} */ way) => {
      const others = STEPS.filter((step) => (step - this.percent) * way > 1e-9);
      if (others.length) take(way > 0 ? others[0] : others[others.length - 1]);
    };
    const step = (/** @type {string} */ sign, /** @type {number} */ way, /** @type {string} */ ariaLabel) =>
      make('button', { type: 'button', textContent: sign, ariaLabel, onclick: () => next(way) });
    const stepper = make(
      'span',
      { className: 'stepper' },
      step('−', -1, text('whatif.narrower', { name: control })),
      make('span', { textContent: '±' }),
      this.number.input,
      make('span', { textContent: '%' }),
      step('+', 1, text('whatif.wider', { name: control })),
    );
    const found = make('span', { className: 'found' }, this.share, this.effect);
    this.box = make('span', { className: 'dots', ariaHidden: 'true' }, this.canvas);
    const bar = make('span', { className: 'bar', ariaHidden: 'true' }, this.bar);
    this.root = make('div', { role: 'listitem' }, name, stepper, bar, found, this.box, this.number.wrong);
  }
  /** @param {number} part */
  set(part) {
    this.percent = Number((100 * part).toPrecision(6));
    this.number.set(this.percent);
  }
  /**
   * @param {string} share
   * @param {number} long  of the bar, 0 to 1
   * @param {string} effect
   */
  show(share, long, effect) {
    write(this.share, share);
    write(this.effect, effect);
    this.bar.style.width = `${100 * long}%`;
  }
  /** It has no tolerance. */
  rest() {
    this.show('–', 0, '');
    cleared(this.canvas, this.box);
  }
  /**
   * Every impact over this value.
   * @param {(n: number) => number} inputOf  −1 to 1
   * @param {Float64Array} values
   * @param {[low: number, high: number]} ends
   * @param {(n: number) => string} toneOf
   */
  dots(inputOf, values, [low, high], toneOf) {
    const found = cleared(this.canvas, this.box);
    if (!found) return;
    const { c, height, width } = found;
    c.globalAlpha = 0.6;
    for (let n = 0; n < Math.min(values.length, DOTS); n++) {
      c.fillStyle = toneOf(n);
      const y = high > low ? (values[n] - low) / (high - low) : 0.5;
      c.fillRect(((inputOf(n) + 1) / 2) * (width - 2), (1 - y) * (height - 2), 1.7, 1.7);
    }
    c.globalAlpha = 1;
  }
}

/** The same tolerance for all values, in a field with a button. */
export class EveryTolerance {
  /** @param {(part: number) => void} set  1 is all of a value */
  constructor(set) {
    let percent = EVERY;
    const take = (/** @type {number} */ value) => {
      percent = value;
    };
    const name = text('whatif.every');
    const number = new NumberField({ control: name, sign: '%' }, () => [0, MOST], pretty, take);
    number.input.ariaLabel = name;
    number.set(percent);
    const button = make('button', { type: 'submit', className: 'whole small', textContent: text('whatif.every-set') });
    const label = make('span', { textContent: text('whatif.every-sign') });
    this.root = make('form', {}, label, number.input, make('span', { textContent: '%' }), button, number.wrong);
    this.root.className = 'whatif-every';
    this.root.onsubmit = (event) => {
      event.preventDefault();
      if (!number.typing) set(percent / 100); // else it has been refused
    };
  }
}
