// The picture of a body that is dropped: it keeps its vertical, time goes across, and impulses hang below the floor.
import { cleared, letters, scale as zoom } from '../charts/canvas.js';
import { between, ticks } from '../charts/scale.js';
import { COLORS, css } from '../charts/styles.js';
import { Words } from '../opening/words.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { engineering, figures, localised, scaled } from '../text/format.js';

/** @import { Fall } from './fall.js' */
/** @typedef {CanvasRenderingContext2D} Context */

const EDGE = { narrow: 66, wide: 0.15, right: 26, top: 46, bottom: 34 }; // pixels, and a share of the width
const NARROW = 560;
const FLOOR = 0.72; // of the height between top and bottom
const BALL = 22; // pixels, its radius
const BARS = { most: 0.62, wide: 8, words: 3 }; // of the room below the floor; pixels; how many say their size
const TOPS = 5; // of which the share is said
const ALIKE = 0.01; // of restitutions whose tops lie on one curve
const LATER = 'rgba(255,255,255,.5)';
const DOTS = 60; // of the curve through the tops

export class FallStage {
  striker = null;
  /** @type {Fall | null} */ fall = null;
  words = new Words();
  box = { left: 0, right: 1, top: 0, floor: 1, bottom: 2 }; // pixels
  time = 0;
  hides = false; // what is still to come, as it is asked for

  /** @param {(t: number) => void} go */
  constructor(go) {
    this.canvas = make('canvas', { role: 'img', ariaLabel: text('fall.about') });
    this.root = make('section', { className: 'stage fall' }, this.canvas);
    this.canvas.onpointerdown = (event) => {
      const { left, right } = this.box;
      const seek = (/** @type {PointerEvent} */ { offsetX }) =>
        go(((offsetX - left) / (right - left)) * (this.fall?.end ?? 0));
      this.canvas.setPointerCapture(event.pointerId);
      this.canvas.onpointermove = seek;
      this.canvas.onpointerup = this.canvas.onpointercancel = () => {
        this.canvas.onpointermove = null;
      };
      seek(event);
    };
  }
  ranges() {
    return {};
  }
  adopt() {}
  /** @param {Fall | null} fall */
  load(fall) {
    this.fall = fall;
  }
  /** @param {number} t */
  #x(t) {
    const { left, right } = this.box;
    return left + (t / (this.fall?.end ?? 1)) * (right - left);
  }
  /** @param {number} height */
  #y(height) {
    const { floor, top } = this.box;
    return floor - (height / (this.fall?.height ?? 1)) * (floor - top);
  }
  /** @param {number} t */
  draw(t) {
    this.time = t;
    const { fall } = this;
    const sheet = fall && cleared(this.canvas, this.root);
    if (!fall || !sheet) return;
    const { c, width, height } = sheet;
    const narrow = width < NARROW;
    const bottom = height - EDGE.bottom;
    const top = EDGE.top + (narrow ? 0 : BALL);
    const floor = top + FLOOR * (bottom - top);
    this.box = { left: narrow ? EDGE.narrow : EDGE.wide * width, right: width - EDGE.right, top, floor, bottom };
    this.words.all = [];
    this.#axes(c, fall, width);
    const x = this.#x(t);
    if (this.hides) this.#past(c, fall, x);
    else this.#whole(c, fall, x);
    const y = this.#y(between(fall.x, fall.y, t));
    c.strokeStyle = COLORS.cursor;
    c.lineWidth = 1.4;
    line(c, [x, top - BALL], [x, bottom]);
    const ball = narrow ? x : this.box.left / 2;
    c.setLineDash([2, 4]);
    if (!narrow) line(c, [ball + BALL, y - BALL], [x, y - BALL]);
    c.setLineDash([]);
    this.#ball(c, ball, y, narrow ? BALL / 2 : BALL);
    c.fillStyle = COLORS.cursor;
    c.beginPath();
    c.arc(x, y, 4.5, 0, 7);
    if (!narrow) c.fill();
    this.words.draw(c, '', 0, 0);
  }
  /**
   * What comes behind this instant is paler.
   * @param {Context} c
   * @param {Fall} fall
   * @param {number} x  of the instant
   */
  #whole(c, fall, x) {
    const { bottom, right, top } = this.box;
    this.#path(c, fall);
    this.#impulses(c, fall);
    this.#rest(c, fall);
    c.fillStyle = LATER;
    c.fillRect(x, top - BALL, right - x + EDGE.right, bottom - top + BALL);
    this.#tops(c, fall);
  }
  /**
   * The height until this instant alone.
   * @param {Context} c
   * @param {Fall} fall
   * @param {number} x  of the instant
   */
  #past(c, fall, x) {
    c.save();
    c.beginPath();
    c.rect(0, 0, x, this.box.floor);
    c.clip();
    this.#path(c, fall);
    c.restore();
  }
  /**
   * @param {Context} c
   * @param {Fall} fall
   * @param {number} width
   */
  #axes(c, { end, height }, width) {
    const { bottom, floor, left, right, top } = this.box;
    const [factor, unit] = scaled(height * (1 + 1e-6), 'm');
    c.font = letters(13);
    c.textBaseline = 'alphabetic';
    c.lineWidth = 1;
    const up = ticks(0, height * factor, (floor - top) / (80 * zoom));
    up.found.forEach((value, k) => {
      const y = Math.round(this.#y(value / factor)) + 0.5;
      c.strokeStyle = COLORS.grid;
      line(c, [left, y], [right, y]);
      const sign = k === up.found.length - 1 ? ` ${unit}` : '';
      this.words.say(`${localised(value.toFixed(up.digits))}${sign}`, left - 8, y + 4, COLORS.faint, c.font, 'right');
    });
    const [per, sign] = end < 1 ? [1e3, 'ms'] : [1, 's'];
    const along = ticks(0, end * per, (right - left) / (110 * zoom));
    along.found.forEach((value, k) => {
      const words = `${localised(value.toFixed(along.digits))}${k ? '' : ` ${sign}`}`;
      this.words.say(words, this.#x(value / per), bottom + 20, COLORS.faint, c.font, 'center');
    });
    this.words.say(text('fall.height'), left, 20 * zoom, COLORS.ink, letters(13, '600 '));
    c.fillStyle = COLORS.grid;
    c.fillRect(0, floor, width, 7);
    c.fillStyle = COLORS.faint;
    c.fillRect(0, floor, width, 1.5);
  }
  /**
   * @param {Context} c
   * @param {Fall} fall
   */
  #path(c, { x, y }) {
    c.beginPath();
    for (let k = 0; k < x.length; k++) c.lineTo(this.#x(x[k]), this.#y(y[k]));
    c.strokeStyle = COLORS.waves;
    c.lineWidth = 2;
    c.stroke();
    c.lineTo(this.#x(x[x.length - 1]), this.box.floor);
    c.lineTo(this.box.left, this.box.floor);
    c.globalAlpha = 0.07;
    c.fillStyle = COLORS.waves;
    c.fill();
    c.globalAlpha = 1;
  }
  /**
   * Where all give as much back, the tops lie on one parabola that meets the floor where it rests.
   * @param {Context} c
   * @param {Fall} fall
   */
  #tops(c, { bounces, gravity, height, rest }) {
    const given = bounces.map(({ restitution }) => restitution);
    if (rest !== null && rest > 0 && Math.max(...given) - Math.min(...given) < ALIKE) {
      c.strokeStyle = COLORS.modal;
      c.lineWidth = 1.4;
      c.setLineDash([5, 5]);
      c.beginPath();
      for (let k = 0; k <= DOTS; k++) c.lineTo(this.#x((k / DOTS) * rest), this.#y(height * (1 - k / DOTS) ** 2));
      c.stroke();
      c.setLineDash([]);
    }
    const ink = letters(13, '600 ');
    bounces.slice(0, TOPS).forEach(({ height: rises, t }) => {
      const at = t + Math.sqrt((2 * rises) / gravity);
      if (rises > 0.02 * height)
        this.words.say(
          `${Math.round((100 * rises) / height)} %`,
          this.#x(at),
          this.#y(rises) - 9,
          COLORS.ink,
          ink,
          'center',
        );
    });
  }
  /**
   * @param {Context} c
   * @param {Fall} fall
   */
  #impulses(c, { bounces }) {
    const { bottom, floor, left, right } = this.box;
    const most = bounces[0].impulse;
    const room = BARS.most * (bottom - floor);
    bounces.forEach(({ impulse, t }, k) => {
      const x = this.#x(t);
      const long = (impulse / most) * room;
      c.fillStyle = css((0.75 * impulse) / most, 1);
      c.fillRect(x - BARS.wide / 2, floor + 8, Math.min(BARS.wide, 0.5 + 2 * long), long);
      const said = k ? figures(impulse * scaled(most, 'N s')[0], 2) : engineering(most, 'N s', 3);
      if (k < BARS.words)
        this.words.say(said, x, floor + 12 + long + 13 * zoom, COLORS.ink, letters(13, k ? '' : '600 '), 'center');
    });
    const title = text('fall.impulses');
    const [at, y] = left > EDGE.narrow ? [left - 8, floor + 26 * zoom] : [right, bottom - 4]; // below the shortest
    this.words.say(title, at, y, COLORS.ink, letters(13, '600 '), 'right');
  }
  /**
   * @param {Context} c
   * @param {Fall} fall
   */
  #rest(c, { rest }) {
    if (rest === null) return;
    const { floor, right } = this.box;
    const x = this.#x(rest);
    c.strokeStyle = c.fillStyle = COLORS.ink;
    c.lineWidth = 1;
    line(c, [x, floor], [x, floor - 46 * zoom]);
    c.beginPath();
    c.arc(x, floor, 4, 0, 7);
    c.fill();
    const to = Math.min(x + 14, right + EDGE.right - 4);
    this.words.say(`${figures(rest, 3)} s`, to, floor - 54 * zoom, COLORS.ink, letters(26, '650 '), 'right');
    this.words.say(text('fall.rest'), to, floor - 84 * zoom, COLORS.faint, letters(13), 'right');
  }
  /**
   * @param {Context} c
   * @param {number} x
   * @param {number} y  of its lowest point
   * @param {number} radius
   */
  #ball(c, x, y, radius) {
    c.fillStyle = '#3f4e5d';
    c.beginPath();
    c.arc(x, y - radius, radius, 0, 7);
    c.fill();
  }
}

/**
 * @param {Context} c
 * @param {[number, number]} from
 * @param {[number, number]} to
 */
function line(c, from, to) {
  c.beginPath();
  c.moveTo(...from);
  c.lineTo(...to);
  c.stroke();
}
