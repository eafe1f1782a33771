// All results over one choice, one above the other: broken where they leap, bands of contacts above all of them, and
// the scene as one upright line through them.
import { cleared, letters, scale } from '../charts/canvas.js';
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { CurveJobs, askedOver } from './curve_jobs.js';
import { Fingers } from './fingers.js';
import { COLOR, disc, mark, pill, word } from './ink.js';
import { drawLetter } from './letters.js';
import { longOf, marksOf, placeOf, roundAt, sureOf, valueAt, writtenOn } from './places.js';
import { plain, shownOf, titleOf, unitFor, written } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Curve } from './curve_jobs.js' */
/** @import { Context } from './ink.js' */
/** @import { Domain } from './plane.js' */
/** @import { Result } from './results.js' */
/** @import { WhatIf } from './whatif.js' */

const NARROW = 560; // pixels of the whole
const NAMES = 208; // pixels of those of the rows
export const BANDS = ['#f6f8f9', '#f9d8c5', '#f4bf9f', '#efaa86']; // of one contact, of two, …; a number stands in each
const CHOSEN = '#c8421f';
const LEAP = 0.012; // of a row: what leaps by less is drawn on
const PAD = 0.04; // of a row, above and below its curve
const STEP = { small: 0.01, large: 0.05 }; // of what is shown, by an arrow
const ARROWS = /** @type {Record<string, number>} */ ({ ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 });
const SAID = 12; // changes that are said in words

/** @typedef {{ top: number, bottom: number, low: number, high: number, log: boolean }} Row  its room and its scale */

export class Curves {
  canvas = make('canvas', { tabIndex: 0, role: 'slider' });
  names = make('div', { className: 'whatif-names' });
  said = make('p', { className: 'unseen', id: 'whatif-curves-said' });
  plot = { x: 0, y: 0, w: 1, h: 1 };
  narrow = false;
  /** @type {Domain | null} */ domain = null; // of the chosen result
  /** @type {Map<Result, { button: HTMLButtonElement, value: HTMLElement }>} */ rows = new Map();
  /** @type {Map<Result, Domain>} */ scales = new Map();
  axis = ''; // that the scales are over
  dragged = false;

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    this.jobs = new CurveJobs(() => whatif.came());
    this.root = make('div', { className: 'whatif-curves' }, this.canvas, this.names, this.said);
    const { canvas } = this;
    canvas.setAttribute('aria-describedby', this.said.id);
    this.fingers = new Fingers(canvas, {
      take: (event) => this.#take(event),
      move: (event) => this.dragged && this.#go(event),
      leave: () => this.#leave(),
    });
    canvas.onkeydown = (event) => this.#key(event);
  }
  forget() {
    this.jobs.ask(null);
  }
  /** Measure its room; whether there is any. */
  measure() {
    const found = cleared(this.canvas, this.root);
    if (!found) return null;
    const { height, width } = found;
    this.narrow = width < NARROW * scale;
    const left = this.narrow ? 16 : NAMES * scale + 24;
    const right = this.narrow ? 16 : 84 * scale;
    const [top, below] = [50 * scale, 46 * scale];
    this.plot = { x: left, y: top, w: Math.max(width - left - right, 40), h: Math.max(height - top - below, 40) };
    return found.c;
  }
  /** What is needed for what is shown. */
  get asked() {
    const { whatif } = this;
    return askedOver(whatif, whatif.x, whatif.y);
  }
  /** @param {Result[]} results  that there are */
  draw(results) {
    this.jobs.ask(this.asked);
    const c = this.measure();
    const names = results.filter((name) => !shownOf(name).whole);
    this.#offer(names);
    const curve = this.jobs.shown;
    if (!c || !curve || curve.asked.axis.name !== this.whatif.x.name) return;
    this.#bands(c, curve);
    names.forEach((name, n) => this.#row(c, curve, name, n, names.length));
    this.#axis(c, curve);
    this.#say(curve);
  }
  /** @param {Result[]} names */
  #offer(names) {
    const { result } = this.whatif;
    if (names.join() !== [...this.rows.keys()].join()) {
      this.rows = new Map(
        names.map((name) => {
          const value = make('strong');
          const title = make('span', { textContent: titleOf(name) });
          const choose = () => this.whatif.choose('of', name);
          return [name, { button: make('button', { type: 'button', onclick: choose }, title, value), value }];
        }),
      );
      this.names.replaceChildren(...[...this.rows.values()].map(({ button }) => button));
    }
    const { h, x, y } = this.plot;
    const each = h / Math.max(names.length, 1);
    [...this.rows].forEach(([name, { button, value }], n) => {
      write(value, written(name, this.whatif.here(name)));
      button.ariaPressed = String(name === result);
      button.style.top = `${y + n * each}px`;
      button.style.height = this.narrow ? '' : `${each}px`;
      button.style.width = this.narrow ? '' : `${x - (each > 72 * scale ? 24 : 76) * scale}px`;
      button.classList.toggle('one-line', this.narrow || each < 44 * scale);
    });
  }
  /**
   * How many contacts there are, above all rows, and an upright line where one is gained or lost.
   * @param {Context} c
   * @param {Curve} curve
   */
  #bands(c, curve) {
    const { h, x, y } = this.plot;
    const top = y - 22 * scale;
    const high = 18 * scale;
    if (!this.narrow) {
      word(c, text('whatif.result.contacts'), 24, top + high / 2, { align: 'left', color: COLOR.soft });
    }
    const bands = curve.bands();
    for (const { count, from, to } of bands) {
      const [left, right] = [this.#across(from), this.#across(to)];
      const wide = right - left;
      c.fillStyle = count < 0 ? COLOR.line : BANDS[Math.min(Math.max(count, 1), BANDS.length) - 1];
      c.beginPath();
      c.roundRect(left + 0.5, top, Math.max(wide - 1, 0.5), high, Math.min(4, wide / 2));
      c.fill();
      if (count > 1 || count < 0) {
        c.globalAlpha = 0.35;
        c.fillRect(left, y, wide, h);
        c.globalAlpha = 1;
      }
      const long = count < 0 ? text('whatif.refused') : text('whatif.contacts', { count });
      const words = wide > (count < 0 ? 170 : 90) * scale ? long : count < 0 ? '' : String(count);
      if (wide > 13 * scale) word(c, words, (left + right) / 2, top + high / 2, { weight: '600 ' });
    }
    c.strokeStyle = COLOR.soft;
    c.lineWidth = 1;
    c.setLineDash([3, 3]);
    c.globalAlpha = curve.whole ? 0.6 : 0.2;
    for (const { from } of bands.slice(1)) mark(c, this.#across(from), y, 0, h);
    c.globalAlpha = 1;
    c.setLineDash([]);
    if (curve.whole) this.#changes(c, curve, top - 10 * scale);
    c.fillStyle = COLOR.soft;
    c.fillRect(x, y + h, this.plot.w, 1);
  }
  /**
   * The value at each change of contacts that has room for it, the nearest to the scene first.
   * @param {Context} c
   * @param {Curve} curve
   * @param {number} y
   */
  #changes(c, { asked, changes }, y) {
    const { w, x } = this.plot;
    const { axis } = asked;
    const all = (changes ?? []).map(({ high, low }) => ({ at: this.#across(low), words: sureOf(axis, low, high) }));
    const here = this.#scene;
    /** @type {[left: number, right: number][]} */
    const taken = [];
    for (const { at, words } of all.sort((a, b) => Math.abs(a.at - here) - Math.abs(b.at - here))) {
      c.font = letters(13, '');
      const half = c.measureText(words).width / 2;
      const middle = Math.min(Math.max(at, x + half), x + w - half);
      const [left, right] = [middle - half - 4, middle + half + 4];
      if (taken.some(([from, to]) => left < to && right > from)) continue;
      taken.push([left, right]);
      word(c, words, middle, y);
    }
  }
  /** @param {number} place */
  #across(place) {
    const { w, x } = this.plot;
    const [from, to] = this.whatif.range(this.whatif.x);
    return x + Math.min(Math.max((place - from) / (to - from), 0), 1) * w;
  }
  /**
   * The scale of a row holds its curve; while that is still coming it only grows, so that it does not leap about.
   * @param {Result} name
   * @param {number[]} values  logarithms where the scale is
   */
  #scale(name, values) {
    const known = this.scales.get(name);
    let low = values.reduce((least, value) => Math.min(least, value), Infinity);
    let high = values.reduce((most, value) => Math.max(most, value), -Infinity);
    if (shownOf(name).nought) low = Math.min(low, 0);
    const most = Math.max(Math.abs(low), Math.abs(high));
    if (high - low < 1e-6 * (most || 1))
      [low, high] = [low, high].map((end, k) => end + (k - 0.5) * 0.04 * (most || 1));
    if (known && !this.jobs.idle) [low, high] = [Math.min(low, known[0]), Math.max(high, known[1])];
    /** @type {Domain} */
    const found = [low, high];
    this.scales.set(name, found);
    return found;
  }
  /**
   * @param {Context} c
   * @param {Curve} curve
   * @param {Result} name
   * @param {number} n
   * @param {number} rows
   */
  #row(c, curve, name, n, rows) {
    const { narrow, plot, whatif } = this;
    const { h, w, x, y } = plot;
    const log = Boolean(shownOf(name).log);
    const of = (/** @type {number} */ value) => (log ? Math.log10(value) : value);
    const chosen = name === whatif.result;
    const here = whatif.here(name);
    const wanted = chosen ? (whatif.wanted[name] ?? null) : null;
    const pieces = curve.pieces(name);
    const more = [here, ...(wanted === null ? [] : [wanted])].filter((value) => Number.isFinite(of(value)));
    if (curve.asked.axis.name !== this.axis) this.scales.clear();
    this.axis = curve.asked.axis.name;
    const top = y + (n * h) / rows;
    if (n) {
      c.fillStyle = COLOR.line;
      c.fillRect(narrow ? x : 24, Math.round(top), x + w - (narrow ? x : 24), 1);
    }
    const values = [...pieces.flatMap((piece) => piece.map(([, value]) => value)), ...more].map(of);
    if (!values.length) return;
    const [low, high] = this.#scale(name, values);
    if (chosen) this.domain = [low, high];
    const [from, to] = [top + (narrow ? 22 : 9) * scale, y + ((n + 1) * h) / rows - (narrow ? 5 : 9) * scale];
    const pad = PAD * (to - from);
    const yOf = (/** @type {number} */ value) => to - pad - ((of(value) - low) / (high - low)) * (to - from - 2 * pad);
    const [factor, unit] = unitFor(name, [low, high]);
    const tick = (/** @type {number} */ level) => `${plain((log ? 10 ** level : level) * factor)} ${unit}`.trim();
    if (!narrow) {
      word(c, tick(high), x - 8, from + 3, { size: 12, align: 'right', color: COLOR.soft });
      if (to - from > 26 * scale) word(c, tick(low), x - 8, to - 3, { size: 12, align: 'right', color: COLOR.soft });
    }
    if (wanted !== null) this.#wanted(c, yOf(wanted), written(name, wanted));
    this.#trace(c, pieces, yOf, chosen, LEAP * (to - from));
    for (const { letter, place, value } of whatif.designs.along(name)) {
      const spot = /** @type {[number, number]} */ ([this.#across(place), yOf(value)]);
      if (chosen) drawLetter(c, spot, letter, false);
      else disc(c, ...spot, 4, COLOR.kept);
    }
    if (!Number.isFinite(of(here))) return;
    disc(c, this.#scene, yOf(here), 5.5, COLOR.accent);
    c.lineWidth = 2;
    c.strokeStyle = COLOR.ring;
    c.stroke();
  }
  /**
   * @param {Context} c
   * @param {number} y
   * @param {string} words
   */
  #wanted(c, y, words) {
    const { plot } = this;
    c.strokeStyle = COLOR.accent;
    c.lineWidth = 1.25;
    c.setLineDash([6, 4]);
    mark(c, plot.x, y, plot.w, 0);
    c.setLineDash([]);
    if (!this.narrow) pill(c, words, plot.x + plot.w + 4, y, 'left', this.canvas.clientWidth);
  }
  /**
   * @param {Context} c
   * @param {[place: number, value: number][][]} pieces
   * @param {(value: number) => number} yOf
   * @param {boolean} chosen
   * @param {number} least  pixels of a leap
   */
  #trace(c, pieces, yOf, chosen, least) {
    const color = chosen ? CHOSEN : COLOR.ink;
    c.beginPath();
    let last = /** @type {[x: number, y: number] | null} */ (null);
    /** @type {[x: number, y: number, full: boolean][]} */
    const dots = [];
    for (const piece of pieces) {
      const spots = piece.map(([place, value]) => [this.#across(place), yOf(value)]);
      const [[x, y]] = spots;
      const leaps = last && Math.abs(last[0] - x) < 1 && Math.abs(last[1] - y) > least;
      const on = last && Math.abs(last[0] - x) < 1 && !leaps;
      if (last && leaps) dots.push([...last, false], [x, y, true]);
      spots.forEach(([px, py], k) => (k || on ? c.lineTo(px, py) : c.moveTo(px, py)));
      last = /** @type {[number, number]} */ (spots[spots.length - 1]);
    }
    c.strokeStyle = color;
    c.lineWidth = chosen ? 2.75 : 1.75;
    c.lineJoin = c.lineCap = 'round';
    c.stroke();
    c.lineWidth = 1.25;
    for (const [x, y, full] of dots) {
      disc(c, x, y, chosen ? 3 : 2.25, full ? color : COLOR.ring);
      c.stroke();
    }
  }
  /** Where the scene is, across. */
  get #scene() {
    const { whatif } = this;
    return this.#across(placeOf(whatif.x, whatif.value(whatif.x)));
  }
  /**
   * @param {Context} c
   * @param {Curve} curve
   */
  #axis(c, { asked }) {
    const { plot, whatif } = this;
    const { axis } = asked;
    const bottom = plot.y + plot.h;
    const at = this.#scene;
    c.strokeStyle = COLOR.soft;
    c.lineWidth = 1;
    for (const { main, named, place, value } of marksOf(axis, whatif.range(axis), plot.w)) {
      const x = Math.round(this.#across(place)) + 0.5;
      mark(c, x, bottom + 3, 0, named ? 6 : main ? 5 : 3);
      if (named && Math.abs(x - at) > 34 * scale)
        word(c, writtenOn(axis, value), x, bottom + 18 * scale, { color: COLOR.soft });
    }
    const title = axis.unit ? `${axis.title} [${axis.unit}]` : axis.title;
    word(c, `${title} →`, plot.x + plot.w, bottom + 36 * scale, { color: COLOR.soft, align: 'right' });
    c.strokeStyle = COLOR.accent;
    c.lineWidth = 1.25;
    mark(c, at, plot.y - 3, 0, plot.h + 9 * scale);
    pill(c, writtenOn(axis, whatif.value(axis)), at, bottom + 18 * scale, 'center', this.canvas.clientWidth);
  }
  /** @param {Curve} curve  In words. */
  #say({ asked, changes, places, whole }) {
    const { canvas, whatif } = this;
    const { axis } = asked;
    const on = (/** @type {number} */ value) => `${writtenOn(axis, value)} ${axis.unit}`.trim();
    const at = (/** @type {number} */ place) => on(valueAt(axis, place));
    const now = whatif.value(axis);
    canvas.ariaLabel = text('whatif.curves-about', { axis: axis.title });
    canvas.ariaValueMin = String(valueAt(axis, asked.from) / axis.factor);
    canvas.ariaValueMax = String(valueAt(axis, asked.to) / axis.factor);
    canvas.ariaValueNow = String(now / axis.factor);
    canvas.ariaValueText = on(now);
    if (!whole || !changes) return;
    const { result } = whatif;
    const said = changes.slice(0, SAID).map(({ high, low }) => at((low + high) / 2));
    write(
      this.said,
      text('whatif.curves-said', {
        ...{ result: titleOf(result), value: written(result, whatif.here(result)), axis: axis.title },
        ...{ now: on(now), from: at(places[0]), to: at(places[places.length - 1]) },
        ...{ count: changes.length, places: said.join('; ') + (changes.length > SAID ? '; …' : '') },
      }),
    );
  }
  /** @param {PointerEvent} event */
  #take(event) {
    if (event.button || !this.jobs.shown) return;
    this.dragged = this.whatif.grip.hand = true;
    this.canvas.setPointerCapture(event.pointerId);
    this.#go(event);
  }
  /** @param {PointerEvent} event */
  #go(event) {
    event.preventDefault();
    const { plot, whatif } = this;
    const { x } = whatif;
    const [from, to] = whatif.range(x);
    const px = event.clientX - this.canvas.getBoundingClientRect().left;
    const share = Math.min(Math.max((px - plot.x) / plot.w, 0), 1);
    whatif.set([[x, roundAt(x, from + share * (to - from))]]);
    whatif.schedule();
  }
  #leave() {
    if (!this.dragged) return;
    this.dragged = this.whatif.grip.hand = false;
    this.whatif.schedule();
  }
  /** @param {KeyboardEvent} event */
  #key(event) {
    const way = ARROWS[event.key];
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const { x } = this.whatif;
    const [from, to] = this.whatif.range(x);
    const step = event.shiftKey ? STEP.large : STEP.small;
    const place = placeOf(x, this.whatif.value(x)) + way * step * (to - from);
    this.whatif.set([[x, roundAt(x, Math.min(Math.max(place, 0), longOf(x)))]]);
    this.whatif.schedule();
  }
}
