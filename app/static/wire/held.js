// What a link takes from the controls: some are hidden, some stay as they are, some move within bounds. That helps a
// class to look at one thing; it is no lock, as anybody may change the link.
import { text } from '../text/catalogue.js';

/** @import { Chosen } from '../messages.js' */
/** @import { Bounds, Spec } from './model.js' */

export const CLOSER = 'closer'; // the ways to look closer below the picture, and its source, which are no choice
const LESSONS = ['lesson', 'class']; // which say themselves what may be moved
const NUMBER = /^-?\d{1,20}(\.\d{1,20})?(e[+-]?\d{1,3})?$/i;
const OF_BODIES = ['mass_ratio', 'slenderness']; // which move with the values of bodies
const LONGEST = 40; // letters of a value that are said

/**
 * The ends that a slider may have, or nothing where it cannot have these.
 * @param {string[]} ends
 * @param {Bounds} bounds  that it has
 * @returns {[low: number, high: number] | null}
 */
export function endsOf(ends, { high: most, low: least, whole }) {
  const [low, high] = ends.map(Number);
  const numbers = ends.length === 2 && ends.every((end) => NUMBER.test(end));
  const possible = numbers && low < high && low >= least && high <= most;
  return possible && (!whole || (Number.isInteger(low) && Number.isInteger(high))) ? [low, high] : null;
}

export class Held {
  /** @type {Set<string>} */ hidden = new Set();
  /** @type {Set<string>} */ fixed = new Set();
  /** @type {Map<string, [low: number, high: number]>} */ bounds = new Map();
  /** @type {[key: string, name: string, allowed: string[]][]} */ unknown = [];
  /** @type {string[]} */ refused = []; // sentences of others
  scene = ''; // whose values were brought within the bounds

  /**
   * @param {string} search  of the address
   * @param {Spec} spec
   */
  constructor(search, spec) {
    this.spec = spec;
    const query = new URLSearchParams(search);
    if (LESSONS.some((key) => query.has(key))) return;
    const all = (/** @type {string} */ key) => (query.get(key) ?? '').split(',').filter(Boolean);
    const hideable = [...Object.keys(spec), CLOSER];
    for (const name of all('hide')) this.#named('hide', name, hideable, () => this.hidden.add(name));
    const fixable = Object.keys(spec).filter((name) => name !== 'bodies');
    for (const name of all('fix')) this.#named('fix', name, fixable, () => this.fixed.add(name));
    const both = [...this.hidden].filter((name) => this.fixed.delete(name)); // as it is not seen
    if (both.length) this.refused.push(text('held.both', { names: both }));
    const sliders = Object.keys(spec).filter((name) => spec[name].low !== undefined);
    for (const given of all('bound')) {
      const [name, ...ends] = given.split(':');
      this.#named('bound', name, sliders, () => this.#bound(given, name, ends));
    }
  }
  /**
   * @param {string} key
   * @param {string} name
   * @param {string[]} allowed
   * @param {() => void} take
   */
  #named(key, name, allowed, take) {
    if (allowed.includes(name)) take();
    else this.unknown.push([key, name.slice(0, LONGEST), allowed]);
  }
  /**
   * @param {string[]} acting  what the scene has
   * @returns {string[]}  sentences
   */
  refusals(acting) {
    const said = this.unknown.map(([key, value, allowed]) =>
      text('held.name', { key, value, options: allowed.filter((name) => name === CLOSER || acting.includes(name)) }),
    );
    return [...said, ...this.refused];
  }
  /**
   * @param {string} given
   * @param {string} name
   * @param {string[]} ends
   */
  #bound(given, name, ends) {
    const { high: most, low: least, whole } = this.spec[name];
    const found = endsOf(ends, this.spec[name]);
    if (found) this.bounds.set(name, found);
    else this.refused.push(text('held.bound', { value: given.slice(0, LONGEST), name, least, most, whole }));
  }
  /**
   * Whether nobody is to change a choice.
   * @param {string} name
   */
  stays(name) {
    return this.hidden.has(name) || this.fixed.has(name);
  }
  /** Whether values of bodies stay as they are, as they would move a choice that does not. */
  get bodies() {
    return OF_BODIES.some((name) => this.stays(name) || this.bounds.has(name));
  }
  /**
   * The value that a choice may have instead of one that is asked for.
   * @template {number | string} Value
   * @param {string} name
   * @param {Value} value
   * @param {Value} now  that it has
   * @returns {Value}
   */
  within(name, value, now) {
    if (this.stays(name)) return now;
    const [low, high] = this.bounds.get(name) ?? [-Infinity, Infinity];
    return typeof value === 'number' ? /** @type {Value} */ (Math.min(Math.max(value, low), high)) : value;
  }
  /**
   * Choices of a scene that has just come, which are beyond their bounds, and where they are to go.
   * @param {Chosen} chosen
   * @returns {[name: string, value: number][]}
   */
  beyond(chosen) {
    if (chosen.scene === this.scene) return [];
    this.scene = String(chosen.scene);
    return [...this.bounds].flatMap(([name, [low, high]]) => {
      const value = Number(chosen[name]);
      const to = Math.min(Math.max(value, low), high);
      return value === to ? [] : [/** @type {[string, number]} */ ([name, to])];
    });
  }
  /** @returns {[key: string, value: string][]}  what the address says of it */
  get said() {
    const bounds = [...this.bounds].map(([name, ends]) => [name, ...ends].join(':'));
    const all = { hide: [...this.hidden], fix: [...this.fixed], bound: bounds };
    return Object.entries(all).flatMap(([key, names]) =>
      names.length ? [/** @type {[string, string]} */ ([key, names.join(',')])] : [],
    );
  }
}
