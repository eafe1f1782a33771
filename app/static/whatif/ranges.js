// How much of each axis is shown: some decades about the scene at first, and as far as the scene has gone.
import { longOf, placeOf, usualRange } from './places.js';

/** @import { Axis } from './axes.js' */
/** @typedef {[from: number, to: number]} Range  places */

const BEYOND = 0.1; // of what is shown, that it reaches beyond the scene

export class Ranges {
  /** @type {Map<string, Range>} */ shown = new Map(); // by axis
  /** @type {Map<string, number>} */ places = new Map(); // of the scene

  /**
   * @param {Axis} axis
   * @param {number} value  of the scene
   */
  of(axis, value) {
    const known = this.shown.get(axis.name) ?? usualRange(axis, value);
    this.shown.set(axis.name, known);
    return known;
  }
  /**
   * Reach as far as the scene has gone; where it has not moved, a closer look stays.
   * @param {Axis} axis
   * @param {number} value  of the scene
   */
  follow(axis, value) {
    const at = placeOf(axis, value);
    if (this.shown.has(axis.name) && at !== this.places.get(axis.name)) {
      const [from, to] = this.of(axis, value);
      const beyond = BEYOND * (to - from);
      const low = at < from ? Math.max(at - beyond, 0) : from;
      this.set(axis, [low, at > to ? Math.min(at + beyond, longOf(axis)) : to]);
    }
    this.places.set(axis.name, at);
  }
  /**
   * @param {Axis} axis
   * @param {Range} range
   */
  set(axis, range) {
    this.shown.set(axis.name, range);
  }
  clear() {
    this.shown.clear();
    this.places.clear();
  }
}
