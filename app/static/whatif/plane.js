// The map as it is drawn: colours, contours, lines where a contact is gained or lost, what is refused hatched, the
// axes; above it, drawn anew with every movement, the bar of colours and the point of the scene.
import { cleared, letters, scale, sizeOf } from '../charts/canvas.js';
import { make } from '../browser/dom.js';
import { Bar, tickOf } from './bar.js';
import { colouring, paletteOf } from './colours.js';
import { contoursOf, levelsOf, partsOf } from './contours.js';
import { Letters } from './letters.js';
import { COLOR, disc, mark, pill, stroke, word } from './ink.js';
import { marksOf, writtenOn } from './places.js';
import { Raster } from './raster.js';
import { CONTACTS, hatch } from './regions.js';
import { shownOf, written } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Window } from './window.js' */
/** @import { Regions } from './regions.js' */
/** @import { Mapped } from './results.js' */
/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {[low: number, high: number]} Domain  logarithms where the scale is */
/** @typedef {[x: number, y: number]} Spot  pixels */

const STEPS = { still: 2, moving: 3 }; // pixels of the page in one of the picture
const ROUND = 6; // pixels
const LEAST_LINE = 32; // numbers of a contour, below which it is rounding
const NARROW = 560; // pixels of the whole
const WIDE = 46; // pixels about a number, for it to stand with its word
const EDGE = 10; // pixels that a number keeps from the ends of the map
const NAME = 20; // and the value of a contour, which may be turned
const POINT = { halo: 15, dot: 9, reach: 20 }; // pixels

/**
 * @typedef {object} Over
 * @property {Axis} x
 * @property {Axis} y
 * @property {Spot} at  places of the scene on both axes
 * @property {[x: number, y: number]} values
 * @property {Mapped} result
 * @property {number} value
 * @property {number | null} wanted
 * @property {import('./letters.js').Kept[]} kept
 * @property {[from: Spot, to: Spot] | null} way  between two of them
 */

export class Plane {
  base = make('canvas');
  over = make('canvas', { tabIndex: 0, role: 'application' });
  raster = new Raster();
  plot = { x: 0, y: 0, w: 1, h: 1 };
  narrow = false;
  fine = 1; // times as many pixels, of what is taken along
  /** @type {Map<number, number[]>} */ lines = new Map(); // contours
  /** @type {number[]} */ goal = []; // that of the value that is wanted
  /** @type {[x: number, y: number, about: number][]} */ taken = []; // places that words have
  /** @type {Spot} */ at = [0, 0]; // of the point
  /** @type {Domain} */ domain = [0, 1];
  /** @type {Bar | null} */ bar = new Bar();
  letters = new Letters();
  blank = false; // nothing but axes and point is seen, as it is asked for
  /** @type {((c: Context, spot: (places: Spot) => Spot) => void) | null} */ guest = null; // draws above all else

  /** @param {Regions} [regions]  what parts of the map are called, and which are not to be trusted */
  constructor(regions = CONTACTS) {
    this.regions = regions;
    this.over.ariaLabel = regions.about;
    if (regions.listed) this.bar = null;
    this.root = make('div', { className: regions.listed ? 'whatif-models-map' : 'whatif-map' }, this.base, this.over);
  }
  /** Measure its room; whether there is any. */
  measure() {
    const [width, height] = sizeOf(this.root);
    if (!width || !height) return false;
    const narrow = width < NARROW * scale;
    this.narrow = narrow;
    const [left, top] = [(narrow ? 52 : 68) * scale, 30 * scale];
    const [right, below] = [(narrow || !this.bar ? 14 : 92) * scale, (narrow ? 44 : 46) * scale];
    this.plot = { x: left, y: top, w: Math.max(width - left - right, 40), h: Math.max(height - top - below, 40) };
    return true;
  }
  /**
   * All that lies under the point.
   * @param {Window} view  filled
   * @param {Mapped} result
   * @param {Domain} domain
   * @param {number | null} wanted
   * @param {boolean} moving  under a hand
   */
  draw(view, result, domain, wanted, moving) {
    const c = cleared(this.base, this.root)?.c;
    if (!c) return;
    const { plot, raster } = this;
    this.domain = domain;
    if (this.blank) {
      this.#empty(c, view);
      return;
    }
    raster.draw(view, moving ? STEPS.moving : STEPS.still / this.fine, colouring(paletteOf(result), domain));
    c.save();
    c.beginPath();
    c.roundRect(plot.x, plot.y, plot.w, plot.h, ROUND);
    c.clip();
    const { sheet, step } = raster;
    c.drawImage(sheet, plot.x, plot.y, sheet.width * step, sheet.height * step);
    c.translate(plot.x, plot.y);
    if (raster.refused) hatch(c, raster, plot, (count) => count < 0, 1);
    const { weak } = this.regions;
    if (weak) hatch(c, raster, plot, weak, -1);
    const { log, whole } = shownOf(result);
    const levels = whole ? [] : levelsOf(domain, Boolean(log));
    const goal = wanted === null || whole ? null : log ? Math.log10(wanted) : wanted;
    this.lines = contoursOf(raster, goal === null ? levels : [...levels, goal].sort((a, b) => a - b), domain);
    this.goal = goal === null ? [] : (this.lines.get(goal) ?? []);
    c.lineJoin = c.lineCap = 'round';
    for (const [level, line] of this.lines)
      if (level !== goal && line.length >= LEAST_LINE) stroke(c, line, COLOR.contour, 1);
    this.#boundaries(c, view);
    if (this.goal.length) {
      stroke(c, this.goal, COLOR.casing, 6);
      stroke(c, this.goal, COLOR.accent, 2.75);
    }
    const [px, py] = [this.at[0] - plot.x, this.at[1] - plot.y];
    this.taken = [
      [px, py, 30],
      [px + 62, py - 20, 72], // what is written there
    ];
    this.#count(c, view);
    for (const [level, line] of this.lines) if (level !== goal) this.#name(c, result, level, line);
    c.restore();
    this.#axes(c, view);
  }
  /**
   * @param {Context} c
   * @param {Window} view
   */
  #empty(c, view) {
    const { h, w, x, y } = this.plot;
    this.goal = [];
    c.beginPath();
    c.roundRect(x, y, w, h, ROUND);
    c.fillStyle = COLOR.ring;
    c.fill();
    c.strokeStyle = COLOR.line;
    c.lineWidth = 1;
    c.stroke();
    this.#axes(c, view);
  }
  /**
   * Lines where a contact is gained or lost; paler until they are found.
   * @param {Context} c
   * @param {Window} view
   */
  #boundaries(c, view) {
    /** @type {number[]} */
    const line = [];
    /** @type {number[]} */
    const rough = [];
    const { h, w } = this.plot;
    for (const [k, { ends, found }] of this.raster.torn) {
      const spots = ends.map(([x, y]) => view.spot((k % view.nx) + x, Math.floor(k / view.nx) + y));
      const points = spots.map(([x, y]) => [x * w, (1 - y) * h]);
      const to = found ? line : rough;
      if (points.length === 2) to.push(...points[0], ...points[1]);
      else if (points.length === 3) {
        const [x, y] = [0, 1].map((n) => points.reduce((sum, point) => sum + point[n] / 3, 0));
        for (const point of points) to.push(...point, x, y);
      }
    }
    c.globalAlpha = 0.35;
    stroke(c, rough, COLOR.boundary, 1.25);
    c.globalAlpha = 1;
    stroke(c, line, COLOR.casing, 4.5);
    stroke(c, line, COLOR.boundary, 1.75);
  }
  /**
   * How many contacts there are, where it is so.
   * @param {Context} c
   * @param {Window} view
   */
  #count(c, view) {
    const parts = partsOf(view);
    if (parts.length < 2) return;
    const { h, w } = this.plot;
    const [X0, Y0] = view.spot(0, 0);
    const [X1, Y1] = view.spot(1, 1);
    const step = Math.min((X1 - X0) * w, (Y1 - Y0) * h); // pixels of a cell
    for (const { count, depth, i, j } of parts) {
      const [X, Y] = view.spot(i, j);
      const inside = (/** @type {number} */ at, /** @type {number} */ end, room = 0) =>
        Math.min(Math.max(at, EDGE * scale + room), end - EDGE * scale - room);
      const wide = depth * step > WIDE * scale;
      const words = this.regions.named(count, wide);
      c.font = letters(15, '600 ');
      const [x, y] = [inside(X * w, w, wide ? c.measureText(words).width / 2 : 0), inside((1 - Y) * h, h)];
      if (depth < 1 || !this.#free(x, y)) continue;
      word(c, words, x, y, { size: 15, weight: '600 ', edge: COLOR.edge });
      this.taken.push([x, y, wide ? 56 : 20]);
    }
  }
  /**
   * @param {number} x
   * @param {number} y
   */
  #free(x, y) {
    return !this.taken.some(([a, b, about]) => Math.hypot(a - x, b - y) < about * scale);
  }
  /**
   * A contour's value on it, where it crosses a line across the map, so that it does not leap about.
   * @param {Context} c
   * @param {Mapped} result
   * @param {number} level
   * @param {number[]} line
   */
  #name(c, result, level, line) {
    const { h, w } = this.plot;
    let [best, near] = [0.3, -1];
    for (let k = 0; k < line.length; k += 4) {
      const [u, v] = [line[k] / w, line[k + 1] / h];
      if (Math.min(u * w, v * h, w - u * w, h - v * h) < NAME * scale) continue; // it would be cut
      const off = Math.abs(v - 0.62 + 0.38 * (u - 0.5)) + 0.02 * Math.abs(u - 0.5);
      if (off < best) [best, near] = [off, k];
    }
    if (near < 0 || line.length < LEAST_LINE) return;
    const [x, y] = [line[near], line[near + 1]];
    if (!this.#free(x, y)) return;
    let angle = Math.atan2(line[near + 3] - y, line[near + 2] - x);
    if (angle > Math.PI / 2) angle -= Math.PI;
    if (angle < -Math.PI / 2) angle += Math.PI;
    c.save();
    c.translate(x, y);
    c.rotate(Math.abs(angle) > 1 ? 0 : angle);
    word(c, tickOf(result, level, this.domain), 0, 0.5, { color: COLOR.label, weight: '500 ', edge: COLOR.edge });
    c.restore();
    this.taken.push([x, y, 34]);
  }
  /**
   * @param {Context} c
   * @param {Window} view
   */
  #axes(c, { axes }) {
    const { narrow, plot } = this;
    const { x, x0, x1, y, y0, y1 } = axes;
    const bottom = plot.y + plot.h;
    c.strokeStyle = COLOR.soft;
    c.lineWidth = 1;
    for (const { main, named, place, value } of marksOf(x, [x0, x1], plot.w)) {
      const at = Math.round(plot.x + ((place - x0) / (x1 - x0)) * plot.w) + 0.5;
      mark(c, at, bottom + 3, 0, named ? 6 : main ? 5 : 3);
      if (named) word(c, writtenOn(x, value), at, bottom + 18 * scale, { color: COLOR.soft });
    }
    for (const { main, named, place, value } of marksOf(y, [y0, y1], plot.h)) {
      const at = Math.round(bottom - ((place - y0) / (y1 - y0)) * plot.h) + 0.5;
      mark(c, plot.x - 3, at, narrow ? -3 : named ? -6 : main ? -5 : -3, 0);
      if (named) word(c, writtenOn(y, value), plot.x - 13, at, { color: COLOR.soft, align: 'right' });
    }
    const title = (/** @type {Axis} */ axis) => (axis.unit ? `${axis.title} [${axis.unit}]` : axis.title);
    word(c, `${title(x)} →`, plot.x + plot.w, bottom + 36 * scale, { color: COLOR.soft, align: 'right' });
    word(c, `↑ ${title(y)}`, 8, plot.y - 14 * scale, { color: COLOR.soft, align: 'left' });
  }
  /**
   * The bar of colours, what is kept, and the point.
   * @param {Over} shown
   * @param {{ x0: number, x1: number, y0: number, y1: number }} axes  ends
   */
  drawOver(shown, { x0, x1, y0, y1 }) {
    const c = cleared(this.over, this.root)?.c;
    if (!c) return;
    const { plot } = this;
    if (!this.narrow && !this.blank) this.bar?.draw(c, plot, this.domain, shown);
    const spot = (/** @type {Spot} */ [p, q]) =>
      /** @type {Spot} */ ([plot.x + ((p - x0) / (x1 - x0)) * plot.w, plot.y + (1 - (q - y0) / (y1 - y0)) * plot.h]);
    this.letters.draw(c, plot, shown.kept, shown.way, spot);
    this.at = spot(shown.at);
    this.#point(c, shown, this.#holds(...this.at));
    this.guest?.(c, spot);
  }
  /**
   * @param {number} px
   * @param {number} py
   */
  #holds(px, py) {
    const { h, w, x, y } = this.plot;
    return px > x - 1 && px < x + w + 1 && py > y - 1 && py < y + h + 1;
  }
  /**
   * @param {Context} c
   * @param {Over} shown
   * @param {boolean} there  whether it is in the plot
   */
  #point(c, { result, value, values, x, y }, there) {
    const { narrow, plot } = this;
    const px = Math.min(Math.max(this.at[0], plot.x), plot.x + plot.w);
    const py = Math.min(Math.max(this.at[1], plot.y), plot.y + plot.h);
    c.strokeStyle = COLOR.cross;
    c.lineWidth = 1;
    c.setLineDash([2, 4]);
    mark(c, plot.x, py, Math.max(px - plot.x - 14, 0), 0);
    mark(c, px, py + 14, 0, Math.max(plot.y + plot.h - py - 14, 0));
    c.setLineDash([]);
    pill(c, writtenOn(x, values[0]), px, plot.y + plot.h + 18 * scale, 'center', this.base.clientWidth);
    pill(c, writtenOn(y, values[1]), plot.x - 6, py, 'right', this.base.clientWidth);
    disc(c, px, py, POINT.halo, COLOR.casing);
    disc(c, px, py, POINT.dot, there ? COLOR.accent : '#fff');
    c.lineWidth = 3;
    c.strokeStyle = COLOR.ring;
    c.stroke();
    if (this.blank) return;
    const words = result === 'model' ? this.regions.named(value, true) : written(result, value);
    const size = narrow ? 22 : 28;
    c.font = letters(size, '650 ');
    const right = px + 22 + c.measureText(words).width < plot.x + plot.w - 4;
    const up = py - plot.y > 44 ? -20 : 26;
    const align = right ? 'left' : 'right';
    word(c, words, px + (right ? 18 : -18), py + up, { size, weight: '650 ', align, edge: COLOR.edge });
  }
  /**
   * What lies under a pointer.
   * @param {number} px
   * @param {number} py
   * @returns {'point' | 'letter' | 'goal' | 'bar' | 'map' | null}
   */
  under(px, py) {
    if (this.blank) return null;
    if (Math.hypot(px - this.at[0], py - this.at[1]) < POINT.reach) return 'point';
    if (this.letters.under(px, py)) return 'letter';
    const { plot } = this;
    if (!this.narrow && this.bar?.holds(px) && py > plot.y - 8 && py < plot.y + plot.h + 8) return 'bar';
    if (!this.#holds(px, py)) return null;
    const [u, v] = [px - plot.x, py - plot.y];
    for (let k = 0; k < this.goal.length; k += 4)
      if (Math.hypot(this.goal[k] - u, this.goal[k + 1] - v) < 9) return 'goal';
    return 'map';
  }
  /**
   * Places on both axes, 0 to 1 each, of a pixel.
   * @param {number} px
   * @param {number} py
   * @returns {[x: number, y: number]}
   */
  share(px, py) {
    const { h, w, x, y } = this.plot;
    const within = (/** @type {number} */ value) => Math.min(Math.max(value, 0), 1);
    return [within((px - x) / w), within(1 - (py - y) / h)];
  }
  /**
   * The value on the bar at a height.
   * @param {number} py
   */
  level(py) {
    const { h, y } = this.plot;
    const [low, high] = this.domain;
    return low + (high - low) * Math.min(Math.max(1 - (py - y) / h, 0), 1);
  }
}
