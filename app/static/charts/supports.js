// What supports exert on the body that they hold, over time; of what is kept too.
import { segments } from '../browser/dom.js';
import { family, text } from '../text/catalogue.js';
import { sizeOf } from './canvas.js';
import { Chart } from './chart.js';
import { overTime } from './scale.js';

/** @import { Axis } from './axis.js' */
/** @import { Series } from './chart.js' */
/** @import { Source } from './gauge.js' */
/** @import { Span } from './marks.js' */

/** @typedef {'force' | 'moment'} Kind */
/** @typedef {[part: string, factor: number]} Read  of a field: what is read at the support, and times what */
/**
 * @typedef {object} Support
 * @property {string} name
 * @property {number} place  [m]
 * @property {Read} force  [N] on the body, against the impact
 * @property {Read} [moment]  [N m], as under a load at rest; of one that lets nothing turn
 */

const UNITS = { force: 'N', moment: 'N m' };

export class Supports {
  /** @type {Kind} */ kind = 'force';
  /** @type {Support[]} */ held = []; // those of the body that is shown
  /** @type {Source['frame']} */ frame;
  /** @type {readonly Span[]} */ contacts = [];
  /** @type {() => Source[]} */ sources = () => [];
  /** @type {() => Source[]} */ kept = () => [];
  /** @type {unknown[]} */ shown = []; // what the curves were worked out for

  /**
   * @param {Axis} axis
   * @param {string} xUnit
   * @param {(t: number) => void} go
   * @param {(frame: any) => Support[]} supportsOf
   */
  constructor(axis, xUnit, go, supportsOf) {
    const about = text('support.about');
    const caption = (/** @type {string} */ unit) => text('support.axes', { unit, kind: this.kind });
    this.supportsOf = supportsOf;
    this.chart = new Chart({ title: this.title, about, axis, xUnit, zero: true, pad: [0.04, 0.12], caption, go });
    const names = family('beam.reaction');
    const press = (/** @type {string} */ kind) => {
      this.kind = /** @type {Kind} */ (kind);
      this.draw();
      this.chart.point();
    };
    this.switch = segments(text('beam.chart.shown'), Object.keys(UNITS), press, (kind) => names[kind]);
    this.switch.root.classList.add('small');
    this.chart.value.before(this.switch.root);
  }
  /** What the chart is called: by its one support, if it has one. */
  get title() {
    const { held, kind } = this;
    return text('support.title', { kind, name: held.length === 1 ? held[0].name : 'several' });
  }
  /**
   * @param {Source['frame']} frame
   * @param {readonly Span[]} contacts
   * @param {() => Source[]} sources  of it: solutions, the leading one first
   */
  load(frame, contacts, sources) {
    Object.assign(this, { frame, contacts, sources, held: this.supportsOf(frame), shown: [] });
    const { held } = this;
    this.chart.root.hidden = !held.length;
    const turned = held.some(({ moment }) => moment);
    this.switch.root.hidden = !turned;
    if (!turned) this.kind = 'force';
    this.chart.title.textContent = this.title;
  }
  draw() {
    const { chart, contacts, kept, kind } = this;
    if (chart.root.hidden || !sizeOf(chart.area)[0]) return;
    const about = [this.frame, kind, kept, ...chart.axis.view];
    if (about.some((each, k) => each !== this.shown[k])) {
      this.shown = about;
      this.switch.show(kind);
      chart.title.textContent = this.title;
      const [own, laid] = [this.sources(), kept()].map((all) => all.flatMap((source) => this.#curves(source)));
      chart.lay(laid.map((series) => ({ ...series, cursor: undefined })));
      chart.show({ series: own, unit: UNITS[kind], shades: [...contacts] });
    }
    chart.draw();
  }
  /**
   * One for each support of the body that the source is of.
   * @param {Source} source
   * @returns {Series[]}
   */
  #curves(source) {
    const { field, frame, name, second, style } = source;
    const supports = this.supportsOf(frame);
    return supports.flatMap((support, k) => {
      const read = support[this.kind];
      if (!read) return [];
      const [part, factor] = read;
      const called = supports.length > 1 ? text('support.by', { support: support.name, name }) : name;
      const about = { factor, name: called, cursor: called, style: k ? second : style };
      return overTime(source, support.place, this.chart.axis.view, this.frame.trip, (stretch) => {
        const found = field.over(support.place, stretch, part);
        return found ? [{ ...found, ...about }] : [];
      });
    });
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}
