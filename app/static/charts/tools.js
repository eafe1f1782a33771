// The menu of a chart: zoom, numbers, files; and what it says aloud.
import { make } from '../browser/dom.js';
import { Menu } from '../browser/menu.js';
import { text } from '../text/catalogue.js';
import { savePng, saveSvg } from './save.js';

/** @typedef {import('./chart.js').Chart} Chart */

const STEP = 0.5; // of the view, for one press on zoom

export class Tools {
  /** @param {Chart} chart */
  constructor(chart) {
    this.chart = chart;
    this.spoken = make('span', { className: 'unseen', ariaLive: 'polite' });
    const title = text('chart.menu', { title: chart.title.textContent });
    this.menu = new Menu('tools', { className: 'more', textContent: '⋯', title });
    this.menu.button.ariaLabel = title;
    this.root = this.menu.root;
    this.root.append(this.spoken);
    this.#fill();
  }

  #fill() {
    const { chart, menu } = this;
    const { axis } = chart;
    const about = () => 0.5 * (axis.view[0] + axis.view[1]);
    menu.item(text('chart.zoom-in'), () => axis.zoom(STEP, about()), true);
    menu.item(text('chart.zoom-out'), () => axis.zoom(1 / STEP, about()), true);
    menu.item(text('chart.show-all'), () => axis.reset());
    const numbers = menu.item(text('chart.show-numbers'), () => {
      chart.numbers.fill();
      chart.numbers.shown = !chart.numbers.shown;
      numbers.textContent = text(chart.numbers.shown ? 'chart.hide-numbers' : 'chart.show-numbers');
    });
    menu.item(text('chart.save-png'), () => savePng(chart));
    menu.item(text('chart.save-svg'), () => saveSvg(chart));
  }

  /** Say what the chart shows now, after a key. */
  tell() {
    const { chart } = this;
    const { axis, now, tip } = chart;
    const seen =
      tip.sentence || (now && now.y === undefined ? tip.sentenceOf({ x: now.x, rows: tip.rows(now.x) }) : '');
    const [low, high] = axis.view.map((x) => chart.writtenX(x));
    this.spoken.textContent = axis.zoomed ? text('chart.seen', { seen, low, high }) : seen;
  }
}
