// The views of what if …: the map, all results over one choice, what tolerances make of a result, and which model is
// enough for it.
import { segments } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { carried } from '../browser/home.js';
import { Curves } from './curves.js';
import { Models } from './models.js';
import { SLOTS } from './sentence.js';
import { Tolerance } from './tolerance.js';

/** @import { Job } from './points.js' */
/** @import { WhatIf } from './whatif.js' */

/** @typedef {keyof typeof SENTENCES} Mode */

const SENTENCES = {
  map: () => text('whatif.sentence', SLOTS),
  curves: () => text('whatif.sentence-curves', SLOTS),
  tolerance: () => text('whatif.sentence-tolerance', SLOTS),
  models: () => text('whatif.sentence-models', SLOTS),
};
const ALL = /** @type {Mode[]} */ (Object.keys(SENTENCES));
const NAMES = ALL.filter((name) => name !== 'models' || !carried); // the server solves by each model
const VIEW = /^(?:(\w+):)?(.*)$/s; // of a link, and the rest of it
const LABELS = {
  ...{ map: text('whatif.map'), curves: text('whatif.curves') },
  ...{ tolerance: text('whatif.tolerance'), models: text('whatif.models') },
};

export class Modes {
  /** @type {Mode} */ mode = 'map';

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    this.curves = new Curves(whatif);
    this.tolerance = new Tolerance(whatif);
    this.models = new Models(whatif);
    const turn = (/** @type {string} */ name) => {
      this.turn(/** @type {Mode} */ (name));
      whatif.page.history.later();
    };
    this.segments = segments(text('whatif.view'), NAMES, turn, (name) => LABELS[/** @type {Mode} */ (name)]);
    this.segments.show(this.mode);
    this.segments.root.classList.add('whatif-modes');
  }
  /** The view that is shown in place of the map, if one is. */
  get shown() {
    return this.mode === 'map' ? null : this[this.mode];
  }
  get parts() {
    return [this.curves.root, this.tolerance.root, this.models.root];
  }
  /** @param {Mode} mode */
  turn(mode) {
    const { whatif } = this;
    this.mode = mode;
    this.segments.show(mode);
    whatif.sentence.say(SENTENCES[mode]());
    if (whatif.open) whatif.page.root.dataset.whatif = mode;
    whatif.tiles.all.clear(); // they are made anew, of what they show now
    whatif.schedule();
  }
  /**
   * What a link says, without the view that it begins with.
   * @param {string} said
   */
  follow(said) {
    const [, first = '', rest] = /** @type {RegExpExecArray} */ (VIEW.exec(said));
    const mode = NAMES.find((name) => name === first) ?? 'map';
    if (mode !== this.mode) this.turn(mode);
    return rest === mode ? '' : rest;
  }
  /** Another scene: nothing that was found is of it. */
  forget() {
    this.curves.forget();
    this.tolerance.forget();
    this.models.forget();
  }
  /** What a link begins with. */
  get said() {
    return this.mode === 'map' ? '' : `${this.mode}:`;
  }
  /**
   * What the view still needs.
   * @param {number} many  impacts at most
   * @returns {Job | null}
   */
  next(many) {
    const { points } = this.whatif;
    if (this.shown === this.models) return points.source === points.own ? null : this.rest(); // the server is asked
    return this.shown?.jobs.next(many) ?? null;
  }
  /** What the server is to find beside what the browser does. */
  rest() {
    return this.shown === this.models ? this.models.jobs.next() : null;
  }
}
