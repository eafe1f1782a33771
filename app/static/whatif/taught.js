// The map of a lesson: below the picture, with the result and the axes that a step names; its point is moved by what
// the step leaves to students.
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { grouped } from '../text/format.js';
import { titleOf } from './results.js';
import { placeOf } from './places.js';
import { nameOf } from './sentence.js';
import { WhatIf } from './whatif.js';

/** @import { Page } from '../page.js' */
/** @import { Axis } from './axes.js' */
/** @import { Boundary } from '../lesson/boundary.js' */
/** @import { Spot } from './plane.js' */

export class TaughtMap extends WhatIf {
  shown = '';
  heading = make('h3');
  head = make('div', { className: 'sketch-head' }, this.heading);
  /** @type {Boundary | null} */ sketch = null; // that is drawn on it
  root = make('section', { className: 'whatif-taught' });

  /**
   * @param {Page} page
   * @param {() => string[]} moves  choices that may be set by hand
   */
  constructor(page, moves) {
    super(page, () => {});
    this.moves = moves;
    this.borders.silent = true; // they are to find it
    this.root.append(this.head, this.plane.root, this.foot);
    this.plane.guest = (c, spot) => this.#drawn(c, spot);
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
  /** Whether all of it is found and drawn. */
  get whole() {
    return Boolean(this.shown && this.view && this.domain && this.jobs.idle && !this.due && !this.streaming);
  }
  /**
   * Have this drawn on it, by hand, before anything of it is seen.
   * @param {Boundary | null} sketch
   */
  lay(sketch) {
    const { head, heading, plane } = this;
    plane.blank = Boolean(sketch && !sketch.done);
    plane.over.tabIndex = plane.blank ? -1 : 0; // one draws beside it
    if (sketch !== this.sketch) {
      this.sketch?.plot.remove();
      this.sketch = sketch;
      head.replaceChildren(heading, ...(sketch ? [sketch.tools, sketch.points] : []));
      if (sketch) {
        sketch.map = this;
        plane.root.append(sketch.plot);
        this.ranges.clear();
      }
    }
    this.schedule();
  }
  /** @param {Axis} axis  At first, and as long as one draws, what the question is about. */
  range(axis) {
    const ends = this.sketch?.rangeOf(axis.name);
    if (ends && (this.plane.blank || !this.ranges.shown.has(axis.name)))
      this.ranges.set(axis, [placeOf(axis, ends[0]), placeOf(axis, ends[1])]);
    return super.range(axis);
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {(places: Spot) => Spot} spot
   */
  #drawn(c, spot) {
    const { plane, sketch, x, y } = this;
    const [across, up] = [x, y].map((axis) => sketch?.rangeOf(axis.name)?.map((value) => placeOf(axis, value)));
    if (!sketch || !across || !up) return;
    const at = (/** @type {number} */ t, /** @type {number} */ value) =>
      spot([across[0] + t * (across[1] - across[0]), up[0] + value * (up[1] - up[0])]);
    const { h, w, x: left, y: top } = plane.plot;
    const share = (/** @type {number} */ part) => Math.min(Math.max(part, 0), 1);
    sketch.paint(c, {
      ...{ left, top, wide: w, tall: h, bottom: top + h, until: 1, axis: [0, 1] },
      x: (t) => at(t, 0)[0],
      y: (value) => at(0, value)[1],
      at: (px, py) => [share(px / w), 1 - share(py / h)],
    });
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
