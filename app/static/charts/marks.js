// What is drawn inside the box of a chart: lines, dots, bands, stretches of the axis.

/** @typedef {import('./plot.js').Plot} Plot */
/** @typedef {import('./scale.js').Range} Range */
/** @typedef {import('./scale.js').Samples} Samples */
/** @typedef {import('./styles.js').Style} Style */
/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {readonly [start: number, end: number, ...unknown[]]} Span  what else it says is not drawn */

import { indexAt } from './scale.js';
import { COLORS } from './styles.js';
import { thinned } from './thinned.js';

/**
 * A line through samples, or their rings or dots.
 * @param {Context} c
 * @param {Plot} plot
 * @param {Samples & { path?: boolean }} samples  `path`: joined in their own order
 * @param {number} factor  of y
 * @param {Style} style
 */
export function curve(c, plot, samples, factor, style) {
  const { color, width = 1.6, dash = [], mark = 'line' } = style;
  c.strokeStyle = c.fillStyle = color;
  if (mark !== 'line') {
    signs(c, plot, samples, factor, mark);
    return;
  }
  c.lineWidth = width;
  c.lineJoin = 'round';
  c.setLineDash(dash);
  c.beginPath();
  if (samples.path) path(c, plot, samples, factor);
  else line(c, plot, samples, factor);
  c.stroke();
  c.setLineDash([]);
}

/**
 * @param {Context} c
 * @param {Plot} plot
 * @param {Samples} samples
 * @param {number} factor
 */
function line(c, plot, { x, y }, factor) {
  const { frame, x: view } = plot;
  const across = frame.w / (view[1] - view[0]);
  const up = (frame.h / (plot.y[1] - plot.y[0])) * factor;
  const base = frame.y + (plot.y[1] * frame.h) / (plot.y[1] - plot.y[0]);
  const first = x[0] < view[0] ? indexAt(x, view[0]) : 0;
  let end = first;
  while (end < x.length && x[end] <= view[1]) end++;
  const some = /** @type {[number, number]} */ ([first, Math.min(end + 1, x.length)]);
  thinned({ x, y }, some, [frame.x - view[0] * across, across], [base, -up], (px, py) => c.lineTo(px, py));
}

/**
 * @param {Context} c
 * @param {Plot} plot
 * @param {Samples} samples
 * @param {number} factor
 */
function path(c, plot, { x, y }, factor) {
  for (let k = 0; k < x.length; k++) c.lineTo(plot.px(x[k]), plot.py(y[k] * factor));
}

/**
 * @param {Context} c
 * @param {Plot} plot
 * @param {Samples} samples
 * @param {number} factor
 * @param {'ring' | 'dot'} mark
 */
function signs(c, plot, { x, y }, factor, mark) {
  c.lineWidth = 1.2;
  for (let k = 0; k < x.length; k++) {
    if (x[k] < plot.x[0] || x[k] > plot.x[1]) continue;
    c.beginPath();
    c.arc(plot.px(x[k]), plot.py(y[k] * factor), 3, 0, 2 * Math.PI);
    if (mark === 'ring') c.stroke();
    else c.fill();
  }
}

/**
 * A dot with a white edge.
 * @param {Context} c
 * @param {Plot} plot
 * @param {number} x
 * @param {number} y
 * @param {string} color
 */
export function dot(c, plot, x, y, color) {
  if (x < plot.x[0] || x > plot.x[1] || !Number.isFinite(y)) return;
  c.fillStyle = color;
  c.strokeStyle = COLORS.panel;
  c.lineWidth = 1.5;
  c.beginPath();
  c.arc(plot.px(x), plot.py(y), 4, 0, 2 * Math.PI);
  c.fill();
  c.stroke();
}

/**
 * A line upward through the whole box.
 * @param {Context} c
 * @param {Plot} plot
 * @param {number} x
 * @param {string} color
 * @param {number} width
 */
export function upright(c, plot, x, color, width) {
  if (x < plot.x[0] || x > plot.x[1]) return;
  const { y, h } = plot.frame;
  c.strokeStyle = color;
  c.lineWidth = width;
  c.beginPath();
  c.moveTo(plot.px(x), y);
  c.lineTo(plot.px(x), y + h);
  c.stroke();
}

/**
 * Stretches of x, filled from top to bottom, at least a pixel wide.
 * @param {Context} c
 * @param {Plot} plot
 * @param {Span[]} spans
 * @param {string} color
 */
export function shades(c, plot, spans, color) {
  c.fillStyle = color;
  for (const [start, end] of spans) {
    if (end < plot.x[0] || start > plot.x[1]) continue;
    c.fillRect(plot.px(start), plot.frame.y, Math.max(plot.px(end) - plot.px(start), 1), plot.frame.h);
  }
}

/**
 * Stretches of x as thick bars at one height, within the box, at least so many pixels wide; others `below` them.
 * @param {Context} c
 * @param {Plot} plot
 * @param {{ spans: Span[], at: number, least: number, color?: string, below?: number }} bars
 */
export function bars(c, plot, { spans, at, least, color = COLORS.ink, below = 0 }) {
  const { x, y, w, h } = plot.frame;
  c.fillStyle = color;
  for (const [start, end] of spans) {
    const left = Math.max(plot.px(start), x);
    const right = Math.min(plot.px(end), x + w);
    if (right < left) continue;
    c.fillRect(left, Math.min(Math.max(plot.py(at) - 2, y) + 5 * below, y + h - 4), Math.max(right - left, least), 4);
  }
}

/**
 * Dashed lines across at these heights.
 * @param {Context} c
 * @param {Plot} plot
 * @param {number[]} heights
 */
export function rules(c, plot, heights) {
  const { x, w } = plot.frame;
  c.strokeStyle = 'rgba(28,39,51,.45)';
  c.lineWidth = 1;
  c.setLineDash([4, 4]);
  c.beginPath();
  for (const height of heights) {
    c.moveTo(x, plot.py(height));
    c.lineTo(x + w, plot.py(height));
  }
  c.stroke();
  c.setLineDash([]);
}

/**
 * The area between two curves over the same x.
 * @param {Context} c
 * @param {Plot} plot
 * @param {{ x: ArrayLike<number>, low: ArrayLike<number>, high: ArrayLike<number>, color: string }} area
 * @param {number} factor
 */
export function between(c, plot, { x, low, high, color }, factor) {
  c.fillStyle = color;
  c.beginPath();
  for (let k = 0; k < x.length; k++) c.lineTo(plot.px(x[k]), plot.py(low[k] * factor));
  for (let k = x.length - 1; k >= 0; k--) c.lineTo(plot.px(x[k]), plot.py(high[k] * factor));
  c.fill();
}
