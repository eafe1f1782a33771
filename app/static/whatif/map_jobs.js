// What a map still needs, for whoever finds it: coarse points first, then finer ones, then where contacts change.
import { text } from '../text/catalogue.js';
import { placeOf } from './places.js';
import { PLACE, WIDTH } from './results.js';
import { halve } from './lattice.js';

/** @import { Window, Point } from './lattice.js' */
/** @import { Job } from './points.js' */
/** @import { WhatIf } from './whatif.js' */

const SPENT = { held: 5, free: 9 }; // ms that a job takes
const [FEW, MANY] = [4, 400]; // impacts in a job

export class MapJobs {
  /** @type {Window | null} */ view = null;
  /** @type {Point[][]} */ wanted = []; // by level
  coarse = false; // whether the first picture is not yet whole
  /** @type {{ key: string, found: Float64Array | null }} */ own = { key: '', found: null };
  under = 0; // jobs that are under way

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
  }
  get idle() {
    return !this.under && !this.wanted.length && (this.whatif.modes.shown?.jobs.idle ?? true);
  }
  /**
   * @param {Window | null} view
   */
  plan(view) {
    this.view = view;
    this.wanted = [];
    this.coarse = false;
    if (!view) return;
    const { x, x0, x1, y, y0, y1 } = view.axes;
    const at = /** @type {[number, number]} */ ([
      (placeOf(x, this.whatif.value(x)) - x0) / (x1 - x0),
      (placeOf(y, this.whatif.value(y)) - y0) / (y1 - y0),
    ]);
    this.wanted = view.plan(at, false);
    this.coarse = view.coarse;
  }
  /** @returns {Job | null} */
  next() {
    const { view } = this;
    const { modes } = this.whatif;
    if (!view && !modes.shown) return null;
    const first = this.#own() ?? this.whatif.goal.seek.next();
    if (first) return first;
    if (!view) return modes.next(this.many);
    while (this.wanted.length && !this.wanted[0].length) this.wanted.shift();
    return this.wanted.length ? this.#points(view) : this.#edges(view);
  }
  /**
   * The scene itself, where the page's answer does not say all that is shown.
   * @returns {Job | null}
   */
  #own() {
    const { chosen, x, y } = this.whatif;
    const key = JSON.stringify(chosen);
    if (key === this.own.key) return null;
    this.own.key = key;
    const rows = Float64Array.of(this.whatif.value(x), this.whatif.value(y));
    return this.#job(rows, (found) => {
      if (found && !found[0]) this.own.found = found;
    });
  }
  /** Impacts in the time of a job. */
  get many() {
    const { held, points } = this.whatif;
    return Math.max(FEW, Math.min(MANY, Math.round(SPENT[held ? 'held' : 'free'] / points.spent)));
  }
  /**
   * @param {Window} view
   * @returns {Job}
   */
  #points(view) {
    const { lattice } = view;
    const some = this.wanted[0].splice(0, this.many);
    const keys = some.map(([i, j]) => view.key(i, j));
    for (const key of keys) lattice.asked.add(key);
    const rows = Float64Array.from(some.flatMap(([i, j]) => view.row(i, j)));
    return this.#job(rows, (found, why) => {
      keys.forEach((key, k) => {
        lattice.asked.delete(key);
        if (!found) return;
        lattice.keep(key, found, k);
        if (found[k * WIDTH]) lattice.why.set(key, why?.get(k) ?? text('whatif.refused'));
      });
    });
  }
  /**
   * @param {Window} view
   * @returns {Job | null}
   */
  #edges(view) {
    const { lattice } = view;
    const all = view.halves(this.many);
    if (!all.length) return null;
    for (const { name } of all) lattice.halving.add(name);
    const rows = Float64Array.from(all.flatMap(({ row }) => row));
    return this.#job(rows, (found) => {
      all.forEach(({ at, edge, name }, k) => {
        lattice.halving.delete(name);
        if (found) halve(edge, at, found[k * WIDTH] ? -1 : found[k * WIDTH + PLACE.contacts]);
      });
    });
  }
  /**
   * @param {Float64Array} rows
   * @param {(found: Float64Array | null, why?: Map<number, string>) => void} take
   * @returns {Job}
   */
  #job(rows, take) {
    this.under += 1;
    const { chosen, named } = this.whatif;
    return {
      chosen,
      names: [named.x, named.y],
      rows,
      done: (found, _, why) => {
        this.under -= 1;
        take(found, why);
        this.whatif.came();
      },
    };
  }
}
