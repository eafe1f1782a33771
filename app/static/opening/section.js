// Below the bodies: their rows over time, which runs down, and the contact force beside them on the same clock.
import { cleared, letters, scale as zoom } from '../charts/canvas.js';
import { between, ticks } from '../charts/scale.js';
import { COLORS, css, STYLES } from '../charts/styles.js';
import { make } from '../shell/dom.js';
import { text } from '../text/catalogue.js';
import { engineering, figures, localised, scaled } from '../text/format.js';
import { weave } from './rows.js';
import { Words } from './words.js';

/** @import { Page } from '../page.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { Shown } from './rows.js' */
/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {{ face: (t: number) => number, mass: (t: number) => number }} Ends  movement of struck face and striker */

const HEAD = 44 * zoom; // pixels above the rows
const FOOT = 10;
// The track of the force: shares of the width, pixels left for times, and how much of it a peak takes.
const TRACK = { edge: 0.06, least: 44 * zoom, gap: 0.05, most: 0.72 };
const KEEP = [0.3, 1]; // shares of the scale between which a peak leaves it as it is
const LATER = 'rgba(255,255,255,.45)'; // over what has not happened yet
const FLOW = 0.4; // of the colour of the struck end, between it and its force
const LABEL = { peak: 26, narrow: 18, line: 17 }; // pixels
const NARROW = 560; // of width
const WALL = '#55636f';
const TIMES = 10; // pixels before them
const MARK = { wide: 5, least: 2 }; // pixels of a contact at the struck place

/**
 * @typedef {object} Beside
 * @property {import('../charts/marks.js').Span[]} contacts
 * @property {Series[]} forces  the most important first
 * @property {[per: number, sign: string]} clock  how many of the unit in which times are written one is
 * @property {string} about  what that unit is
 * @property {string} title
 * @property {Ends | null} ends  where the first place is the one that is struck
 * @property {boolean} strikes  by a body that is drawn beside it
 * @property {number | null} [prediction]  velocity of that body by rigid-body theory
 * @property {boolean} [held]  whether the last place is
 * @typedef {Shown & Beside} Scene
 */

export class Section {
  image = make('canvas');
  /** @type {Scene | null} */ shown = null;
  /** @type {Float64Array} */ ends = new Float64Array(0); // values at the struck place, row by row
  most = 0; // the end of the scale of forces [N]
  words = new Words(); // that are not paler before their time
  box = { top: HEAD, tall: 1, base: 1, track: 1, width: 1 }; // pixels

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.below = make('canvas', { role: 'img', ariaLabel: text('opening.section-about') });
    this.above = make('canvas');
    this.root = make('section', { className: 'section' }, this.below, this.above);
    this.root.onpointerdown = (event) => this.#take(event);
  }
  /** @returns {[start: number, end: number]} of time */
  get stretch() {
    return this.page.range();
  }
  /**
   * The place of an instant, down from the top.
   * @param {number} t
   */
  y(t) {
    const [start, end] = this.stretch;
    return this.box.top + ((t - start) / (end - start)) * this.box.tall;
  }
  /** @param {number} force  [N] */
  #x(force) {
    return this.box.base - (force / this.most) * this.box.track;
  }
  /**
   * All that changes with a solve.
   * @param {Scene | null} shown  nothing of bodies that have no rows
   */
  draw(shown) {
    this.shown = shown;
    this.root.hidden = !shown;
    const sheet = shown && cleared(this.below, this.root);
    if (!shown || !sheet) return;
    const { c, width, height } = sheet;
    const base = shown.drawn.left - TRACK.gap * width;
    const track = base - Math.max(TRACK.edge * width, TRACK.least);
    this.box = { top: HEAD, tall: height - HEAD - FOOT, base, track, width };
    this.words.all = [];
    this.#scale(shown);
    const [down, across] = [Math.max(Math.round(this.box.tall), 1), Math.round(width)];
    this.ends = weave(this.image, shown, this.stretch, across, down);
    c.drawImage(this.image, 0, this.box.top, width, this.box.tall);
    this.#flow(c, shown);
    this.#peak(c, shown.forces[0]);
    this.#frame(c, shown);
    c.save();
    c.beginPath();
    c.rect(0, this.box.top, width, this.box.tall);
    c.clip();
    this.#striker(c, shown);
    if (!shown.ends && !shown.scale) this.#struck(c, shown);
    for (const series of shown.forces.toReversed()) this.#curve(c, series);
    this.#names(c, shown);
    c.restore();
  }
  /**
   * The scale of forces stays while a peak can be read on it, so that a heavier mass is seen to push harder.
   * @param {Scene} scene
   */
  #scale({ forces: [{ factor = 1, y }] }) {
    let peak = 0;
    for (let k = 0; k < y.length; k++) peak = Math.max(peak, factor * y[k]);
    const share = peak / (TRACK.most * this.most);
    if (share > KEEP[0] && share <= KEEP[1]) return;
    this.most = (peak || 1) / TRACK.most;
  }
  /**
   * From the struck end into the force, while they touch.
   * @param {Context} c
   * @param {Scene} scene
   */
  #flow(c, { contacts, drawn, ends, forces: [force], largest, scale }) {
    const [start, end] = this.stretch;
    const rows = this.ends.length;
    const { base, tall, top } = this.box;
    for (let row = 0; ends && row < rows; row++) {
      const t = start + ((row + 0.5) / rows) * (end - start);
      if (!contacts.some(([from, to]) => t >= from && t <= to)) continue;
      const y = Math.round(top + (row / rows) * tall);
      const high = Math.round(top + ((row + 1) / rows) * tall) - y;
      const here = this.#x(between(force.x, force.y, t) * (force.factor ?? 1));
      c.fillStyle = css(this.ends[row], largest);
      c.globalAlpha = 1;
      c.fillRect(here, y, base - here, high);
      c.globalAlpha = FLOW;
      c.fillRect(base, y, drawn.left + ends.face(t) * scale - base, high);
    }
    c.globalAlpha = 1;
  }
  /**
   * Scales of force and time, and what they are of.
   * @param {Context} c
   * @param {Scene} scene
   */
  #frame(c, { about, clock: [per, sign], drawn, held, title }) {
    const { base, tall, top, track, width } = this.box;
    const [factor, unit] = scaled(this.most, 'N');
    c.font = letters(13);
    c.textBaseline = 'alphabetic';
    c.lineWidth = 1;
    c.fillStyle = COLORS.faint;
    c.textAlign = 'center';
    for (const force of ticks(0, this.most * factor, track / (70 * zoom)).found) {
      const x = Math.round(this.#x(force / factor)) + 0.5;
      c.strokeStyle = force ? COLORS.grid : COLORS.edge;
      c.beginPath();
      c.moveTo(x, top);
      c.lineTo(x, top + tall);
      c.stroke();
      c.fillText(localised(String(force)), x, top - 6);
    }
    const [start, end] = this.stretch;
    const marks = ticks(start * per, end * per, tall / (60 * zoom));
    c.textAlign = 'left';
    marks.found.forEach((t, k) => {
      const words = `${localised(t.toFixed(marks.digits))}${k ? '' : ` ${sign}`}`;
      this.words.say(words, TIMES, Math.min(this.y(t / per) + 4, top + tall - 2), COLORS.faint);
    });
    c.fillStyle = COLORS.ink;
    const force = text('opening.force', { unit });
    c.fillText(force, Math.max(base - c.measureText(force).width, 2), top - 8 - LABEL.line * zoom);
    c.fillText(title, drawn.left, top - 8);
    c.fillStyle = COLORS.faint;
    const after = drawn.left + c.measureText(`${title} `).width;
    if (after + c.measureText(about).width < width) c.fillText(about, after + 8, top - 8);
    c.fillStyle = WALL;
    if (held) c.fillRect(drawn.right, top, 5, tall);
  }
  /**
   * The face of the striker.
   * @param {Context} c
   * @param {Scene} scene
   */
  #striker(c, { drawn, duration, ends, prediction = null, scale, strikes }) {
    const [start, end] = this.stretch;
    const { base, tall, top, width } = this.box;
    if (!strikes || !ends) return;
    c.save();
    c.beginPath();
    c.rect(base, top, width, tall); // beside the force
    c.clip();
    const path = (/** @type {(t: number) => number} */ moved) => {
      c.beginPath();
      for (let k = 0; k <= tall; k++) {
        const t = start + (k / tall) * (end - start);
        if (t <= duration) c.lineTo(drawn.left + moved(t) * scale, this.y(t));
      }
      c.stroke();
    };
    c.strokeStyle = COLORS.ink;
    c.lineWidth = 1.4;
    path((t) => ends.mass(t));
    c.strokeStyle = COLORS.prediction;
    c.setLineDash([5, 4]);
    if (prediction !== null) path((t) => prediction * t);
    c.restore();
    const gone = prediction === null ? 0 : (base - drawn.left) / (prediction * scale); // when it is at the force
    if (gone > start && gone < end)
      this.words.say(
        text('opening.predicted'),
        base + 6,
        Math.min(this.y(gone) + 16 * zoom, top + tall - 6),
        COLORS.faint,
      );
  }
  /**
   * The struck place of what is bent across, and when it is touched.
   * @param {Context} c
   * @param {Scene} scene
   */
  #struck(c, { contacts, drawn: { left, rest } }) {
    const { tall, top } = this.box;
    c.strokeStyle = COLORS.faint;
    c.lineWidth = 1;
    c.setLineDash([3, 4]);
    c.beginPath();
    c.moveTo(rest, top);
    c.lineTo(rest, top + tall);
    c.stroke();
    c.setLineDash([]);
    for (const [from, to] of contacts) {
      const [y, high] = [this.y(from), Math.max(this.y(to) - this.y(from), MARK.least)];
      c.fillStyle = COLORS.contact;
      c.fillRect(0, y, left, high);
      c.fillStyle = COLORS.ink;
      c.fillRect(rest - MARK.wide / 2, y, MARK.wide, high);
    }
  }
  /**
   * @param {Context} c
   * @param {Series} series
   */
  #curve(c, { factor = 1, style, x, y }) {
    const { color, dash = [], mark, width = 1.6 } = STYLES[style];
    c.strokeStyle = c.fillStyle = color;
    c.lineWidth = width;
    c.setLineDash(dash);
    c.beginPath();
    for (let k = 0; k < x.length; k++) {
      const [across, down] = [this.#x(y[k] * factor), this.y(x[k])];
      if (mark) c.rect(across - 1.5, down - 1.5, 3, 3);
      else c.lineTo(across, down);
    }
    if (mark) c.fill();
    else c.stroke();
    c.setLineDash([]);
  }
  /**
   * What the curves are, in their colours, where they have come to rest.
   * @param {Context} c
   * @param {Scene} scene
   */
  #names(c, { forces }) {
    const { base, tall, top } = this.box;
    const named = forces.filter(({ cursor }) => cursor);
    c.font = letters(13, '600 ');
    named.forEach(({ cursor = '', style }, k) => {
      const x = Math.max(base - 10, c.measureText(cursor).width + 16 * zoom);
      const y = top + tall - 8 - (named.length - 1 - k) * LABEL.line * zoom;
      this.words.say(cursor, x, y, STYLES[style].color, c.font, 'right');
    });
  }
  /**
   * The peak, beside the curve where it leaves room.
   * @param {Context} c
   * @param {Series} series
   */
  #peak(c, { factor = 1, x, y }) {
    let most = 0;
    for (let k = 1; k < y.length; k++) if (y[k] > y[most] * (1 + 1e-9)) most = k;
    const words = engineering(y[most] * factor, 'N', 3);
    const { base, tall: all, top: first, width } = this.box;
    const tall = (width < NARROW ? LABEL.narrow : LABEL.peak) * zoom;
    c.font = letters(tall / zoom, '650 ');
    const { font } = c;
    const wide = c.measureText(words).width + 8;
    const [at, down] = [this.#x(y[most] * factor), this.y(x[most])];
    const beside = at - wide >= TRACK.least;
    const left = beside ? at - wide : Math.max(Math.min(TRACK.least, base - wide), 18 * zoom);
    const high = tall + LABEL.line * zoom; // with what it is
    const clear = (/** @type {number} */ top) => {
      for (let k = 0; k < x.length; k++) {
        const py = this.y(x[k]);
        if (py > top && py < top + high && this.#x(y[k] * factor) < left + wide) return false;
      }
      return top >= first && top + high <= first + all;
    };
    const found = [...(beside ? [down - tall / 2] : []), down - high - 6, down + 8].find(clear);
    const [side, top] = found === undefined ? [base + 8, Math.max(down - tall / 2, first)] : [left, found];
    this.words.say(words, side, top + 0.85 * tall, COLORS.ink, font);
    this.words.say(text('opening.peak'), side, top + tall + 0.75 * LABEL.line * zoom, COLORS.faint);
    c.fillStyle = COLORS.ink;
    c.beginPath();
    c.arc(at, down, 3.5, 0, 7);
    c.fill();
  }
  /**
   * The instant of the clock: what is to come is paler.
   * @param {number} t
   */
  show(t) {
    const { shown } = this;
    const sheet = shown && cleared(this.above, this.root);
    if (!shown || !sheet) return;
    const { c, width } = sheet;
    const { base, tall, top } = this.box;
    const y = Math.min(Math.max(this.y(t), top), top + tall);
    c.fillStyle = LATER;
    c.fillRect(0, y, width, top + tall - y);
    c.strokeStyle = COLORS.cursor;
    c.lineWidth = 1.4;
    c.beginPath();
    c.moveTo(0, y);
    c.lineTo(width, y);
    c.stroke();
    const [{ factor = 1, x, y: force }] = shown.forces;
    const value = between(x, force, t) * factor;
    c.fillStyle = COLORS.cursor;
    c.beginPath();
    c.arc(this.#x(value), y, 4.5, 0, 7);
    c.fill();
    const [perUnit, unit] = scaled(this.most, 'N');
    const above = y - LABEL.line * zoom >= top; // else it would lie on what is written there
    const said = `${figures(Math.abs(value) < 1e-6 * this.most ? 0 : value * perUnit, 3)} ${unit}`;
    this.words.draw(c, said, base + 6, above ? y - 5 : y + 16 * zoom);
  }
  /**
   * A hand on the picture sets the clock.
   * @param {PointerEvent} event
   */
  #take(event) {
    if (event.button !== 0) return;
    const go = (/** @type {PointerEvent} */ { offsetY }) => {
      const [start, end] = this.stretch;
      const { tall, top } = this.box;
      this.page.player.seek(start + ((offsetY - top) / tall) * (end - start) - this.page.player.start);
    };
    this.root.setPointerCapture(event.pointerId);
    this.root.onpointermove = go;
    this.root.onpointerup = this.root.onpointercancel = () => {
      this.root.onpointermove = this.root.onpointerup = this.root.onpointercancel = null;
    };
    go(event);
  }
}
