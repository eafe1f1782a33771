// The lines that a class has drawn, laid over each other, and what happens on top of them.
import { cleared, letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { axes, border, OWN, Paper, say } from '../lesson/drawing.js';
import { timeOf } from '../lesson/events.js';
import { marksOf } from '../lesson/settings.js';

/** @import { Samples } from '../charts/scale.js' */
/** @import { Events } from '../lesson/events.js' */
/** @import { Part } from '../lesson/questions.js' */
/** @typedef {CanvasRenderingContext2D} Context */

const WIDTH = 2; // pixels of a line
const DENSE = 12; // lines, beyond which each is fainter
const FAINTEST = 0.08;

/**
 * @param {Context} c
 * @param {Paper} paper
 * @param {[t: number, value: number][]} points
 */
function lineOf(c, paper, points) {
  c.beginPath();
  for (const [t, value] of points) c.lineTo(paper.x(t), paper.y(value));
  c.stroke();
}

export class Laid {
  /** @type {number[][]} */ lines = []; // values at equal steps
  /** @type {Samples} */ curve = { x: [], y: [] };
  until = NaN; // [T]
  /** @type {Events} */ events = {}; // of the frame, which comes later

  /** @param {Part} part */
  constructor(part) {
    this.axis = /** @type {[low: number, high: number]} */ (part.axis);
    this.marks = marksOf(part);
    this.canvas = make('canvas', { ariaHidden: 'true' });
    this.root = make('div', { className: 'class-laid', role: 'img' }, this.canvas);
    new ResizeObserver(() => this.draw()).observe(this.root);
  }
  /**
   * What stands in the gaps of a sentence for all of them: when it is so, by a clock.
   * @param {number | string | [number | string, number | string]} at
   */
  gaps(at) {
    return { yours: '…', true: this.marks ? '…' : this.timeWords(at), at: '…', off: '…' };
  }
  /**
   * A time of the lesson file, as it is written.
   * @param {number | string | [number | string, number | string]} time
   */
  timeWords(time) {
    const t = timeOf(Array.isArray(time) ? time[0] : time, this.events);
    return Number.isFinite(t) ? `${figures(Number(t.toFixed(2)), 4)} T` : '…';
  }
  draw() {
    const { axis, curve, lines, marks, until } = this;
    const sheet = this.root.isConnected && until > 0 ? cleared(this.canvas, this.root) : null;
    if (!sheet) return;
    const { c, height, width } = sheet;
    const paper = new Paper(width, height, { axis, marks, until });
    axes(c, paper);
    c.lineJoin = 'round';
    c.lineWidth = WIDTH;
    c.strokeStyle = OWN;
    c.globalAlpha = Math.max(Math.min(1, DENSE / (2 * Math.max(lines.length, 1))), FAINTEST);
    for (const line of lines)
      lineOf(
        c,
        paper,
        line.map((value, k) => [(k / (line.length - 1)) * until, value]),
      );
    c.globalAlpha = 1;
    if (marks) {
      border(c, paper, curve);
      return;
    }
    const seen = Array.from(curve.x, (t, k) => /** @type {[number, number]} */ ([t, curve.y[k]]));
    c.strokeStyle = COLORS.panel; // an edge, by which it stands out from the lines
    c.lineWidth = 3 * WIDTH;
    const inside = seen.filter(([t]) => t >= 0 && t <= until);
    lineOf(c, paper, inside);
    c.strokeStyle = COLORS.ink;
    c.lineWidth = WIDTH;
    lineOf(c, paper, inside);
    if (!inside.length) return;
    const [t, value] = inside.reduce((a, b) => (b[1] > a[1] ? b : a));
    c.font = letters(13, '600 ');
    say(c, text('lesson.happens'), paper.x(t) + 10, Math.max(paper.y(value) + 4, paper.top + 10), COLORS.ink);
  }
}
