// The picture of a mechanism that moves on: its links, what their joints bear, and the mass where it flies.
import { Mechanism } from '../beam/mechanism.js';
import { cleared, letters } from '../charts/canvas.js';
import { between } from '../charts/scale.js';
import { COLORS } from '../charts/styles.js';
import { make } from '../shell/dom.js';
import { text } from '../text/catalogue.js';

/** @import { Found } from './motion.js' */
/** @import { Point } from '../beam/mechanism.js' */

const SEEN = 0.012; // of the whole time for which an impact is marked
const AROUND = 0.35; // of the mechanism, as far as which the mass is followed
const NARROW = 440; // pixels, below which there is room for few words

export class Picture {
  /** @type {Found | null} */ found = null;
  /** @type {Mechanism} */ mechanism;
  /** @type {Record<'x' | 'y', number[]>} */ mass = { x: [], y: [] };

  constructor() {
    this.canvas = make('canvas', { role: 'img', ariaLabel: text('motion.about') });
    this.root = make('div', { className: 'picture' }, this.canvas);
  }
  /** @param {Found} found */
  load(found) {
    this.found = found;
    const { impactor, mass_places: flown, mechanism, places, time } = found;
    const each = places.length / time.length;
    const first = places.slice(0, each);
    this.mechanism = new Mechanism(
      {
        ...{ impactor, mechanism, main: {}, linkTime: Float64Array.from(time) },
        linkPoints: Float64Array.from(first),
        linkMoves: Float64Array.from(places, (place, k) => place - first[k % each]),
        shapes: { linkPoints: [mechanism.links.length, each / 2 / mechanism.links.length, 2] },
        reactionTime: Float64Array.from(found.history_time),
        reactions: Float64Array.from(found.reactions),
      },
      0,
    );
    this.mass = { x: flown.filter((_, k) => k % 2 === 0), y: flown.filter((_, k) => k % 2 === 1) };
    this.mechanism.roam([...places, ...this.#near()]);
  }
  /** Where the mass flies, as long as it is near the links. */
  #near() {
    const { mechanism, found } = this;
    mechanism.roam(found?.places ?? []);
    const [left, right, low, high] = mechanism.box;
    const room = AROUND * Math.max(right - left, high - low);
    const { x, y } = this.mass;
    const inside = (/** @type {number} */ k) =>
      x[k] > left - room && x[k] < right + room && y[k] > low - room && y[k] < high + room;
    return x.flatMap((_, k) => (inside(k) ? [x[k], y[k]] : []));
  }
  /**
   * @param {number} t  [ms]
   */
  draw(t) {
    const { canvas, found, mass, mechanism, root } = this;
    const sheet = found && cleared(canvas, root);
    if (!sheet) return;
    const { c, height, width } = sheet;
    mechanism.fit(width, height);
    mechanism.place(t);
    this.#path(c);
    mechanism.links(c, () => 0, 1, false);
    mechanism.joints(c);
    const { angle, time } = found.normals;
    const leans = between(time, angle, t);
    /** @type {Point} */
    const at = [between(found.time, mass.x, t), between(found.time, mass.y, t)];
    mechanism.striking(c, at, [Math.cos(leans), Math.sin(leans)], this.#touching(t));
    mechanism.reactions(c, t);
    mechanism.words(c, 12, 36, width < NARROW);
    c.fillStyle = COLORS.faint;
    c.font = letters(12);
    c.textAlign = 'left';
    c.textBaseline = 'alphabetic';
    c.fillText(text('motion.scale'), 12, 18);
  }
  /** @param {number} t */
  #touching(t) {
    const { duration, impacts } = /** @type {Found} */ (this.found);
    return impacts.some(([start, end]) => t >= start && t <= end + SEEN * duration);
  }
  /**
   * The way of the mass.
   * @param {CanvasRenderingContext2D} c
   */
  #path(c) {
    const { x, y } = this.mass;
    c.strokeStyle = COLORS.edge;
    c.lineWidth = 1;
    c.setLineDash([2, 4]);
    c.beginPath();
    for (let k = 0; k < x.length; k++) c.lineTo(...this.mechanism.pixel(x[k], y[k]));
    c.stroke();
    c.setLineDash([]);
  }
}
