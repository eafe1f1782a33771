// Of what is dropped the impact that is nearest to the clock, seen closer: its force over time.
import { cleared, letters, scale as zoom } from '../charts/canvas.js';
import { ticks } from '../charts/scale.js';
import { COLORS, css } from '../charts/styles.js';
import { make } from '../browser/dom.js';
import { unitOfTime } from '../clock/times.js';
import { text } from '../text/catalogue.js';
import { duration, engineering, figures, localised, scaled } from '../text/format.js';

/** @import { AxialFrame, Numbers } from '../messages.js' */
/** @import { Bounce } from './fall.js' */

const EDGE = { left: 40 * zoom, right: 10, top: 26 * zoom, bottom: 22 * zoom }; // pixels
const LATER = 1.12; // of the time that it lasts, that is drawn
const HOT = 1.15; // of the largest force of all impacts, that has the colour of the largest

/**
 * @typedef {object} Impact
 * @property {number} t  when it begins, from the release on [s]
 * @property {Numbers} y  forces, evenly until they part [N]
 * @property {number} end  when they part [s]
 * @property {number} most  the largest force [N]
 * @property {number} flown  how long it fell, or flew, before [s]
 */

/**
 * The forces of all impacts; none where one takes no time.
 * @param {AxialFrame} frame
 * @param {Bounce[]} bounces
 * @returns {Impact[]}
 */
export function impactsOf({ touches, touchForce }, bounces) {
  if (!touches || !touchForce) return [];
  const count = touchForce.length / bounces.length;
  let parted = 0;
  return bounces.map(({ t }, k) => {
    const [end, most] = touches.subarray(2 * k);
    const flown = t - parted;
    parted = t + end;
    return { t, end, most, flown, y: touchForce.subarray(count * k, count * (k + 1)) };
  });
}

/**
 * Which impact is nearest to an instant.
 * @param {Impact[]} impacts
 * @param {number} t
 */
export const nearest = (impacts, t) =>
  impacts.reduce((best, each, k) => (Math.abs(each.t - t) < Math.abs(impacts[best].t - t) ? k : best), 0);

export class Lens {
  /** @type {Impact[]} */ impacts = [];
  shown = -1; // of them
  canvas = make('canvas', { role: 'img', ariaLabel: text('fall.lens-about') });
  area = make('div', {}, this.canvas);
  title = make('h3');
  lasts = make('p');
  root = make('section', { className: 'lens' }, this.title, this.lasts, this.area);

  /** @param {Impact[]} impacts */
  load(impacts) {
    this.impacts = impacts;
    this.shown = -1;
    this.root.hidden = !impacts.length;
  }
  /**
   * The impact that is nearest to the clock.
   * @param {number} t
   */
  show(t) {
    const { impacts, shown } = this;
    if (!impacts.length) return;
    this.shown = nearest(impacts, t);
    if (this.shown === shown) return;
    const number = this.shown + 1;
    const { end, flown } = impacts[this.shown];
    this.title.textContent = text('fall.lens', { number });
    const times = figures(flown / end, 2);
    this.lasts.textContent = text('fall.lasts', { first: number === 1, time: duration(end), times });
    this.draw();
  }
  draw() {
    const impact = this.impacts[this.shown];
    const sheet = impact && cleared(this.canvas, this.area);
    if (!sheet) return;
    const { c, width, height } = sheet;
    const { end, most, y } = impact;
    const step = end / (y.length - 1);
    const hardest = Math.max(...this.impacts.map((each) => each.most));
    const [left, right, top, floor] = [EDGE.left, width - EDGE.right, EDGE.top, height - EDGE.bottom];
    const across = (/** @type {number} */ t) => left + (t / (LATER * end)) * (right - left);
    const up = (/** @type {number} */ force) => floor - (force / most) * (floor - top);
    c.font = letters(13);
    c.textBaseline = 'alphabetic';
    c.lineWidth = 1;
    this.#scales(c, impact, most, { left, right, top, floor });
    for (let px = Math.floor(left); px < right; px++) {
      const t = ((px + 0.5 - left) / (right - left)) * LATER * end;
      const force = t < end ? y[Math.floor(t / step)] : 0;
      c.fillStyle = css(force, HOT * hardest);
      if (force > 0) c.fillRect(px, up(force), 1, floor - up(force));
    }
    c.strokeStyle = COLORS.ink;
    c.lineWidth = 1.6;
    c.beginPath();
    c.moveTo(left, floor);
    for (let k = 0; k < y.length; k++) c.lineTo(across(k * step), up(y[k]));
    c.lineTo(right, floor);
    c.stroke();
    this.#peak(c, most, [across(step * y.indexOf(Math.max(...y))), top, width]);
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Impact} impact
   * @param {number} most  [N]
   * @param {{ left: number, right: number, top: number, floor: number }} box
   */
  #scales(c, { end }, most, { floor, left, right, top }) {
    const [factor, unit] = scaled(most, 'N');
    const up = ticks(0, most * factor, (floor - top) / (44 * zoom));
    c.textAlign = 'right';
    up.found.forEach((value, k) => {
      const y = Math.round(floor - (value / (most * factor)) * (floor - top)) + 0.5;
      c.strokeStyle = value ? COLORS.grid : COLORS.edge;
      c.beginPath();
      c.moveTo(left, y);
      c.lineTo(right, y);
      c.stroke();
      c.fillStyle = COLORS.faint;
      c.fillText(`${localised(value.toFixed(up.digits))}${k ? '' : ` ${unit}`}`, left - 6, y + 4);
    });
    const [per, sign] = unitOfTime(end);
    const along = ticks(0, LATER * end * per, (right - left) / (60 * zoom));
    along.found.forEach((value, k) => {
      c.textAlign = k ? 'center' : 'left';
      const words = `${localised(value.toFixed(along.digits))}${k ? '' : ` ${sign}`}`;
      c.fillText(words, left + (value / (LATER * end * per)) * (right - left), floor + 16 * zoom);
    });
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {number} most  [N]
   * @param {[x: number, y: number, width: number]} at
   */
  #peak(c, most, [x, y, width]) {
    const words = engineering(most, 'N', 3);
    c.font = letters(18, '600 ');
    c.fillStyle = COLORS.ink;
    const beside = x + c.measureText(words).width + 10 < width;
    c.textAlign = beside ? 'left' : 'right';
    c.fillText(words, x + (beside ? 8 : -8), y - 6);
    c.beginPath();
    c.arc(x, y, 3.5, 0, 7);
    c.fill();
  }
}
