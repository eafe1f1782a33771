// What a map still needs, for whoever finds it: coarse points first, then finer ones, then where contacts change.
import { text } from '../text/catalogue.js';
import { placeOf } from './places.js';
import { PLACE, WIDTH } from './results.js';
import { counted, halve } from './lattice.js';
import { failedOf } from './points.js';

/** @import { Window, Point } from './window.js' */
/** @import { Job } from './points.js' */
/** @import { WhatIf } from './whatif.js' */
/**
 * How many impacts of what is drawn are found, and how many changes of contacts are still sought.
 * @typedef {{ found: number, all: number, changes: number, coarse: boolean }} Progress
 */

const SPENT = { own: { held: 5, free: 9 }, served: { held: 200, free: 400 } }; // ms that a job takes
export const TOLERANCE = 1e-5; // of a step through a contact law: colours need no more, and it is four times as quick
const [FEW, MANY] = [4, 256]; // impacts in a job
const LEFT = 16; // impacts in a job of those that the browser could not find

/**
 * @param {Window} view
 * @param {Point[][]} wanted  by level
 * @param {ReturnType<Window['halves']> | null} halves
 * @returns {Progress}
 */
export function progressOf(view, wanted, halves) {
  const { first, known } = view.counts;
  const { asked, halving } = view.lattice;
  const missing = wanted.reduce((sum, level) => sum + level.length, asked.size);
  const changes = (halves?.length ?? 0) + halving.size;
  if (view.coarse) return { ...first, changes: 0, coarse: true };
  return { found: known, all: known + missing, changes, coarse: false };
}

export class MapJobs {
  /** @type {Window | null} */ view = null;
  /** @type {Point[][]} */ wanted = []; // by level
  /** @type {ReturnType<Window['halves']> | null} */ halves = null; // once they are looked for
  partly = false; // whether of these only the first level is known
  at = /** @type {[x: number, y: number]} */ ([0, 0]); // of the scene, 0 to 1 each
  coarse = false; // whether the first picture is not yet whole
  /** @type {{ key: string, of: string, found: Float64Array | null }} */ own = { key: '', of: '', found: null };
  under = 0; // jobs that are under way

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
  }
  get idle() {
    const others = (this.whatif.modes.shown?.jobs ?? this.whatif.borders).idle;
    const found = !this.view || (this.halves?.length === 0 && !this.view.lattice.left.size);
    return others && found && !this.under && !this.wanted.length;
  }
  /** @returns {Progress | null}  of the map that is drawn */
  get progress() {
    return this.view && progressOf(this.view, this.wanted, this.halves);
  }
  /**
   * @param {Window | null} view
   */
  plan(view) {
    const { held, points } = this.whatif;
    if (held && view && view.lattice !== this.view?.lattice) points.wait();
    this.view = view;
    this.wanted = [];
    this.halves = null;
    this.coarse = false;
    if (!view) return;
    const { x, x0, x1, y, y0, y1 } = view.axes;
    const at = /** @type {[number, number]} */ ([
      (placeOf(x, this.whatif.value(x)) - x0) / (x1 - x0),
      (placeOf(y, this.whatif.value(y)) - y0) / (y1 - y0),
    ]);
    this.at = at;
    this.partly = held && points.source === points.own; // the next picture is there before more is needed
    this.wanted = view.plan(at, false, this.partly);
    this.coarse = view.coarse;
  }
  /** @returns {Job | null} */
  next() {
    const { view } = this;
    const { borders, designs, gains, goal, modes } = this.whatif;
    if (!view && !modes.shown) return null;
    const wish = this.#own() ?? designs.next() ?? goal.pulling.next() ?? goal.seek.next();
    if (wish) return wish;
    const { points } = this.whatif;
    if (points.stopped && points.source === points.served) return gains.next();
    const slow = modes.shown === modes.models; // all else comes first
    const near = borders.near.next(this.many) ?? (view || slow ? null : modes.next(this.many));
    if (near) return { ...near, drawn: true };
    const gain = view && this.coarse ? null : gains.next();
    if (gain || !view) return gain ?? (slow ? modes.next(this.many) : null);
    while (this.wanted.length && !this.wanted[0].length) this.wanted.shift();
    if (!this.wanted.length && this.partly) {
      this.partly = false;
      view.look();
      this.wanted = view.plan(this.at, false);
    }
    if (!this.wanted.length && !this.halves) {
      this.wanted = [view.mend()].filter(({ length }) => length);
      this.halves = view.halves();
    }
    const job = this.wanted.length ? this.#points(view) : (this.#edges(view) ?? borders.next(this.many));
    return job && { ...job, drawn: true };
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
    const job = this.#job(rows, 0, (found) => {
      if (found && !found[0]) Object.assign(this.own, { found, of: key });
    });
    return { ...job, wished: true };
  }
  /** Impacts in the time of a job. */
  get many() {
    const { held, points } = this.whatif;
    const spent = SPENT[points.source === points.own ? 'own' : 'served'][held ? 'held' : 'free'];
    return Math.max(FEW, Math.min(MANY, Math.round(spent / points.spent)));
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
    const job = this.#job(rows, TOLERANCE, (found, why) => {
      for (const key of keys) lattice.asked.delete(key);
      if (!found) return;
      const { points } = this.whatif;
      keys.forEach((key, k) => lattice.keep(key, found, k));
      for (const k of failedOf(found)) {
        lattice.why.set(keys[k], why?.get(k) ?? text('whatif.refused'));
        if (!points.serves) continue;
        lattice.why.set(keys[k], text('whatif.for-server'));
        lattice.left.set(keys[k], view.row(...some[k]));
      }
      points.feed();
    });
    return { ...job, apart: true };
  }
  /**
   * Impacts that the browser has no room for, the nearest to the scene first.
   * @returns {Job | null}
   */
  rest() {
    const { view } = this;
    const { modes, points, x, y } = this.whatif;
    if (!view) return modes.rest();
    if (!view?.lattice.left.size || !points.serves || !points.base || !x || !y) return null;
    const { lattice } = view;
    const places = (/** @type {number[]} */ [a, b]) => [placeOf(view.axes.x, a), placeOf(view.axes.y, b)];
    const here = places([this.whatif.value(x), this.whatif.value(y)]);
    const off = (/** @type {number[]} */ row) => Math.hypot(...places(row).map((place, k) => place - here[k]));
    const some = [...lattice.left].sort((a, b) => off(a[1]) - off(b[1])).slice(0, LEFT);
    for (const [key] of some) lattice.left.delete(key);
    const rows = Float64Array.from(some.flatMap(([, row]) => row));
    const job = this.#job(rows, TOLERANCE, (found, why) => {
      points.handed += found ? some.length : 0;
      some.forEach(([key, row], k) => {
        if (!found) lattice.left.set(key, row);
        else lattice.keep(key, found, k);
        if (found?.[k * WIDTH]) lattice.why.set(key, why?.get(k) ?? text('whatif.refused'));
      });
    });
    return { ...job, drawn: true };
  }
  /**
   * @param {Window} view
   * @returns {Job | null}
   */
  #edges(view) {
    const { lattice } = view;
    const all = this.halves?.splice(0, this.many);
    if (!all?.length) return null;
    for (const { name } of all) lattice.halving.add(name);
    const rows = Float64Array.from(all.flatMap(({ row }) => row));
    return this.#job(rows, TOLERANCE, (found) => {
      all.forEach(({ at, edge, name }, k) => {
        lattice.halving.delete(name);
        lattice.version += 1;
        if (found) halve(edge, at, found[k * WIDTH] ? -1 : counted(found[k * WIDTH + PLACE.contacts]));
      });
    });
  }
  /**
   * @param {Float64Array} rows
   * @param {number} tolerance
   * @param {(found: Float64Array | null, why?: Map<number, string>) => void} take
   * @returns {Job}
   */
  #job(rows, tolerance, take) {
    this.under += 1;
    const { chosen, named } = this.whatif;
    return {
      chosen,
      names: [named.x, named.y],
      rows,
      tolerance,
      done: (found, _, why) => {
        this.under -= 1;
        take(found, why);
        this.whatif.came();
      },
    };
  }
}
