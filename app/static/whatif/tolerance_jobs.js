// Thousands of impacts about a scene whose values are known only to some percent, evenly spread over all that they may
// be. The newest wish wins, but not before there are some of what has begun.
import { MOST_INPUTS, haltonAt } from './spread.js';
import { PLACE, WIDTH, valueOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Progress } from './map_jobs.js' */
/** @import { Job } from './points.js' */
/** @import { Result } from './results.js' */

const FIRST = 200; // impacts, from which on they are shown
const LOST = 8; // jobs, after which what they were about counts as refused

/** @typedef {{ axis: Axis, value: number, part: number }} Input  between 1 − part and 1 + part times the value */
/**
 * @typedef {object} Asked
 * @property {string} key  of all that the impacts hang on
 * @property {Input[]} inputs
 * @property {Record<string, any>} chosen
 * @property {number} total  impacts
 */
/** @typedef {Record<'values' | 'sorted' | 'contacts', Float64Array> & { at: Int32Array }} Column  at: rows */

/**
 * The value of an input, within what it can be.
 * @param {Input} input
 * @param {number} unit  −1 to 1
 */
export function drawnOf({ axis, part, value }, unit) {
  return Math.min(Math.max(value * (1 + part * unit), axis.low), axis.high);
}

/** @param {Input} input  Whether its tolerance goes beyond what it can be. */
export const clips = ({ axis, part, value }) => {
  const ends = [value * (1 - part), value * (1 + part)];
  return Math.min(...ends) < axis.low || Math.max(...ends) > axis.high;
};

export class Samples {
  count = 0;
  refused = 0;
  /** @type {Map<Result, Column>} */ columns = new Map(); // of as many as there are now

  /** @param {Asked} asked */
  constructor(asked) {
    this.asked = asked;
    this.units = new Float64Array(asked.total * asked.inputs.length); // −1 to 1, of each input
    this.found = new Float64Array(asked.total * WIDTH);
  }
  get whole() {
    return this.count === this.asked.total;
  }
  /**
   * @param {number[][]} units
   * @param {Float64Array | null} found
   */
  add(units, found) {
    const { inputs } = this.asked;
    units.forEach((each, n) => {
      this.units.set(each, this.count * inputs.length);
      if (found) this.found.set(found.subarray(n * WIDTH, (n + 1) * WIDTH), this.count * WIDTH);
      else this.found[this.count * WIDTH] = 1;
      if (this.found[this.count * WIDTH]) this.refused += 1;
      this.count += 1;
    });
    this.columns.clear();
  }
  /**
   * All values of a result that there are.
   * @param {Result} result
   */
  column(result) {
    const known = this.columns.get(result);
    if (known) return known;
    const rows = Array.from({ length: this.count }, (_, n) => n).filter(
      (n) => !this.found[n * WIDTH] && Number.isFinite(valueOf(result, this.found, n * WIDTH)),
    );
    const values = Float64Array.from(rows, (n) => valueOf(result, this.found, n * WIDTH));
    const contacts = Float64Array.from(rows, (n) => this.found[n * WIDTH + PLACE.contacts]);
    const column = { values, sorted: values.slice().sort(), contacts, at: Int32Array.from(rows) };
    this.columns.set(result, column);
    return column;
  }
  /**
   * An input of an impact, −1 to 1.
   * @param {number} row
   * @param {number} input
   */
  unit(row, input) {
    return this.units[row * this.asked.inputs.length + input];
  }
}

export class ToleranceJobs {
  /** @type {Asked | null} */ wish = null; // the newest that has not begun
  /** @type {Samples | null} */ run = null;
  /** @type {Samples | null} */ shown = null; // the newest of which there are some
  begun = 0; // impacts of the run that were asked for
  /** @type {number[][]} */ again = []; // those whose worker has died
  lost = 0;

  /** @param {() => void} came */
  constructor(came) {
    this.came = came;
  }
  /** @param {Asked | null} asked  Nothing: what is under way is not wanted any more. */
  ask(asked) {
    const newest = this.wish ?? this.run?.asked;
    if (!asked) this.run = this.wish = this.shown = null;
    else if (newest?.key !== asked.key) this.wish = { ...asked, inputs: asked.inputs.slice(0, MOST_INPUTS) };
  }
  /** Whether the first picture is not yet there. */
  get rough() {
    return Boolean(this.wish || (this.run && this.shown !== this.run));
  }
  get idle() {
    return !this.wish && (!this.run || this.run.whole);
  }
  /** @returns {Progress | null}  of the impacts that are being found */
  get progress() {
    const { run, shown } = this;
    return run && { found: run.count, all: run.asked.total, changes: 0, coarse: run !== shown };
  }
  /**
   * @param {number} many  impacts at most
   * @returns {Job | null}
   */
  next(many) {
    if (this.wish && (!this.run || this.shown === this.run)) {
      this.run = new Samples(this.wish);
      Object.assign(this, { wish: null, begun: 0, again: [], lost: 0 });
    }
    const { run } = this;
    if (!run) return null;
    const { chosen, inputs, total } = run.asked;
    const units = this.again.splice(0, many);
    const until = this.wish ? Math.min(FIRST, total) : total;
    while (units.length < many && this.begun < until)
      units.push(haltonAt(this.begun++, inputs.length).map((share) => 2 * share - 1));
    if (!units.length) return null;
    return {
      chosen,
      names: inputs.map(({ axis }) => axis.name),
      rows: Float64Array.from(units.flatMap((each) => inputs.map((input, k) => drawnOf(input, each[k])))),
      done: (found) => {
        if (this.run !== run) return;
        if (!found && (this.lost += 1) <= LOST) this.again.push(...units);
        else run.add(units, found);
        if (run.count >= Math.min(FIRST, total)) this.shown = run;
        this.came();
      },
    };
  }
}
