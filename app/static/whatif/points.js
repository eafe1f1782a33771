// Where the impacts of a map come from: the browser's own kernels, which other threads ask, or the server. What is to
// be found next is asked for only when one of them is free, so that the newest wish is always next.
import { byOf, called, errorsOf } from '../text/words.js';
import { Pool } from './pool.js';
import { WIDTH } from './results.js';
import { Served } from './server.js';

/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */

/**
 * @typedef {object} Job
 * @property {Record<string, any>} chosen  the other choices
 * @property {string[]} names  of choices that its impacts differ by
 * @property {Float64Array} rows  their values, impact by impact
 * @property {number} [tolerance]  of a step through a contact law; 0: that of the page's own answers
 * @property {boolean} [wished]  whether somebody waits for it
 * @property {boolean} [drawn]  whether it is part of the view that is drawn, which may be stopped
 * @property {boolean} [apart]  whether it is done without what the browser has no room for
 * @property {{ figure: string, bounds: number[] }} [models]  the smallest that are enough are wanted in its place
 * @property {(models: import('../text/words.js').Called[], shown: number) => void} [named]  from the smallest up
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

const QUICK = 3; // ms for an impact, above which it takes long
const WHOLE = 3000; // ms that all points of a map may take, none spared
const REST = 150; // ms without another scene under a hand, before the server finds more beside the browser
const CELL = { least: 4, held: 7, most: 10 }; // pixels of a step of the lattice

export class Points {
  /** @type {Source | null} */ source = null; // of what is shown
  /** @type {Frame | null} */ base = null; // that its impacts are made from
  spent = 0.3; // ms for an impact
  solved = 0;
  /** @type {Job[]} */ files = []; // that the server is asked for
  /** @type {Job[]} */ queue = []; // that the server is asked while the browser finds the others
  ready = false;
  stopped = false; // by hand: the server finds nothing more of what is drawn
  stopping = false; // just now
  still = 0; // when the server finds more beside the browser
  /** @type {number | undefined} */ waits;
  handed = 0; // impacts that the server has found while the browser finds the others

  /**
   * @param {Page} page
   * @param {() => Job | null} next
   * @param {() => Job | null} rest  of what the browser could not find, on the map
   */
  constructor(page, next, rest) {
    this.page = page;
    /** @type {Source} */ this.own = new Pool(() => (this.source === this.own ? this.#counted(next()) : null));
    /** @returns {Job | null} */
    const others = () => (this.source === this.served ? this.#counted(next()) : this.#waiting(rest));
    /** @type {Served} */ this.served = new Served(page, () => this.files.shift() ?? others());
    /** @type {Source[]} */ this.sources = [];
  }
  async prepare() {
    const all = [this.own, this.served];
    const there = await Promise.all(all.map((each) => each.prepare()));
    this.sources = all.filter((_, k) => there[k]);
    this.ready = true;
  }
  /**
   * What the browser has no room for, the server finds before it is done.
   * @param {Job | null} job
   * @returns {Job | null}
   */
  #counted(job) {
    if (!job) return null;
    const count = job.rows.length / job.names.length;
    const own = this.source === this.own;
    return {
      ...job,
      done: (found, spent, why) => {
        if (found) {
          this.spent += 0.2 * (spent / count - this.spent);
          this.solved += count;
        }
        const left = found && own && !job.apart ? failedOf(found) : [];
        if (!found || !left.length || !this.#forward(job, found, left)) job.done(found, spent, why);
      },
    };
  }
  /**
   * Have the server find the rows that are left; whether it can.
   * @param {Job} job
   * @param {Float64Array} found
   * @param {number[]} left
   */
  #forward(job, found, left) {
    const { names, rows } = job;
    const { base, served } = this;
    if (!base || !this.serves || !served.covers(base, names)) return false;
    /** @type {Job} */
    const forwarded = {
      ...job,
      rows: Float64Array.from(left.flatMap((k) => [...rows.subarray(k * names.length, (k + 1) * names.length)])),
      done: (more, spent, why) => {
        if (this.stopping) return void this.queue.unshift(forwarded); // until it goes on
        this.handed += more ? left.length : 0;
        if (more) left.forEach((k, n) => found.set(more.subarray(n * WIDTH, (n + 1) * WIDTH), k * WIDTH));
        job.done(found, spent, why && new Map([...why].map(([n, each]) => [left[n], each])));
        this.feed(); // it may have been waited for
      },
    };
    const first = job.wished ? this.queue.findIndex(({ wished }) => !wished) : -1;
    this.queue.splice(first < 0 ? this.queue.length : first, 0, forwarded);
    this.feed();
    return true;
  }
  /** Whether there is a server that finds what the browser cannot. */
  get serves() {
    return this.source === this.own && this.sources.includes(this.served);
  }
  /**
   * What the server is asked next while the browser finds the others.
   * @param {() => Job | null} rest
   */
  #waiting(rest) {
    if (performance.now() < this.still) return null;
    const first = this.queue.findIndex(({ drawn }) => !(drawn && this.stopped));
    const [job = null] = first < 0 ? [] : this.queue.splice(first, 1);
    return job ?? (this.stopped ? null : rest());
  }
  /** A hand moves: what the server would find beside the browser is soon of no use. */
  wait() {
    this.still = performance.now() + REST;
    clearTimeout(this.waits);
    this.waits = window.setTimeout(() => this.feed(), REST + 1);
  }
  /** Impacts of what is drawn that wait for the server, beside those that it is at. */
  get left() {
    const all = this.served.job ? [...this.queue, this.served.job] : this.queue;
    const count = (/** @type {Job} */ { drawn, names, rows }) => (drawn ? rows.length / names.length : 0);
    return all.reduce((sum, job) => sum + count(job), 0) - (this.served.job?.drawn ? this.served.count : 0);
  }
  /** @param {boolean} stopped  The server finds nothing more of what is drawn, nor what it is at; or goes on. */
  stop(stopped) {
    this.stopped = stopped;
    this.stopping = true;
    if (stopped && this.served.job?.drawn) this.served.leave();
    this.stopping = false;
    this.feed();
  }
  /** Nobody is asked for what waits. */
  #drop() {
    const { queue } = this;
    this.queue = [];
    this.handed = 0;
    for (const { done } of queue) done(null, 0);
  }
  /** Whether an impact is found in a moment. */
  get quick() {
    return this.source === this.own && this.spent < QUICK;
  }
  /**
   * How far apart the points of a map are at least [px]: what lies between them, it does not show.
   * @param {[width: number, height: number]} size  of the map [px]
   * @param {boolean} held  whether it follows a hand
   */
  cell([width, height], held) {
    const least = held ? CELL.held : CELL.least;
    const fit = Math.sqrt((width * height * this.spent) / WHOLE);
    const steady = 2 ** Math.round(Math.log2(fit / least)) * least; // whatever one measured time is
    return Math.min(Math.max(steady, least), CELL.most);
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
          if (source !== this.source) {
            this.spent = source === this.own ? 0.3 : 20;
            this.solved = 0; // by the other
          }
          if (source !== this.source || base !== this.base) {
            this.#drop();
            source.scene(base);
            if (source === this.own) this.served.scene(base);
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
    if (this.source === this.own) this.own.feed();
    if (this.sources.includes(this.served) && !this.page.changes.asked) this.served.feed();
  }
  leave() {
    clearTimeout(this.waits);
    for (const each of this.sources) each.leave();
    this.source = this.base = null;
    this.stopped = false;
    for (const { done } of this.files.splice(0)) done(null, 0);
    this.#drop();
    this.sources = [];
  }
}

/** @param {Float64Array} found  The rows without an answer. */
export const failedOf = (found) =>
  Array.from({ length: found.length / WIDTH }, (_, k) => k).filter((k) => found[k * WIDTH]);
