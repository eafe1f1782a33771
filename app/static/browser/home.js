// Where the laboratory is at home: it is the page that its server sends, or a component of another page, which keeps
// address, history and keys for itself.
import { placeOf } from '../place.js';

/** @import { Listed } from '../gallery/gallery.js' */
/** @import { Spec } from '../wire/model.js' */

/**
 * @typedef {object} Carried  what came with a page that has no server, see app/serving/folder.py
 * @property {Spec} spec
 * @property {Listed & { lacking: number }} gallery  `lacking`: lessons that need a server
 * @property {Record<string, import('../lesson/lesson.js').Record_>} lessons  by name
 * @property {string} kernels  fingerprint of their sources
 * @property {string} laboratory  address of one with a server, or nothing
 * @property {ArrayBuffer[]} messages  one of each scene
 * @property {() => Promise<ArrayBuffer>} module  of the kernels; rejects where it is missing or damaged
 * @property {() => Promise<ArrayBuffer>} worker  script of a worker that has them; likewise
 */

/** Nothing where there is a server. */
export const carried = /** @type {Carried | null} */ (/** @type {any} */ (globalThis).strikewaveCarried ?? null);
/** Whether it is the page itself. */
export const alone = Boolean(globalThis.document?.getElementById('session'));
/** Whether it is in a frame, in the page of another site, whose address asks for that. */
export const framed = alone && new URLSearchParams(globalThis.location.search).has('embed');

/**
 * The address of something else that is served with this script.
 * @param {string} name
 */
export const served = (name) => new URL(placeOf(`../../${name}`));

/**
 * @template Entry
 * @typedef {object} Entries  what `window.history` has of these
 * @property {Entry | null} state
 * @property {() => void} back
 * @property {() => void} forward
 * @property {(entry: Entry, title: string, address: string) => void} pushState
 * @property {(entry: Entry, title: string, address: string) => void} replaceState
 */

/**
 * What stands for the history of the browser in another's page, and in a frame, where that is of the whole tab.
 * @template Entry
 * @implements {Entries<Entry>}
 */
export class Steps {
  /** @type {Entry[]} */ entries = [];
  at = 0;

  /**
   * @param {() => void} arrive  after it has gone to another entry
   * @param {(address: string) => void} [follow]  to the address of what is shown
   */
  constructor(arrive, follow = () => {}) {
    this.arrive = arrive;
    this.follow = follow;
  }
  get state() {
    return this.entries[this.at] ?? null;
  }
  /**
   * @param {Entry} entry
   * @param {string} [title]
   * @param {string} [address]
   */
  replaceState(entry, title, address) {
    this.entries[this.at] = entry;
    if (address) this.follow(address);
  }
  /**
   * @param {Entry} entry
   * @param {string} [title]
   * @param {string} [address]
   */
  pushState(entry, title, address) {
    this.entries.splice(++this.at, Infinity, entry);
    if (address) this.follow(address);
  }
  back() {
    this.#go(-1);
  }
  forward() {
    this.#go(1);
  }
  /** @param {number} by */
  #go(by) {
    if (!(this.at + by in this.entries)) return;
    this.at += by;
    this.arrive();
  }
}
