// The map of a lesson: below the picture, with the result and the axes that a step names; its point is moved by what
// the step leaves to students.
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { grouped } from '../text/format.js';
import { titleOf } from './results.js';
import { nameOf } from './sentence.js';
import { WhatIf } from './whatif.js';

/** @import { Page } from '../page.js' */
/** @import { Axis } from './axes.js' */

export class TaughtMap extends WhatIf {
  shown = '';
  heading = make('h3');
  root = make('section', { className: 'whatif-taught' });

  /**
   * @param {Page} page
   * @param {() => string[]} moves  choices that may be set by hand
   */
  constructor(page, moves) {
    super(page, () => {});
    this.moves = moves;
    this.root.append(this.heading, this.plane.root, this.foot);
  }
  /**
   * Have this result over these axes.
   * @param {string} said  as a link says it
   */
  async show(said) {
    if (this.open) {
      if (said === this.shown) return;
      this.asked = said;
      this.take();
    } else await this.enter(said);
    this.shown = said;
  }
  place() {} // where its lesson has it
  clear() {}
  beside() {
    const { result, x, y } = this;
    write(this.heading, text('whatif.sentence', { of: titleOf(result), x: nameOf(x), y: nameOf(y) }));
  }
  /** A lesson does not weigh how impacts are solved. */
  say() {
    write(this.status, text('whatif.impacts', { count: grouped(this.points.solved) }));
  }
  /** @param {[axis: Axis, value: number][]} values */
  set(values) {
    const free = this.moves();
    super.set(values.filter(([{ name }]) => free.includes(name)));
  }
}
