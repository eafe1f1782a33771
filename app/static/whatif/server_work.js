// What the server still has to find of what is drawn, and a button that ends that and has it go on.
import { make, write } from '../browser/dom.js';
import { grouped } from '../text/format.js';
import { text } from '../text/catalogue.js';

/** @import { WhatIf } from './whatif.js' */

export class ServerWork {
  words = make('span');
  button = make('button', { type: 'button', onclick: () => this.turn() });
  root = make('span', { className: 'whatif-work', hidden: true }, this.words, this.button);
  of = ''; // what was stopped: which view, of which scene, over which choices

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
  }
  /** Stop, or go on. */
  turn() {
    const { borders, modes, points } = this.whatif;
    const searches = [modes.curves.jobs, modes.tolerance.jobs, ...borders.searches, borders.near];
    for (const jobs of searches) jobs.lost = 0; // what was stopped is not refused
    points.stop(!points.stopped);
    this.whatif.schedule();
  }
  /** Whether all that is drawn is found by the server. */
  get #all() {
    const { modes, points } = this.whatif;
    return points.source === points.served || modes.shown === modes.models;
  }
  /** Another picture is there; of another view the server finds all. */
  follow() {
    const { modes, named, points, scene, sentence } = this.whatif;
    const of = JSON.stringify([scene, named, modes.mode]);
    if (of !== this.of && points.stopped) points.stop(false);
    this.of = of;
    const words = this.#words();
    const hidden = words === null && !(points.stopped && this.#all);
    if (hidden && this.button.matches(':focus')) sentence.root.focus();
    this.root.hidden = hidden;
    write(this.words, words ?? '');
    write(this.button, text(points.stopped ? 'whatif.go-on' : 'whatif.stop'));
    this.button.title = text(points.stopped ? 'whatif.go-on-about' : 'whatif.stop-about');
  }
  /** How much is found; nothing where the server has nothing left to find. */
  #words() {
    const { jobs, modes, points, view } = this.whatif;
    if (this.#all) {
      const progress = (modes.shown?.jobs ?? jobs).progress;
      const { all = 0, changes = 0, coarse = false, found = 0 } = progress ?? {};
      const said = { found: grouped(found), all: grouped(all), coarse: String(coarse) };
      if (found < all) return text('whatif.progress', said);
      if (changes) return text('whatif.progress-changes', { count: changes });
      return points.served.job?.drawn ? '' : null;
    }
    const left = points.serves ? points.left + (view?.lattice.left.size ?? 0) : 0;
    const [found, all] = [points.handed, points.handed + left].map(grouped);
    return left ? text('whatif.progress-left', { found, all }) : null;
  }
}
