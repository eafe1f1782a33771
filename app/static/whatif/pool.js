// Workers that find figures of many impacts, each by kernels of its own. The next job is asked for only when one of
// them is free, so that the newest wish is next and nothing has to be stopped.
import { carried } from '../browser/home.js';
import { placeOf } from '../place.js';
import { coverable } from '../wasm/answers.js';

/** @import { Chosen, Frame } from '../messages.js' */

const MOST = 4; // workers: each takes some megabytes
const DEEP = 3; // jobs of a worker, so that it never waits while the next one is made
const SMALL = 20; // ms: what takes longer is not given several at once, as what is wanted may change meanwhile

/**
 * @typedef {object} Job
 * @property {Chosen} chosen  choices that differ from those of the scene, but for those that its points differ by
 * @property {string[]} names  of these
 * @property {Float64Array} rows  (points, names)
 * @property {number} [tolerance]  of a step of waves through a contact law; none: that of what is drawn
 * @property {(found: Float64Array | null, spent: number) => void} done  (points, COLUMNS) as app/static/wasm/columns.js
 *   has them, or null where the worker has died; ms
 */
/**
 * @typedef {object} Own
 * @property {Worker} worker
 * @property {boolean} ready
 * @property {Map<number, Job>} jobs  that it has
 * @property {number} last  ms that its last job took
 * @property {boolean} replaced  whether it stands for one that has died
 */
/** @typedef {{ ready?: boolean, job: number, found: Float64Array, spent: number }} Said */

/** The kernels: of a page without a server those that came with it. */
async function moduleOf() {
  if (carried) return WebAssembly.compile(await carried.module());
  const fetched = await fetch(placeOf('wasm/kernels.wasm'));
  if (!fetched.ok) throw new Error(`no module: ${fetched.status}`);
  return WebAssembly.compile(await fetched.arrayBuffer());
}

/** The script of a worker; of a page from the disk, which may fetch none, one that came with it. */
async function scriptOf() {
  if (!carried) return placeOf('wasm/worker.js');
  return URL.createObjectURL(new Blob([await carried.worker()], { type: 'text/javascript' }));
}

export class Pool {
  /** @type {Own[]} */ workers = [];
  /** @type {WebAssembly.Module | null} */ module = null;
  /** @type {Frame | null} */ frame = null; // that all jobs are about
  /** @type {(stands: boolean) => void} */ settle = () => {};
  numbered = 0; // jobs so far
  script = ''; // address of that of a worker
  left = 0; // how often all of them have been ended
  /** @type {Promise<boolean> | null} */ preparing = null;

  /** @param {() => Job | null} next  what is to be done next, if there is anything */
  constructor(next) {
    this.next = next;
  }
  /** Have workers that stand: whether there are any. */
  async prepare() {
    this.preparing ??= this.#stand();
    return this.preparing;
  }
  async #stand() {
    if (typeof WebAssembly === 'undefined' || typeof Worker === 'undefined') return false;
    const { left } = this;
    try {
      const [module, script] = await Promise.all([moduleOf(), scriptOf()]);
      if (left !== this.left) return false;
      Object.assign(this, { module, script });
      /** @type {Promise<boolean>} */
      const stands = new Promise((settle) => {
        this.settle = settle;
      });
      const count = Math.min(MOST, Math.max(1, (navigator.hardwareConcurrency || 2) - 1));
      for (let k = 0; k < count; k++) this.#start(false);
      return await stands;
    } catch {
      return false; // as where a policy forbids it: the server answers
    }
  }
  /**
   * Whether kernels answer a scene over these choices.
   * @param {Frame} frame
   * @param {string[]} names
   */
  covers(frame, names) {
    return coverable(frame, names);
  }
  /**
   * What all jobs after this are about.
   * @param {Frame} frame  of the server
   */
  scene(frame) {
    this.frame = frame;
    for (const { worker } of this.workers) worker.postMessage({ kind: 'scene', frame });
  }
  /** @param {boolean} replaced */
  #start(replaced) {
    const worker = new Worker(this.script, { type: carried ? 'classic' : 'module' });
    /** @type {Own} */
    const own = { worker, ready: false, jobs: new Map(), last: Infinity, replaced };
    worker.onmessage = ({ data }) => this.#take(own, data);
    worker.onerror = () => this.#lose(own);
    worker.onmessageerror = () => this.#lose(own);
    worker.postMessage({ kind: 'module', module: this.module });
    if (this.frame) worker.postMessage({ kind: 'scene', frame: this.frame });
    this.workers.push(own);
  }
  /**
   * @param {Own} own
   * @param {Said} said
   */
  #take(own, { found, job, ready, spent }) {
    if (ready === false) {
      this.#lose(own);
      return;
    }
    if (ready) {
      own.ready = true;
      this.settle(true);
    } else {
      const given = own.jobs.get(job);
      own.jobs.delete(job);
      own.last = spent;
      given?.done(found, spent);
    }
    this.feed();
  }
  /**
   * One has died: of its jobs nothing is found, and another takes its place, but for one that does already.
   * @param {Own} own
   */
  #lose(own) {
    const at = this.workers.indexOf(own);
    if (at < 0) return;
    this.workers.splice(at, 1);
    own.worker.terminate();
    if (!own.replaced) this.#start(true);
    if (!this.workers.length) this.settle(false);
    for (const { done } of own.jobs.values()) done(null, 0);
  }
  /** Give work to whoever has none, and to those whose jobs are small some that wait. */
  feed() {
    if (!this.frame) return;
    for (let deep = 1; deep <= DEEP; deep++) {
      for (const own of this.workers) {
        if (!own.ready || own.jobs.size >= deep || (deep > 1 && own.last > SMALL)) continue;
        const job = this.next();
        if (!job) return;
        own.jobs.set(++this.numbered, job);
        const { chosen, names, rows, tolerance } = job;
        own.worker.postMessage({ kind: 'points', job: this.numbered, chosen, names, rows, tolerance });
      }
    }
  }
  get idle() {
    return this.workers.every(({ jobs }) => jobs.size === 0);
  }
  /** End all workers; of what they were at nothing is found. */
  leave() {
    const { workers } = this;
    this.workers = [];
    for (const { worker } of workers) worker.terminate();
    for (const { jobs } of workers) for (const { done } of jobs.values()) done(null, 0);
    this.preparing = null;
    this.left += 1;
    if (carried && this.script) URL.revokeObjectURL(this.script);
    this.settle(false);
  }
}
