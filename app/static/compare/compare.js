// Solutions that are kept: up to eight, overlaid on every chart, compared with the one that is shown, and one of them
// beside it in the picture. They are messages that the browser has already; nothing is solved for them.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { Bar, freeLetter } from './bar.js';
import { Beside } from './beside.js';
import { layOver } from './overlay.js';
import { Run } from './run.js';
import { Scales } from './scales.js';
import { differing, lineOf } from '../form/settings.js';
import { comparable, compares } from './kinds.js';
import { Summary } from './summary.js';

/** @import { Page } from '../page.js' */
/** @import { Changes } from '../wire/changes.js' */
/** @import { Wanted } from '../frame/kept.js' */
/** @import { Chosen, Frame, Question } from '../messages.js' */

const PATIENCE = 30_000; // ms for a solution of a link
const REMEMBERED = 16; // runs that undo may bring back as they were; others are solved again

export class Compare {
  /** @type {Run[]} */ runs = [];
  /** @type {Run | null} */ beside = null; // in the picture
  /** @type {ArrayBuffer} */ bytes; // of the frame that is shown
  due = false; // it is to be kept once it is no draft any more
  /** @type {Question | null} */ coming = null; // of which the second answer is being solved
  /** @type {Map<string, Run>} */ known = new Map(); // that are or were kept, by what an entry of the history says

  /**
   * @param {Page} page
   * @param {Parameters<typeof compares>[0]} kinds
   */
  constructor(page, kinds) {
    compares(kinds);
    this.page = page;
    this.scales = new Scales();
    this.bar = new Bar(this);
    this.summary = new Summary();
    this.second = new Beside(page);
    this.tag = make('span', { className: 'tag own', textContent: text('compare.now'), hidden: true });
  }
  /**
   * What is kept, as it can be asked for again.
   * @returns {Wanted[]}
   */
  get wanted() {
    return this.runs.map(({ frame, letter }) => ({ letter, settings: frame.chosen }));
  }
  get locked() {
    return this.scales.locked;
  }
  /** Whether there are axes to be locked. */
  get lockable() {
    return Boolean(this.page.views[this.page.frame.kind].axis);
  }
  /**
   * Another message is about to be shown.
   * @param {ArrayBuffer} bytes
   * @param {Frame} frame
   */
  take(bytes, frame) {
    this.bytes = bytes;
    if (this.locked && this.page.root.dataset.kind !== frame.kind) this.lock(false); // other charts
    this.lay(frame);
  }
  /**
   * Lay what is kept over the charts of a frame that is about to be shown.
   * @param {Frame} frame
   */
  lay(frame) {
    layOver(this.page.views[frame.kind], frame, this.runs);
  }
  /**
   * The message that is shown is kept; the run that has it, or nothing where there is no room.
   * @returns {Run | null}
   */
  keep() {
    const { page, runs } = this;
    const own = page.own.made.has(page.frame);
    if (own) page.changes.flush(); // it is wanted now
    this.due = page.frame.draft || own;
    if (this.due) return null; // once the server has solved it as chosen
    const letter = freeLetter(runs);
    const same = runs.find((run) => !differing([page.frame, run.frame]).length);
    if (same) page.complain(text('compare.already', { name: same.letter }));
    else if (!letter) page.complain(text('compare.full'));
    if (same || !letter) return same ?? null;
    const run = new Run(letter, this.bytes);
    this.runs = [...runs, run].sort((a, b) => a.letter.localeCompare(b.letter));
    this.#changed();
    return run;
  }
  /**
   * What a key does. Whether it does anything.
   * @param {KeyboardEvent} event
   */
  key(event) {
    if (event.key.toLowerCase() !== 'k') return false;
    this.keep();
    return true;
  }
  /** @param {Run} run */
  remove(run) {
    this.runs = this.runs.filter((each) => each !== run);
    if (this.beside === run) this.beside = null;
    this.#changed();
  }
  clear() {
    this.runs = [];
    this.beside = null;
    this.#changed();
  }
  /** @param {Run | null} run */
  standBeside(run) {
    this.beside = run;
    this.#changed();
  }
  /** @param {boolean} locked */
  lock(locked) {
    this.scales.lock(this.page.view, this.page.frame, locked);
    this.#changed();
  }
  /**
   * Go back to the settings of a kept run.
   * @param {Run} run
   */
  goBack({ frame }) {
    this.page.goTo(frame.chosen);
  }
  /**
   * A ready-made comparison: all settings are solved, all but the last are kept.
   * @param {Question} question
   */
  ask(question) {
    const { alone, between, first, question: key, second } = question;
    const { page } = this;
    const chosen = alone ? {} : page.frame.chosen;
    const settings = [first, ...between, second];
    const next = (/** @type {number} */ place) => {
      page.goTo({ ...chosen, ...settings[place] }, (frame) => {
        if (place === settings.length - 1) {
          this.coming = null;
          if (!frame) this.tell(page.frame); // what is shown with an answer is said anyhow
          return;
        }
        const run = frame && this.keep();
        if (!run) return;
        run.asked = key;
        this.coming = question;
        this.tell(frame);
        page.layout.show('story');
        next(place + 1);
      });
    };
    next(0);
  }
  /**
   * Have what a link says is kept solved again, out of sight, and come back to what is shown.
   * @param {Wanted[]} wanted
   */
  async restore(wanted) {
    const { page } = this;
    const { changes, history } = page;
    const { chosen } = page.frame;
    const lost = [];
    history.going ??= wanted; // to where it was kept: that is no step
    changes.quiet = page.root.inert = true;
    page.waiter.soon('kept', text('compare.restoring'));
    for (const { letter, settings } of wanted)
      if (await reached(changes, { scene: chosen.scene, ...settings })) this.runs.push(new Run(letter, changes.bytes));
      else lost.push(letter);
    await reached(changes, chosen);
    changes.quiet = page.root.inert = false;
    page.waiter.over('kept');
    if (lost.length) page.complain(text('compare.lost', { names: lost }));
    this.runs.sort((a, b) => a.letter.localeCompare(b.letter));
    this.#changed();
    if (history.going === wanted) history.going = null;
  }
  /**
   * Have these kept and no others, as undo and redo ask.
   * @param {Wanted[]} wanted
   */
  async recall(wanted) {
    const known = wanted.map((each) => this.known.get(JSON.stringify(each)));
    this.runs = known.filter((run) => run !== undefined);
    if (this.beside && !this.runs.includes(this.beside)) this.beside = null;
    const missing = wanted.filter((_, place) => !known[place]);
    if (missing.length) await this.restore(missing);
    else this.#changed();
  }
  /** What is kept, or how it is shown, has changed. */
  #changed() {
    const { page } = this;
    if (!page.frame) return;
    this.wanted.forEach((each, place) => this.known.set(JSON.stringify(each), this.runs[place]));
    for (const oldest of [...this.known.keys()].slice(0, -REMEMBERED)) this.known.delete(oldest);
    layOver(page.view, page.frame, this.runs);
    this.reach();
    page.view.dress();
    this.tell(page.frame);
    page.redraw();
    page.history.write();
  }
  /** The charts show as much time as what they show takes. */
  reach() {
    const { frame, view } = this.page;
    view.axis?.reach(0, this.span(frame));
  }
  /**
   * How much time the charts show, in units of the message; beside the map there is nothing of what is kept.
   * @param {Frame} frame
   */
  span(frame) {
    if (!('trip' in frame) || this.page.root?.dataset.whatif) return frame.duration;
    if (this.scales.seconds) return this.scales.seconds / frame.trip;
    const others = this.runs.flatMap(({ frame: kept }) =>
      'trip' in kept && comparable(frame, kept) ? [(kept.duration * kept.trip) / frame.trip] : [],
    );
    return Math.max(frame.duration, ...others);
  }
  /**
   * Words and numbers, with those of what is shown.
   * @param {Frame} frame
   */
  tell(frame) {
    const coming = this.coming && secondOf(this.coming, frame);
    this.bar.load(frame, coming);
    this.summary.load(frame, this.runs, coming);
  }
  /**
   * Dress the picture beside; where the colours of both end.
   * @param {string} what  they show
   * @param {number} [largest]  of what is shown, in units of its message
   * @param {number} [unit]
   */
  dress(what, largest = 0, unit = 1) {
    const { beside, scales, second } = this;
    second.choose(beside);
    this.tag.hidden = !beside;
    const own = largest * unit;
    const other = second.picture?.end?.(what) ?? 0;
    const end = scales.end(what, own && Math.max(own, other));
    second.picture?.load(what, end);
    return end / unit;
  }
  /**
   * Draw both pictures to one scale.
   * @param {import('./scales.js').Scaled} stage  of what is shown
   */
  share(stage) {
    const { stage: other } = this.second;
    this.scales.share(stage, other && other.constructor === stage.constructor ? other : null);
  }
  /** @param {number} t  of what is shown */
  show(t) {
    this.second.picture?.draw(this.page.frame, t);
  }
}

/**
 * The second setting of a question, in words; of another scene there are none.
 * @param {Question} question
 * @param {Frame} frame  that is shown
 */
function secondOf({ second }, frame) {
  const names = 'scene' in second ? [] : Object.keys(second);
  const settings = lineOf(names, /** @type {Frame} */ ({ ...frame, chosen: { ...frame.chosen, ...second } }));
  return text('compare.coming', { settings: settings || 'none' });
}

/**
 * Whether settings were reached.
 * @param {Changes} changes
 * @param {Partial<Chosen>} settings
 * @returns {Promise<boolean>}
 */
function reached(changes, settings) {
  return new Promise((done) => {
    const late = setTimeout(() => changes.leave(), PATIENCE);
    changes.go(settings, (frame) => {
      clearTimeout(late);
      done(frame !== null);
    });
  });
}
