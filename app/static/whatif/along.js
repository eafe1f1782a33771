// What is taken along of the map, of curves or of tolerances: picture, table, command and Python, link.
import { partOf } from '../frame/code_part.js';
import { copyLink, linkOf } from '../frame/share.js';
import { download, make } from '../browser/dom.js';
import { late } from '../browser/late.js';
import { Menu } from '../browser/menu.js';
import { carried } from '../browser/home.js';
import { text } from '../text/catalogue.js';
import { fileOf } from '../wire/own.js';
import { Behind } from './behind.js';
import { apart, commandOf, figureOf, planOf, pythonOf, variedOf, withinOf } from './code_lines.js';
import { TOLERANCE } from './map_jobs.js';
import { longOf, valueAt } from './places.js';
import { csvOf, tableOfCurves, tableOfMap, tableOfModels, tableOfTolerance } from './table.js';
import { drawnOf } from './tolerance_jobs.js';
import { saidOf } from './view_link.js';

/** @import { Scope } from '../take/picture.js' */
/** @import { Axis } from './axes.js' */
/** @import { Varied } from './code_lines.js' */
/** @import { SceneFile } from './points.js' */
/** @import { WhatIf } from './whatif.js' */

/** @typedef {[axis: Axis, values: number[]]} Line  of values along an axis */
/** @typedef {typeof import('../take/files.js')} Files */
/** @typedef {{ scene: string, varied: Varied[] | null, left: string[] }} Found  left: inputs that no key stands for */

const FINE = 2; // times as many pixels of the map in a picture
const MOST = 64; // values of an axis in a command
const TOGETHER = 15; // of each of two axes whose keys go together
const PARTS = ['sentence', 'map', 'curves', 'tolerance', 'models-map', 'models-list', 'models-said', 'foot'].map(
  (name) => `.whatif-${name}`,
);
const BARS = '.whatif-inputs .bar i';

export class Along {
  said = ''; // by the address

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    const button = { className: 'whole', textContent: text('whatif.along'), title: text('whatif.along-about') };
    const menu = new Menu('takes', button);
    this.root = menu.root;
    this.root.classList.add('whatif-along');
    menu.button.ariaLabel = menu.button.textContent; // on a phone it is a sign
    menu.item(text('take.png'), () => this.#picture(({ savePng }, ...what) => savePng(whatif.page, ...what), FINE));
    menu.item(text('take.svg'), () => this.#picture(({ saveSvg }, ...what) => saveSvg(whatif.page, ...what), 1));
    this.behind = new Behind(whatif, () => menu.button.focus());
    menu.item(text('whatif.as-table'), () => this.behind.open());
    menu.item(text('whatif.table'), () => this.#table());
    if (!carried) menu.item(text('whatif.code'), () => this.#code()); // the server says the scene file
    menu.item(text('whatif.link'), () => copyLink(whatif.page));
    this.status = make('p', { className: 'help', role: 'status' });
    this.codes = /** @type {const} */ (['command', 'python', 'scene']).map((name) =>
      partOf(name, this.status, () => this.#named('toml')),
    );
    const close = make('button', { type: 'button', className: 'sign', textContent: '✕', title: text('layout.shut') });
    close.ariaLabel = close.title;
    close.onclick = () => this.dialog.close();
    const title = make('h2', { textContent: text('whatif.code'), id: 'whatif-code' });
    const head = make('header', { className: 'panel-head' }, title, close);
    const parts = this.codes.map(({ root }) => root);
    this.dialog = make('dialog', { className: 'whatif-code' }, head, this.status, ...parts);
    this.dialog.setAttribute('aria-labelledby', title.id);
    this.dialog.onkeydown = (event) => event.stopPropagation(); // to what is behind
    this.dialog.onclick = (event) => {
      if (event.target === this.dialog) this.dialog.close(); // beside it
    };
    this.root.append(this.dialog, this.behind.dialog);
  }
  /** The address says what is seen. */
  follow() {
    const said = saidOf(this.whatif);
    if (said === this.said) return;
    this.said = said;
    this.whatif.page.history.later();
  }
  /** @param {string} extension */
  #named(extension) {
    const scene = fileOf(this.whatif.chosen.scene);
    return extension === 'toml' ? `${scene}.toml` : `strikewave-${scene}-${this.whatif.modes.mode}.${extension}`;
  }
  /**
   * @param {(files: Files, named: (extension: string) => string, scope: Scope) => void} act
   * @param {number} fine
   */
  async #picture(act, fine) {
    const { page } = this.whatif;
    try {
      act(await late('take/files.js'), (extension) => this.#named(extension), this.#scope(fine));
    } catch {
      if (!page.connection?.miss('files')) page.complain(text('take.lost'));
    }
  }
  /**
   * @param {number} fine  times as many pixels of the map
   * @returns {Scope}
   */
  #scope(fine) {
    const { page, plane } = this.whatif;
    return {
      all: PARTS.flatMap((part) => [...page.root.querySelectorAll(part)]),
      signed: true,
      redraw: (diverted) => {
        plane.fine = diverted ? fine : 1;
        this.whatif.painted = '';
        this.whatif.draw();
      },
      more: (c) => {
        for (const bar of page.root.querySelectorAll(BARS)) {
          const { height, left, top, width } = bar.getBoundingClientRect();
          c.fillStyle = getComputedStyle(bar).backgroundColor;
          c.fillRect(left, top, width, height);
        }
      },
    };
  }
  /** What is shown as a table, if anything is. */
  get #shown() {
    const { modes, view } = this.whatif;
    if (modes.mode === 'map') return view && tableOfMap(view);
    if (modes.mode === 'models') return modes.models.view && tableOfModels(modes.models.view, modes.models.jobs.models);
    if (modes.mode === 'curves') return modes.curves.jobs.shown && tableOfCurves(modes.curves.jobs.shown);
    return modes.tolerance.jobs.shown && tableOfTolerance(modes.tolerance.jobs.shown);
  }
  async #table() {
    const { modes, page, points } = this.whatif;
    const table = this.#shown;
    if (!table?.rows.length) {
      page.complain(text('whatif.nothing-yet'));
      return;
    }
    const name = this.#named('csv');
    const [link, rough] = [linkOf(page), modes.mode === 'map' && points.source === points.own && this.#gives];
    const file = await this.#file([], []);
    const scene = typeof file === 'string' ? '' : file.scene;
    download(new Blob([csvOf(table, scene, link, rough ? TOLERANCE : 0)], { type: 'text/csv' }), name);
  }
  /** Whether the contact gives way, so that a map is found with longer steps. */
  get #gives() {
    return Number.isFinite(this.whatif.here('peak_indentation'));
  }
  /**
   * The scene file, and the keys by which these impacts differ from it.
   * @param {Axis[]} axes
   * @param {number[][]} rows
   */
  #file(axes, rows) {
    const { chosen, points, x, y } = this.whatif;
    const all = axes.length ? axes : [x, y];
    const now = all.map((axis) => this.whatif.value(axis));
    return points.file({ chosen, names: all.map(({ name }) => name), rows: Float64Array.from([now, ...rows].flat()) });
  }
  async #code() {
    const { modes } = this.whatif;
    for (const { root } of this.codes) root.hidden = true;
    this.status.textContent = text('whatif.preparing');
    if (!this.dialog.open) this.dialog.showModal();
    const { mode } = modes;
    if (mode === 'models') return this.#plan();
    const found = await (mode === 'map' ? this.#ofMap() : mode === 'curves' ? this.#ofCurves() : this.#ofTolerance());
    if (!this.dialog.open) return;
    if (typeof found === 'string' || !found.varied?.length) {
      const why = typeof found === 'string' ? found : text('whatif.no-keys');
      this.status.textContent = why || text('whatif.no-code');
      return;
    }
    const { left, scene, varied } = found;
    const what = mode === 'tolerance' ? 'uncertain' : 'study';
    const file = this.#named('toml');
    const results = mode === 'curves' ? [...modes.curves.rows.keys()] : [this.whatif.result];
    const figures = [...results.map(figureOf), ...(mode === 'curves' ? ['contacts'] : [])];
    const command = commandOf(what, file, varied, figures);
    this.#show({ command, python: pythonOf(what, file, varied, figures), scene });
    const help =
      what === 'study' ? text('whatif.code-help-study', { file }) : text('whatif.code-help-uncertain', { file });
    const rest = left.length ? text('whatif.left-out', { names: left.join(', ') }) : '';
    this.status.textContent = `${help} ${rest}`.trim();
  }
  /** Of which model is enough for the scene, not for each point. */
  async #plan() {
    const { modes, result } = this.whatif;
    const [file, found] = [this.#named('toml'), await this.#file([], [])];
    const lines = planOf(file, result, modes.models.bound);
    if (!this.dialog.open) return;
    if (typeof found === 'string' || !lines) this.status.textContent = found && text('whatif.no-plan');
    else {
      this.#show({ ...lines, scene: found.scene });
      this.status.textContent = text('whatif.code-help-plan', { file });
    }
  }
  /** @param {Record<'command' | 'python' | 'scene', string>} written */
  #show(written) {
    for (const { code, name, root } of this.codes) {
      code.textContent = name === 'scene' ? written.scene.replaceAll('\n[', '\n\n[') : written[name];
      root.hidden = false;
    }
  }
  /** @returns {Promise<Found | string>} */
  async #ofMap() {
    const { view, x, y } = this.whatif;
    if (!view) return '';
    const lines = /** @type {[Line, Line]} */ ([x, y].map((axis, way) => [axis, this.#along(way, MOST)]));
    const [across, up] = lines.map(([, values]) => values);
    const now = [x, y].map((axis) => this.whatif.value(axis));
    const corner = [across[across.length - 1], up[up.length - 1]];
    const rows = [...across.map((value) => [value, now[1]]), ...up.map((value) => [now[0], value]), corner];
    const found = await this.#file([x, y], rows);
    if (typeof found === 'string') return found;
    const { keys, scene } = found;
    const separate = keys && apart(keys, across.length);
    if (keys && !separate) return this.#together(x, y);
    const varied = separate?.map(variedOf);
    return { scene, varied: varied?.every(Boolean) ? /** @type {Varied[]} */ (varied) : null, left: [] };
  }
  /**
   * Keys that go with both axes: all pairs of fewer values.
   * @param {Axis} x
   * @param {Axis} y
   * @returns {Promise<Found | string>}
   */
  async #together(x, y) {
    const [across, up] = [0, 1].map((way) => this.#along(way, TOGETHER));
    const found = await this.#file(
      [x, y],
      across.flatMap((p) => up.map((q) => [p, q])),
    );
    if (typeof found === 'string') return found;
    const varied = found.keys && variedOf(found.keys);
    return { scene: found.scene, varied: varied && [varied], left: [] };
  }
  /**
   * Values of the lattice along an axis of the map, so many at most, from one end that is seen to the other.
   * @param {number} way  0: across, 1: upwards
   * @param {number} most
   */
  #along(way, most) {
    const view = /** @type {NonNullable<WhatIf['view']>} */ (this.whatif.view);
    const { axes, first, steps } = view;
    const [axis, from, to] = way ? [axes.y, axes.y0, axes.y1] : [axes.x, axes.x0, axes.x1];
    const [low, high] = [Math.max(from, 0), Math.min(to, longOf(axis))];
    for (let stride = 1; ; stride *= 2) {
      const step = steps[way] * stride;
      const [start, end] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
      if (end - start < most && first[way] % stride === 0)
        return Array.from({ length: end - start + 1 }, (_, k) => valueAt(axis, (start + k) * step));
    }
  }
  /** @returns {Promise<Found | string>} */
  async #ofCurves() {
    const curve = this.whatif.modes.curves.jobs.shown;
    if (!curve) return '';
    const { axis } = curve.asked;
    const found = await this.#file(
      [axis],
      curve.places.map((place) => [valueAt(axis, place)]),
    );
    if (typeof found === 'string') return found;
    const varied = found.keys && variedOf(found.keys);
    return { scene: found.scene, varied: varied && [varied], left: [] };
  }
  /** @returns {Promise<Found | string>} */
  async #ofTolerance() {
    const inputs = this.whatif.modes.tolerance.jobs.shown?.asked.inputs;
    if (!inputs) return '';
    const now = inputs.map(({ value }) => value);
    const rows = inputs.flatMap((input, k) => [-1, 1].map((unit) => now.with(k, drawnOf(input, unit))));
    const found = await this.#file(
      inputs.map(({ axis }) => axis),
      rows,
    );
    if (typeof found === 'string') return found;
    const { keys, scene } = found;
    const each = inputs.map((_, k) => {
      const both = Object.entries(keys ?? {}).map(([name, values]) => [name, values.slice(2 * k, 2 * k + 2)]);
      return withinOf(Object.fromEntries(both.filter(([, [low, high]]) => low !== high)));
    });
    const left = inputs.filter((_, k) => !each[k]).map(({ axis }) => axis.title);
    return { scene, varied: /** @type {Varied[]} */ (each.filter(Boolean)), left };
  }
}
