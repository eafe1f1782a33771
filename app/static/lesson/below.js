// Charts and analyses of the page that a step shows below its picture, in the place of the rows.
import { make } from '../browser/dom.js';

/** @import { Chart } from '../charts/chart.js' */
/** @import { Page } from '../page.js' */

const OF_SOLUTIONS = ['force', 'moved']; // charts that have other solutions of the impact beside the first

export class Below {
  /** @type {string[]} */ names = []; // that the step shows, by now
  root = make('div', { className: 'strip lesson-charts' });

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    for (const { dispersion, stack, stage } of Object.values(page.views)) {
      if (dispersion) dispersion.chart.lone = true;
      if ('taught' in stage) stage.taught = true;
      for (const [name, chart] of stack?.charts ?? []) chart.lone = OF_SOLUTIONS.includes(name);
    }
  }
  /**
   * A chart of the view that is seen, or an analysis.
   * @param {string} name
   * @returns {HTMLElement | undefined}
   */
  #part(name) {
    const { analyses } = this.page;
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
   * @param {boolean} there  whether the scene of the step is, so that analyses are of it
   */
  show(names, there) {
    const { analyses, root } = this.page;
    this.names = names;
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
