// In which unit times are written, on the whole page: T, in which an impact along an axis counts them, or seconds.
import { figures } from '../text/format.js';
import { shownUnit } from '../text/units.js';
import { keep, kept } from '../browser/store.js';

/** @import { AxialFrame } from '../messages.js' */

export const TRIPS = 'T'; // the unit of an axis that is written as is chosen here
export const SECONDS = 's'; // of one that is written in the unit that suits it
const NAME = 'seconds';

/**
 * The unit that suits times of this size: how many of it a second has, and its sign.
 * @param {number} seconds
 * @returns {[factor: number, unit: string]}
 */
export function unitOfTime(seconds) {
  const { factor, sign } = shownUnit('s', seconds);
  return [1 / factor, sign];
}

/**
 * How an axis is written that ends there: how many of the unit shown its own has, and the sign of that.
 * @param {string} unit
 * @param {number} end
 * @returns {[factor: number, unit: string]}
 */
export const shownIn = (unit, end) => (unit === SECONDS ? unitOfTime(end) : [1, unit]);

class Times {
  inSeconds = kept(NAME, false);
  bare = false; // in T alone: how long one is, is not said
  trip = 1; // seconds in T
  span = 1; // of all that is shown [T]
  /** @type {(() => void)[]} */ #watchers = [];

  /** @param {Pick<AxialFrame, 'duration' | 'trip'>} frame */
  load({ duration, trip }) {
    Object.assign(this, { trip, span: duration });
  }
  /**
   * How many of the unit shown T has, and its sign.
   * @returns {[factor: number, unit: string]}
   */
  get shown() {
    if (!this.inSeconds || this.bare) return [1, TRIPS];
    const [factor, unit] = unitOfTime(this.span * this.trip);
    return [factor * this.trip, unit];
  }
  /** The unit that is not shown. */
  get other() {
    return this.inSeconds ? TRIPS : unitOfTime(this.span * this.trip)[1];
  }
  /**
   * @param {number} t  [T]
   * @param {number} [digits]
   */
  written(t, digits = 4) {
    const [factor, unit] = this.shown;
    return `${figures(t * factor, digits)} ${unit}`;
  }
  /** Write them in the other unit, from now on. */
  turn() {
    this.inSeconds = !this.inSeconds;
    keep(NAME, this.inSeconds);
    for (const watcher of this.#watchers) watcher();
  }
  /** @param {() => void} watcher  called after every change of the unit */
  watch(watcher) {
    this.#watchers.push(watcher);
  }
}

export const times = new Times();
