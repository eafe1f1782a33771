// Answers that the browser finds by itself while a slider moves, at every picture, by the library's kernels: see
// app/static/wasm. The server is asked once the hand rests, and its answer, with all that it knows besides, follows.
import { carried } from '../browser/home.js';
import { late } from '../browser/late.js';
import { inTurn } from '../browser/turns.js';

/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */

const REST = 150; // ms without a change, after which the server is asked
const PAUSE = 2000; // ms for which the server answers alone, after an answer that would have taken too long

/**
 * @typedef {object} Answers  as app/static/wasm/answers.js makes them
 * @property {boolean} late  whether the last answer was none, as it took too long
 * @property {(frame: Frame, changed: string[]) => boolean} covers
 * @property {(frame: Frame, chosen: Chosen) => Frame | null} answer
 */

export class OwnAnswers {
  /** @type {Answers | null} */ answers = null; // until they are there, and for good where they cannot be
  count = 0; // of pictures that were answered so
  due = false; // whether the next picture waits for its turn
  #turn = () => this.#draw();
  /** @type {WeakSet<Frame>} */ made = new WeakSet();
  /** @type {Frame | null} */ whole = null; // the last answer of the server that is no draft
  beyond = ''; // choices that cannot be answered here after all
  refused = false; // whether the last answer was none, so that those of the server are shown while a slider moves
  resumes = 0; // when it answers again

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
  }
  /** Fetch what answers, once the page stands. */
  async prepare() {
    if (carried) return; // there is no server that another answer is awaited of
    try {
      const { ownAnswers } = await late('wasm/answers.js');
      this.answers = await ownAnswers();
      window.requestIdleCallback?.(() => this.#practise());
    } catch {
      // as where there is no WebAssembly, or a policy forbids it
    }
  }
  /** Answer what is shown, for nobody: the first answer, whose code is yet to be compiled, takes thrice as long. */
  #practise() {
    const { latest } = this.page.changes;
    if (latest && this.answers?.covers(latest, [])) this.#found(latest);
  }
  /** What is chosen by now, whatever the server knows of it. */
  get #chosen() {
    const { latest, sent, waiting } = this.page.changes;
    const { model } = this.page;
    const asked = Object.fromEntries(sent.map((name) => [name, model[name]]));
    return { ...latest.chosen, ...asked, ...waiting };
  }
  /**
   * The choices in which an answer differs from that.
   * @param {Frame} frame
   */
  #changed({ chosen }) {
    return Object.entries(this.#chosen).flatMap(([name, value]) => (Object.is(chosen[name], value) ? [] : [name]));
  }
  /** Whether what is chosen by now is not what is shown. */
  get behind() {
    const { changes, frame } = this.page;
    return Boolean(changes.latest) && this.#changed(frame).length > 0;
  }
  /** The answer of the server that one to what is chosen by now is made from: its last, or the last whole one. */
  get #base() {
    const { answers, page } = this;
    const { latest, goal } = page.changes;
    if (!answers || !latest || goal || performance.now() < this.resumes) return null;
    if (JSON.stringify(this.#chosen) === this.beyond) return null;
    const found = [latest, ...(this.whole ? [this.whole] : [])];
    return found.find((frame) => answers.covers(frame, this.#changed(frame))) ?? null;
  }
  /**
   * A choice has been changed by hand: answer it, if that can be.
   * @returns {number}  ms for which the server is left alone
   */
  take() {
    const { latest } = this.page.changes;
    if (latest && !this.#changed(latest).length) this.restore(); // the hand has come back to what is answered
    if (!this.#base) return 0;
    this.due = inTurn(this.#turn);
    return REST;
  }
  /**
   * Whether an answer of the server is of choices that have been changed since, which are answered here.
   * @param {Frame} frame
   */
  ahead(frame) {
    if (!frame.draft) this.whole = frame;
    this.beyond = ''; // the server has gone past it
    const { chosen, kind } = this.page.frame ?? {};
    if (frame.kind !== kind || frame.chosen.scene !== chosen?.scene) return false; // all is laid out anew for another
    if (this.refused || !this.#changed(frame).length || !this.#base) return false;
    this.due = inTurn(this.#turn);
    return true;
  }
  /** Show the server's last answer in place of one that was found here, and its choices. */
  restore() {
    const { changes, controls, frame } = this.page;
    if (!this.made.has(frame)) return;
    for (const [name, value] of Object.entries(changes.latest.chosen))
      if (!Object.is(value, frame.chosen[name])) controls.show(name, value);
    this.page.take(changes.bytes);
  }
  /**
   * The answer, if there is one; a module that has failed is not asked again.
   * @param {Frame} base
   */
  #found(base) {
    try {
      return this.answers?.answer(base, this.#chosen) ?? null;
    } catch {
      this.answers = null;
      return null;
    }
  }
  #draw() {
    this.due = false;
    const { page } = this;
    const { changes } = page;
    if (!this.#changed(changes.latest).length) this.restore(); // the hand has come back to what the server has answered
    const base = this.#base;
    if (!base || !this.#changed(page.frame).length) return; // the server has answered, or is to
    const frame = this.#found(base);
    this.refused = !frame;
    if (!frame) {
      this.beyond = JSON.stringify(this.#chosen);
      if (this.answers?.late) this.resumes = performance.now() + PAUSE;
      changes.flush();
      return;
    }
    this.made.add(frame);
    this.count++;
    page.frame = frame;
    page.compare.lay(frame);
    page.view.load(frame);
    page.view.draw();
    page.opening.draw(true);
    page.player.load(page.view.clock(frame));
    page.tell();
    page.connection?.tell(); // there may be no server
  }
}
