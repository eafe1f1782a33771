// A figure whose looks Python has drawn (app/views/figures.py): fetched when it is first shown, filled from answers,
// and zoomed, read and saved by Bokeh in the browser. The server hears of none of it.
import { bokeh } from '../browser/bokeh.js';
import { download, make } from '../browser/dom.js';
import { served } from '../browser/home.js';
import { language, text } from '../text/catalogue.js';
import { dress, NARROW } from './dress.js';

/** @typedef {import('./scale.js').Range} Range */

/**
 * @typedef {object} Part  one plot
 * @property {string} name
 * @property {string} title
 * @property {boolean} [headed]  whether the title stands above the plot, or never; else it is in it
 * @property {string} about  what is to be seen, for those who do not see it
 * @property {() => (string | number)[][]} [numbers]  a table of what is drawn; its first row is the head
 * @property {HTMLElement} [below]  what is said of it
 */

/** @type {Map<string, Promise<string>>} */
const looks = new Map(); // by name of the figure

/** @param {string} name */
async function fetched(name) {
  const answer = await fetch(served(`figures/${language}/${name}`));
  if (!answer.ok) throw new Error(`figures/${name}: ${answer.status}`);
  return answer.text();
}

/** @param {string} name */
function lookOf(name) {
  const known = looks.get(name) ?? fetched(name);
  looks.set(name, known);
  known.catch(() => looks.delete(name)); // the next who opens it tries again
  return known;
}

export class Figure {
  /** @type {any} */ views = null; // of Bokeh, once it is shown
  /** @type {any} */ document = null;
  /** @type {Promise<void> | null} */ coming = null;
  /** @type {Map<string, Record<string, unknown>>} */ given = new Map(); // by model: what it has whenever shown
  /** @type {Map<string, any>} */ models = new Map(); // that were looked for, by name
  /** @type {(() => void)[]} */ ready = [];

  /**
   * @param {string} name  as the server knows it
   * @param {Part[]} parts
   */
  constructor(name, parts) {
    this.name = name;
    this.parts = parts.map((part) => ({ ...part, ...this.#frame(part) }));
    this.root = make('div', { className: 'figures' }, ...this.parts.map(({ root }) => root));
  }

  /** @param {Part} part */
  #frame(part) {
    const area = make('div', { className: 'figure-area', role: 'group', ariaLabel: part.about });
    const table = make('div', { className: 'numbers', hidden: true });
    const show = make('button', { type: 'button', textContent: text('chart.show-numbers'), ariaExpanded: 'false' });
    show.onclick = () => {
      table.hidden = !table.hidden;
      show.ariaExpanded = String(!table.hidden);
      show.textContent = table.hidden ? text('chart.show-numbers') : text('chart.hide-numbers');
      this.tabulate();
    };
    const button = (/** @type {string} */ textContent, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', textContent, onclick });
    const save = button(text('chart.save-svg'), () => this.saveSvg(part.name));
    const all = button(text('chart.show-all'), () => this.reset(part.name));
    const buttons = make('div', { className: 'figure-tools' }, all, ...(part.numbers ? [show] : []), save);
    const title = make('h2', { className: part.headed ? '' : 'unseen', textContent: part.title });
    const root = make('section', { className: 'chart figure' }, title, area, buttons, table);
    if (part.below) root.append(part.below);
    return { area, table, root };
  }

  /** Show it; what it is filled with before that is kept. */
  open() {
    this.coming ??= this.#embed().catch((error) => {
      this.coming = null;
      for (const { area } of this.parts) area.textContent = text('chart.not-loaded', { why: error.message });
    });
    return this.coming;
  }

  async #embed() {
    const { doc, roots } = JSON.parse(await lookOf(this.name));
    const own = /** @type {string[]} */ (Object.values(roots));
    const places = Object.fromEntries(this.parts.map(({ name, area }) => [roots[name], area]));
    const item = { docid: this.name, roots: places, root_ids: own };
    for (const { area } of this.parts) area.replaceChildren();
    const [views] = await bokeh().embed.embed_items({ [this.name]: doc }, [item]);
    this.views = views;
    this.document = views.roots[0].model.document;
    for (const { area, headed, name, root } of this.parts) {
      dress(this.model(name), area);
      root.firstElementChild?.classList.toggle('unseen', !(headed ?? area.clientWidth < NARROW));
    }
    for (const [name, values] of this.given) this.model(name)?.setv(values);
    if (matchMedia('(pointer: coarse)').matches) this.#leaveFingers();
    for (const act of this.ready) act();
  }

  // A finger scrolls the page, until a tool is chosen.
  #leaveFingers() {
    for (const { name } of this.parts)
      for (const tool of this.model(name).toolbar.tools) if (tool.event_types.includes('pan')) tool.active = false;
  }

  /** Free its memory; `open` shows it anew. */
  close() {
    if (!this.views) return;
    const { documents } = bokeh();
    this.views.clear();
    documents.splice(documents.indexOf(this.document), 1);
    this.views = this.document = this.coming = null;
    this.models.clear();
  }

  /** @param {() => void} act  whenever it is shown anew */
  whenReady(act) {
    this.ready.push(act);
    if (this.views) act();
  }

  /**
   * @param {string} name
   * @returns {any} undefined while it is not shown
   */
  model(name) {
    const known = this.models.get(name) ?? this.document?.get_model_by_name(name);
    if (known) this.models.set(name, known);
    return known;
  }

  /**
   * Set properties of a model, now and whenever it is shown anew.
   * @param {string} name
   * @param {Record<string, unknown>} values
   */
  set(name, values) {
    this.given.set(name, { ...this.given.get(name), ...values });
    this.model(name)?.setv(values);
  }

  /**
   * Fill a source; null stands for no value.
   * @param {string} name
   * @param {Record<string, unknown[]>} columns
   */
  fill(name, columns) {
    const data = Object.entries(columns).map(([key, values]) => [key, values.map((value) => value ?? NaN)]);
    this.set(name, { data: Object.fromEntries(data) });
    this.tabulate();
  }

  /**
   * Set what an axis shows; if that is as before, a zoom stays.
   * @param {string} name
   * @param {Range} range
   */
  range(name, [start, end]) {
    const known = this.given.get(name);
    if (known?.reset_start === start && known.reset_end === end) return;
    this.set(name, { start, end, reset_start: start, reset_end: end });
  }

  /**
   * Move a line across.
   * @param {string} name
   * @param {number} location
   */
  cursor(name, location) {
    const line = this.model(name);
    if (line && line.location !== location) line.location = location;
  }

  /**
   * Where values lie in a plot, in pixels from its left and upper edge.
   * @param {string} plot
   * @param {number} x
   * @param {number} y
   */
  placeOf(plot, x, y) {
    const { x_scale: across, y_scale: up } = this.#view(plot).frame;
    return [across.compute(x), up.compute(y)];
  }

  /** Fill the tables that are open. */
  tabulate() {
    for (const { numbers, table, title } of this.parts) {
      if (table.hidden || !numbers) continue;
      const [head, ...rows] = numbers();
      const cells = (/** @type {(string | number)[]} */ row, /** @type {'th' | 'td'} */ tag) =>
        make('tr', {}, ...row.map((cell) => make(tag, { textContent: String(cell) })));
      const body = make('tbody', {}, ...rows.map((row) => cells(row, 'td')));
      table.replaceChildren(
        make('table', {}, make('caption', { textContent: title }), make('thead', {}, cells(head, 'th')), body),
      );
    }
  }

  /** @param {string} plot */
  #view(plot) {
    return this.views?.get(this.model(plot));
  }

  /** @param {string} plot */
  reset(plot) {
    this.#view(plot)?.reset();
  }

  /** @param {string} plot */
  async saveSvg(plot) {
    const blob = await this.#view(plot)?.export('svg').to_blob();
    if (blob) download(blob, `strikewave-${plot}.svg`);
  }
}
