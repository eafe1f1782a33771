// What all charts share: a head with a title and a legend, and two canvases: what changes with a solve below, what
// moves with time above.
import { make } from '../browser/dom.js';
import { signed } from '../text/format.js';
import { letters, scale, sized, sizeOf, wiped } from './canvas.js';
import { ticks, within } from './scale.js';
import { COLORS } from './styles.js';

/** @typedef {import('./scale.js').Range} Range */
/** @typedef {import('./legend.js').Key} Key */

export const FONT = letters(13);
export const CHARACTER = 7.1 * scale; // pixels of a digit in it

export class Plot {
  /** @type {Range} */ x = [0, 1];
  /** @type {Range} */ y = [0, 1];
  margin = { left: 52 * scale, right: 10, top: 6, bottom: 20 * scale };
  width = 0;
  height = 0;
  ratio = 1;
  /** @type {{ x: number, y: number, w: number, h: number } | null} */ box = null; // none before it was drawn
  /** @type {((value: number, digits: number) => string) | null} */ label = null; // of a tick upward
  xUnit = ''; // written at the last tick across
  across = 1; // of values across, for that unit
  unitAt = 0; // where it is written [pixels]
  /** @type {Map<string, HTMLOutputElement>} */ values = new Map(); // of curves at the clock, by their names
  #said = '';

  /**
   * @param {string} title
   * @param {string} about  what is to be seen, for those who do not see it
   */
  constructor(title, about) {
    this.title = make('h2', { textContent: title });
    this.unit = make('span', { className: 'unit' });
    this.legend = make('span', { className: 'legend' });
    this.value = make('output', { className: 'readout', ariaLive: 'off' });
    this.head = make('header', { className: 'chart-head' }, this.title, this.unit, this.legend, this.value);
    this.below = make('canvas', { role: 'img', ariaLabel: about });
    this.above = make('canvas', { className: 'above', ariaHidden: 'true' });
    this.area = make('div', { className: 'chart-area' }, this.below, this.above);
    this.root = make('section', { className: 'chart' }, this.head, this.area);
  }

  /** Make the canvases as large as the chart; false while it has no size. */
  fit() {
    const [width, height] = sizeOf(this.area);
    if (!width || !height) return false;
    sized(this.below, width, height);
    this.ratio = sized(this.above, width, height);
    Object.assign(this, { width, height });
    const { left, right, top, bottom } = this.margin;
    this.box = { x: left, y: top, w: width - left - right, h: height - top - bottom };
    return true;
  }

  /** The box of the axes in pixels. Raises an error before the first `fit`. */
  get frame() {
    if (!this.box) throw new Error('the chart has no size yet');
    return this.box;
  }

  /** @param {number} x */
  px(x) {
    return this.frame.x + ((x - this.x[0]) / (this.x[1] - this.x[0])) * this.frame.w;
  }

  /** @param {number} y */
  py(y) {
    return this.frame.y + ((this.y[1] - y) / (this.y[1] - this.y[0])) * this.frame.h;
  }

  /**
   * Place of a pointer in the box, as shares of it from the left and from below.
   * @param {{ clientX: number, clientY: number }} event
   * @returns {[across: number, up: number]}
   */
  place(event) {
    const from = this.area.getBoundingClientRect();
    const { x, y, w, h } = this.frame;
    return [(event.clientX - from.left - x) / w, 1 - (event.clientY - from.top - y) / h];
  }

  /** @param {HTMLCanvasElement} layer */
  begin(layer) {
    return wiped(layer, this.width, this.height, this.ratio);
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {boolean} [grid]
   */
  axes(c, grid = true) {
    const { x: left, y: top, w, h } = this.frame;
    const vertical = ticks(Math.min(...this.y), Math.max(...this.y), Math.max(h / 34, Math.min(2, h / 18)));
    const across = ticks(this.x[0] * this.across, this.x[1] * this.across, w / 70);
    c.font = FONT;
    c.lineWidth = 1;
    c.fillStyle = COLORS.faint;
    c.strokeStyle = COLORS.grid;
    c.beginPath();
    const ys = vertical.found.map((v) => Math.round(this.py(v)) + 0.5);
    const xs = across.found.map((v) => Math.round(this.px(v / this.across)) + 0.5);
    for (const y of grid ? ys : []) {
      c.moveTo(left, y);
      c.lineTo(left + w, y);
    }
    for (const x of grid ? xs : []) {
      c.moveTo(x, top);
      c.lineTo(x, top + h);
    }
    c.stroke();
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    vertical.found.forEach((v, k) => {
      c.fillText(this.tick(v, vertical.digits), left - 6, within(ys[k], [top + 5, top + h - 5]));
    });
    c.textAlign = 'center';
    c.textBaseline = 'top';
    across.found.forEach((v, k) => {
      const last = k === across.found.length - 1;
      const text = `${signed(v, across.digits)}${last && this.xUnit ? ` ${this.xUnit}` : ''}`;
      const middle = Math.min(xs[k], this.width - 5 - (text.length * CHARACTER) / 2);
      c.fillText(text, middle, top + h + 5);
      if (last) this.unitAt = middle + ((text.length - this.xUnit.length) * CHARACTER) / 2;
    });
    c.strokeStyle = COLORS.edge;
    c.strokeRect(left + 0.5, top + 0.5, w - 1, h - 1);
  }

  /**
   * @param {number} value
   * @param {number} digits
   */
  tick(value, digits) {
    return this.label ? this.label(value, digits) : signed(value, digits);
  }

  /** @param {CanvasRenderingContext2D} c */
  clip(c) {
    const { x, y, w, h } = this.frame;
    c.save();
    c.beginPath();
    c.rect(x, y, w, h);
    c.clip();
  }

  /** @param {Key[]} entries */
  key(entries) {
    const said = entries.map(({ text, color, mark }) => `${text} ${color} ${mark}`).join('|');
    if (said === this.#said) return;
    this.#said = said;
    this.values.clear();
    this.legend.replaceChildren(
      ...entries.map(({ text, color, mark }) => {
        const sign = make('i', { className: mark });
        sign.style.color = color;
        const value = make('output', { ariaLive: 'off' });
        value.style.setProperty('--curve', color);
        this.values.set(text, value);
        return make('span', { className: 'key' }, sign, text, value);
      }),
    );
  }
}

/**
 * Value at a share of an axis.
 * @param {Range} range
 * @param {number} share
 */
export const valueAt = ([low, high], share) => low + within(share, [0, 1]) * (high - low);
