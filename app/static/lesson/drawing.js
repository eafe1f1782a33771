// The chart of a sketch: time to the right, the value up; the line that was drawn, and what happens laid under it.
import { letters, scale as zoom } from '../charts/canvas.js';
import { ticks } from '../charts/scale.js';
import { COLORS, css, KEPT } from '../charts/styles.js';
import { localised } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { BIN, joined } from './judge.js';

/** @import { Samples } from '../charts/scale.js' */
/** @import { Judgement } from './judge.js' */
/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {{ share: number, words: string }} Mark */
/**
 * Of axes that are settings: where they have numbers, and what they are called.
 * @typedef {{ across: Mark[], upwards: Mark[], titles: string[] }} Marks
 */
/** @typedef {Pick<Paper, 'axis' | 'bottom' | 'left' | 'tall' | 'top' | 'until' | 'wide' | 'x' | 'y'>} Sheet */

export const OWN = KEPT.B; // the colour of whatever is set beside what happens
const ROOM = { left: 46, right: 14, top: 14, bottom: 26 }; // pixels about the chart
const ROOM_OF_SETTINGS = { left: 56, right: 14, top: 28, bottom: 44 };
const TICK = { across: 90, down: 60 }; // pixels between two, about
const RING = 5.5; // pixels
const HEAD = 5; // of an arrow
const CLEAR = 26; // pixels of an arrow that is worth drawing

/**
 * @typedef {object} Chart
 * @property {number} until  [T]
 * @property {[low: number, high: number]} axis
 * @property {Marks | null} [marks]  where it is not over time
 */
/** Where the chart lies in its canvas. */
export class Paper {
  /**
   * @param {number} width
   * @param {number} height
   * @param {Chart} chart
   */
  constructor(width, height, { axis, marks = null, until }) {
    this.axis = axis;
    this.marks = marks;
    this.until = until;
    const room = marks ? ROOM_OF_SETTINGS : ROOM;
    this.left = room.left * zoom;
    this.top = room.top * zoom;
    this.wide = Math.max(width - this.left - room.right * zoom, 1);
    this.tall = Math.max(height - this.top - room.bottom * zoom, 1);
  }
  get bottom() {
    return this.top + this.tall;
  }
  /** @param {number} t */
  x(t) {
    return this.left + (t / this.until) * this.wide;
  }
  /** @param {number} value */
  y(value) {
    const [low, high] = this.axis;
    return this.top + (1 - (value - low) / (high - low)) * this.tall;
  }
  /**
   * @param {number} x  from the left end of the axis [px]
   * @param {number} y  from the upper end [px]
   * @returns {[t: number, value: number]}
   */
  at(x, y) {
    const [low, high] = this.axis;
    const share = (/** @type {number} */ part) => Math.min(Math.max(part, 0), 1);
    return [share(x / this.wide) * this.until, low + (1 - share(y / this.tall)) * (high - low)];
  }
}

/**
 * @param {Context} c
 * @param {string} words
 * @param {number} x
 * @param {number} y
 * @param {string} color
 * @param {CanvasTextAlign} [align]
 */
export function say(c, words, x, y, color, align = 'left') {
  c.textAlign = align;
  c.textBaseline = 'alphabetic';
  c.lineJoin = 'round';
  c.lineWidth = 4;
  c.strokeStyle = COLORS.panel;
  c.strokeText(words, x, y);
  c.fillStyle = color;
  c.fillText(words, x, y);
}

/**
 * @param {Context} c
 * @param {Paper} paper
 * @param {{ edge: string, faint: string, grid: string }} [colors]
 */
export function axes(c, paper, colors = COLORS) {
  if (paper.marks) {
    axesOfSettings(c, paper, paper.marks, colors);
    return;
  }
  const { axis, bottom, left, tall, top, until, wide } = paper;
  c.font = letters(13);
  c.lineWidth = 1;
  const across = ticks(0, until, wide / (TICK.across * zoom));
  const down = ticks(axis[0], axis[1], tall / (TICK.down * zoom));
  c.strokeStyle = colors.grid;
  c.beginPath();
  for (const t of across.found) {
    c.moveTo(paper.x(t), top);
    c.lineTo(paper.x(t), bottom);
  }
  for (const value of down.found) {
    c.moveTo(left, paper.y(value));
    c.lineTo(left + wide, paper.y(value));
  }
  c.stroke();
  c.strokeStyle = colors.edge;
  c.beginPath();
  c.moveTo(left, top);
  c.lineTo(left, bottom);
  c.moveTo(left, paper.y(Math.max(axis[0], 0)));
  c.lineTo(left + wide, paper.y(Math.max(axis[0], 0)));
  c.stroke();
  for (const t of across.found) {
    const words = t ? `${localised(String(Number(t.toFixed(across.digits))))} T` : '0';
    say(c, words, paper.x(t), bottom + 17 * zoom, colors.faint, t > 0.97 * until ? 'right' : 'center');
  }
  for (const value of down.found)
    say(c, localised(value.toFixed(down.digits)), left - 8, paper.y(value) + 4, colors.faint, 'right');
  const first = across.found[1] ?? until;
  say(c, text('lesson.time'), paper.x(0.5 * first), bottom + 17 * zoom, COLORS.ink, 'center');
}

/**
 * @param {Context} c
 * @param {Paper} paper
 * @param {Marks} marks
 * @param {{ edge: string, faint: string, grid: string }} colors
 */
function axesOfSettings(c, paper, { across, titles, upwards }, colors) {
  const { bottom, left, tall, top, wide } = paper;
  c.font = letters(13);
  c.lineWidth = 1;
  c.strokeStyle = colors.grid;
  c.beginPath();
  for (const { share } of across) {
    c.moveTo(paper.x(share), top);
    c.lineTo(paper.x(share), bottom);
  }
  for (const { share } of upwards) {
    c.moveTo(left, paper.y(share));
    c.lineTo(left + wide, paper.y(share));
  }
  c.stroke();
  c.strokeStyle = colors.edge;
  c.strokeRect(left, top, wide, tall);
  for (const { share, words } of across) say(c, words, paper.x(share), bottom + 17 * zoom, colors.faint, 'center');
  for (const { share, words } of upwards) say(c, words, left - 8, paper.y(share) + 4, colors.faint, 'right');
  say(c, `${titles[0]} →`, left + wide, bottom + 36 * zoom, COLORS.ink, 'right');
  say(c, `↑ ${titles[1]}`, 4, top - 12 * zoom, COLORS.ink);
}

/**
 * Where something begins to be, over settings.
 * @param {Context} c
 * @param {Sheet} paper
 * @param {Samples} curve
 */
export function border(c, paper, { x, y }) {
  for (const [color, width] of /** @type {const} */ ([
    [COLORS.panel, 5.5],
    [COLORS.ink, 2.25],
  ])) {
    // prettier-ignore
    c.strokeStyle = color;
    c.lineWidth = width;
    c.beginPath();
    Array.from(x, (t, k) => c.lineTo(paper.x(t), paper.y(y[k])));
    c.stroke();
  }
}

/**
 * What happens, until an instant: filled in the colours of its stress.
 * @param {Context} c
 * @param {Paper} paper
 * @param {Samples} curve
 * @param {number} until  [T]
 */
export function truth(c, paper, { x, y }, until) {
  const largest = Math.max(...Array.from(y, Math.abs), 1e-30);
  const zero = paper.y(Math.max(paper.axis[0], 0));
  const end = Math.min(until, paper.until);
  const all = Array.from(x, (t, k) => /** @type {[number, number]} */ ([t, y[k]])).filter(([t]) => t >= 0 && t <= end);
  for (let k = 1; k < all.length; k++) {
    const [[t0, v0], [t1, v1]] = [all[k - 1], all[k]];
    c.fillStyle = css(0.5 * (v0 + v1), largest);
    c.beginPath();
    c.moveTo(paper.x(t0), zero);
    c.lineTo(paper.x(t0), paper.y(v0));
    c.lineTo(paper.x(t1) + 0.5, paper.y(v1));
    c.lineTo(paper.x(t1) + 0.5, zero);
    c.fill();
  }
  c.strokeStyle = COLORS.ink;
  c.lineWidth = 1.6;
  c.beginPath();
  for (const [t, value] of all) c.lineTo(paper.x(t), paper.y(value));
  c.stroke();
}

/**
 * Where a label of this size lies beside a point, clear of lines; the first place where none is.
 * @param {Paper} paper
 * @param {[x: number, y: number]} point
 * @param {[wide: number, high: number]} size
 * @param {[x: number, y: number][]} lines  points of them
 * @returns {[x: number, y: number]}  its left end, and the foot of its letters
 */
export function clearOf(paper, [x, y], [wide, high], lines) {
  const right = paper.left + paper.wide - wide;
  const foot = (/** @type {number} */ at) => Math.min(Math.max(at, paper.top + high), paper.bottom - 4);
  const beside = [x + 10, x - wide - 10, x + 40, right].filter((each) => each >= paper.left && each <= right);
  const places = [0, -1.5 * high, 1.5 * high, 3 * high, 5 * high].flatMap((down) =>
    beside.map((each) => /** @type {[number, number]} */ ([each, foot(y + 4 + down)])),
  );
  const hit = (/** @type {[number, number]} */ [left, low]) =>
    lines.some(([a, b]) => a > left - 4 && a < left + wide + 4 && b > low - high && b < low + 4);
  return places.find((each) => !hit(each)) ?? places[0] ?? [x + 10, foot(y)];
}

/**
 * What the curve is called, beside its peak and over no line.
 * @param {Context} c
 * @param {Paper} paper
 * @param {Samples} curve
 * @param {number[]} line  that was drawn
 */
export function happens(c, paper, curve, line) {
  const within = Array.from(curve.x, (t, k) => /** @type {[number, number]} */ ([t, curve.y[k]])).filter(
    ([t]) => t >= 0 && t <= paper.until,
  );
  if (!within.length) return;
  const at = (/** @type {[number, number]} */ [t, value]) =>
    /** @type {[number, number]} */ ([paper.x(t), paper.y(value)]);
  const [, peak] = within.reduce((a, b) => (b[1] > a[1] ? b : a));
  const top = /** @type {[number, number]} */ (within.find(([, value]) => value === peak));
  const drawn = joined(line).map((value, k) => at([k * BIN, value]));
  c.font = letters(13, '600 ');
  const words = text('lesson.happens');
  const size = /** @type {[number, number]} */ ([c.measureText(words).width, 13 * zoom]);
  const [x, y] = clearOf(paper, at(top), size, [...drawn, ...within.map(at)]);
  say(c, words, x, y, COLORS.ink);
}

/**
 * @param {Context} c
 * @param {Sheet} paper
 * @param {number[]} line
 * @param {boolean} done  gaps are joined then, as they are judged
 */
export function own(c, paper, line, done) {
  c.strokeStyle = OWN;
  c.lineWidth = 3;
  c.lineJoin = 'round';
  c.beginPath();
  let drawn = false;
  /** @type {[from: number, to: number][]} */
  const gaps = [];
  let last = -1;
  line.forEach((value, k) => {
    if (Number.isNaN(value)) return (drawn = false);
    const [x, y] = [paper.x(k * BIN), paper.y(value)];
    if (drawn) c.lineTo(x, y);
    else c.moveTo(x, y);
    if (!drawn) c.lineTo(x + 0.1, y);
    if (!drawn && last >= 0) gaps.push([last, k]);
    last = k;
    return (drawn = true);
  });
  c.stroke();
  c.setLineDash(done ? [] : [3, 5]);
  c.lineWidth = done ? 3 : 1.5;
  c.beginPath();
  for (const [from, to] of gaps) {
    c.moveTo(paper.x(from * BIN), paper.y(line[from]));
    c.lineTo(paper.x(to * BIN), paper.y(line[to]));
  }
  c.stroke();
  c.setLineDash([]);
}

/**
 * A point that is given, or where the pen is.
 * @param {Context} c
 * @param {Sheet} paper
 * @param {[t: number, value: number]} point
 */
export function dot(c, paper, [t, value]) {
  c.fillStyle = OWN;
  c.beginPath();
  c.arc(paper.x(t), paper.y(value), 5, 0, 7);
  c.fill();
}

/**
 * The pen, and what it would write there; above a finger, which hides what is below.
 * @param {Context} c
 * @param {Sheet} paper
 * @param {[t: number, value: number]} point
 * @param {string} words
 * @param {boolean} finger
 */
export function pen(c, paper, [t, value], words, finger) {
  const [x, y] = [paper.x(t), paper.y(value)];
  c.strokeStyle = COLORS.edge;
  c.lineWidth = 1;
  c.beginPath();
  c.moveTo(x, y);
  c.lineTo(x, paper.y(Math.max(paper.axis[0], 0)));
  c.stroke();
  dot(c, paper, [t, value]);
  c.font = letters(14, '600 ');
  const wide = c.measureText(words).width;
  const side = x + wide + 20 > paper.left + paper.wide ? 'right' : 'left';
  const high = finger ? y - 44 : y - 12;
  say(c, words, x + (side === 'left' ? 12 : -12), Math.max(high, paper.top + 14), OWN, side);
}

/**
 * Where a sentence belongs in the line, and from there to where it is.
 * @param {Context} c
 * @param {Sheet} paper
 * @param {Judgement} judgement
 * @param {boolean} lit
 */
export function mark(c, paper, { outcome, ring, span, to }, lit) {
  const [x, y] = [paper.x(ring[0]), paper.y(ring[1])];
  const [a, b] = [paper.x(to[0]), paper.y(to[1])];
  if (lit) {
    c.fillStyle = COLORS.contact;
    c.fillRect(paper.x(span[0]), paper.top, paper.x(span[1]) - paper.x(span[0]), paper.tall);
  }
  c.strokeStyle = c.fillStyle = OWN;
  const far = Math.hypot(a - x, b - y);
  if (far > CLEAR) {
    const [along, down] = [(a - x) / far, (b - y) / far];
    c.lineWidth = 1.6;
    c.beginPath();
    c.moveTo(x + RING * along, y + RING * down);
    c.lineTo(a, b);
    c.stroke();
    c.beginPath();
    c.moveTo(a, b);
    c.lineTo(a - 2 * HEAD * along - HEAD * down, b - 2 * HEAD * down + HEAD * along);
    c.lineTo(a - 2 * HEAD * along + HEAD * down, b - 2 * HEAD * down - HEAD * along);
    c.fill();
  }
  c.fillStyle = COLORS.panel;
  c.lineWidth = 2;
  c.beginPath();
  c.arc(x, y, RING, 0, 7);
  c.fill();
  c.stroke();
  if (outcome !== 'yes') return;
  c.lineWidth = 1.6;
  c.beginPath();
  c.moveTo(x - 2.5, y);
  c.lineTo(x - 0.5, y + 2.2);
  c.lineTo(x + 2.8, y - 2.2);
  c.stroke();
}
