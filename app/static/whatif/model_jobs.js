// Which model is enough, point by point, as the server finds it: coarse points first, then where it changes.
import { text } from '../text/catalogue.js';
import { Lattice, halve } from './lattice.js';
import { progressOf } from './map_jobs.js';
import { failedOf } from './points.js';
import { WIDTH } from './results.js';

/** @import { Job } from './points.js' */
/** @import { Called } from '../text/words.js' */
/** @import { Window, Point } from './window.js' */

export const BOUNDS = [0.1, 0.05, 0.01, 0.001]; // of the error
const MOST = 8; // points in a job: each is solved a dozen times
const HALVINGS = 2; // of a step: to 2 or 3 pixels

/** @param {ArrayLike<number>} row  By bound the smallest that is enough, from 1. */
const placesOf = (row) => BOUNDS.map((_, k) => row[k + 1]);

/** Of each point the smallest model that is enough within each bound, of which one is looked at. */
export class ModelLattice extends Lattice {
  /** @type {import('./results.js').Result[]} */ names = []; // nothing between two points that agree
  halvings = HALVINGS;
  bound = 0; // number of that which is looked at

  /** @param {number} bound */
  look(bound) {
    if (bound === this.bound) return;
    this.bound = bound;
    this.version += 1;
    for (const known of [this.edges, this.spared, this.halving]) known.clear(); // of another bound
  }
  /**
   * @param {ArrayLike<number>} found
   * @param {number} row
   */
  counted(found, row) {
    return found[row * WIDTH] ? -1 : found[row * WIDTH + 1 + this.bound];
  }
  /** @param {number} point */
  contacts(point) {
    return point < 0 ? 0 : this.counted(this.data, point);
  }
  /**
   * @param {import('./results.js').Mapped} _
   * @param {number} point
   */
  value(_, point) {
    return this.contacts(point);
  }
}

/**
 * @typedef {object} Asked
 * @property {ModelLattice} lattice
 * @property {Record<string, any>} chosen
 * @property {string[]} names  of both axes
 * @property {number[]} values  of the scene on these
 * @property {string} figure  whose error it is
 */

export class ModelJobs {
  /** @type {Asked | null} */ asked = null;
  /** @type {Window | null} */ view = null;
  /** @type {Point[][]} */ wanted = []; // by level
  /** @type {ReturnType<Window['halves']> | null} */ halves = null;
  /** @type {{ key: string, places: number[] | null }} */ own = { key: '', places: null }; // of the scene, by bound
  /** @type {Called[]} */ models = []; // from the smallest up
  shown = Infinity; // where the method that the page shows stands among them, from 1
  under = 0;

  /** @param {() => void} came */
  constructor(came) {
    this.came = came;
  }
  /**
   * @param {Asked} asked
   * @param {Window} view
   * @param {[x: number, y: number]} at  of the scene, 0 to 1 each
   */
  ask(asked, view, at) {
    this.asked = asked;
    this.view = view;
    this.wanted = view.plan(at, false);
    this.halves = null;
  }
  forget() {
    this.asked = this.view = null;
    this.models = [];
    this.wanted = [];
    this.own = { key: '', places: null };
  }
  get progress() {
    return this.view && progressOf(this.view, this.wanted, this.halves);
  }
  get rough() {
    return !this.view || this.view.coarse;
  }
  get idle() {
    return !this.under && !this.wanted.length && this.halves?.length === 0;
  }
  /** @returns {Job | null} */
  next() {
    const { asked, view } = this;
    if (!asked || !view) return null;
    const scene = this.#scene(asked);
    if (scene) return scene;
    while (this.wanted.length && !this.wanted[0].length) this.wanted.shift();
    if (!this.wanted.length && !this.halves) {
      this.wanted = [view.mend()].filter(({ length }) => length);
      this.halves = view.halves();
    }
    return this.wanted.length ? this.#points(asked, view) : this.#edges(asked);
  }
  /**
   * @param {Asked} asked
   * @returns {Job | null}
   */
  #scene(asked) {
    const key = JSON.stringify([asked.chosen, asked.figure]);
    if (key === this.own.key) return null;
    this.own = { key, places: null };
    const job = this.#job(asked, Float64Array.from(asked.values), (found) => {
      if (this.own.key !== key) return;
      if (!found)
        this.own.key = ''; // given up: it is asked for once more
      else if (!found[0]) this.own.places = placesOf(found);
    });
    return { ...job, drawn: false };
  }
  /**
   * @param {Asked} asked
   * @param {Window} view
   */
  #points(asked, view) {
    const { lattice } = asked;
    const some = this.wanted[0].splice(0, MOST);
    const keys = some.map(([i, j]) => view.key(i, j));
    for (const key of keys) lattice.asked.add(key);
    return this.#job(asked, Float64Array.from(some.flatMap(([i, j]) => view.row(i, j))), (found, why) => {
      for (const key of keys) lattice.asked.delete(key);
      if (!found) return;
      keys.forEach((key, k) => lattice.keep(key, found, k));
      for (const k of failedOf(found)) lattice.why.set(keys[k], why?.get(k) ?? text('whatif.refused'));
    });
  }
  /**
   * @param {Asked} asked
   * @returns {Job | null}
   */
  #edges(asked) {
    const all = this.halves?.splice(0, MOST);
    if (!all?.length) return null;
    const { lattice } = asked;
    for (const { name } of all) lattice.halving.add(name);
    return this.#job(asked, Float64Array.from(all.flatMap(({ row }) => row)), (found) => {
      lattice.version += 1;
      all.forEach(({ at, edge, name }, k) => {
        lattice.halving.delete(name);
        if (found) halve(edge, at, lattice.counted(found, k));
      });
    });
  }
  /**
   * @param {Asked} asked
   * @param {Float64Array} rows
   * @param {(found: Float64Array | null, why?: Map<number, string>) => void} take
   * @returns {Job}
   */
  #job({ chosen, figure, names }, rows, take) {
    this.under += 1;
    return {
      ...{ chosen, names, rows },
      models: { figure, bounds: BOUNDS },
      drawn: true,
      named: (models, shown) => Object.assign(this, { models, shown }),
      done: (found, _, why) => {
        this.under -= 1;
        take(found, why);
        this.came();
      },
    };
  }
}
