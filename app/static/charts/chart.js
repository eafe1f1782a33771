// A chart that is said, not programmed: axes, series and what else is to be seen; it finds its range and unit, writes
// its legend, and can be zoomed, read, saved and listened to.
import { make, write } from '../browser/dom.js';
import { shownIn, TRIPS, times } from '../clock/times.js';
import { text } from '../text/catalogue.js';
import { figures, scaled, signed } from '../text/format.js';
import { Axis } from './axis.js';
import { listen } from './gestures.js';
import { keysOf } from './legend.js';
import * as marks from './marks.js';
import { Numbers } from './numbers.js';
import { CHARACTER, FONT, Plot } from './plot.js';
import { between, rangeOf, ticks } from './scale.js';
import { COLORS, STYLES } from './styles.js';
import { Tip } from './tip.js';
import { Tools } from './tools.js';

/** @typedef {import('./legend.js').Key} Key */
/** @typedef {import('./scale.js').Range} Range */
/** @typedef {import('./marks.js').Span} Span */

/**
 * @typedef {object} Series
 * @property {string} [name]  in the legend; curves of one name stand there once
 * @property {ArrayLike<number>} x  ascending, in the unit of the axis; where it stands twice, a jump
 * @property {ArrayLike<number>} y
 * @property {number} [factor]  y times this is in the unit of the chart; 1 by default
 * @property {keyof typeof STYLES} style
 * @property {boolean} [path]  x is in any order
 * @property {import('./scale.js').Reach} [reach]  how far it may widen the range; by default it leads
 * @property {number} [below]  how far below nought, of what is above it, where it does not lead
 * @property {string} [cursor]  what its value at the clock is called in the head; none by default
 * @property {string} [unit]  the only one of the chart in which it can be drawn
 */

/**
 * @typedef {object} Picture  colours over x and y, in place of a range of y
 * @property {HTMLCanvasElement} image
 * @property {Range} x  of its left and right edge
 * @property {(x: number, y: number) => string} probe  the value there, with its name and unit; '' beside it
 */

/**
 * @typedef {object} Band  areas between two curves each, the widest first
 * @property {string} name
 * @property {string} color  in the legend
 * @property {ArrayLike<number>} x
 * @property {{ low: ArrayLike<number>, high: ArrayLike<number>, color: string }[]} areas
 */

/**
 * @typedef {object} Content
 * @property {Series[]} series  the most important first, which is drawn last
 * @property {Span[]} [shades]  stretches of x behind all
 * @property {Band | null} [band]
 * @property {Picture} [picture]
 * @property {string} [blank]  why there is no picture, in its place
 * @property {{ name: string, spans: Span[], at: number, least: number }} [bars]
 * @property {number[]} [rules]  dashed lines across
 * @property {Key[]} [keys]  of the legend, besides the names
 * @property {string} [unit]  in place of the unit of the chart
 * @property {Range} [range]  of y in that unit, in place of one that follows the series
 * @property {string} [xUnit]  in place of that of the axis
 * @property {string} [readout]  in the head, where no clock writes there
 */

/**
 * @typedef {object} Options
 * @property {string} title
 * @property {string} about  what is to be seen, for those who do not see it
 * @property {Axis} [axis]  shared with other charts; its own by default
 * @property {string} [xName]  time by default
 * @property {string} xUnit  T: times, written in the unit that is chosen for all of the page; s: in one that suits
 * @property {string} [unit]  of y, without prefix
 * @property {boolean | 'whole'} [zero]  nought belongs to the range: always, or while nothing is zoomed
 * @property {[below: number, above: number]} [pad]  room about the range, as shares of it
 * @property {Range} [y]  in place of a range that follows the series
 * @property {(unit: string, xUnit: string) => string} [caption]  beside the title; the unit by default
 * @property {(x: number) => void} [go]  set the clock, or what else its line stands for
 * @property {'clock' | 'place'} [moves]  what that is
 * @property {boolean} [points]  single samples are read, not all values at one x
 */

const OTHERS = ['other', 'raw', 'rawExact', 'thinOther', 'dashedOther', 'halfSpace'];
const WIDE = 5; // letters of a value, at least

/** @typedef {{ spans: Span[], color: string }} Stretches  contacts of a solution that is laid over */

export class Chart extends Plot {
  /** @type {Content} */ content = { series: [] }; // that is drawn
  /** @type {Content} */ own = { series: [] }; // without what is laid over
  /** @type {Series[]} */ laid = []; // of other solutions, beneath its own
  /** @type {Stretches[]} */ stretches = []; // below its own bars
  /** @type {Record<string, Range> | null} */ held = null; // ranges of y by unit, without prefix: they are locked
  /** @type {{ x: number, y?: number, text?: string } | null} */ now = null; // what the clock shows
  /** @type {import('./tip.js').Reading | null} */ inspected = null; // what a pointer or a key reads
  /** @type {Range | null} */ selected = null; // what a drag has passed over
  lone = false; // without other solutions of the same impact beside the first
  factor = 1; // of values, for the unit shown
  unitShown = '';
  #longest = 0;

  /** @param {Options} options */
  constructor(options) {
    super(options.title, options.about);
    this.options = options;
    this.axis = options.axis ?? new Axis();
    if (!options.axis) this.axis.watch(() => this.redraw());
    this.tip = new Tip(this);
    this.numbers = new Numbers(this);
    this.tools = new Tools(this);
    this.head.append(this.tools.root);
    this.root.append(this.numbers.root);
    this.turn = make('button', { type: 'button', className: 'unit-of-time', onclick: () => times.turn() });
    this.turn.onpointerdown = (event) => event.stopPropagation(); // which would set the clock
    if (options.xUnit === TRIPS) this.area.append(this.turn);
    listen(this);
  }

  get xName() {
    return this.options.xName ?? text('chart.time');
  }

  /** @param {Content} content */
  show(content) {
    if (this.lone) content = { ...content, series: content.series.filter(({ style }) => !OTHERS.includes(style)) };
    const unit = content.unit ?? this.options.unit;
    const laid = this.laid.filter((series) => !series.unit || series.unit === unit);
    this.own = content;
    this.content = laid.length ? { ...content, series: [...content.series, ...laid] } : content;
    this.xUnit = content.xUnit ?? this.options.xUnit;
    this.inspected = null;
    this.tip.hide();
    this.key(keysOf(this.content));
    if (content.readout !== undefined) this.say(content.readout);
  }

  /**
   * Lay other solutions over what is shown.
   * @param {Series[]} series
   * @param {Stretches[]} [stretches]
   */
  lay(series, stretches = []) {
    this.laid = series;
    this.stretches = stretches;
    if (this.xUnit) this.show(this.own);
  }

  /**
   * The range of y as it is drawn, by unit, to be held.
   * @returns {Record<string, Range>}
   */
  ranges() {
    if (this.options.y || !this.box) return {};
    return { [this.content.unit ?? this.options.unit ?? '']: [this.y[0] / this.factor, this.y[1] / this.factor] };
  }

  /** Draw all that changes with a solve or a zoom. */
  draw() {
    const { content, options, axis } = this;
    this.x = axis.view;
    const xUnit = content.xUnit ?? options.xUnit;
    [this.across, this.xUnit] = xUnit === TRIPS ? times.shown : shownIn(xUnit, axis.whole[1]);
    if (options.y) this.y = options.y;
    else {
      const { zero, pad = [0.08, 0.08] } = options;
      const unit = content.unit ?? options.unit ?? '';
      const held = this.held?.[unit];
      const [low, high] =
        held ?? content.range ?? rangeOf(content.series, axis.view, { zoomed: axis.zoomed, zero, pad });
      if (this.held && !held) this.held[unit] = [low, high];
      const most = Math.max(Math.abs(low), Math.abs(high));
      [this.factor, this.unitShown] = scaled(most, unit);
      this.y = [low * this.factor, high * this.factor];
    }
    const caption = options.caption?.(this.unitShown, this.xUnit) ?? this.unitShown;
    write(this.unit, caption);
    this.numbers.wait();
    if (this.fit()) this.paint(this.begin(this.below));
    this.turn.style.left = `${this.unitAt}px`;
    this.turn.title = this.turn.ariaLabel = text('chart.unit-of-time', { unit: times.other });
  }

  /** After a change of the view of this chart alone. */
  redraw() {
    this.draw();
    if (this.box) this.point();
  }

  /**
   * Draw on whatever draws like a canvas.
   * @param {CanvasRenderingContext2D} c
   */
  paint(c) {
    const { picture, blank, series, shades, band, bars, rules } = this.content;
    if (picture) this.#picture(c, picture);
    else if (blank) this.#say(c, this.x[0], blank);
    this.axes(c, !picture && !blank);
    this.clip(c);
    if (shades) marks.shades(c, this, shades, COLORS.contact);
    for (const area of band?.areas ?? []) marks.between(c, this, { x: band?.x ?? [], ...area }, this.factor);
    if (rules) marks.rules(c, this, rules);
    for (const over of [false, true])
      for (let k = series.length - 1; k >= 0; k--) {
        const style = STYLES[series[k].style];
        if (Boolean(style.over) === over) marks.curve(c, this, series[k], this.scaleOf(series[k]), style);
      }
    c.restore();
    if (bars) marks.bars(c, this, bars);
    if (bars) this.stretches.forEach((other, k) => marks.bars(c, this, { ...bars, ...other, below: k + 1 }));
  }

  /** @param {Series} series */
  scaleOf({ factor = 1 }) {
    return factor * this.factor;
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Picture} picture
   */
  #picture(c, { image, x: [start, end] }) {
    const { x, y, w, h } = this.frame;
    const perUnit = image.width / (end - start);
    const from = Math.max(this.x[0], start);
    const to = Math.min(this.x[1], end);
    const wide = (to - from) * perUnit;
    this.#say(c, Math.max(end, this.x[0]), text('chart.ends')); // what is laid over may last longer
    if (wide <= 0) return;
    c.imageSmoothingEnabled = wide < image.width / 3 || image.width < w / 2;
    const across = w / (this.x[1] - this.x[0]);
    const left = x + (from - this.x[0]) * across;
    c.drawImage(image, (from - start) * perUnit, 0, wide, image.height, left, y, (to - from) * across, h);
  }

  /**
   * Words where there is no picture, if there is room for them.
   * @param {CanvasRenderingContext2D} c
   * @param {number} from
   * @param {string} said
   */
  #say(c, from, said) {
    const { x, y, w, h } = this.frame;
    const left = this.px(from);
    c.font = FONT;
    c.fillStyle = COLORS.faint;
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    if (x + w - left > said.length * CHARACTER) c.fillText(said, (left + x + w) / 2, y + h / 2);
  }

  /**
   * Show the instant of the clock.
   * @param {number} x
   */
  cursor(x) {
    this.now = { x };
    if (this.box) this.point();
  }

  /**
   * Show the state at the instant of the clock, where x is no time.
   * @param {number} x
   * @param {number} y
   * @param {string} reading
   */
  mark(x, y, reading) {
    this.now = { x, y, text: reading };
    if (this.box) this.point();
  }

  /** Draw what lies above the curves: clock, selection, what is read. */
  point() {
    const c = this.begin(this.above);
    const { now, selected, inspected } = this;
    if (selected) marks.shades(c, this, [selected], 'rgba(200,30,74,.14)');
    if (inspected) marks.upright(c, this, inspected.x, COLORS.faint, 1);
    if (now?.y !== undefined) {
      if (now.x > 0) marks.dot(c, this, now.x, now.y * this.factor, COLORS.cursor);
      this.say(now.text ?? '');
    } else if (now) this.#clock(c, now.x);
    for (const { x, y, color } of inspected?.rows ?? []) if (y !== undefined) marks.dot(c, this, x, y, color);
  }

  /**
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   */
  #clock(c, t) {
    marks.upright(c, this, t, COLORS.cursor, 1.4);
    const said = [];
    for (let k = this.content.series.length - 1; k >= 0; k--) {
      const series = this.content.series[k];
      if (series.cursor === undefined) continue;
      const value = between(series.x, series.y, t) * this.scaleOf(series);
      marks.dot(c, this, t, value, STYLES[series.style].color);
      const written = this.written(value);
      const beside = this.values.get(series.name ?? '');
      if (beside) put(beside, written);
      else said.unshift(`${series.cursor} ${written}`.trim());
    }
    this.say(said.length ? `${said.join('   ')} ${this.unitShown}` : '');
  }

  /**
   * A value in the unit shown; what is lost in the range of the chart is nought.
   * @param {number} value
   * @param {number} [digits]
   */
  written(value, digits) {
    return figures(Math.abs(value) < 1e-6 * Math.abs(this.y[1] - this.y[0]) ? 0 : value, digits);
  }

  /**
   * A place on the axis, with as many digits as can be distinguished on it.
   * @param {number} x
   */
  writtenX(x) {
    const [low, high] = this.x.map((end) => end * this.across);
    return `${signed(x * this.across, ticks(low, high, 10).digits + 2)} ${this.xUnit}`;
  }

  /**
   * Write into the head. Its room only grows, so that nothing moves while the clock runs.
   * @param {string} words
   */
  say(words) {
    if (this.value.textContent === words) return;
    this.value.textContent = words;
    if (words.length <= this.#longest) return;
    this.#longest = words.length;
    this.value.style.minWidth = `${0.92 * words.length}ch`;
  }
}

/**
 * Write a value beside the name of its curve; its room only grows.
 * @param {HTMLOutputElement} output
 * @param {string} words
 */
function put(output, words) {
  if (output.textContent === words) return;
  output.textContent = words;
  const wide = Math.max(words.length, Number(output.dataset.wide ?? WIDE));
  output.dataset.wide = String(wide);
  output.style.minWidth = `${wide}ch`;
}
