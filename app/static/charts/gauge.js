// What a gauge on a body reads: a quantity at one place over time, and over all places at the instant of the clock, in
// which that place can be dragged; of what is kept too.
import { NumberField } from '../form/number_field.js';
import { make, segments } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';
import { sizeOf } from './canvas.js';
import { Chart } from './chart.js';
import { between, extremes, overTime, within } from './scale.js';

/** @import { Axis } from './axis.js' */
/** @import { Content, Series } from './chart.js' */
/** @import { Range, Samples } from './scale.js' */

const MILLIMETRES = 1000; // in a metre
const MIDDLE = 0.5; // of the body: where the gauge is, unless a scene says where
const SURVEYED = 48; // instants at which the range of values is looked for
const MEANS = 400; // stretches between instants at which a mean is taken
const ROOM = 0.06; // above and below it
/** @type {Record<string, string>} */
const SAVED = { stress: 'compression', right: 'compression_right_going', left: 'compression_left_going' };

/**
 * A quantity that can be read.
 * @typedef {object} Quantity
 * @property {string} unit
 * @property {string[]} parts  of it, which are drawn together
 * @property {(frame: any) => number} factor  of its values, in the unit
 * @property {(frame: any) => boolean} [mean]  whether that of the whole body is drawn over time too
 */
/**
 * A solution that is read. Places are in metres, times in those of its frame.
 * @typedef {object} Source
 * @property {{ duration: number, trip: number }} frame
 * @property {string} name
 * @property {Series['style']} style
 * @property {Series['style']} second  of the second part of a quantity
 * @property {string} [key]  of its columns in saved histories
 * @property {Readable} field
 */
/**
 * @typedef {object} Readable
 * @property {number} from  its first place [m]
 * @property {number} to
 * @property {(t: number, part: any) => Samples | null} along
 * @property {(place: number, stretch: Range, part: any) => Samples | null} over
 */
/**
 * Where something can be read.
 * @typedef {object} Body
 * @property {unknown} scene
 * @property {Range} reach  first and last place [m]; none where both are the same
 * @property {number | null} [usual]  place without another, the middle by default
 * @property {string | null} [read]  what is read at first
 * @property {{ duration: number, trip: number }} frame
 * @property {readonly import('./marks.js').Span[]} contacts
 */
/**
 * @typedef {object} Options
 * @property {Axis} axis  of time
 * @property {string} xUnit  of it
 * @property {(t: number) => void} go
 * @property {(place: number) => void} move  the gauge [m]
 * @property {() => void} turned  to another quantity
 * @property {Record<string, Quantity>} quantities  the usual one first
 * @property {Record<string, string>} names  of quantities
 * @property {(t: number) => string} written  an instant
 */

export class Gauge {
  /** @type {number | null} */ asked = null; // place, by a hand or a link [m]
  usual = 0; // place without one, as this body is
  /** @type {Body} */ body;
  /** @type {() => Source[]} */ sources = () => []; // of what is shown
  /** @type {() => Source[]} */ kept = () => []; // and of what is kept
  /** @type {WeakMap<Readable, Record<string, Range>>} */ ranges = new WeakMap();
  t = 0;
  /** @type {unknown[]} */ shown = []; // what the curves over time were worked out for

  /** @param {Options} options */
  constructor(options) {
    this.options = options;
    const { axis, go, move, names, quantities, xUnit } = options;
    [this.what] = this.whats = Object.keys(quantities);
    const signed = (/** @type {string} */ unit) => `${unit}${this.sign}`;
    this.over = new Chart({
      ...{ title: text('gauge.over'), about: text('gauge.over-about'), axis, xUnit, zero: true, go },
      caption: (unit) => signed(unit),
    });
    this.along = new Chart({
      ...{ title: text('gauge.along'), about: text('gauge.along-about'), xName: text('gauge.place'), xUnit: 'mm' },
      caption: (unit) => text('gauge.now', { unit: signed(unit), time: options.written(this.t) }),
      go: (place) => move(within(place / MILLIMETRES, this.body.reach)),
      moves: 'place',
    });
    this.switches = [this.over, this.along].map(({ value }) => {
      const found = segments(
        text('gauge.shown'),
        this.whats,
        (name) => this.read(name),
        (name) => names[name],
      );
      found.root.classList.add('small');
      value.before(found.root);
      return found;
    });
    const asked = { control: text('gauge.control'), sign: text('gauge.unit'), si: 'm', factor: 1 / MILLIMETRES };
    const written = (/** @type {number} */ place) => localised(String(Number((MILLIMETRES * place).toPrecision(5))));
    this.number = new NumberField(asked, () => this.body.reach, written, move);
    this.number.input.ariaLabel = asked.control;
    const sign = make('span', { className: 'unit', textContent: text('gauge.unit') });
    const field = make('label', { className: 'part' }, text('gauge.at'), this.number.input, sign);
    this.over.title.after(field, this.number.wrong);
    this.parts = [
      { chart: this.over, draw: () => this.#drawOver(), cursor: (/** @type {number} */ t) => this.over.cursor(t) },
      { chart: this.along, draw: () => this.#drawAlong(), cursor: (/** @type {number} */ t) => this.#at(t) },
    ];
  }
  /** From the first end [m]; on a body too short for the one that was asked for, its end. */
  get place() {
    return this.asked === null ? this.usual : within(this.asked, this.body.reach);
  }
  get quantity() {
    return this.options.quantities[this.what];
  }
  /** What is read where no hand has said otherwise. */
  get first() {
    const { read } = this.body;
    return read && this.whats.includes(read) ? read : this.whats[0];
  }
  /** Which way of it is positive. */
  get sign() {
    return text('gauge.sign', { what: this.what });
  }
  /** Whether there is a body with places. */
  get there() {
    const [from, to] = this.body?.reach ?? [0, 0];
    return to > from;
  }
  /** Whether either chart is seen. */
  get seen() {
    return this.there && [this.over, this.along].some((chart) => sizeOf(chart.area)[0] > 0);
  }
  /** @param {string} what  is to be read */
  read(what) {
    this.what = what;
    this.draw();
    this.options.turned();
  }
  /**
   * @param {Body} body
   * @param {() => Source[]} sources  of it: solutions, the leading one first
   * @param {(what: string) => boolean} [has]  whether there is anything of a quantity
   */
  load(body, sources, has = () => true) {
    const same = body.scene === this.body?.scene;
    if (!same) {
      this.asked = null;
      if (body.read && this.whats.includes(body.read)) this.what = body.read;
      else if (this.body?.read) [this.what] = this.whats; // what a scene has asked for goes with it
    }
    this.body = body;
    this.sources = sources;
    this.shown = [];
    for (const { root } of [this.over, this.along]) root.hidden = !this.there;
    if (!this.there) return;
    if (!has(this.what)) this.what = this.whats.find(has) ?? this.what;
    for (const { root } of this.switches)
      for (const button of root.querySelectorAll('button')) button.hidden = !has(button.dataset.kind ?? '');
    const [from, to] = body.reach;
    this.usual = within(body.usual ?? MIDDLE * to, body.reach);
    const { axis } = this.along;
    axis[same ? 'reach' : 'load'](MILLIMETRES * from, MILLIMETRES * to);
  }
  draw() {
    if (!this.there) return;
    for (const part of this.parts) part.draw();
  }
  /** All that is read, what is kept last. */
  get all() {
    return [...this.sources(), ...this.kept()];
  }
  /**
   * Curves of a solution, one for each part.
   * @param {Source} source
   * @param {(field: Readable, part: string) => Samples | null} read
   * @returns {Series[]}
   */
  #series({ field, frame, name, second, style }, read) {
    const { factor, parts } = this.quantity;
    return parts.flatMap((part, k) => {
      const found = read(field, part);
      if (!found) return [];
      const called = parts.length > 1 ? text('gauge.part', { part, name }) : name;
      return [{ ...found, factor: factor(frame), name: called, cursor: called, style: k ? second : style }];
    });
  }
  /**
   * Whether one of the charts is to be drawn.
   * @param {number} number
   */
  #due(number) {
    if (!this.there) return false;
    this.switches[number].show(this.what);
    return sizeOf(this.parts[number].chart.area)[0] > 0;
  }
  #drawOver() {
    const { over: chart } = this;
    if (!this.#due(0)) return;
    const { place, what } = this;
    const about = [this.body, place, what, this.kept, ...chart.axis.view];
    if (about.some((each, k) => each !== this.shown[k])) {
      this.shown = about;
      const [own, kept] = [this.sources(), this.kept()].map((all) => all.flatMap((source) => this.#overTime(source)));
      chart.lay(kept.map((series) => ({ ...series, cursor: undefined })));
      this.number.set(place);
      chart.show({ series: own, unit: this.quantity.unit, shades: [...this.body.contacts] });
    }
    chart.draw();
  }
  /** @param {Source} source */
  #overTime(source) {
    const { field, frame } = source;
    return overTime(source, this.place, this.over.axis.view, this.body.frame.trip, (stretch) => {
      const found = this.#series(source, (_, part) => field.over(this.place, stretch, part));
      const { factor, mean, parts } = this.quantity;
      if (source.style === 'exact' && mean?.(frame)) {
        const name = text('gauge.mean');
        const means = meanOver(field, parts[0], stretch);
        found.push({ ...means, factor: factor(frame), name, cursor: name, style: 'prediction' });
      }
      return found;
    });
  }
  /** What is read at the place, as columns to save. @returns {{ name: string, at: (t: number) => number }[]} */
  get columns() {
    if (!this.there) return [];
    const where = `at_${Number((MILLIMETRES * this.place).toPrecision(5))}_mm`;
    const { factor, parts, unit } = this.quantity;
    const written = unit.replace('/', '_per_').replace('µ', 'u').replaceAll(' ', '_');
    return this.sources().flatMap(({ field, frame, key }) =>
      parts.flatMap((part) => {
        const found = field.over(this.place, [0, frame.duration], part);
        const name = `${SAVED[part] ?? part}_${key}_${where}_${written}`;
        return found ? [{ name, at: (t) => between(found.x, found.y, t) * factor(frame) }] : [];
      }),
    );
  }
  /** @param {number} t  the instant shown */
  #at(t) {
    if (t === this.t) return;
    this.t = t;
    this.#drawAlong();
  }
  #drawAlong() {
    const { along: chart, t } = this;
    if (!this.#due(1)) return;
    /** @type {Content} */
    const content = { series: [], unit: this.quantity.unit, range: this.#range() };
    content.series = this.all.flatMap((source) => {
      const own = (t * this.body.frame.trip) / source.frame.trip;
      const found = own > source.frame.duration ? [] : this.#series(source, (field, part) => field.along(own, part));
      return found.map((each) => ({ ...each, x: Array.from(each.x, (x) => MILLIMETRES * x) }));
    });
    for (const series of content.series) content.range = widened(content.range, series, chart.axis.view);
    chart.now = { x: MILLIMETRES * this.place };
    chart.show(content);
    chart.redraw();
  }
  /** Of values over the whole impact, so that the axis stays while the clock runs. @returns {Range} */
  #range() {
    let [low, high] = [0, 0];
    for (const { field, frame } of this.all)
      for (const part of this.quantity.parts) {
        const known = this.ranges.get(field) ?? {};
        known[part] ??= surveyed(field, part, frame.duration);
        this.ranges.set(field, known);
        const factor = this.quantity.factor(frame);
        [low, high] = [Math.min(low, known[part][0] * factor), Math.max(high, known[part][1] * factor)];
      }
    const room = ROOM * (high - low || 1);
    return [low - room, high + room];
  }
}

/**
 * The smallest and the largest value at any place and time.
 * @param {Readable} field
 * @param {string} part
 * @param {number} duration
 * @returns {Range}
 */
function surveyed(field, part, duration) {
  let [low, high] = [0, 0];
  for (let k = 0; k < SURVEYED; k++)
    for (const value of Array.from(field.along(((k + 0.5) / SURVEYED) * duration, part)?.y ?? []))
      [low, high] = [Math.min(low, value), Math.max(high, value)];
  return [low, high];
}

/**
 * The mean over the body, at instants of a stretch of time.
 * @param {Readable} field
 * @param {string} part
 * @param {Range} stretch
 */
export function meanOver(field, part, [start, end]) {
  const x = Array.from({ length: MEANS + 1 }, (_, k) => start + (k / MEANS) * (end - start));
  return { x, y: x.map((t) => meanOf(field.along(t, part))) };
}

/** @param {Samples | null} samples  straight between their places */
function meanOf(samples) {
  if (!samples) return NaN;
  const { x, y } = samples;
  let sum = 0;
  for (let k = 1; k < x.length; k++) sum += 0.5 * (y[k] + y[k - 1]) * (x[k] - x[k - 1]);
  return sum / (x[x.length - 1] - x[0]);
}

/**
 * A range that holds what is seen of a curve too.
 * @param {Range | undefined} range
 * @param {Series} series
 * @param {Range} view
 * @returns {Range | undefined}
 */
function widened(range, series, view) {
  const [low, high] = extremes(series, view)?.map((value) => value * (series.factor ?? 1)) ?? [];
  return range && low !== undefined ? [Math.min(range[0], low), Math.max(range[1], high)] : range;
}
