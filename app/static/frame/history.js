// Undo and redo: every change of the choices is an entry of the browser's history, a drag is one however slow the hand
// and the answers are, and so is whatever is kept or kept no more, and a turn from the picture to the dock or the
// laboratory. Back undoes, and does not leave the page before all is undone.
import { make } from '../browser/dom.js';
import { choicesText, ownAddress } from './address.js';
import { alone, framed, Steps } from '../browser/home.js';
import { Writing } from './keys.js';
import { text } from '../text/catalogue.js';
import { keep, kept } from '../browser/store.js';

/** @import { Page } from '../page.js' */
/** @import { Wanted } from './kept.js' */
/** @import { Chosen } from '../messages.js' */

const REST = 250; // ms after which the address follows what is seen
const HELD = /** @type {const} */ (['pointerdown', 'pointerup', 'pointercancel']);
const LAST = 100; // ms after a press, in which a control says its last value
const TOP = 'history'; // under which the last entry is kept while the page reloads

/**
 * @typedef {object} State  of the page
 * @property {Chosen} chosen
 * @property {string} choices  what is chosen, as text
 * @property {Wanted[]} kept  solutions beside it
 * @property {import('../opening/opening.js').Plan} plan  of the page
 * @property {string} [tab]  of its dock
 * @property {boolean} [lent]  whether that is open because the scene asks for it
 * @property {number} [step]  of a lesson
 */
/** @typedef {State & { strikewave: number }} Entry  and its number */
/**
 * @typedef {object} Choice
 * @property {number} at  when it was made [ms]
 * @property {number} press  of a pointer in which it was, from 1; 0: none
 * @property {string} [name]
 * @property {number | string} [value]
 * @property {boolean} shown  it was answered: what changes then is not by hand
 */

export class History {
  top = 0; // number of the last entry
  pause = 700; // ms between choices, after which the next is a step of its own
  hand = new Hand();
  /** @type {Choice} */ chosen = { at: -Infinity, press: 0, shown: true }; // the last by hand
  /** @type {Choice} */ changed = this.chosen; // that of the entry
  /** @type {Chosen | null} */ followed = null; // that were shown last
  moving = ''; // names of the choices that changed last
  /** @type {[state: State, address: string] | null} */ held = null; // what is still to be written
  /** @type {Writing | undefined} */ writing; // in a field
  /** @type {object | null} */ going = null; // what it goes to: what is answered meanwhile is no step
  /** @type {number | undefined} */ resting;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.popped = () => this.#arrive();
    const follow = (/** @type {string} */ address) => window.history.replaceState(null, '', address);
    /** @type {import('../browser/home.js').Entries<Entry>} */
    this.entries = alone && !framed ? window.history : new Steps(this.popped, framed ? follow : undefined);
    const { entry } = this;
    if (entry) this.top = Math.max(kept(TOP, 0, true), entry.strikewave); // the page was left, or reloaded
    const button = (/** @type {string} */ sign, /** @type {string} */ title, /** @type {() => void} */ onclick) =>
      make('button', {
        type: 'button',
        className: 'step-history',
        textContent: sign,
        title,
        ariaLabel: title,
        onclick,
      });
    this.undoing = button('↶', text('page.undo'), () => this.undo());
    this.redoing = button('↷', text('page.redo'), () => this.redo());
    this.undoing.setAttribute('aria-keyshortcuts', 'Control+Z');
    this.redoing.setAttribute('aria-keyshortcuts', 'Control+Shift+Z');
    if (alone) window.addEventListener('popstate', this.popped);
  }
  /**
   * The fields below this have an undo of their own.
   * @param {HTMLElement} root
   */
  watch(root) {
    this.writing = new Writing(root);
  }
  leave() {
    window.removeEventListener('popstate', this.popped);
    this.hand.leave();
    clearTimeout(this.resting);
  }
  /**
   * Something is chosen by hand, and will be answered.
   * @param {string} name
   * @param {number | string} value
   */
  choose(name, value) {
    this.chosen = { at: performance.now(), press: this.hand.press, name, value, shown: false };
  }
  /** What has led to what is shown. */
  get #choice() {
    return this.chosen.shown ? { at: performance.now(), press: 0, shown: true } : this.chosen;
  }
  /** Whether that goes on with the step of the entry: by the same press, or soon after. */
  get #goesOn() {
    const { at, press } = this.#choice;
    return (press > 0 && press === this.changed.press) || at - this.changed.at < this.pause;
  }
  /** @returns {Entry | null} */
  get entry() {
    const { state } = this.entries;
    return state && typeof state.strikewave === 'number' && state.chosen ? state : null;
  }
  undo() {
    this.#settle();
    if ((this.entry?.strikewave ?? 0) > 0) this.entries.back();
  }
  redo() {
    this.#settle();
    if ((this.entry?.strikewave ?? 0) < this.top) this.entries.forward();
  }
  /** What is still to be written comes before. */
  #settle() {
    const { frame, own, telling } = this.page;
    if (!this.going && (this.resting || telling || own.made.has(frame))) this.write();
  }
  /**
   * Another answer is shown. While choices change again and again, all in one step, the address follows at rest:
   * browsers take 5 ms to write it.
   */
  follow() {
    if (this.going) return; // that is written on arrival
    const { chosen } = this.page.frame;
    const moved = namesOf(this.followed, chosen);
    const others = Boolean(moved && this.followed && moved !== this.moving);
    const goesOn = moved && !others && this.#goesOn && this.entry && this.entry.chosen.scene === chosen.scene;
    this.followed = chosen;
    this.moving = moved || this.moving;
    if (!goesOn) {
      if (others && this.held) this.#replace(...this.held);
      this.held = null;
      this.write(others);
      return;
    }
    this.#change();
    this.held = this.#now();
    this.later();
  }
  #change() {
    const { chosen, page } = this;
    this.changed = this.#choice;
    if (chosen.name) chosen.shown ||= Object.is(page.frame.chosen[chosen.name], chosen.value);
  }
  /** @returns {[state: State, address: string]}  of what is shown */
  #now() {
    const { compare, frame, layout, opening } = this.page;
    const { lent, plan } = opening;
    const shown = { chosen: frame.chosen, choices: choicesText(this.page), kept: compare.wanted };
    const step = opening.teaching.lesson?.at;
    return [{ ...shown, plan, lent, step, tab: layout.tabs.selected }, ownAddress(this.page)];
  }
  /**
   * The address says what is shown, as a step of its own where the choices have changed.
   * @param {boolean} [another]  choice has changed than before: a step, however soon
   */
  write(another = false) {
    clearTimeout(this.resting);
    this.resting = undefined;
    const known = this.held !== null; // as what goes on with the step
    this.held = null;
    const { page, entry } = this;
    const { lesson, on } = page.opening.teaching;
    if (!page.frame || page.changes.quiet || (on && !lesson)) return; // a lesson that comes has an address of its own
    if (lesson?.paper) return; // nobody goes there
    const [state, address] = this.#now();
    const moved = entry && state.choices !== entry.choices;
    const turned = (entry?.plan ?? state.plan) !== state.plan || (entry && entry.step !== state.step);
    const keeps = entry && JSON.stringify(state.kept) !== JSON.stringify(entry.kept ?? []);
    const others = turned || keeps || (entry && entry.chosen.scene !== state.chosen.scene) || (moved && another);
    const soon = !others && (known || this.#goesOn);
    if (moved && !known) this.#change();
    const stays = state.step !== undefined && entry?.step === state.step; // a lesson has a step for each of its own
    if (!entry || this.going || !(moved || others) || soon || stays) this.#replace(state, address);
    else {
      this.top = entry.strikewave + 1;
      keep(TOP, this.top, true);
      this.#put('pushState', { strikewave: this.top, ...state }, address);
    }
    this.#enable();
  }
  /**
   * @param {State} state
   * @param {string} address
   */
  #replace(state, address) {
    this.#put('replaceState', { strikewave: this.entry?.strikewave ?? 0, ...state }, address);
  }
  /**
   * Browsers allow so many entries a minute; what comes too soon is left out.
   * @param {'pushState' | 'replaceState'} how
   * @param {Entry} entry
   * @param {string} address
   */
  #put(how, entry, address) {
    try {
      this.entries[how](entry, '', address);
    } catch {
      this.later();
    }
  }
  /** What is seen has changed, not what is chosen: the address follows in a moment. */
  later() {
    clearTimeout(this.resting);
    this.resting = window.setTimeout(() => this.going || this.write(), REST);
  }
  #enable() {
    const at = this.entry?.strikewave ?? 0;
    this.undoing.disabled = at === 0;
    this.redoing.disabled = at >= this.top;
  }
  /** The browser has gone to an entry: its choices are chosen again, and what was kept is there again. */
  #arrive() {
    const { entry, page } = this;
    if (!entry || !page.frame) return;
    const { lesson } = page.opening.teaching;
    if (lesson) {
      lesson.enter(entry.step ?? 0); // which knows what it shows
      return;
    }
    this.going = entry;
    page.opening.come(entry);
    page.goTo(entry.chosen, async () => {
      if (this.going === entry) await page.compare.recall(entry.kept ?? []);
      if (this.going !== entry) return; // on to another
      this.going = null;
      this.write();
    });
    this.#enable();
  }
  /**
   * What keys do, with Ctrl. Whether they do anything.
   * @param {KeyboardEvent} event
   */
  key(event) {
    const { key, shiftKey } = event;
    const name = key.toLowerCase();
    if (this.writing?.takes(event)) return false;
    if (name === 'z' && !shiftKey) this.undo();
    else if ((name === 'z' && shiftKey) || name === 'y') this.redo();
    else return false;
    return true;
  }
}

/** That of the user: which press of a pointer a choice belongs to. */
class Hand {
  #count = 0;
  #until = 0; // when it ends

  constructor() {
    this.moved = (/** @type {PointerEvent} */ { type }) => {
      const down = type === 'pointerdown';
      if (down) this.#count += 1;
      this.#until = down ? Infinity : performance.now() + LAST;
    };
    for (const type of HELD) window.addEventListener(type, this.moved, true);
  }
  leave() {
    for (const type of HELD) window.removeEventListener(type, this.moved, true);
  }
  /** Its number, or 0 where none is held. */
  get press() {
    return performance.now() < this.#until ? this.#count : 0;
  }
}

/**
 * Names of the choices that differ.
 * @param {Chosen | null} before
 * @param {Chosen} now
 */
const namesOf = (before, now) =>
  Object.keys(now)
    .filter((name) => !Object.is(before?.[name], now[name]))
    .join();
