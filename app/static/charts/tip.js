// What a chart says of the place under a pointer, or of one that keys have gone to.
import { make } from '../browser/dom.js';
import { between } from './scale.js';
import { STYLES } from './styles.js';

/** @typedef {import('./chart.js').Chart} Chart */
/** @typedef {{ name: string, text: string, color: string, x: number, y?: number }} Row  y: where a dot belongs */
/** @typedef {{ x: number, rows: Row[] }} Reading */

const NEAR = 24; // pixels from a point that is meant
const AWAY = 14; // pixels between the pointer and what is written

/** @param {import('./chart.js').Series} series */
const nameOf = ({ name, cursor }) => name ?? cursor ?? '';

/**
 * Whether a series has a name and a value at every x.
 * @param {import('./chart.js').Series} series
 */
const readable = (series) => !series.path && nameOf(series) !== '' && !STYLES[series.style].mark;

export class Tip {
  /** @type {number | null} */ at = null; // number of the sample that keys have gone to

  /** @param {Chart} chart */
  constructor(chart) {
    this.chart = chart;
    this.root = make('div', { className: 'tip', hidden: true, ariaHidden: 'true' });
    chart.area.append(this.root);
  }

  /**
   * Say what lies under a pointer.
   * @param {{ clientX: number, clientY: number }} event
   */
  read(event) {
    const { chart } = this;
    if (!chart.box) return;
    const [u, w] = chart.place(event);
    if (u < 0 || u > 1 || w < 0 || w > 1) {
      this.hide();
      return;
    }
    const x = chart.x[0] + u * (chart.x[1] - chart.x[0]);
    const y = chart.y[0] + w * (chart.y[1] - chart.y[0]);
    this.show(chart.options.points ? this.#nearest(x, y) : { x, rows: this.rows(x, y) });
  }

  /** Names of all that has a value at every x. */
  get names() {
    const read = this.chart.content.series.filter((each) => readable(each));
    return [...new Set(read.map(nameOf))];
  }

  /**
   * The values at x of all that is drawn; y in the unit shown.
   * @param {number} x
   * @param {number} [y]
   * @returns {Row[]}
   */
  rows(x, y) {
    const { chart } = this;
    const { series, picture } = chart.content;
    const found = [];
    for (const each of series) {
      if (!readable(each) || x < each.x[0] || x > each.x[each.x.length - 1]) continue;
      const value = between(each.x, each.y, x) * chart.scaleOf(each);
      const text = `${chart.written(value, 4)} ${chart.unitShown}`;
      found.push({ name: nameOf(each), text, color: STYLES[each.style].color, x, y: value });
    }
    if (picture && y !== undefined) {
      const text = picture.probe(x, y);
      if (text) found.push({ name: '', text, color: '', x });
    }
    return found;
  }

  /**
   * The sample that lies nearest, if any is near.
   * @param {number} x
   * @param {number} y
   */
  #nearest(x, y) {
    const { chart } = this;
    const [left, top] = [chart.px(x), chart.py(y)];
    let best = NEAR;
    /** @type {Reading | null} */
    let found = null;
    for (const each of chart.content.series)
      for (let k = 0; k < each.x.length; k++) {
        const away = Math.hypot(chart.px(each.x[k]) - left, chart.py(each.y[k] * chart.scaleOf(each)) - top);
        if (away >= best) continue;
        best = away;
        found = { x: each.x[k], rows: [this.#sample(each, k)] };
      }
    return found;
  }

  /**
   * @param {import('./chart.js').Series} series
   * @param {number} k
   * @returns {Row}
   */
  #sample(series, k) {
    const { chart } = this;
    const y = series.y[k] * chart.scaleOf(series);
    const text = `${chart.written(y, 4)} ${chart.unitShown}`;
    return { name: series.name ?? '', text, color: STYLES[series.style].color, x: series.x[k], y };
  }

  /**
   * Go so many samples along the first series, and say what is there.
   * @param {number} way
   */
  step(way) {
    const { chart } = this;
    const series = chart.content.series.find(({ x }) => x.length);
    if (!series) return;
    const last = series.x.length - 1;
    this.at = Math.min(Math.max((this.at ?? (way > 0 ? -1 : last + 1)) + way, 0), last);
    this.show({ x: series.x[this.at], rows: [this.#sample(series, this.at)] });
  }

  /** @param {Reading | null} found */
  show(found) {
    const { chart, root } = this;
    if (!found?.rows.length) {
      this.hide();
      return;
    }
    chart.inspected = found;
    const lines = found.rows.map(({ name, text, color }) => {
      const sign = make('i', { className: 'dot' });
      sign.style.color = color;
      return make('div', {}, ...(color ? [sign] : []), `${name} ${text}`.trim());
    });
    root.replaceChildren(make('div', { className: 'where', textContent: this.where(found.x) }), ...lines);
    root.hidden = false;
    const left = chart.px(found.x);
    const right = left > chart.frame.x + 0.5 * chart.frame.w;
    const place = right ? `${left - AWAY}px - 100%` : `${left + AWAY}px`;
    root.style.transform = `translateX(clamp(0px, ${place}, ${chart.width}px - 100%))`; // within the chart
    chart.point();
  }

  /** @param {number} x */
  where(x) {
    return `${this.chart.xName} ${this.chart.writtenX(x)}`;
  }

  /** What is said, in one sentence; nothing while nothing is. */
  get sentence() {
    const { inspected } = this.chart;
    return inspected ? this.sentenceOf(inspected) : '';
  }

  /** @param {Reading} found */
  sentenceOf({ x, rows }) {
    return `${this.where(x)}: ${rows.map(({ name, text }) => `${name} ${text}`).join(', ')}`;
  }

  hide() {
    if (this.root.hidden) return;
    this.root.hidden = true;
    this.at = null;
    this.chart.inspected = null;
    if (this.chart.box) this.chart.point();
  }
}
