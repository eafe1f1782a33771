// Impacts on a lattice over two axes, kept: what has been found there stays true as long as nothing else is chosen.
import { NAMES, PLACE, WIDTH, valueOf } from './results.js';

/** @import { Mapped } from './results.js' */

export const MISSING = -1;
export const MANY = 6; // contacts: with as many or more each impact has a number of its own, and there are no lines

/** @param {number} contacts  As lines on a map tell them apart. */
export const counted = (contacts) => Math.min(contacts, MANY);

/** @typedef {{ low: number, high: number, from: number, steps: number }} Edge  of contacts `from` at `low` */

export class Lattice {
  names = NAMES; // of results that are not straight lines everywhere
  halvings = 5; // of a step, until a change of contacts is found to 1e-3 of an axis
  /** @type {Map<number, number>} */ points = new Map(); // number of a point, by its place at the finest level
  count = 0;
  version = 0; // changes with whatever is found
  data = new Float64Array(WIDTH * 4096);
  /** @type {Map<string, Edge>} */ edges = new Map(); // on which the number of contacts changes
  /** @type {Set<number>} */ asked = new Set(); // points that are under way
  /** @type {Set<string>} */ halving = new Set(); // edges that are
  /** @type {Set<number>} */ spared = new Set(); // points between which a straight line will do
  /** @type {Map<number, number[]>} */ left = new Map(); // points that the browser has no room for: values of both axes
  /** @type {Map<number, string>} */ why = new Map(); // points that are refused

  /** @param {number} number  of all that there were */
  constructor(number) {
    this.number = number;
  }
  /**
   * @param {number} key
   * @param {Float64Array} found
   * @param {number} row
   */
  keep(key, found, row) {
    const known = this.points.get(key) ?? this.count++;
    this.version += 1;
    this.points.set(key, known);
    if (this.count * WIDTH > this.data.length) {
      const data = new Float64Array(this.data.length * 2);
      data.set(this.data);
      this.data = data;
    }
    this.why.delete(key);
    this.data.set(found.subarray(row * WIDTH, (row + 1) * WIDTH), known * WIDTH);
  }
  /**
   * A result at a point that is kept.
   * @param {Mapped} name
   * @param {number} point
   */
  value(name, point) {
    return valueOf(name, this.data, point * WIDTH);
  }
  /**
   * The number of contacts of a point that is kept, `MANY` of those with as many or more; negative where it is refused,
   * 0 where none is known.
   * @param {number} point
   */
  contacts(point) {
    if (point === MISSING) return 0;
    const at = point * WIDTH;
    return this.data[at] ? -1 : counted(this.data[at + PLACE.contacts]);
  }
}

/**
 * What is kept of what has been looked at, the newest.
 * @template {Lattice} L
 */
export class Lattices {
  /** @type {Map<string, L>} */ all = new Map();
  made = 0;

  /**
   * @param {number} most
   * @param {(number: number) => L} make
   */
  constructor(most, make) {
    this.most = most;
    this.make = make;
  }
  /** @param {string} key  of all that its impacts hang on */
  get(key) {
    const found = this.all.get(key) ?? this.make((this.made += 1));
    this.all.delete(key);
    this.all.set(key, found); // the newest last
    for (const [old] of [...this.all].slice(0, -this.most)) this.all.delete(old);
    return found;
  }
  clear() {
    this.all.clear();
  }
}

/**
 * What came of the half of an edge.
 * @param {Edge} edge
 * @param {number} at
 * @param {number} contacts  there; negative where it is refused
 */
export function halve(edge, at, contacts) {
  if (contacts === edge.from) edge.low = at;
  else edge.high = at;
  edge.steps += 1;
}
