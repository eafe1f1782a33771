// All results over one choice: samples, coarse ones first, then every place between them where the number of contacts
// changes. The newest wish wins, but a coarse curve that has begun is brought to its end, so that something moves.
import { longOf, valueAt } from './places.js';
import { PLACE, WIDTH, valueOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Progress } from './map_jobs.js' */
/** @import { Job } from './points.js' */
/** @import { Result } from './results.js' */

const [PARTS, EVERY] = [160, 4]; // of a curve; every so manieth first
const NARROW = 1e-6; // of an axis: then a change is found
const LOST = 8; // jobs, after which what they were about counts as refused

/**
 * @typedef {object} Asked
 * @property {string} key  of all that the results hang on
 * @property {Axis} axis
 * @property {number} from  place
 * @property {number} to  place
 * @property {[name: string, value: number][]} fixed  other choices that are said with each impact
 * @property {Record<string, any>} chosen
 * @property {number} [parts]  of the curve
 * @property {number} [most]  contacts: more count as so many
 */
/**
 * A change of the number of contacts, between two places.
 * @typedef {object} Change
 * @property {number} low  place
 * @property {number} high  place
 * @property {Float64Array} before  what is found at the lower one
 * @property {Float64Array} after  and at the higher one
 * @property {boolean} asked
 */

/**
 * All results over one axis, where the scene is on the other.
 * @param {import('./whatif.js').WhatIf} whatif
 * @param {Axis} axis
 * @param {Axis} other
 * @returns {Asked}
 */
export function askedOver(whatif, axis, other) {
  const { chosen, points } = whatif;
  const [from, to] = whatif.range(axis);
  const others = Object.entries(chosen).filter(([name]) => name !== axis.name);
  const key = JSON.stringify([others, axis, from, to, points.source === points.own, other.name]);
  return { key, axis, from, to, fixed: [[other.name, whatif.value(other)]], chosen };
}

/**
 * The number of contacts; −1 where nothing can be computed.
 * @param {Float64Array} found
 * @param {number} [at]  where its row begins
 */
export const countOf = (found, at = 0) => (found[at] ? -1 : found[at + PLACE.contacts]);

export class Curve {
  /** @type {Change[] | null} */ changes = null; // in order; none before all samples are known
  whole = false; // whether all changes are found

  /** @param {Asked} asked */
  constructor(asked) {
    this.asked = asked;
    const { from, parts = PARTS, to } = asked;
    this.places = Array.from({ length: parts + 1 }, (_, k) => from + (k / parts) * (to - from));
    this.found = new Float64Array((parts + 1) * WIDTH);
    this.known = new Uint8Array(parts + 1);
  }
  /** @param {number} k  a sample */
  count(k) {
    return this.counted(this.row(k));
  }
  /** @param {Float64Array} row  Contacts, as lines distinguish them. */
  counted(row) {
    return Math.min(countOf(row), this.asked.most ?? Infinity);
  }
  /** @param {number} k  a sample */
  row(k) {
    return this.found.subarray(k * WIDTH, (k + 1) * WIDTH);
  }
  /** Where the number of contacts may change, once all samples are known. */
  compare() {
    this.changes = [];
    for (let k = 0; k + 1 < this.places.length; k++)
      if (this.count(k) !== this.count(k + 1)) {
        const [low, high] = [this.places[k], this.places[k + 1]];
        this.changes.push({ low, high, before: this.row(k), after: this.row(k + 1), asked: false });
      }
  }
  /** @param {Change} change  Whether it is found. */
  narrow({ high, low }) {
    return high - low <= NARROW * longOf(this.asked.axis);
  }
  /**
   * What is found half way of a change.
   * @param {Change} change
   * @param {Float64Array} row
   */
  halve(change, row) {
    const middle = (change.low + change.high) / 2;
    const count = this.counted(row);
    if (count === this.counted(change.before)) Object.assign(change, { low: middle, before: row });
    else if (count === this.counted(change.after)) Object.assign(change, { high: middle, after: row });
    else {
      const at = /** @type {Change[]} */ (this.changes).indexOf(change);
      this.changes?.splice(at + 1, 0, { ...change, low: middle, before: row, asked: false });
      Object.assign(change, { high: middle, after: row });
    }
  }
  /**
   * Stretches with as many contacts each, from left to right.
   * @returns {{ from: number, to: number, count: number }[]}
   */
  bands() {
    /** @type {{ from: number, to: number, count: number }[]} */
    const bands = [];
    const add = (/** @type {number} */ place, /** @type {number} */ count) => {
      const last = bands.at(-1);
      if (last?.count === count) return;
      if (last) last.to = place;
      bands.push({ from: place, to: this.asked.to, count });
    };
    let before = -1;
    this.places.forEach((place, k) => {
      if (!this.known[k]) return;
      if (before < 0) add(this.asked.from, this.count(k));
      else if (!this.changes) add((place + this.places[before]) / 2, this.count(k));
      before = k;
    });
    for (const { after, high, low } of this.changes ?? []) add((low + high) / 2, countOf(after));
    return bands;
  }
  /**
   * A result in pieces without a change, each a line of places and values.
   * @param {Result} result
   */
  pieces(result) {
    /** @type {[place: number, value: number][][]} */
    const pieces = [[]];
    const end = () => pieces.at(-1)?.length && pieces.push([]);
    const add = (/** @type {number} */ place, /** @type {Float64Array} */ row) => {
      const value = row[0] ? NaN : valueOf(result, row);
      if (Number.isFinite(value)) pieces[pieces.length - 1].push([place, value]);
      else end();
    };
    const changes = [...(this.changes ?? [])];
    let count = NaN;
    this.places.forEach((place, k) => {
      if (!this.known[k]) return;
      for (; changes.length && changes[0].low < place; changes.shift()) {
        add(changes[0].low, changes[0].before);
        end();
        add(changes[0].high, changes[0].after);
      }
      if (!this.changes && count !== this.count(k)) end();
      count = this.count(k);
      add(place, this.row(k));
    });
    return pieces.filter((piece) => piece.length);
  }
}

export class CurveJobs {
  /** @type {Asked | null} */ wish = null; // the newest that has not begun
  /** @type {Curve | null} */ run = null;
  /** @type {Curve | null} */ shown = null; // the newest that is there from end to end
  /** @type {number[]} */ coarse = []; // samples that nobody was asked for
  /** @type {number[]} */ fine = [];
  under = 0; // samples that are under way
  lost = 0;

  /** @param {() => void} came */
  constructor(came) {
    this.came = came;
  }
  /** @param {Asked | null} asked  Nothing: what is under way is not wanted any more. */
  ask(asked) {
    const newest = this.wish ?? this.run?.asked;
    if (!asked) this.run = this.wish = this.shown = null;
    else if (newest?.key !== asked.key) this.wish = asked;
  }
  /** Whether the first picture is not yet there. */
  get rough() {
    return Boolean(this.wish || (this.run && this.shown !== this.run));
  }
  get idle() {
    return !this.wish && (!this.run || this.run.whole);
  }
  /** @returns {Progress | null}  of the curve that is being found */
  get progress() {
    const { run, shown } = this;
    if (!run) return null;
    const changes = run.changes?.filter((each) => !run.narrow(each)).length ?? 0;
    const found = run.known.reduce((sum, known) => sum + known, 0);
    return { found, all: run.places.length, changes, coarse: run !== shown };
  }
  /**
   * @param {number} many  impacts at most
   * @returns {Job | null}
   */
  next(many) {
    if (this.wish && (!this.run || this.shown === this.run)) this.#begin(this.wish);
    const { run } = this;
    if (!run) return null;
    const queue = this.coarse.length ? this.coarse : this.fine;
    if (queue.length) return queue === this.fine && this.wish ? null : this.#samples(run, queue.splice(0, many));
    return run.changes ? this.#halves(run, run.changes, many) : null;
  }
  /** @param {Asked} asked */
  #begin(asked) {
    this.run = new Curve(asked);
    this.wish = null;
    this.under = this.lost = 0;
    const all = this.run.places.map((_, k) => k);
    this.coarse = all.filter((k) => k % EVERY === 0);
    this.fine = all.filter((k) => k % EVERY);
  }
  /**
   * @param {Curve} run
   * @param {number[]} some  samples
   */
  #samples(run, some) {
    this.under += some.length;
    return this.#job(
      run,
      some.map((k) => run.places[k]),
      (found) => {
        this.under -= some.length;
        if (!found && (this.lost += 1) <= LOST) {
          this.coarse.unshift(...some);
          return;
        }
        some.forEach((k, n) => {
          run.known[k] = 1;
          if (found) run.found.set(found.subarray(n * WIDTH, (n + 1) * WIDTH), k * WIDTH);
          else run.found[k * WIDTH] = 1;
        });
        const there = run.places.every((_, k) => k % EVERY || run.known[k]);
        if (there) this.shown = run;
        if (this.under || this.coarse.length || this.fine.length) return;
        run.compare();
        this.#settle(run);
      },
    );
  }
  /**
   * @param {Curve} run
   * @param {Change[]} changes
   * @param {number} many
   */
  #halves(run, changes, many) {
    const some = changes.filter((each) => !each.asked && !run.narrow(each)).slice(0, many);
    if (!some.length) return null;
    for (const change of some) change.asked = true;
    return this.#job(
      run,
      some.map(({ high, low }) => (low + high) / 2),
      (found) => {
        if (!found && (this.lost += 1) > LOST) this.run = null; // as far as it is
        some.forEach((change, n) => {
          change.asked = false;
          if (found) run.halve(change, found.slice(n * WIDTH, (n + 1) * WIDTH));
        });
        this.#settle(run);
      },
    );
  }
  /** @param {Curve} run  Whether all of it is found. */
  #settle(run) {
    run.whole = Boolean(run.changes?.every((each) => run.narrow(each)));
  }
  /**
   * @param {Curve} run
   * @param {number[]} places
   * @param {(found: Float64Array | null) => void} take
   * @returns {Job}
   */
  #job(run, places, take) {
    const { axis, chosen, fixed } = run.asked;
    const others = fixed.map(([, value]) => value);
    return {
      chosen,
      names: [axis.name, ...fixed.map(([name]) => name)],
      rows: Float64Array.from(places.flatMap((place) => [valueAt(axis, place), ...others])),
      done: (found) => {
        if (this.run !== run) return;
        take(found);
        this.came();
      },
    };
  }
}
