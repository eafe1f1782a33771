// Charts one below the other on one axis of time, all in view: each can be folded to its head, and where there is no
// room for all, the last are.
import { scale } from '../charts/canvas.js';
import { text } from '../text/catalogue.js';
import { make } from './dom.js';
import { keep, kept } from './store.js';

/** @import { Chart } from '../charts/chart.js' */

const LEAST = 148 * scale; // pixels that an open chart needs, its head included
const LEAST_NARROW = 190 * scale; // where its head takes more lines
const NARROW = 480; // pixels of width
const HEAD = 30 * scale; // of a folded one

export class Stack {
  /** @type {Record<string, boolean>} */ folded; // what a hand has folded or opened, by name
  /** @type {HTMLButtonElement[]} */ buttons = [];

  /**
   * @param {string} name  under which is kept what is folded
   * @param {Record<string, Chart>} charts  by name, from the top
   * @param {() => void} changed
   */
  constructor(name, charts, changed) {
    this.name = name;
    this.charts = Object.entries(charts);
    this.changed = changed;
    this.folded = kept(`folded.${name}`, {});
    this.root = make('div', { className: 'time-views' });
    for (const [key, chart] of this.charts) {
      const button = make('button', { type: 'button', className: 'fold', onclick: () => this.#toggle(key) });
      chart.head.prepend(button);
      this.buttons.push(button);
    }
    this.gather();
    new ResizeObserver(() => this.arrange()).observe(this.root);
  }
  /** All charts in their order, also one that was shown elsewhere. */
  gather() {
    this.root.append(...this.charts.map(([, chart]) => chart.root));
  }
  /** Pixels that an open chart needs here. */
  get least() {
    return this.root.clientWidth < NARROW ? LEAST_NARROW : LEAST;
  }
  /** Which of them this scene has, in this place. */
  get here() {
    return this.charts.map(([, chart]) => chart.root.parentElement === this.root && !chart.root.hidden);
  }
  /**
   * Which are open: as a hand has left them, else as many as there is room for.
   * @returns {boolean[]}
   */
  get open() {
    const { here, least } = this;
    let room = this.root.clientHeight - HEAD * here.filter(Boolean).length;
    return this.charts.map(([key], k) => {
      if (!here[k]) return true;
      const fits = room >= least - HEAD;
      const open = this.folded[key] === undefined ? fits : !this.folded[key];
      if (open) room -= least - HEAD;
      return open;
    });
  }
  arrange() {
    if (!this.root.clientHeight) return;
    this.open.forEach((open, k) => {
      const [, chart] = this.charts[k];
      const button = this.buttons[k];
      if (button.ariaExpanded === String(open)) return;
      chart.root.classList.toggle('folded', !open);
      button.ariaExpanded = String(open);
      button.ariaLabel = text('layout.fold', { open, title: chart.title.textContent });
      button.textContent = open ? '▾' : '▸';
    });
  }
  /** @param {string} key */
  #toggle(key) {
    const k = this.charts.findIndex(([name]) => name === key);
    const opening = !this.open[k];
    this.folded[key] = !opening;
    // where there is no room for another, the last of the others that are open gives its own
    const { here, least } = this;
    const open = this.open.map((each, i) => each && here[i]);
    const room = Math.floor((this.root.clientHeight - HEAD * here.filter(Boolean).length) / (least - HEAD));
    const last = open.findLastIndex((each, i) => each && i !== k);
    if (opening && open.filter(Boolean).length > Math.max(room, 1) && last >= 0)
      this.folded[this.charts[last][0]] = true;
    keep(`folded.${this.name}`, this.folded);
    this.arrange();
    this.changed();
  }
}
