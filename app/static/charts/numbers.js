// The numbers of a chart as a table: for those who listen to the page, and for all who ask for it.
import { headOf, make } from '../browser/dom.js';

/** @typedef {import('./chart.js').Chart} Chart */

const ROWS = 21;
const REST = 700; // ms without a change before the table follows: nobody reads it while a slider is dragged

export class Numbers {
  /** @param {Chart} chart */
  constructor(chart) {
    this.chart = chart;
    this.table = make('table');
    this.root = make('div', { className: 'numbers unseen' }, this.table);
    /** @type {number | undefined} */ this.resting = undefined;
  }

  get shown() {
    return !this.root.classList.contains('unseen');
  }

  set shown(value) {
    this.root.classList.toggle('unseen', !value);
  }

  /** The chart has changed: the table follows once it has come to rest. */
  wait() {
    clearTimeout(this.resting);
    this.resting = window.setTimeout(() => this.fill(), REST);
  }

  fill() {
    const { chart } = this;
    if (!chart.box) return;
    const { title, unit } = chart;
    const [head, ...rows] = chart.options.points ? this.#samples() : this.#values();
    this.table.replaceChildren(
      make('caption', { textContent: `${title.textContent}: ${unit.textContent}` }),
      headOf(head),
      make(
        'tbody',
        {},
        ...rows.map((cells) => make('tr', {}, ...cells.map((textContent) => make('td', { textContent })))),
      ),
    );
  }

  /** All that is drawn, at instants spread over the view; pictures at a few places upward. */
  #values() {
    const { chart } = this;
    const [low, high] = chart.axis.view;
    const { picture } = chart.content;
    const heights = picture ? [0, 0.25, 0.5, 0.75, 1].map((u) => chart.y[0] + u * (chart.y[1] - chart.y[0])) : [];
    const names = chart.tip.names;
    const head = [`${chart.xName}, ${chart.xUnit}`, ...names, ...heights.map((y) => chart.tick(y, 2))];
    const rows = Array.from({ length: ROWS }, (_, k) => {
      const x = low + (k / (ROWS - 1)) * (high - low);
      const found = new Map(chart.tip.rows(x).map(({ name, text }) => [name, text]));
      return [
        chart.writtenX(x),
        ...names.map((name) => found.get(name) ?? '–'),
        ...heights.map((y) => picture?.probe(x, y) || '–'),
      ];
    });
    return [head, ...rows];
  }

  /** Samples of each series, evenly taken. */
  #samples() {
    const { chart } = this;
    const rows = chart.content.series.flatMap((series) => {
      const count = Math.min(series.x.length, ROWS);
      return Array.from({ length: count }, (_, k) => {
        const i = count > 1 ? Math.round((k / (count - 1)) * (series.x.length - 1)) : 0;
        const y = series.y[i] * chart.scaleOf(series);
        return [series.name ?? '', chart.writtenX(series.x[i]), `${chart.written(y, 4)} ${chart.unitShown}`];
      });
    });
    return [['', `${chart.xName}, ${chart.xUnit}`, chart.unitShown], ...rows];
  }
}
