// Where each integrator keeps the energy, chatters or fails: one small map each, over the step and one thing more.
import { Figure } from '../charts/figure.js';
import { within } from '../charts/scale.js';
import { make } from '../browser/dom.js';
import { named, said, text } from '../text/catalogue.js';
import { Panel } from './panel.js';
import { AXES, COLOURS, KINDS, MARKERS, Small, columnsOf, edges, marksOf, nameOf, spanOf } from './stability_map.js';

/** @import { Page } from '../page.js' */
/** @import { Cell, Maps, OneMap } from './stability_map.js' */
/** @import { Note } from '../text/catalogue.js' */

/** @type {Record<string, Cell>} */
const ARROWS = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 0], ArrowDown: [-1, 0] };
/** @type {Record<string, string>} */
const SIGNS = { dot: '∙', triangle: '△', dash: '−', cross: '+', x: '×' }; // of markers, in the legend

/**
 * Whether the scene has no place along this axis: a rigid contact among stiffnesses.
 * @param {Maps} maps
 */
const placeless = ({ across, rigid }) => across.name === 'contact_stiffness' && rigid;

class Stability extends Panel {
  /** @type {Maps | null} */ known = null; // the maps that are shown
  /** @type {Small[]} */ maps = [];
  /** @type {Cell | null} */ cell = null; // that is read, in all maps at once

  /** @param {Page} page */
  constructor(page) {
    const [label, title, heading] = ['button', 'title', 'heading'].map((name) => text(`stability.${name}`));
    super(page, 'stability', label, title, heading, ['stability_axis']);
    const options = Object.entries(AXES).map(([value, across]) => make('option', { value, textContent: across.title }));
    this.axis = make('select', { ariaLabel: text('stability.against') }, ...options);
    this.axis.onchange = () => this.turn(this.axis.value);
    this.said = make('p', { className: 'help', role: 'status' });
    this.notes = make('ul', { className: 'help' });
    this.start = make('button', { type: 'button', className: 'whole', onclick: () => this.run() });
    this.bar = make('progress', { max: 1, value: 0, hidden: true, ariaLabel: text('stability.so-far') });
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
    const against = make('label', { className: 'part' }, text('stability.against'), this.axis);
    const form = make('div', { className: 'record-form' }, against, this.start, this.bar);
    this.root.append(this.said, form, this.key, this.grid, this.notes); // maps are in view at once
    page.model.on('stability_running', () => this.fill());
    const entry = (/** @type {string} */ name, /** @type {HTMLElement} */ mark) =>
      make('span', { className: 'key' }, mark, name);
    const chip = (/** @type {string} */ kind) => {
      const mark = make('i', { className: 'chip', textContent: SIGNS[MARKERS[kind]] ?? '' });
      mark.style.background = COLOURS[kind];
      return mark;
    };
    const kinds = KINDS.map((kind) => entry(nameOf(kind), chip(kind)));
    this.key.replaceChildren(...kinds, entry(text('stability.limit'), make('i', { className: 'line' })));
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
  render(found) {
    const { model, frame } = this.page;
    this.axis.value = model.stability_axis;
    const running = model.stability_running;
    const away = !this.page.views[frame.kind].axis; // nothing of it takes time
    this.bar.hidden = !running;
    this.bar.value = found?.of ? (found.done ?? 0) / found.of : 0;
    this.start.disabled = away && !running;
    this.start.textContent = text(
      running ? 'panel.cancel' : this.known || found?.maps ? 'panel.again' : 'panel.work-out',
    );
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
    const refused = this.fresh(found) ? found?.error : null;
    if (refused) this.said.textContent = said(refused);
  }
  /**
   * @param {boolean} running
   * @param {boolean} away
   * @param {Maps | null} known
   * @param {boolean} stale
   */
  #state(running, away, known, stale) {
    const { title } = AXES[this.page.model.stability_axis];
    if (running) return text('stability.running', { across: title });
    if (away) return text('stability.in-space');
    if (!known) return text('stability.nothing-yet');
    if (stale) return text('stability.stale');
    return text('stability.here', { cancelled: Boolean(known.cancelled), rigid: placeless(known) });
  }
  /** @param {Maps} found */
  load(found) {
    found.maps.forEach((map, k) => (this.maps[k] ??= new Small()).load(found, map));
    this.cell = null;
    const { across, step } = found;
    const look = across.log ? 'stability' : 'stability-linear';
    if (this.figure?.name !== look) this.figure = this.#made(look, found);
    const { axis, title } = AXES[across.name];
    this.grid.ariaLabel = text('stability.keys', { across: title });
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
    for (const map of found.maps) this.figure.fill(`${map.name}-marks`, marksOf(found, map, cells));
    this.figure.range('modal-x', spanOf(across.values));
    this.figure.range('modal-y', spanOf(step));
    const here = [within(found.here[0], spanOf(step)), within(found.here[1], spanOf(across.values))];
    const there = !placeless(found);
    this.figure.fill('here', there ? { step: [here[0]], across: [here[1]] } : { step: [], across: [] });
    for (const { name, limit } of found.maps) {
      this.figure.set(`${name}-across`, { axis_label: axis });
      this.figure.fill(`${name}-limit`, { across: limit ? across.values : [], step: limit ?? [] });
      this.figure.set(`here-width-${name}`, { location: here[0] });
      this.figure.set(`here-height-${name}`, { location: here[1], visible: there });
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
      const about = text('stability.about', { integrator: title });
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

export const PANELS = { stability: Stability }; // by their names in the address
