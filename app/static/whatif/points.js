// Where the impacts of a map come from: the browser's own kernels, which other threads ask, or the server. What is to
// be found next is asked for only when one of them is free, so that the newest wish is always next.
import { byOf, called, errorsOf } from '../text/words.js';
import { Pool } from './pool.js';
import { Served } from './server.js';

/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */

/**
 * @typedef {object} Job
 * @property {Record<string, any>} chosen  the other choices
 * @property {string[]} names  of choices that its impacts differ by
 * @property {Float64Array} rows  their values, impact by impact
 * @property {number} [tolerance]  of a step through a contact law; 0: that of the page's own answers
 * @property {boolean} [file]  the scene file of the first impact is wanted, and by which keys the others differ from it
 * @property {(found: Float64Array | null, spent: number, why?: Map<number, string>, file?: SceneFile) => void} done
 */
/** @typedef {{ scene: string, keys: Record<string, (number | null)[]> | null }} SceneFile */
/**
 * @typedef {object} Source
 * @property {() => Promise<boolean>} prepare
 * @property {(frame: Frame, names: string[]) => boolean} covers
 * @property {(frame: Frame) => void} scene
 * @property {() => void} feed
 * @property {boolean} idle
 * @property {() => void} leave
 */

const MOST = 32; // jobs that wait for the server
const QUICK = 3; // ms for an impact, above which it takes long

export class Points {
  /** @type {Source | null} */ source = null; // of what is shown
  /** @type {Frame | null} */ base = null; // that its impacts are made from
  spent = 0.3; // ms for an impact
  solved = 0;
  /** @type {Job[]} */ files = []; // that the server is asked for
  /** @type {Job[]} */ queue = []; // that the server is asked while the browser finds the others
  /** @type {Frame | null} */ asked = null; // what the server is asked about
  ready = false;

  /**
   * @param {Page} page
   * @param {() => Job | null} next
   */
  constructor(page, next) {
    this.page = page;
    /** @type {Source} */ this.own = new Pool(() => (this.source === this.own ? this.#counted(next()) : null));
    /** @type {Source} */ this.served = new Served(
      page,
      () => this.files.shift() ?? (this.source === this.served ? this.#counted(next()) : this.#left()),
    );
    /** @type {Source[]} */ this.sources = [];
  }
  async prepare() {
    const all = [this.own, this.served];
    const there = await Promise.all(all.map((each) => each.prepare()));
    this.sources = all.filter((_, k) => there[k]);
    this.ready = true;
  }
  /**
   * @param {Job | null} job
   * @returns {Job | null}
   */
  #counted(job) {
    if (!job) return null;
    const count = job.rows.length / job.names.length;
    return {
      ...job,
      done: (found, spent, why) => {
        if (found) {
          this.spent += 0.2 * (spent / count - this.spent);
          this.solved += count;
        }
        job.done(found, spent, why);
      },
    };
  }
  /** Whether an impact is found in a moment. */
  get quick() {
    return this.source === this.own && this.spent < QUICK;
  }
  /**
   * What the next are about: the scene as it is chosen, over these choices, whether they can be found; over others they
   * are if `covers` says so.
   * @param {Chosen} chosen
   * @param {string[]} names
   */
  about(chosen, names) {
    const { latest } = this.page.changes;
    const bases = [...(this.base ? [this.base] : []), latest, ...(this.page.own.whole ? [this.page.own.whole] : [])];
    const changed = (/** @type {Frame} */ frame) =>
      Object.keys(chosen).filter((name) => !Object.is(frame.chosen[name], chosen[name]));
    const same = (/** @type {Frame} */ frame) =>
      frame.chosen.scene === chosen.scene && frame.chosen.bodies === chosen.bodies;
    for (const source of this.sources)
      for (const base of bases)
        if (same(base) && source.covers(base, source === this.own ? [...names, ...changed(base)] : names)) {
          if (source !== this.source) this.spent = source === this.own ? 0.3 : 20;
          if (source !== this.source || base !== this.base) {
            source.scene(base);
            this.queue = [];
          }
          Object.assign(this, { source, base });
          return true;
        }
    this.source = null;
    return false;
  }
  /** By which solution impacts are found, and how wrong that is where the scene was; nothing of what is not weighed. */
  get by() {
    const { base } = this;
    const solved = base && ('exact' in base ? base.exact : 'main' in base ? base.main : null);
    return solved ? byOf(called(solved), errorsOf(solved)) : [];
  }
  /**
   * What the browser could not find, the newest first.
   * @returns {Job | null}
   */
  #left() {
    return this.queue.pop() ?? null;
  }
  /**
   * Have the server find what the browser could not.
   * @param {Job} job
   */
  elsewhere(job) {
    if (this.source !== this.own || !this.base || !this.sources.includes(this.served)) return;
    if (!this.served.covers(this.base, job.names)) return;
    this.#about(this.base);
    this.queue.push(job);
    if (this.queue.length > MOST) this.queue.shift();
    this.served.feed();
  }
  /** @param {Frame} base  What the server is asked about. */
  #about(base) {
    if (this.asked !== base) this.served.scene(base);
    this.asked = base;
  }
  /**
   * Have the server write a scene file.
   * @param {Omit<Job, 'done' | 'file'>} job
   * @returns {Promise<SceneFile | string>}  or why there is none
   */
  file(job) {
    return new Promise((take) => {
      const { base } = this;
      const there = base && this.sources.includes(this.served) && this.served.covers(base, job.names);
      if (!there || this.page.connection?.lost) {
        take('');
        return;
      }
      if (this.source !== this.served) this.#about(base);
      this.files.push({ ...job, file: true, done: (_, __, why, file) => take(file ?? why?.get(0) ?? '') });
      this.served.feed();
    });
  }
  /** @param {string} name  Whether it can vary in what is asked for. */
  covers(name) {
    return Boolean(this.base && this.source?.covers(this.base, [name]));
  }
  /** Whatever is free is asked; the server only once it has answered the page itself. */
  feed() {
    if (this.source === this.own || !this.page.changes.asked) this.source?.feed();
  }
  leave() {
    for (const each of this.sources) each.leave();
    this.source = this.base = this.asked = null;
    for (const { done } of this.files.splice(0)) done(null, 0);
    this.queue = [];
    this.sources = [];
  }
}
