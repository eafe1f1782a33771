// A boundary that is drawn over the map of a step before its colours are seen; then it is laid over the true one.
import { letters } from '../charts/canvas.js';
import { text } from '../text/catalogue.js';
import { percent } from '../text/format.js';
import { LABELS } from '../text/words.js';
import * as drawing from './drawing.js';
import { BIN } from './judge.js';
import { settingWords, shareOf } from './settings.js';
import { SHORT, Sketch } from './sketch.js';

/** @import { Judgement } from './judge.js' */
/** @import { Part } from './questions.js' */
/** @typedef {import('./drawing.js').Sheet & { at(x: number, y: number): [t: number, value: number] }} MapSheet */

export class Boundary extends Sketch {
  over = 'map'; // what it is drawn on
  /** @type {{ over(): void } | null} */ map = null; // once it is there

  get laid() {
    return this.done;
  }
  get chart() {
    return undefined; // the map has its place
  }
  get rolls() {
    return false;
  }
  get whole() {
    const { drawn } = this;
    return drawn.begun && drawn.from <= SHORT && drawn.reach >= 1 - SHORT;
  }
  /** From where to where it is to be drawn. */
  get reach_() {
    return { from: settingWords(this.part, 0, 0), until: settingWords(this.part, 0, 1) };
  }
  get untilWords() {
    return this.reach_.until;
  }
  get drawOn() {
    return text('lesson.draw-over', this.reach_);
  }
  /** @param {string} name  What of a setting is shown; nothing of another one. */
  rangeOf(name) {
    const { ranges, settings } = this.part;
    return /** @type {[low: number, high: number] | undefined} */ (ranges[settings.indexOf(name)]);
  }
  get pointsAbout() {
    const [across, upwards] = this.part.settings.map((/** @type {string} */ name) => {
      const { title, unit = '' } = LABELS[name];
      return unit ? `${title} [${unit}]` : title;
    });
    return text('lesson.points-over', { across, upwards });
  }
  get pointsSuch() {
    const { given, ranges } = this.part;
    const value = ranges[1][given ? 0 : 1];
    return `${ranges[0][0]} ${value}\n${ranges[0][1]} ${value}`;
  }
  /** @param {[t: number, value: number][]} points  values of both settings */
  taken(points) {
    const { part } = this;
    return points.map(([t, value]) => /** @type {[number, number]} */ ([shareOf(part, 0, t), shareOf(part, 1, value)]));
  }
  /** @param {[t: number, value: number]} point */
  words([t, value]) {
    return `${settingWords(this.part, 0, t)}, ${settingWords(this.part, 1, value)}`;
  }
  /** @param {Judgement} judgement */
  gaps({ ring, to, yours }) {
    const { part } = this;
    return {
      at: settingWords(part, 0, yours),
      yours: settingWords(part, 1, ring[1]),
      true: settingWords(part, 1, to[1]),
      off: percent(Math.abs(ring[1] - to[1])),
    };
  }
  /** @param {number} _  Nothing of a map is at an instant. */
  stand(_) {}
  draw() {
    this.map?.over();
  }
  /**
   * On the map, whose point and axes are there already.
   * @param {CanvasRenderingContext2D} c
   * @param {MapSheet} paper
   */
  paint(c, paper) {
    const { done, drawn, judgements, lit } = this;
    this.paper = /** @type {any} */ (paper);
    const { left, tall, top, wide } = paper;
    Object.assign(this.plot.style, {
      ...{ left: `${left}px`, top: `${top}px`, width: `${wide}px`, height: `${tall}px` },
    });
    c.save();
    c.beginPath();
    c.rect(left, top, wide, tall);
    c.clip();
    if (done) drawing.border(c, paper, this.curve);
    drawing.own(c, paper, drawn.line, done);
    if (done) {
      judgements.forEach((each, k) => drawing.mark(c, paper, each, k === lit));
      this.#name(c, paper);
    } else if (drawn.given) drawing.dot(c, paper, drawn.given);
    const pen = done ? null : this.pen;
    if (pen) drawing.pen(c, paper, pen, this.words(pen), this.finger && Boolean(this.near));
    c.restore();
  }
  /**
   * Whose line it is, at its left end, clear of the other one.
   * @param {CanvasRenderingContext2D} c
   * @param {MapSheet} paper
   */
  #name(c, paper) {
    const value = this.drawn.line[Math.round(SHORT / BIN)];
    if (Number.isNaN(value)) return;
    c.font = letters(13, '600 ');
    drawing.say(c, text('lesson.yours'), paper.x(SHORT), paper.y(value) - 10, drawing.OWN);
  }
}

/** @param {Part} part */
export const drawsOverMap = (part) => part.kind === 'sketch' && Boolean(part.settings);
