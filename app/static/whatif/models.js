// Which model is enough: the smallest whose result is within a bound, over the axes of the map. What the page shows is
// hatched where that is not enough.
import { make, write } from '../browser/dom.js';
import { grouped } from '../text/format.js';
import { rowsOf } from './behind_rows.js';
import { WIDTH, titleOf } from './results.js';
import { nameOf, percent } from './sentence.js';
import { family, text } from '../text/catalogue.js';
import { colourOfModel } from './colours.js';
import { Hands } from './hands.js';
import { BOUNDS, ModelJobs, ModelLattice } from './model_jobs.js';
import { Lattices } from './lattice.js';
import { placeOf } from './places.js';
import { Plane } from './plane.js';
import { Window } from './window.js';

/** @import { WhatIf } from './whatif.js' */

const KEPT = 8; // lattices
const CELL = 10; // pixels of a step
const COARSE = 16; // steps of the first picture: some thirty points
const SHORT = family('whatif.model');

export class Models {
  /** @type {Window | null} */ view = null; // that is seen
  domain = null; // of a result: none is shown
  bound = BOUNDS[2];
  lattices = new Lattices(KEPT, (number) => new ModelLattice(number));
  list = make('ul', { className: 'whatif-models-list' });
  said = make('p', { className: 'whatif-models-said', id: 'whatif-models-said' });
  pointed = '';

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    this.jobs = new ModelJobs(() => whatif.came());
    this.plane = new Plane({
      about: text('whatif.models-about'),
      named: (count, wide) => (wide ? this.name(count) : ''),
      weak: (count) => count > this.jobs.shown,
      listed: true,
    });
    this.root = make('div', { className: 'whatif-models' }, this.plane.root, this.list, this.said);
    this.plane.over.setAttribute('aria-describedby', this.said.id);
    this.hands = new Hands(whatif, this);
  }
  forget() {
    this.jobs.forget();
    this.lattices.clear();
    this.view = null;
  }
  measure() {
    return this.plane.measure();
  }
  /**
   * What a model is called in a few words.
   * @param {number} place  from 1
   */
  name(place) {
    const model = this.jobs.models[place - 1];
    if (!model) return '';
    if (model.name === 'more-than') return text('whatif.more-modes', { modes: model.modes ?? 0 });
    return model.modes ? text('whatif.modes', { modes: model.modes }) : SHORT[model.name];
  }
  /** What is asked for, of the scene as it is chosen. */
  get #asked() {
    const { chosen, result, x, y } = this.whatif;
    const others = Object.entries(chosen).filter(([name]) => name !== x.name && name !== y.name);
    const key = JSON.stringify([x.name, y.name, result, others]);
    const lattice = this.lattices.get(key);
    lattice.look(BOUNDS.indexOf(this.bound));
    const values = [x, y].map((axis) => this.whatif.value(axis));
    return { lattice, chosen, names: [x.name, y.name], values, figure: result };
  }
  draw() {
    const { plane, whatif } = this;
    const { x, y } = whatif;
    const asked = this.#asked;
    const [[x0, x1], [y0, y1]] = [whatif.range(x), whatif.range(y)];
    const { h, w } = plane.plot;
    const view = new Window(asked.lattice, { x, y, x0, x1, y0, y1 }, [w, h], CELL, COARSE);
    const places = /** @type {[number, number]} */ ([x, y].map((axis, k) => placeOf(axis, asked.values[k])));
    this.jobs.ask(asked, view, [(places[0] - x0) / (x1 - x0), (places[1] - y0) / (y1 - y0)]);
    const same = this.view?.axes.x.name === x.name && this.view.axes.y.name === y.name;
    if (!view.coarse || !same || !this.view) this.view = view; // what was found stays until there is a whole picture
    const seen = Object.assign(this.view, { axes: view.axes });
    seen.fill('model');
    plane.draw(seen, 'model', [0.5, Math.max(this.jobs.models.length, 1) + 0.5], null, whatif.held);
    this.over();
    this.#list(seen);
    this.#say();
  }
  over() {
    const { jobs, plane, view, whatif } = this;
    const { x, y } = whatif;
    if (!view) return;
    const values = /** @type {[number, number]} */ ([whatif.value(x), whatif.value(y)]);
    const at = /** @type {[number, number]} */ ([placeOf(x, values[0]), placeOf(y, values[1])]);
    const value = jobs.own.places?.[BOUNDS.indexOf(this.bound)] ?? 0;
    plane.drawOver({ x, y, at, values, result: 'model', value, wanted: null, ...whatif.designs.shown }, view.axes);
  }
  /** @param {Window} view  The models that are seen, by colour. */
  #list(view) {
    const { index, nx, ny } = view;
    const there = new Set();
    for (let j = 0, k = 0; j < ny; j++)
      for (let i = 0; i < nx; i++, k++) if (index[k] >= 0 && view.seen(i, j)) there.add(view.contacts[k]);
    const all = [...there].filter((place) => place > 0).sort((a, b) => a - b);
    const known = JSON.stringify(all.map((place) => this.name(place)));
    if (this.list.dataset.known === known) return;
    this.list.dataset.known = known;
    this.list.replaceChildren(
      ...all.map((place) => {
        const sign = make('i');
        sign.style.background = colourOfModel(place);
        return make('li', {}, sign, this.name(place));
      }),
    );
  }
  /** Of the scene, in words: what is enough, within each bound, and whether that which is shown is. */
  #say() {
    const { jobs } = this;
    const { places } = jobs.own;
    const within = BOUNDS.map((bound, k) => ({ bound, model: places ? this.name(places[k]) : '' }));
    const enough = within.map(({ bound, model }) => text('whatif.enough', { bound: percent(bound), model }));
    const here = places?.[BOUNDS.indexOf(this.bound)] ?? 0;
    const weak = here > this.jobs.shown ? text('whatif.not-enough', { bound: percent(this.bound) }) : '';
    const refused = jobs.models.length ? '' : this.#refused();
    write(
      this.said,
      [this.pointed, places ? `${text('whatif.here')} ${enough.join(' · ')}.` : '', weak, refused]
        .filter(Boolean)
        .join(' '),
    );
  }
  /** What is seen as a table. */
  get rows() {
    const { bound, view, whatif } = this;
    const { result, x, y } = whatif;
    const said = { of: titleOf(result), within: percent(bound), x: nameOf(x), y: nameOf(y) };
    const caption = text('whatif.sentence-models', said);
    return view && rowsOf(view, caption, (at) => [this.name(view.lattice.contacts(at / WIDTH)), '']);
  }
  /** How many points there are. */
  get status() {
    const all = [...this.lattices.all.values()].reduce((sum, { count }) => sum + count, 0);
    return text('whatif.models-status', { count: grouped(all), busy: String(!this.jobs.idle) });
  }
  /** Why there is nothing, where all are refused. */
  #refused() {
    const [why] = this.view?.lattice.why.values() ?? [];
    return why ?? text('whatif.preparing');
  }
  /**
   * What is under a pointer.
   * @param {[number, number] | null} at  pixels
   */
  look(at) {
    const { plane, view } = this;
    const [X, Y] = at ? plane.share(...at) : [0, 0];
    const place = (at && view?.near(X, Y)) || 0;
    const why = at ? view?.why(X, Y) : null;
    this.pointed = why ?? (place > 0 ? text('whatif.under', { model: this.name(place) }) : '');
    this.#say();
  }
}
