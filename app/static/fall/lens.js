// The first impact of what is dropped, seen closer: its force over time, which is far shorter than its fall.
import { cleared, letters, scale as zoom } from '../charts/canvas.js';
import { between, ticks } from '../charts/scale.js';
import { COLORS, css } from '../charts/styles.js';
import { make } from '../shell/dom.js';
import { unitOfTime } from '../shell/times.js';
import { text } from '../text/catalogue.js';
import { duration, engineering, figures, localised, scaled } from '../text/format.js';

/** @import { AxialFrame, Numbers } from '../messages.js' */

const EDGE = { left: 40 * zoom, right: 10, top: 26 * zoom, bottom: 22 * zoom }; // pixels
const LATER = 1.12; // of the time that it lasts, that is drawn
const HOT = 1.15; // of the peak, that has the colour of the largest

/**
 * @typedef {object} Impact
 * @property {Numbers} x  times [s]
 * @property {Numbers} y  forces [N]
 * @property {number} end  when they part [s]
 * @property {number} fell  how long it fell before [s]
 */

/**
 * The force of the impact that the message has; nothing of one that takes no time.
 * @param {AxialFrame} frame
 * @param {number} fell  how long it fell [s]
 * @returns {Impact | null}
 */
export function impactOf({ exact: { contacts, sudden }, exactForce, exactTime, forceUnit, trip }, fell) {
  const end = (contacts.at(-1)?.[1] ?? 0) * trip;
  if (sudden || exactTime.length < 2 || !(end > 0)) return null;
  return { x: exactTime.map((t) => t * trip), y: exactForce.map((force) => force * forceUnit), end, fell };
}

export class Lens {
  /** @type {Impact | null} */ impact = null;
  canvas = make('canvas', { role: 'img', ariaLabel: text('fall.lens-about') });
  area = make('div', {}, this.canvas);
  lasts = make('p');
  root = make('section', { className: 'lens' }, make('h3', { textContent: text('fall.lens') }), this.lasts, this.area);

  /** @param {Impact | null} impact */
  load(impact) {
    this.impact = impact;
    this.root.hidden = !impact;
    if (!impact) return;
    const times = figures(impact.fell / impact.end, 2);
    this.lasts.textContent = text('fall.lasts', { time: duration(impact.end), times });
    this.draw();
  }
  draw() {
    const { impact } = this;
    const sheet = impact && cleared(this.canvas, this.area);
    if (!impact || !sheet) return;
    const { c, width, height } = sheet;
    const { end, x, y } = impact;
    const [left, right, top, floor] = [EDGE.left, width - EDGE.right, EDGE.top, height - EDGE.bottom];
    const most = y.reduce((a, b) => Math.max(a, b), 0);
    const across = (/** @type {number} */ t) => left + (t / (LATER * end)) * (right - left);
    const up = (/** @type {number} */ force) => floor - (force / most) * (floor - top);
    c.font = letters(13);
    c.textBaseline = 'alphabetic';
    c.lineWidth = 1;
    this.#scales(c, impact, most, { left, right, top, floor });
    for (let px = Math.floor(left); px < right; px++) {
      const t = ((px + 0.5 - left) / (right - left)) * LATER * end;
      const force = t > 0 && t < end ? between(x, y, t) : 0;
      c.fillStyle = css(force, HOT * most);
      if (force > 0) c.fillRect(px, up(force), 1, floor - up(force));
    }
    c.strokeStyle = COLORS.ink;
    c.lineWidth = 1.6;
    c.beginPath();
    c.moveTo(left, floor);
    for (let k = 0; k < x.length && x[k] <= LATER * end; k++) c.lineTo(across(x[k]), up(y[k]));
    c.stroke();
    this.#peak(c, most, [across(x[y.indexOf(most)]), top, width]);
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
