// Charts one below the other on one axis of time, all in view: each can be folded to its head, and where there is no
// room for all, the last are.
import { scale } from '../charts/canvas.js';
import { text } from '../text/catalogue.js';
import { make } from '../browser/dom.js';
import { keep, kept } from '../browser/store.js';

/** @import { Chart } from '../charts/chart.js' */

const LEAST = 156 * scale; // pixels that an open chart needs, its head included
const LEAST_NARROW = 200 * scale; // where its head takes more lines
const NARROW = 540; // pixels of width
const LINE = 540; // in which the names of three fit side by side
const HEAD = 30 * scale; // of a folded one

export class Stack {
  /** @type {Record<string, boolean>} */ folded; // what a hand has folded or opened, by name
  /** @type {HTMLButtonElement[]} */ buttons = [];
  /** @type {unknown} */ scene = null; // that is shown
  /** @type {string[]} */ leading = []; // charts that it was opened with
  sought = false; // whether these are still to come into view
  had = ''; // which there were then
  beside = false; // a picture that shows what the others do: those that it was opened with have all the room

  /**
   * @param {string} name  under which is kept what is folded
   * @param {Record<string, Chart>} charts  by name, from the top
   * @param {() => void} changed
   * @param {string[]} [late]  those that are folded unless a hand or a scene opens them
   */
  constructor(name, charts, changed, late = []) {
    this.name = name;
    this.late = late;
    this.charts = Object.entries(charts);
    this.changed = changed;
    this.folded = kept(`folded.${name}`, {});
    this.root = make('div', { className: 'time-views' });
    for (const [key, chart] of this.charts) {
      const button = make('button', { type: 'button', className: 'fold', onclick: () => this.#toggle(key) });
      chart.head.prepend(button);
      chart.root.classList.toggle('late', late.includes(key));
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
  /** Whether the names of late ones do not fit side by side. */
  get narrow() {
    return this.root.clientWidth < LINE * scale;
  }
  /** Pixels for charts, their heads taken off; of late ones that wait only where each has a line of its own. */
  get room() {
    const { here, late, narrow } = this;
    const counted = this.charts.filter(([key], k) => here[k] && (narrow || !late.includes(key) || this.#wanted(key)));
    return this.root.clientHeight - HEAD * counted.length;
  }
  /** Which is never folded for want of room: the force, or the first of a scene that has none. */
  get vital() {
    const force = this.charts.findIndex(([key]) => key === 'force');
    return this.here[force] ? force : this.here.indexOf(true);
  }
  /** @param {string} key */
  #wanted(key) {
    return this.leading.includes(key) || this.folded[key] === false;
  }
  /**
   * Another scene comes with charts that are to be seen first, or the same is shown on.
   * @param {unknown} scene
   * @param {string[]} charts
   */
  lead(scene, charts) {
    const had = String(this.here); // of another size it hears otherwise, and to ask for that the page is laid out
    if (scene === this.scene && had === this.had) return;
    if (scene !== this.scene) [this.leading, this.sought] = [charts, charts.length > 0];
    this.scene = scene;
    this.had = had;
    this.arrange();
  }
  /**
   * Which are open: those that the scene is opened with, the others as a hand has left them, else as many as there is
   * room for.
   * @returns {boolean[]}
   */
  get open() {
    const { here, leading, least } = this;
    let { room } = this;
    /** @type {boolean[]} */
    const found = this.charts.map(() => true);
    const leads = this.charts.map(([key]) => leading.includes(key));
    const { vital } = this;
    const rank = (/** @type {number} */ k) => (leads[k] ? 2 : Number(k === vital));
    for (const k of [...found.keys()].sort((a, b) => rank(b) - rank(a))) {
      const [key] = this.charts[k];
      if (!here[k]) continue;
      const fits = room >= least - HEAD || (k === vital && !leading.length);
      const left = this.folded[key] === undefined ? null : !this.folded[key] && (fits || !leading.length);
      found[k] = leads[k] || (left ?? (fits && !this.late.includes(key) && !(this.beside && leading.length)));
      if (found[k]) room -= least - HEAD;
    }
    return found;
  }
  /**
   * Whether a chart is seen, as far as this stack can tell.
   * @param {string} key
   */
  shows(key) {
    const [, chart] = this.charts.find(([name]) => name === key) ?? [];
    return Boolean(chart && !chart.root.hidden && !chart.root.classList.contains('folded'));
  }
  /** @returns {Chart | undefined} the first that the scene was opened with, unless it is for those who look for it */
  get leader() {
    const [first] = this.leading.filter((key) => !this.late.includes(key));
    return this.charts.find(([key]) => key === first)?.[1];
  }
  arrange() {
    if (!this.root.clientHeight) return;
    this.root.classList.toggle('narrow', this.narrow);
    this.open.forEach((open, k) => {
      const [, chart] = this.charts[k];
      const button = this.buttons[k];
      if (button.ariaExpanded === String(open)) return;
      chart.root.classList.toggle('folded', !open);
      button.ariaExpanded = String(open);
      button.ariaLabel = text('layout.fold', { open, title: chart.title.textContent });
      button.textContent = open ? '▾' : '▸';
    });
    if (this.sought) this.#bring();
  }
  /** What the scene was opened with comes into view where the charts scroll. */
  #bring() {
    this.sought = false;
    const [, chart] = this.charts.find(([key]) => this.leading.includes(key)) ?? [];
    if (!chart) return;
    const [box, part] = [this.root, chart.root].map((each) => each.getBoundingClientRect());
    const above = part.top - box.top;
    this.root.scrollTop += above < 0 ? above : Math.max(Math.min(part.bottom - box.bottom, above), 0);
  }
  /** @param {string} key */
  #toggle(key) {
    const k = this.charts.findIndex(([name]) => name === key);
    const opening = !this.open[k];
    this.folded[key] = !opening;
    this.leading = this.leading.filter((name) => name !== key); // of this one a hand says now
    // where there is no room for another, the last of the others that are open gives its own
    const { here, least } = this;
    const others = this.open.map((each, i) => each && here[i] && i !== k);
    const room = Math.floor(this.room / (least - HEAD));
    const last = others.lastIndexOf(true);
    if (opening && others.filter(Boolean).length >= Math.max(room, 1) && last >= 0) {
      const [other] = this.charts[last];
      this.folded[other] = true;
      this.leading = this.leading.filter((name) => name !== other);
    }
    keep(`folded.${this.name}`, this.folded);
    this.arrange();
    this.changed();
  }
}
