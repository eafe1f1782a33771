// The menu of a chart: zoom, numbers, files; and what it says aloud.
import { make } from '../shell/dom.js';
import { text } from '../text/catalogue.js';
import { savePng, saveSvg } from './save.js';

/** @typedef {import('./chart.js').Chart} Chart */

const STEP = 0.5; // of the view, for one press on zoom

export class Tools {
  /** @param {Chart} chart */
  constructor(chart) {
    this.chart = chart;
    this.spoken = make('span', { className: 'unseen', ariaLive: 'polite' });
    this.button = make('button', { type: 'button', className: 'more', textContent: '⋯', onclick: () => this.toggle() });
    this.button.title = this.button.ariaLabel = text('chart.menu', { title: chart.title.textContent });
    this.menu = make('div', { className: 'menu', hidden: true });
    this.root = make('div', { className: 'tools' }, this.button, this.menu, this.spoken);
    this.root.onkeydown = (event) => {
      if (event.key === 'Escape') this.close(true);
    };
    this.root.addEventListener('focusout', (event) => {
      if (!this.root.contains(/** @type {Node | null} */ (event.relatedTarget))) this.close();
    });
    this.#fill();
  }

  #fill() {
    const { chart } = this;
    const { axis } = chart;
    const about = () => 0.5 * (axis.view[0] + axis.view[1]);
    this.numbers = this.#item(text('chart.show-numbers'), () => {
      chart.numbers.fill();
      chart.numbers.shown = !chart.numbers.shown;
      this.numbers.textContent = text(chart.numbers.shown ? 'chart.hide-numbers' : 'chart.show-numbers');
    });
    this.menu.append(
      this.#item(text('chart.zoom-in'), () => axis.zoom(STEP, about()), true),
      this.#item(text('chart.zoom-out'), () => axis.zoom(1 / STEP, about()), true),
      this.#item(text('chart.show-all'), () => axis.reset()),
      this.numbers,
      this.#item(text('chart.save-png'), () => savePng(chart)),
      this.#item(text('chart.save-svg'), () => saveSvg(chart)),
    );
  }

  /**
   * @param {string} textContent
   * @param {() => void} act
   * @param {boolean} [stays]  the menu stays open
   */
  #item(textContent, act, stays = false) {
    const onclick = () => {
      act();
      if (!stays) this.close(true);
    };
    return make('button', { type: 'button', textContent, onclick });
  }

  toggle() {
    this.menu.hidden = !this.menu.hidden;
    this.button.ariaExpanded = String(!this.menu.hidden);
  }

  /** @param {boolean} [back]  the focus goes back to the button */
  close(back = false) {
    if (this.menu.hidden) return;
    this.toggle();
    if (back) this.button.focus();
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
