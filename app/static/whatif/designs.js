// Designs: what is kept of the scene, as letters on the map and as a list of inputs and results beside it; one is
// compared with the scene in words, two morph. What is kept is what the picture keeps, too: see compare/compare.js.
import { figure } from '../compare/figure.js';
import { leastSaid, sentences } from '../compare/figures.js';
import { comparable } from '../compare/kinds.js';
import { differing, lineOf, titleOf } from '../form/settings.js';
import { download, make, write } from '../browser/dom.js';
import { linkOf } from '../frame/share.js';
import { text } from '../text/catalogue.js';
import { entriesOf } from '../wire/body_values.js';
import { fileOf } from '../wire/own.js';
import { figuresOfWhole, listed } from '../wasm/columns.js';
import { valueIn } from './axes.js';
import { tableOf } from './inputs.js';
import { Morph } from './morph.js';
import { longOf, placeOf } from './places.js';
import { PLACE, valueOf, written } from './results.js';

/** @import { Figure, Size } from '../compare/figure.js' */
/** @import { Run } from '../compare/run.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Axis } from './axes.js' */
/** @import { Kept, Spot } from './letters.js' */
/** @import { Job } from './points.js' */
/** @import { Result } from './results.js' */
/** @import { WhatIf } from './whatif.js' */

/** @type {Record<Result, [key: string, size: Size]>} */
const FIGURES = {
  peak_force: ['force', 'force'],
  contacts: ['contacts', 'count'],
  impactor_velocity: ['rebound', 'velocity'],
  newton: ['restitution', 'number'],
  contact_time: ['real', 'time'],
  peak_stress: ['stress', 'stress'],
  vibration: ['waves', 'share'],
  dissipated: ['lost', 'share'],
  peak_indentation: ['indentation', 'length'],
  target_velocity: ['target', 'velocity'],
};
const ALL = /** @type {Result[]} */ (Object.keys(FIGURES));

/** @typedef {{ root: HTMLElement, what: HTMLElement, value: HTMLElement }} Row */

/** @param {Frame} frame */
const keyOf = ({ chosen }) => JSON.stringify(chosen);

/**
 * Whether a design differs from the scene in more than these axes.
 * @param {Frame} now
 * @param {Frame} frame
 * @param {Axis[]} axes
 */
export function differsBeyond(now, frame, axes) {
  const over = axes.map(({ name }) => name);
  const bodies = (/** @type {Frame} */ { chosen }) =>
    entriesOf(chosen.bodies)
      .filter(([key]) => !over.includes(key))
      .join(' ');
  return differing([now, frame]).some((name) =>
    name === 'bodies' ? bodies(now) !== bodies(frame) : !over.includes(name),
  );
}

/**
 * What a comparison of two rows of figures says: of this result and of contacts, else of what differs most.
 * @param {ArrayLike<number>} now
 * @param {ArrayLike<number>} kept
 * @param {Result} result
 */
export function comparedIn(now, kept, result) {
  const figuresIn = (/** @type {ArrayLike<number>} */ found, /** @type {Result[]} */ names) =>
    names.map((name) => {
      const value = found[PLACE[name]];
      return /** @type {Figure} */ (figure(...FIGURES[name], Number.isFinite(value) ? value : null));
    });
  const said = (/** @type {Result[]} */ names) => sentences(figuresIn(now, names), figuresIn(kept, names));
  const first = said([...new Set([result, /** @type {const} */ ('contacts')])]);
  if (first.length) return first.join('; ');
  const [most] = said(ALL);
  return most ?? leastSaid(figuresIn(now, ALL), figuresIn(kept, ALL)).replace(/\.$/, '');
}

export class Designs {
  /** @type {Map<string, ArrayLike<number>>} */ found = new Map(); // figures by choices, where the answer lacks some
  /** @type {Map<Run, Row>} */ rows = new Map();
  against = ''; // the letter that the scene is compared with, if one was clicked
  asked = ''; // the key of the job that is under way
  due = false; // the table is wanted, once the server has answered

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    this.morph = new Morph(whatif);
    const button = { type: 'button', className: 'whole', textContent: text('compare.keep') };
    this.keep = make('button', /** @type {any} */ (button));
    this.keep.title = text('compare.keep-hint');
    this.keep.setAttribute('aria-keyshortcuts', 'K');
    this.keep.onclick = () => whatif.page.compare.keep();
    this.save = make('button', { type: 'button', className: 'whole small', textContent: text('whatif.table') });
    this.save.title = text('whatif.table-about');
    this.save.onclick = () => {
      this.due = true;
      if (whatif.page.own.made.has(whatif.page.frame)) whatif.page.changes.flush();
      this.#save();
    };
    this.list = make('ul');
    this.said = make('p', { ariaLive: 'polite' });
    const head = make('div', { className: 'whatif-line' });
    this.title = make('strong', { textContent: text('compare.runs') });
    head.append(this.title, this.morph.root, this.save);
    this.root = make('section', { className: 'whatif-kept' }, head, this.morph.wrong, this.said, this.list);
    this.root.ariaLabel = text('compare.runs');
  }
  /** All that is kept. */
  get #runs() {
    return this.whatif.page.compare.runs;
  }
  /** What can be set beside the scene. */
  get beside() {
    const { frame } = this.whatif.page;
    return this.#runs.filter((run) => comparable(frame, run.frame));
  }
  /**
   * Figures of an answer, and where it lacks some, what was found of it besides.
   * @param {Frame} frame
   * @returns {ArrayLike<number>}
   */
  figures(frame) {
    const whole = figuresOfWhole(frame);
    const key = keyOf(frame);
    const { found, of } = this.whatif.jobs.own;
    const more = this.found.get(key) ?? ((of === key && found) || listed(null));
    return Float64Array.from(whole, (value, k) => (Number.isNaN(value) ? more[k] : value));
  }
  /** @param {Frame} frame  What the map has found of the scene is known of what is kept of it. */
  #learn(frame) {
    const { found, of } = this.whatif.jobs.own;
    if (found && of === keyOf(frame)) this.found.set(of, found);
  }
  /**
   * Figures that are still to be found.
   * @returns {Job | null}
   */
  next() {
    const { points, x, y } = this.whatif;
    const { base, own, source } = points;
    if (!base || this.asked) return null;
    for (const { frame } of this.beside) {
      const key = keyOf(frame);
      const { chosen } = frame;
      if (this.found.has(key) || chosen.scene !== base.chosen.scene) continue;
      const changed = Object.keys(chosen).filter((name) => !Object.is(chosen[name], base.chosen[name]));
      const covered = source === own ? own.covers(base, changed) : Number.isNaN(figuresOfWhole(frame)[PLACE.contacts]);
      if (!covered) continue;
      const rows = Float64Array.of(valueIn(x, frame), valueIn(y, frame));
      if (!rows.every(Number.isFinite)) continue;
      this.asked = key;
      return {
        ...{ chosen, names: [x.name, y.name], rows, tolerance: 0 },
        done: (found) => {
          this.asked = '';
          if (found) this.found.set(key, found[0] ? listed(null) : found);
          this.whatif.schedule();
        },
      };
    }
    return null;
  }
  /** What the map has of them. */
  get shown() {
    const { page, x, y } = this.whatif;
    const at = (/** @type {Frame} */ frame) =>
      /** @type {Spot} */ ([placeOf(x, valueIn(x, frame)), placeOf(y, valueIn(y, frame))]);
    const kept = this.beside
      .map(({ frame, letter }) => ({ letter, at: at(frame), hollow: differsBeyond(page.frame, frame, [x, y]) }))
      .filter(({ at: place }) => place.every(Number.isFinite))
      .sort((one, other) => Number(other.hollow) - Number(one.hollow)); // those of this very map above the others
    const { changes, from, to } = this.morph;
    const way = changes.length && from && to ? [at(from.frame), at(to.frame)] : null;
    return { kept: /** @type {Kept[]} */ (kept), way: /** @type {[Spot, Spot] | null} */ (way) };
  }
  /**
   * Those on a curve over the axis across: places and values.
   * @param {Result} result
   */
  along(result) {
    const { page, x } = this.whatif;
    const [from, to] = this.whatif.range(x);
    return this.beside
      .filter(({ frame }) => !differsBeyond(page.frame, frame, [x]))
      .map(({ frame, letter }) => ({
        ...{ letter, place: placeOf(x, valueIn(x, frame)) },
        value: valueOf(result, this.figures(frame)),
      }))
      .filter(({ place, value }) => place >= from && place <= to && Number.isFinite(value));
  }
  /**
   * Have the scene become one of them.
   * @param {string} letter
   */
  go(letter) {
    const { compare } = this.whatif.page;
    const run = this.#runs.find((each) => each.letter === letter);
    this.against = letter;
    if (run) compare.goBack(run);
  }
  /** Everything that is written of them. */
  follow() {
    const runs = this.#runs;
    const { frame } = this.whatif.page;
    for (const run of runs) this.#learn(run.frame);
    this.root.hidden = !runs.length;
    const { beside } = this;
    this.morph.follow(beside);
    this.title.hidden = !this.morph.root.hidden; // the slider has its room
    this.#list(runs, beside);
    this.#compare(frame, beside);
    this.#save();
  }
  /**
   * @param {Run[]} runs
   * @param {Run[]} beside
   */
  #list(runs, beside) {
    const { page, result } = this.whatif;
    const anew = runs.length !== this.rows.size || runs.some((run) => !this.rows.has(run));
    if (anew) {
      this.rows = new Map(runs.map((run) => [run, this.rows.get(run) ?? this.#row(run)]));
      this.list.replaceChildren(...[...this.rows.values()].map(({ root }) => root));
    }
    for (const [run, { value, what }] of this.rows) {
      const { frame } = run;
      const there = beside.includes(run);
      const differs = there ? lineOf(differing([page.frame, frame]), frame) : titleOf(frame);
      write(what, differs || text('compare.same'));
      write(value, there ? written(result, valueOf(result, this.figures(frame))) : '');
    }
  }
  /**
   * @param {Run} run
   * @returns {Row}
   */
  #row(run) {
    const { compare } = this.whatif.page;
    const { letter } = run;
    const what = make('span');
    const value = make('strong');
    const act = (/** @type {string} */ hint, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', title: hint, ariaLabel: hint, onclick });
    const go = act(text('compare.restore', { name: letter }), () => this.go(letter));
    go.append(make('b', { textContent: letter }));
    const remove = act(text('compare.remove', { name: letter }), () => compare.remove(run));
    remove.className = 'sign';
    remove.textContent = '✕';
    return { root: make('li', {}, go, what, value, remove), value, what };
  }
  /**
   * The scene against the one that was clicked, else the nearest.
   * @param {Frame} now
   * @param {Run[]} beside
   */
  #compare(now, beside) {
    const { result, x, y } = this.whatif;
    const off = (/** @type {Axis} */ axis, /** @type {Frame} */ frame) =>
      (placeOf(axis, valueIn(axis, frame)) - placeOf(axis, valueIn(axis, now))) / longOf(axis);
    const far = (/** @type {Run} */ { frame }) => {
      const over = [x, y].map((axis) => off(axis, frame));
      return Math.hypot(...over) + (differsBeyond(now, frame, [x, y]) ? 1 : 0); // one that is on this map first
    };
    const near = beside.toSorted((one, other) => far(one) - far(other));
    const run = beside.find(({ letter }) => letter === this.against) ?? near[0];
    if (!run) return write(this.said, '');
    const { frame, letter: name } = run;
    if (!differing([now, frame]).length) return write(this.said, text('compare.against-same', { name }));
    return write(
      this.said,
      text('whatif.against', { name, differs: comparedIn(this.figures(now), this.figures(frame), result) }),
    );
  }
  /** The table, once all of it is the server's answer to what is chosen. */
  #save() {
    const { page } = this.whatif;
    const { frame } = page;
    if (!this.due || frame.draft || page.own.made.has(frame)) return;
    this.due = false;
    const now = { name: text('compare.now'), frame, found: this.figures(frame) };
    const designs = this.beside.map((run) => ({ name: run.letter, frame: run.frame, found: this.figures(run.frame) }));
    const name = `strikewave-${fileOf(frame.chosen.scene)}-designs.csv`;
    download(new Blob([tableOf([...designs, now], linkOf(page))], { type: 'text/csv' }), name);
  }
}
