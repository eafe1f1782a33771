// Points of the map that the server finds: for scenes that the browser's own kernels do not cover. One question at a
// time is under way, and the next is only made when it is answered, so that the newest wish wins.
import { carried } from '../browser/home.js';
import { said } from '../text/catalogue.js';
import { COLUMNS } from '../wasm/columns.js';
import { isBodyKey } from '../wire/body_values.js';

/** @import { Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */
/** @import { Job } from './points.js' */

const FAILED = 1; // status of a point that is refused, or of which nothing is found
const MOST_NAMES = 8;
const MOST_ROWS = 256; // of a question, and its letters
const LONGEST = 15_000;
const LEAST_ROWS = 8; // that are asked at once, however long the last took; else twice as many as were found in time
const PATIENCE = 30_000; // ms without an answer, some of which kernels may take to be compiled
const TICK = 250; // ms between looks whether the server is still there

/**
 * @typedef {object} Answer  of the server
 * @property {number | null} id
 * @property {Record<string, any>} chosen
 * @property {(number | null)[][]} [rows]
 * @property {import('../text/words.js').Called[]} [models]  that rows of models name by number
 * @property {number} [shown]  that of the page's method
 * @property {Record<string, any>} [why]
 * @property {any} [error]
 * @property {string} [scene]  the file of the first row
 * @property {Record<string, (number | null)[]> | null} [keys]  of scene files, by which the others differ from it
 */

export class Served {
  /** @type {Frame | null} */ frame = null; // what the points are about
  /** @type {Job | null} */ job = null; // that is under way
  begun = 0; // when
  asked = 0; // when its last question was, and the number of that
  id = 0;
  found = new Float64Array(0);
  count = 0; // of its rows that are answered
  /** @type {Map<number, string>} */ why = new Map();
  atOnce = MOST_ROWS; // rows of a question
  stress = false; // whether the peak stress is asked for, which costs as much again, or more
  /** @type {number | undefined} */ watch;

  /**
   * @param {Page} page
   * @param {() => Job | null} next  the next job, asked only when the last is answered
   */
  constructor(page, next) {
    this.page = page;
    this.next = next;
    page.model.on('whatif', () => this.#take());
  }
  /** Whether there is a server. */
  async prepare() {
    return !carried;
  }
  get idle() {
    return !this.job;
  }
  get #lost() {
    return Boolean(this.page.connection?.lost);
  }
  /**
   * Whether points of this scene can be found over these names: numbers, whatever the scene.
   * @param {Frame} _frame
   * @param {string[]} names
   */
  covers(_frame, names) {
    const { spec } = this.page.model;
    const known = (/** @type {string} */ name) => spec[name]?.low !== undefined || isBodyKey(name);
    return !carried && names.length > 0 && names.length <= MOST_NAMES && names.every(known);
  }
  /**
   * What the next jobs are about; one that is under way about something else is given up.
   * @param {Frame} frame
   */
  scene(frame) {
    if (this.job && this.frame?.chosen.scene !== frame.chosen.scene) this.leave();
    this.frame = frame;
  }
  /** Ask for the next job, if none is under way. */
  feed() {
    if (this.job || !this.frame || this.#lost) return;
    const job = this.next();
    if (!job) return;
    this.job = job;
    this.begun = performance.now();
    this.count = 0;
    this.why = new Map();
    this.found = new Float64Array((job.rows.length / job.names.length) * COLUMNS.length).fill(NaN);
    clearInterval(this.watch);
    this.watch = window.setInterval(() => this.#look(), TICK);
    this.#ask();
  }
  /** Nothing more is worked out. */
  leave() {
    if (!this.job) return;
    if (!this.#lost) this.page.model.whatif_points = ''; // which ends it there
    this.#end(null);
  }
  #look() {
    if (this.#lost || performance.now() - this.asked > PATIENCE) this.leave();
  }
  /** Have as many of the rows that are left found as one question holds. */
  #ask() {
    const { frame, job, page } = this;
    if (!job || !frame) return;
    const total = job.rows.length / job.names.length;
    if (this.count >= total) return this.#end(this.found);
    if (job.chosen.scene !== frame.chosen.scene) return this.leave(); // another scene has been chosen meanwhile
    this.id += 1;
    this.asked = performance.now();
    let rows = job.file ? total : Math.min(this.atOnce, total - this.count);
    let text = this.#question(job, rows);
    while (text.length > LONGEST && rows > 1) {
      rows = Math.ceil(rows / 2);
      text = this.#question(job, rows);
    }
    page.model.whatif_points = text;
  }
  /**
   * Its number first, by which the answer is known; and all that is chosen, whatever the server knows of it.
   * @param {Job} job
   * @param {number} rows
   */
  #question({ chosen, file, models, names, rows: all }, rows) {
    const { count, id, page, stress } = this;
    const width = names.length;
    const list = Array.from({ length: rows }, (_, k) => [
      ...all.subarray((count + k) * width, (count + k + 1) * width),
    ]);
    const others = Object.keys(page.model.spec).filter((name) => name !== 'scene' && !names.includes(name));
    const set = Object.fromEntries(others.flatMap((name) => (name in chosen ? [[name, chosen[name]]] : [])));
    return JSON.stringify({ id, names, rows: list, set, stress, file, models });
  }
  #take() {
    const { frame, job, page } = this;
    if (!job || !frame || !page.model.whatif) return;
    /** @type {Answer} */
    const answer = JSON.parse(page.model.whatif);
    if (answer.id !== this.id) return; // of what is no longer asked
    if (answer.error) return this.#refuse(said(answer.error));
    if (answer.chosen.scene !== frame.chosen.scene) return this.leave();
    const { keys = null, models, rows = [], scene, shown, why = {} } = answer;
    if (models && shown) job.named?.(models, shown);
    if (job.file && scene) return this.#end(this.found, { keys, scene });
    if (!rows.length) return this.#refuse('');
    for (const [k, row] of rows.entries()) {
      const start = (this.count + k) * COLUMNS.length;
      for (const [column, value] of row.entries()) this.found[start + column] = value ?? NaN;
      if (why[k]) this.why.set(this.count + k, said(why[k]));
    }
    this.count += rows.length;
    this.atOnce = Math.min(Math.max(LEAST_ROWS, 2 * rows.length), MOST_ROWS);
    this.#ask();
  }
  /**
   * None of the rows that are left can be found.
   * @param {string} sentence  why
   */
  #refuse(sentence) {
    for (; this.count * COLUMNS.length < this.found.length; this.count++) {
      this.found[this.count * COLUMNS.length] = FAILED;
      this.why.set(this.count, sentence);
    }
    this.#end(this.found);
  }
  /**
   * @param {Float64Array | null} found
   * @param {import('./points.js').SceneFile} [file]
   */
  #end(found, file) {
    const { job, why } = this;
    clearInterval(this.watch);
    this.job = null;
    job?.done(found, performance.now() - this.begun, why, file);
    if (found) this.feed();
  }
}
