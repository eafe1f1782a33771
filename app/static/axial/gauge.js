// Stress at one place of the rods over time, as a strain gauge there would tell it; of what is kept too.
import { Chart } from '../charts/chart.js';
import { within } from '../charts/scale.js';
import { make } from '../shell/dom.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';
import { signsOf, typed } from '../text/units.js';
import { naming } from '../text/words.js';
import { exactFieldOf, otherFieldOf } from './field_of.js';

/** @import { Page } from '../page.js' */
/** @import { Axis } from '../charts/axis.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { AxialFrame } from '../shell/message.js' */
/** @import { Field } from './fields.js' */

const MILLIMETRES = 1000; // in a metre
const MIDDLE = 0.5; // of what is struck: where the gauge is, unless a scene says where

/**
 * A solution that is kept, or the other of the two in it.
 * @typedef {{ frame: AxialFrame, which: 'exact' | 'other', name: string, style: Series['style'] }} Kept
 */

export class Gauge {
  place = 0; // from the struck end [m]
  usual = 0; // the same, as the scene is opened
  /** @type {unknown} */ scene = null;
  /** @type {AxialFrame} */ frame;
  /** @type {Kept[]} */ kept = [];
  /** @type {WeakMap<AxialFrame, Partial<Record<Kept['which'], Field>>>} */ fields = new WeakMap(); // of what is kept
  unit = text('axial.chart.gauge-unit');
  /** @type {unknown[]} */ shown = []; // what the curves were worked out for

  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   * @param {Page} page
   */
  constructor(axis, go, page) {
    this.page = page;
    const [title, about] = [text('axial.chart.gauge'), text('axial.chart.gauge-about')];
    const caption = (/** @type {string} */ unit) => text('axial.chart.gauge-axes', { unit });
    this.chart = new Chart({ title, about, axis, xUnit: 'T', unit: 'Pa', zero: true, caption, go });
    this.input = make('input', { type: 'text', inputMode: 'decimal', className: 'number', maxLength: 24 });
    this.input.autocomplete = 'off';
    this.input.ariaLabel = text('axial.chart.gauge-place');
    this.input.onchange = () => this.#set(this.input.value);
    const sign = make('span', { className: 'unit', textContent: this.unit });
    const field = make('label', { className: 'part' }, text('axial.chart.gauge-at'), this.input, sign);
    this.chart.title.after(field);
  }
  /** Between which places it can be [m]. @returns {[number, number]} */
  get reach() {
    const { rods } = this.frame;
    return [rods[0].from, rods[rods.length - 1].to];
  }
  /** @param {string} written */
  #set(written) {
    const [from, to] = this.reach;
    const place = typed(written, 'm', 1 / MILLIMETRES);
    if (place >= from && place <= to) {
      this.page.axial.gaugeAt(place);
      return;
    }
    const range = {
      low: MILLIMETRES * from,
      high: MILLIMETRES * to,
      unit: this.unit,
      units: signsOf('m'),
      whole: false,
    };
    const value = `“${written.slice(0, 24)}”`;
    this.page.complain(text('refused.typed', { control: text('axial.chart.gauge-place'), value, ...range }));
    this.#write();
  }
  #write() {
    this.input.value = localised(String(Number((MILLIMETRES * this.place).toPrecision(5))));
  }
  /** @param {AxialFrame} frame */
  load(frame) {
    this.frame = frame;
    const { chosen, opens, rods } = frame;
    this.chart.root.hidden = !rods.length;
    if (!rods.length) return;
    if (chosen.scene !== this.scene) this.place = this.usual = opens.place ?? MIDDLE * rods[rods.length - 1].to;
    this.scene = chosen.scene;
    this.place = within(this.place, this.reach);
  }
  /**
   * Work the curves out, once for each answer and place.
   * @param {Field} exact
   * @param {Field | null} other
   */
  follow(exact, other) {
    const { frame, kept, place } = this;
    const about = [exact, other, place, kept];
    if (about.every((each, k) => each === this.shown[k])) return;
    this.shown = about;
    this.#write();
    const series = [
      ...this.#seriesOf(frame, exact, { name: naming(frame.exact.name), style: 'exact' }),
      ...(other ? this.#seriesOf(frame, other, { name: naming(frame.other?.name ?? ''), style: 'other' }) : []),
    ];
    this.chart.lay(kept.flatMap((run) => this.#laid(run)));
    this.chart.show({ series: series.map((each) => ({ ...each, cursor: each.name })), shades: frame.exact.contacts });
  }
  /**
   * @param {AxialFrame} frame
   * @param {Field} field
   * @param {{ name: string, style: Series['style'] }} how
   * @returns {Series[]}
   */
  #seriesOf({ stressUnit }, field, how) {
    const found = field.stressAt(this.place);
    return found ? [{ ...found, factor: stressUnit, ...how }] : [];
  }
  /** @param {Kept} run */
  #laid({ frame, name, style, which }) {
    if (!frame.rods.length) return [];
    const known = this.fields.get(frame) ?? {};
    const field = (known[which] ??= which === 'exact' ? exactFieldOf(frame) : otherFieldOf(frame));
    this.fields.set(frame, known);
    if (this.place < field.from || this.place > field.to) return [];
    const times = frame.trip / this.frame.trip;
    return this.#seriesOf(frame, field, { name, style }).map((each) => ({
      ...each,
      x: times === 1 ? each.x : Float64Array.from(Array.from(each.x), (t) => times * t),
    }));
  }
  draw() {
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}
