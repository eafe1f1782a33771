// Charts and analyses of the page that a step shows below its picture, in the place of the rows.
import { make } from '../browser/dom.js';
import { late } from '../browser/late.js';
import { text } from '../text/catalogue.js';

/** @import { Chart } from '../charts/chart.js' */
/** @import { Page } from '../page.js' */
/** @import { TaughtMap } from '../whatif/taught.js' */

const MAP = 'map';
export const FIGURE = '.figure-area';
const AWAITED = `[aria-busy='true'], ${FIGURE}:empty`;
const OF_SOLUTIONS = ['force', 'moved']; // charts that have other solutions of the impact beside the first

export class Below {
  /** @type {string[]} */ names = []; // that the step shows, by now
  root = make('div', { className: 'strip lesson-charts' });
  /** @type {TaughtMap | null} */ map = null; // once a step has shown one
  /** @type {string[]} */ of = []; // its result and its axes
  fetched = false;
  /** @type {any} */ question = null; // that is drawn on the map

  /**
   * @param {Page} page
   * @param {() => string[]} moves  choices that may be set by hand
   */
  constructor(page, moves) {
    this.page = page;
    this.moves = moves;
    for (const { dispersion, stack, stage } of Object.values(page.views)) {
      if (dispersion) dispersion.chart.lone = true;
      if ('taught' in stage) stage.taught = true;
      for (const [name, chart] of stack?.charts ?? []) chart.lone = OF_SOLUTIONS.includes(name);
    }
  }
  /** Whether an analysis has no answer yet, or no figure, or a map is not whole. */
  get awaited() {
    return this.root.querySelector(AWAITED) !== null || (this.names.includes(MAP) && !this.map?.whole);
  }
  /**
   * A chart of the view that is seen, or an analysis.
   * @param {string} name
   * @returns {HTMLElement | undefined}
   */
  #part(name) {
    const { analyses } = this.page;
    if (name === MAP) return this.map?.root;
    const found = this.charts[name];
    return found && !found.root.hidden ? found.root : analyses.byName.get(name)?.root;
  }
  /** @returns {Record<string, Chart | undefined>} those of the view that is seen, by name */
  get charts() {
    const { view } = this.page;
    const charts = Object.fromEntries(view.stack?.charts ?? []);
    return { ...charts, indentation: view.cycle?.chart, dispersion: view.dispersion?.chart };
  }
  get #parts() {
    return this.names.flatMap((name) => this.#part(name) ?? []);
  }
  /** Whether all of it is there. */
  get placed() {
    const parts = this.#parts;
    return parts.length === this.root.children.length && parts.every((part, k) => this.root.children[k] === part);
  }
  /**
   * Whether it shows an analysis, which is not only a chart.
   * @param {HTMLElement} root
   */
  #shows(root) {
    return this.#parts.includes(root);
  }
  /**
   * @param {string[]} names
   * @param {string[]} of  result and axes of a map; none: the page's own
   */
  async #chart(names, of) {
    const { page } = this;
    if (!names.includes(MAP)) {
      if (this.map?.open) this.map.leave();
      return;
    }
    this.of = of;
    if (!this.fetched) {
      this.fetched = true;
      try {
        const { TaughtMap: Map } = await late('whatif/entry.js');
        this.map = new Map(page, this.moves);
      } catch {
        this.fetched = false;
        page.complain(text('opening.no-map'));
        return;
      }
      this.lend();
    }
    if (!this.names.includes(MAP)) return;
    this.map?.lay(this.question);
    await this.map?.show(this.of.join(','));
  }
  /**
   * @param {string[]} names
   * @param {boolean} there  whether the scene of the step is, so that analyses are of it
   * @param {string[]} of  result and axes of a map
   */
  show(names, there, of) {
    const { analyses, root } = this.page;
    this.names = names;
    this.map?.lay(this.question);
    if (there) this.#chart(names, of);
    for (const view of there ? analyses.all : []) if (view.open !== this.#shows(view.root)) view.toggle();
    root.classList.toggle('charted', names.length > 0);
    if (!this.root.isConnected) root.append(this.root);
    this.lend();
  }
  /** Take what is to be seen; the view has its other charts back. */
  lend() {
    if (this.placed) return;
    this.page.view.stack?.gather();
    this.root.replaceChildren(...this.#parts);
    for (const part of this.root.children) part.classList.remove('folded', 'behind');
  }
}
