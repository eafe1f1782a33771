// What is chosen, on its way to the server: one change at a time, the next when the last is answered, and then only the
// newest of each. Whole sets of settings go in two steps: the scene, which brings its own values, then the rest.

import { alone } from '../browser/home.js';
import { Held } from './held.js';

/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Model } from './model.js' */

const PATIENCE = 2500; // ms without an answer, after which the next change is sent all the same
const MAX_TRIES = 4; // answers that may differ from the settings gone to, before they are given up

/**
 * Settings that the page goes to: a scene, and what differs from its own values.
 * @typedef {{ scene: string, settings: Partial<Chosen>, tries: number, done: (frame: Frame | null) => void }} Goal
 */

/**
 * @typedef {object} Server
 * @property {Model} model
 * @property {() => boolean} lost  there is none at present
 * @property {() => void} sent  a change is on its way
 * @property {() => void} kept  a change waits until there is one
 */

export class Changes {
  /** @type {Record<string, any>} */ waiting = {}; // that are to be sent
  asked = 0; // when the last was, or 0 if it is answered
  /** @type {string[]} */ sent = []; // the choices that it changed
  /** @type {number | undefined} */ patience;
  /** @type {Goal | null} */ goal = null;
  quiet = false; // what is answered is kept, not shown
  resting = 0; // a timer: changes wait for the hand to rest
  /** @type {Frame} */ latest; // that was answered, and the message that it was
  /** @type {ArrayBuffer} */ bytes;

  /** @param {Server} server */
  constructor(server) {
    this.server = server;
    this.held = new Held(alone ? window.location.search : '', server.model.spec ?? {});
  }
  /**
   * @param {Frame} frame
   * @param {ArrayBuffer} bytes
   */
  take(frame, bytes) {
    this.latest = frame;
    this.bytes = bytes;
  }
  /** Milliseconds for which an answer has been awaited. */
  get late() {
    return this.asked ? performance.now() - this.asked : 0;
  }
  /**
   * What a choice may be where this is asked for.
   * @param {string} name
   * @param {number | string} value
   */
  allowed(name, value) {
    return this.held.within(name, value, this.waiting[name] ?? this.server.model[name]);
  }
  /**
   * Set by hand, which ends any goal.
   * @param {string} name
   * @param {number | string} value
   * @param {() => number} [wait]  ms for which it is not sent, unless it is changed again
   */
  set(name, value, wait = () => 0) {
    this.leave();
    this.waiting[name] = this.allowed(name, value);
    const rest = wait();
    clearTimeout(this.resting);
    this.resting = rest && window.setTimeout(() => this.#rested(), rest);
    if (!rest) this.flush();
  }
  #rested() {
    this.resting = 0;
    this.flush();
  }
  flush() {
    const { model } = this.server;
    const names = Object.keys(this.waiting);
    const left = this.asked ? PATIENCE - (performance.now() - this.asked) : 0;
    if (this.server.lost()) this.server.kept();
    if (!names.length || this.server.lost()) return;
    if (left > 0) {
      // an answer that never comes must not hold the next change for good
      clearTimeout(this.patience);
      this.patience = window.setTimeout(() => this.flush(), left + 1);
      return;
    }
    const changes = this.waiting;
    this.waiting = {};
    const sent = names.filter((name) => !Object.is(model[name], changes[name]));
    if (!sent.length) return;
    this.sent = sent;
    this.asked = performance.now();
    for (const name of sent) model[name] = changes[name];
    this.server.sent();
  }
  /**
   * Whether a frame answers what was sent last. One that a draft is refined to may cross it on the way.
   * @param {Frame} frame
   */
  answers(frame) {
    const { model } = this.server;
    return this.sent.every((name) => Object.is(model[name], frame.chosen[name]));
  }
  settle() {
    this.asked = 0;
    if (!this.resting) this.flush();
  }
  /**
   * Go to settings. `done` is given the frame that answers them, or nothing if they cannot be.
   * @param {Partial<Chosen>} settings  what differs from the own values of the scene
   * @param {(frame: Frame | null) => void} done
   */
  go(settings, done) {
    const now = this.latest;
    this.leave();
    clearTimeout(this.resting);
    this.resting = 0;
    this.waiting = {};
    this.goal = { scene: String(settings.scene ?? now.chosen.scene), settings, tries: 0, done };
    this.arrived(now);
  }
  /**
   * An answer has come: whether the settings are reached, and if not, what is to be sent next.
   * @param {Frame} frame
   */
  arrived(frame) {
    const { goal, server } = this;
    if (!goal) return;
    const { bodies = '' } = goal.settings; // which, like the scene, bring values of their own
    const there = frame.chosen.scene === goal.scene && frame.chosen.bodies === bodies;
    /** @type {Record<string, any>} */
    const wanted = there ? { ...frame.own, ...goal.settings } : { scene: goal.scene, bodies };
    const names = Object.keys(wanted).filter((name) => name in server.model.spec);
    const flying = this.asked ? this.sent : []; // an answer to these is on its way
    const differs = (/** @type {string} */ name) =>
      flying.includes(name) && !Object.is(server.model[name], wanted[name]);
    const missing = names.filter((name) => !Object.is(frame.chosen[name], wanted[name]) || differs(name));
    if (there && !missing.length) {
      this.goal = null;
      goal.done(frame);
      return;
    }
    const unsent = names.filter((name) => !Object.is(server.model[name], wanted[name]));
    if (!missing.some((name) => unsent.includes(name))) return; // all is on its way
    goal.tries += 1;
    if (goal.tries > MAX_TRIES) this.leave();
    // with what was refused and is not yet taken back, else that would have these refused too
    for (const name of this.goal ? unsent : []) this.waiting[name] = wanted[name];
    this.flush();
  }
  /** Give up the goal. */
  leave() {
    const { goal } = this;
    this.goal = null;
    if (goal) goal.done(null);
  }
}
