// Stress at one place of the rods over time, as a strain gauge there would tell it; of what is kept too.
import { Chart } from '../charts/chart.js';
import { within } from '../charts/scale.js';
import { make } from '../shell/dom.js';
import { NumberField } from '../shell/number_field.js';
import { TRIPS } from '../shell/times.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';
import { called } from '../text/words.js';
import { exactFieldOf, otherFieldOf } from './field_of.js';

/** @import { Page } from '../page.js' */
/** @import { Axis } from '../charts/axis.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { AxialFrame } from '../messages.js' */
/** @import { Field } from './fields.js' */

const MILLIMETRES = 1000; // in a metre
const MIDDLE = 0.5; // of what is struck: where the gauge is, unless a scene says where

/**
 * A solution that is kept, or the other of the two in it.
 * @typedef {{ frame: AxialFrame, which: 'exact' | 'other', name: string, style: Series['style'] }} Kept
 */

export class Gauge {
  /** @type {number | null} */ asked = null; // place, by a hand or a link [m]
  usual = 0; // place without one, as these rods are
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
    this.chart = new Chart({ title, about, axis, xUnit: TRIPS, unit: 'Pa', zero: true, caption, go });
    const asked = { control: text('axial.chart.gauge-place'), sign: this.unit, si: 'm', factor: 1 / MILLIMETRES };
    const written = (/** @type {number} */ place) => localised(String(Number((MILLIMETRES * place).toPrecision(5))));
    this.number = new NumberField(
      asked,
      () => this.reach,
      written,
      (place) => page.axial.gaugeAt(place),
    );
    this.number.input.ariaLabel = asked.control;
    const sign = make('span', { className: 'unit', textContent: this.unit });
    const field = make('label', { className: 'part' }, text('axial.chart.gauge-at'), this.number.input, sign);
    this.chart.title.after(field, this.number.wrong);
  }
  /** From the struck end [m]; on rods too short for the one that was asked for, their end. */
  get place() {
    return this.asked === null ? this.usual : within(this.asked, this.reach);
  }
  /** Between which places it can be [m]. @returns {[number, number]} */
  get reach() {
    const { rods } = this.frame;
    return [rods[0].from, rods[rods.length - 1].to];
  }
  /** @param {AxialFrame} frame */
  load(frame) {
    this.frame = frame;
    const { chosen, opens, rods } = frame;
    this.chart.root.hidden = !rods.length;
    if (!rods.length) return;
    if (chosen.scene !== this.scene) this.asked = null;
    this.scene = chosen.scene;
    this.usual = within(opens.place ?? MIDDLE * rods[rods.length - 1].to, this.reach);
  }
  /**
   * Work the curves out, once for each answer and place.
   * @param {Field} exact
   * @param {Field | null} other
   */
  follow(exact, other) {
    const { frame, kept, place } = this;
    const about = [exact, other, place, kept, ...this.chart.axis.view];
    if (about.every((each, k) => each === this.shown[k])) return;
    this.shown = about;
    this.number.set(place);
    const series = [
      ...this.#seriesOf(frame, exact, { name: called(frame.exact), style: 'exact' }),
      ...(other ? this.#seriesOf(frame, other, { name: frame.other ? called(frame.other) : '', style: 'other' }) : []),
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
  #seriesOf({ duration, stressUnit, trip }, field, how) {
    const times = trip / this.frame.trip;
    const [start, end] = this.chart.axis.view.map((t) => within(t / times, [0, duration]));
    const found = end > start ? field.stressAt(this.place, [start, end]) : null;
    if (!found) return [];
    const x = times === 1 ? found.x : Float64Array.from(Array.from(found.x), (t) => times * t);
    return [{ x, y: found.y, factor: stressUnit, ...how }];
  }
  /** @param {Kept} run */
  #laid({ frame, name, style, which }) {
    if (!frame.rods.length) return [];
    const known = this.fields.get(frame) ?? {};
    const field = (known[which] ??= which === 'exact' ? exactFieldOf(frame) : otherFieldOf(frame));
    this.fields.set(frame, known);
    if (this.place < field.from || this.place > field.to) return [];
    return this.#seriesOf(frame, field, { name, style });
  }
  draw() {
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}
