// Where one choice gives a result that is wanted: the result over all that the choice can be, then every place where it
// crosses what is wanted, and every leap across it, which is none.
import { longOf, valueAt } from './places.js';
import { PLACE, WIDTH, valueOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Job } from './points.js' */
/** @import { Result } from './results.js' */

const SAMPLES = 97;
const ROUNDS = 40; // at most, of halving and of chords
const NARROW = 1e-9; // of an axis: then it is found
const CLOSE = 1e-5; // of what is wanted: what is off by more is a leap

/**
 * @typedef {object} Asked
 * @property {Axis} axis  that gives way
 * @property {Result} result
 * @property {number} wanted
 * @property {Record<string, any>} chosen  all choices, with those that are set otherwise
 * @property {[name: string, value: number][]} fixed  values of axes that are set otherwise
 */
/**
 * @typedef {object} Sought
 * @property {Asked} asked
 * @property {number[]} places  on the axis, of all samples
 * @property {number[]} values  NaN where there is none
 * @property {number[]} contacts
 * @property {number[]} roots  places
 * @property {number[]} leaps  places
 */
/** @typedef {{ low: number, high: number, atLow: number, atHigh: number }} Bracket  places, and off by how much */

export class Seek {
  /** @type {Asked | null} */ wish = null; // the newest that has not begun
  /** @type {{ sought: Sought, brackets: Bracket[] | null, asked: boolean, round: number } | null} */ run = null;

  /**
   * @param {(sought: Sought) => void} done
   */
  constructor(done) {
    this.done = done;
  }
  /** @param {Asked | null} asked  Nothing: what is under way is not wanted any more. */
  ask(asked) {
    this.wish = asked;
    if (!asked) this.run = null;
  }
  get idle() {
    return !this.run && !this.wish;
  }
  /** @returns {Job | null} */
  next() {
    if (!this.run && this.wish) {
      const { axis } = this.wish;
      const places = Array.from({ length: SAMPLES }, (_, k) => (k / (SAMPLES - 1)) * longOf(axis));
      const sought = { asked: this.wish, places, values: [], contacts: [], roots: [], leaps: [] };
      this.run = { sought, brackets: null, asked: false, round: 0 };
      this.wish = null;
    }
    const { run } = this;
    if (!run || run.asked) return null;
    run.asked = true;
    const { brackets } = run;
    const places = brackets ? brackets.map((each) => between(each, run.round)) : run.sought.places;
    return this.#job(run, places, (found) => {
      if (brackets) this.#narrow(run, brackets, places, found);
      else this.#bracket(run, found);
    });
  }
  /**
   * @param {NonNullable<Seek['run']>} run
   * @param {number[]} places
   * @param {(found: Float64Array) => void} take
   * @returns {Job}
   */
  #job(run, places, take) {
    const { axis, chosen, fixed } = run.sought.asked;
    const others = fixed.map(([, value]) => value);
    return {
      chosen,
      names: [...fixed.map(([name]) => name), axis.name],
      wished: true,
      rows: Float64Array.from(places.flatMap((place) => [...others, valueAt(axis, place)])),
      done: (found) => {
        if (this.run !== run) return;
        run.asked = false;
        if (found) take(found);
        else this.run = null; // whoever was asked is gone
      },
    };
  }
  /**
   * @param {NonNullable<Seek['run']>} run
   * @param {Float64Array} found
   */
  #bracket(run, found) {
    const { sought } = run;
    const { asked, places } = sought;
    sought.values = places.map((_, k) => (found[k * WIDTH] ? NaN : valueOf(asked.result, found, k * WIDTH)));
    sought.contacts = places.map((_, k) => (found[k * WIDTH] ? -1 : found[k * WIDTH + PLACE.contacts]));
    const off = sought.values.map((value) => value - asked.wanted);
    sought.roots = places.filter((_, k) => off[k] === 0);
    run.brackets = places.slice(1).flatMap((high, k) => {
      const crosses = off[k] * off[k + 1] < 0;
      return crosses ? [{ low: places[k], high, atLow: off[k], atHigh: off[k + 1] }] : [];
    });
    if (!run.brackets.length) this.#end(sought);
  }
  /**
   * @param {NonNullable<Seek['run']>} run
   * @param {Bracket[]} brackets
   * @param {number[]} places
   * @param {Float64Array} found
   */
  #narrow(run, brackets, places, found) {
    const { sought } = run;
    const { asked } = sought;
    run.round += 1;
    const close = CLOSE * Math.abs(asked.wanted) || CLOSE;
    run.brackets = brackets.flatMap((each, k) => {
      const off = found[k * WIDTH] ? NaN : valueOf(asked.result, found, k * WIDTH) - asked.wanted;
      const place = places[k];
      if (Math.abs(off) < 1e-3 * close) {
        sought.roots.push(place);
        return [];
      }
      const left = off * each.atLow < 0;
      const next = left ? { ...each, high: place, atHigh: off } : { ...each, low: place, atLow: off };
      const thin = next.high - next.low < NARROW * longOf(asked.axis) || run.round >= ROUNDS || Number.isNaN(off);
      if (!thin) return [next];
      const near = Math.min(Math.abs(next.atLow), Math.abs(next.atHigh)) < close;
      (near ? sought.roots : sought.leaps).push(place);
      return [];
    });
    if (!run.brackets.length) this.#end(sought);
  }
  /** @param {Sought} sought */
  #end(sought) {
    sought.roots.sort((a, b) => a - b);
    this.run = null;
    this.done(sought);
  }
}

/**
 * Where to look next: where the chord crosses, and every third time half way, so that it does not creep.
 * @param {Bracket} bracket
 * @param {number} round
 */
function between({ atHigh, atLow, high, low }, round) {
  const chord = low - (atLow * (high - low)) / (atHigh - atLow);
  return round % 3 === 2 || !(chord > low && chord < high) ? (low + high) / 2 : chord;
}

/**
 * The root that is nearest to a place, if there is one.
 * @param {Sought} sought
 * @param {number} place
 */
export const nearestTo = ({ roots }, place) =>
  roots.length ? roots.reduce((best, each) => (Math.abs(each - place) < Math.abs(best - place) ? each : best)) : null;
