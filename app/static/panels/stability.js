// Where each integrator keeps the energy, chatters or fails: one small map each, over the step and one thing more.
import { Figure } from '../charts/figure.js';
import { within } from '../charts/scale.js';
import { make } from '../shell/dom.js';
import { named, said } from '../text/catalogue.js';
import { Panel } from './panel.js';
import { AXES, COLOURS, HATCHES, Small, WORDS, columnsOf, edges, spanOf } from './stability_map.js';

/** @import { Page } from '../page.js' */
/** @import { Cell, Maps, OneMap } from './stability_map.js' */
/** @import { Note } from '../text/catalogue.js' */

/** @type {Record<string, Cell>} */
const ARROWS = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 0], ArrowDown: [-1, 0] };
/** @type {Record<string, string>} */
const SIGNS = { '.': '∙', '/': '⁄', '-': '−', '+': '+', x: '×' }; // of hatches, in the legend

export class Stability extends Panel {
  /** @type {Maps | null} */ known = null; // the maps that are shown
  /** @type {Small[]} */ maps = [];
  /** @type {Cell | null} */ cell = null; // that is read, in all maps at once

  /** @param {Page} page */
  constructor(page) {
    const title = 'where each integrator keeps the energy, chatters or fails';
    const heading = `${title[0].toUpperCase()}${title.slice(1)}`;
    super(page, 'stability', 'Stability', title, heading, ['stability_axis']);
    const options = Object.entries(AXES).map(([value, across]) => make('option', { value, textContent: across.title }));
    this.axis = make('select', { ariaLabel: 'Step against' }, ...options);
    this.axis.onchange = () => this.turn(this.axis.value);
    this.said = make('p', { className: 'help', role: 'status' });
    this.notes = make('ul', { className: 'help' });
    this.start = make('button', { type: 'button', className: 'whole', onclick: () => this.run() });
    this.bar = make('progress', { max: 1, value: 0, hidden: true, ariaLabel: 'Worked out so far' });
    this.key = make('p', { className: 'legend' });
    this.grid = make('div', { tabIndex: 0, role: 'application' });
    this.grid.onkeydown = (event) => {
      const way = ARROWS[event.key];
      if (!way || !this.known || event.target !== this.grid) return;
      event.preventDefault();
      const counts = [this.known.step.length, this.known.across.values.length];
      const [row, column] = (this.cell ?? [0, 0]).map((at, k) =>
        within(at + (this.cell ? way[k] : 0), [0, counts[k] - 1]),
      );
      this.select([row, column]);
    };
    const against = make('label', { className: 'part' }, 'Step against', this.axis);
    const form = make('div', { className: 'record-form' }, against, this.start, this.bar);
    this.root.append(this.said, form, this.notes, this.key, this.grid);
    page.model.on('stability_running', () => this.fill());
    const entry = (/** @type {string} */ text, /** @type {HTMLElement} */ mark) =>
      make('span', { className: 'key' }, mark, text);
    const chip = (/** @type {string} */ kind) => {
      const mark = make('i', { className: 'chip', textContent: SIGNS[HATCHES[kind]] ?? '' });
      mark.style.background = COLOURS[kind];
      return mark;
    };
    const kinds = Object.entries(WORDS).map(([kind, text]) => entry(text, chip(kind)));
    this.key.replaceChildren(...kinds, entry('largest stable step by theory', make('i', { className: 'line' })));
  }
  opened() {
    if (this.open && !this.known && !this.page.model.stability_running) this.run();
  }
  run() {
    const { model } = this.page;
    model.stability_running = !model.stability_running;
    this.fill();
  }
  /**
   * What is under way is of the other axis: it is stopped, and begun anew.
   * @param {string} axis
   */
  turn(axis) {
    const { model } = this.page;
    model.stability_axis = axis;
    model.stability_running = false;
    if (!this.start.disabled) model.stability_running = true;
    this.fill();
  }
  /** @param {Maps | null} found */
  told(found) {
    const { model, frame } = this.page;
    this.axis.value = model.stability_axis;
    const running = model.stability_running;
    const away = frame.kind === 'bodies';
    this.bar.hidden = !running;
    this.bar.value = found?.of ? (found.done ?? 0) / found.of : 0;
    this.start.disabled = away && !running;
    this.start.textContent = running ? 'Cancel' : this.known || found?.maps ? 'Work it out again' : 'Work it out';
    if (found?.maps && found !== this.known && (this.fresh(found) || !found.cancelled)) {
      this.known = found;
      this.load(found);
    }
    const { known } = this;
    const stale = known !== null && !this.fresh(known);
    this.root.ariaBusy = String(stale);
    this.said.textContent = this.#state(running, away, known, stale);
    const notes = known && !stale && !running ? known.notes.map(said) : [];
    this.notes.replaceChildren(...notes.map((textContent) => make('li', { textContent })));
    this.key.hidden = this.grid.hidden = !known;
  }
  /**
   * @param {boolean} running
   * @param {boolean} away
   * @param {Maps | null} known
   * @param {boolean} stale
   */
  #state(running, away, known, stale) {
    const { title } = AXES[this.page.model.stability_axis];
    if (running) return `Striking with steps from a hundredth to five periods, over the ${title} …`;
    if (away) return 'Bodies in space have no step to choose: their impact takes no time.';
    if (!known) return 'Nothing is worked out yet.';
    if (stale) return 'These maps are of the choices before.';
    const cancelled = known.cancelled ? 'Cancelled: what is white was not run. ' : '';
    return `${cancelled}The dot is this scene at the page’s own step.`;
  }
  /** @param {Maps} found */
  load(found) {
    found.maps.forEach((map, k) => (this.maps[k] ??= new Small()).load(found, map));
    this.cell = null;
    const { across, step } = found;
    const look = across.log ? 'stability' : 'stability-linear';
    if (this.figure?.name !== look) this.figure = this.#made(look, found);
    const { axis, title } = AXES[across.name];
    this.grid.ariaLabel = `Maps over step and ${title}: arrow keys go from one run to the next, in all maps at once`;
    const [up, sideways] = [edges(step, true), edges(across.values, across.log)];
    const cells = step.flatMap((_up, i) => across.values.map((_, j) => /** @type {Cell} */ ([i, j])));
    /** @type {Record<string, unknown[]>} */
    const columns = {
      ...{ left: cells.map(([, j]) => sideways[j]), right: cells.map(([, j]) => sideways[j + 1]) },
      ...{ bottom: cells.map(([i]) => up[i]), top: cells.map(([i]) => up[i + 1]) },
      ...{ step: cells.map(([i]) => step[i]), across: cells.map(([, j]) => across.values[j]) },
    };
    for (const map of found.maps) Object.assign(columns, columnsOf(found, map, cells));
    this.figure.fill('cells', columns);
    this.figure.range('modal-x', spanOf(across.values));
    this.figure.range('modal-y', spanOf(step));
    const here = [within(found.here[0], spanOf(step)), within(found.here[1], spanOf(across.values))];
    this.figure.fill('here', { step: [here[0]], across: [here[1]] });
    for (const { name, limit } of found.maps) {
      this.figure.set(`${name}-across`, { axis_label: axis });
      this.figure.fill(`${name}-limit`, { across: limit ? across.values : [], step: limit ?? [] });
      this.figure.set(`here-width-${name}`, { location: here[0] });
      this.figure.set(`here-height-${name}`, { location: here[1] });
    }
    if (!this.root.hidden) this.frame();
  }
  /**
   * The figure for a kind of axis.
   * @param {string} look
   * @param {Maps} found
   */
  #made(look, found) {
    this.figure?.close();
    const parts = found.maps.map(({ name }, k) => {
      const title = named('integrator-long', name);
      const about = `where runs of ${title} keep the energy, chatter or fail`;
      return { name, title, headed: true, about, numbers: () => this.maps[k].numbers(), below: this.maps[k].said };
    });
    const figure = new Figure(look, parts);
    figure.root.classList.add('small-maps');
    figure.whenReady(() => {
      const { selected } = figure.model('cells');
      selected.properties.indices.change.connect(() => this.#read(selected.indices));
      this.#read([]);
    });
    this.grid.replaceChildren(figure.root);
    return figure;
  }
  /** @param {Cell} cell */
  select([i, j]) {
    const cells = this.figure?.model('cells');
    if (cells && this.known) cells.selected.indices = [i * this.known.across.values.length + j];
  }
  /** @param {number[]} indices */
  #read([index]) {
    const columns = this.known?.across.values.length ?? 1;
    this.cell = index === undefined ? null : [Math.floor(index / columns), index % columns];
    for (const map of this.maps) map.read(this.cell);
  }
}
