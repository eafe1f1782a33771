// Below the bodies: their rows over time, which runs down, and beside them contact force and tracks on the same clock.
import { cleared, letters, scale as zoom } from '../charts/canvas.js';
import { between, ticks } from '../charts/scale.js';
import { COLORS, css, dark, STYLES } from '../charts/styles.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { engineering, figures, localised, scaled } from '../text/format.js';
import { curve, feet, NARROW, striker, struck, traces } from './beside.js';
import { withBesides } from './besides.js';
import { weave } from './rows.js';
import { seam } from './seam.js';
import { dot, drawTrack, placed } from './tracks.js';
import { Words } from './words.js';

/** @import { Page } from '../page.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { Shown } from './rows.js' */
/** @import { Place, Track } from './tracks.js' */
/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {{ face: (t: number) => number, mass: (t: number) => number }} Ends  movement of struck face and striker */

const HEAD = 44 * zoom; // pixels above the rows
const FOOT = 10;
// The track of the force: shares of the width, pixels left for times, how much of it a peak takes, and share of others.
const TRACK = { edge: 0.06, least: 44 * zoom, gap: 0.05, most: 0.72, beside: 0.4 };
const KEEP = [0.3, 1]; // shares of the scale between which a peak leaves it as it is
const LATER = `rgba(255,255,255,${dark ? 0.3 : 0.45})`; // over what has not happened yet
const FLOW = 0.4; // of the colour of the struck end, between it and its force
const LABEL = { peak: 26, narrow: 18, line: 17 }; // pixels
const WALL = '#55636f';
const TIMES = 10; // pixels before them

/**
 * @typedef {object} Over  what all share
 * @property {[per: number, sign: string]} clock  how many of the unit in which times are written one is
 * @property {string[]} by  which solution it is of, and how wrong that may be; nothing of one that is not weighed
 * @property {Track[]} [tracks]  beside the force; where nothing lies as it is drawn above, in its place
 */
/**
 * @typedef {object} Beside
 * @property {import('../charts/marks.js').Span[]} contacts
 * @property {Series[]} forces  the most important first
 * @property {number | null} [peak]  of the first, where samples may miss it [N]
 * @property {string} about  what the unit of time is
 * @property {string} title
 * @property {Ends | null} ends  where the first place is the one that is struck
 * @property {boolean} strikes  by a body that is drawn beside it
 * @property {number | null} [prediction]  velocity of that body by rigid-body theory
 * @property {boolean} [held]  whether the last place is
 * @property {Trace[]} [traces]  what gauges would tell, where they are
 * @property {import('./seam.js').Filled | null} [seam]
 * @property {{ about: string, all: { x: number, words: string }[] }} [feet]  what is said at the end of the rows
 */
/** @typedef {{ name: string, at: number, x: ArrayLike<number>, moved: number[] }} Trace  at a place [px] */
/**
 * @typedef {object} Alone
 * @property {null} drawn
 * @property {Track[]} tracks
 * @property {[from: number, to: number]} [timed]  where the clock has times
 * @property {boolean} [tall]  the picture is about as high as wide, so that it needs more height
 */
/**
 * @typedef {Over & Shown & Beside} Woven  rows below what is drawn
 * @typedef {Over & Alone} Tracked  nothing but tracks
 * @typedef {Woven | Tracked} Scene
 */

export class Section {
  image = make('canvas');
  /** @type {Scene | null} */ shown = null;
  /** @type {Float64Array} */ ends = new Float64Array(0); // values at the struck place, row by row
  most = 0; // the end of the scale of forces [N]
  /** @type {unknown} */ scene = ''; // that it is of
  /** @type {Series | null} */ guess = null; // a line of force that was drawn by hand
  lone = false; // without other solutions beside the first, but these
  /** @type {Series[]} */ besides = [];
  /** @type {(Series & { trip: number })[]} */ first = []; // the force of before
  called = ''; // what the first is called beside them
  words = new Words(); // that are not paler before their time
  /** @type {[x: number, y: number] | null} */ dot = null; // at the peak
  pulled = false; // the peak, by a hand: the scale stays
  /** @type {{ track: Track, place: Place }[]} */ tracks = [];
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
  x(force) {
    return this.box.base - (force / this.most) * this.box.track;
  }
  /**
   * All that changes with a solve.
   * @param {Scene | null} shown  nothing of bodies that have no rows
   */
  draw(shown) {
    if (this.lone && shown) {
      const beside = [...this.besides, ...this.first];
      const called = this.called || (this.first.length && !this.besides.length ? text('lesson.now') : '');
      shown = withBesides(shown, beside, called, this.page.frame);
      if (!this.besides.length) shown = { ...shown, by: [] }; // a lesson about one solution does not weigh it
    }
    this.shown = shown;
    this.dot = null;
    this.root.hidden = !shown;
    this.page.root.classList.toggle('rowless', !shown);
    const sheet = shown && cleared(this.below, this.root);
    if (!shown || !sheet) return;
    const { c, width, height } = sheet;
    Object.assign(this.words, { all: [], edge: width - 2 });
    const top = HEAD + (shown.drawn ? 0 : LABEL.line * zoom); // another line for which solution it is
    const down = { top, tall: height - top - FOOT };
    let left = Math.max(TRACK.edge * width, TRACK.least);
    const base = shown.drawn ? shown.drawn.left - TRACK.gap * width : width - FOOT;
    const tracks = shown.drawn && width < NARROW ? [] : (shown.tracks ?? []);
    const right = shown.drawn ? left + TRACK.beside * (base - left) : base;
    this.tracks = tracks.length ? placed(tracks, left, right, down) : [];
    if (this.tracks.length) left = right + TRACK.least;
    this.box = { ...down, base, track: base - left, width };
    this.ends = new Float64Array(0);
    if (shown.drawn) this.#woven(c, shown);
    else this.#clock(c, shown);
    for (const { track, place } of this.tracks)
      drawTrack(c, track, place, { y: (t) => this.y(t), stretch: this.stretch }, this.words);
  }
  /**
   * Rows below what is drawn, and the force beside them.
   * @param {Context} c
   * @param {Woven} shown
   */
  #woven(c, shown) {
    const { width } = this.box;
    this.#scale(shown);
    const [down, across] = [Math.max(Math.round(this.box.tall), 1), Math.round(width)];
    this.ends = weave(this.image, shown, this.stretch, across, down);
    c.drawImage(this.image, 0, this.box.top, width, this.box.tall);
    if (shown.seam) seam(c, this, shown.seam);
    this.#flow(c, shown);
    this.#peak(c, shown);
    this.#frame(c, shown);
    c.save();
    c.beginPath();
    c.rect(0, this.box.top, width, this.box.tall);
    c.clip();
    striker(c, this, shown);
    if (!shown.ends && !shown.scale && !shown.feet) struck(c, this, shown);
    const forces = this.guess ? [...shown.forces, this.guess] : shown.forces;
    c.save();
    c.beginPath();
    c.rect(this.box.base - this.box.track, this.box.top, width, this.box.tall); // ripples may leave the scale
    c.clip();
    for (const series of forces.toReversed()) curve(c, this, series);
    c.restore();
    this.#names(c, forces);
    feet(this, shown);
    traces(c, this, shown);
    c.restore();
  }
  /**
   * The scale of forces stays while a peak can be read on it, so that a heavier mass is seen to push harder.
   * @param {Woven} scene
   */
  #scale({ forces: [first, ...others] }) {
    const { frame, history } = this.page;
    const { scene } = frame.chosen;
    const hand = this.scene === scene && !history.going; // else it is as if the scene were opened so
    this.scene = scene;
    let peak = 0;
    for (const { factor = 1, y } of this.lone ? [first, ...others] : [first])
      for (let k = 0; k < y.length; k++) peak = Math.max(peak, factor * y[k]);
    const share = peak / (TRACK.most * this.most);
    if (this.pulled || (hand && share > KEEP[0] && share <= KEEP[1])) return;
    this.most = (peak || 1) / TRACK.most;
  }
  /**
   * From the struck end into the force, while they touch.
   * @param {Context} c
   * @param {Woven} scene
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
      const here = this.x(between(force.x, force.y, t) * (force.factor ?? 1));
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
   * @param {Woven} scene
   */
  #frame(c, scene) {
    const { about, by, drawn, held, title } = scene;
    const { base, tall, top, track, width } = this.box;
    const [factor, unit] = scaled(this.most, 'N');
    c.font = letters(13);
    c.textBaseline = 'alphabetic';
    c.lineWidth = 1;
    c.fillStyle = COLORS.faint;
    c.textAlign = 'center';
    let right = Infinity;
    for (const force of ticks(0, this.most * factor, Math.max(track / (70 * zoom), 2)).found) {
      const words = localised(String(force));
      const half = c.measureText(words).width / 2 + 3;
      const x = Math.round(this.x(force / factor)) + 0.5;
      c.strokeStyle = force ? COLORS.grid : COLORS.edge;
      c.beginPath();
      c.moveTo(x, top);
      c.lineTo(x, top + tall);
      c.stroke();
      if (x + half > right) continue;
      right = x - half;
      c.fillText(words, x, top - 6);
    }
    this.#clock(c, scene);
    c.fillStyle = COLORS.ink;
    c.textAlign = 'left';
    const force = text('opening.force', { unit });
    const long = c.measureText(force).width;
    const from = Math.max(base - long, 2);
    c.fillText(force, from, top - 8 - LABEL.line * zoom);
    c.fillText(title, drawn.left, top - 8, width - drawn.left);
    c.fillStyle = COLORS.faint;
    const after = drawn.left + c.measureText(`${title} `).width;
    if (after + c.measureText(about).width < width) c.fillText(about, after + 8, top - 8);
    const beside = Math.max(drawn.left, from + long + 12);
    const room = width - beside - 8;
    const fits = c.measureText(by.join(', ')).width < room || by.length < 2;
    c.fillText((fits ? by : by.slice(1)).join(', '), beside, top - 8 - LABEL.line * zoom, room);
    c.fillStyle = WALL;
    if (held) c.fillRect(drawn.right, top, 5, tall);
  }
  /**
   * Times at the left; where there are tracks alone also which solution they are of.
   * @param {Context} c
   * @param {Scene} scene
   */
  #clock(c, scene) {
    const { by, drawn } = scene;
    const [per, sign] = scene.clock;
    const { tall, top, width } = this.box;
    const [start, end] = (!scene.drawn && scene.timed) || this.stretch;
    const marks = ticks(start * per, end * per, (this.y(end) - this.y(start)) / (60 * zoom));
    marks.found.forEach((t, k) => {
      const words = `${localised(t.toFixed(marks.digits)).replace('-', '−')}${k ? '' : ` ${sign}`}`;
      this.words.say(words, TIMES, Math.min(this.y(t / per) + 4, top + tall - 2), COLORS.faint);
    });
    if (drawn) return;
    c.font = letters(13);
    c.fillStyle = COLORS.faint;
    c.textAlign = 'right';
    c.textBaseline = 'alphabetic';
    c.fillText(by.join(', '), width - FOOT, LABEL.line * zoom - 3);
  }
  /**
   * What the curves are, in their colours, where they have come to rest.
   * @param {Context} c
   * @param {Series[]} forces
   */
  #names(c, forces) {
    const { base, tall, top } = this.box;
    const named = forces.filter(({ cursor }) => cursor);
    c.font = letters(13, '600 ');
    let y = top + tall - 8;
    for (const { cursor = '', style } of named.toReversed()) {
      const x = Math.max(base - 10, c.measureText(cursor).width + 16 * zoom);
      const said = () => this.words.say(cursor, x, y, STYLES[style].color, c.font, 'right');
      for (let free = false; !free && y > top; y -= LABEL.line * zoom) free = said(); // times may stand in its way
    }
  }
  /**
   * The peak, beside the curve where it leaves room.
   * @param {Context} c
   * @param {Woven} scene
   */
  #peak(c, { contacts, forces: [{ factor = 1, style, x, y }, ...others], peak }) {
    let most = 0;
    for (let k = 1; k < y.length; k++) if (y[k] > y[most] * (1 + 1e-9)) most = k;
    const words = engineering(peak ?? y[most] * factor, 'N', 3);
    const { base, tall: all, top: first, width } = this.box;
    const tall = (width < NARROW || this.tracks.length ? LABEL.narrow : LABEL.peak) * zoom;
    c.font = letters(tall / zoom, '600 ');
    const { font } = c;
    const wide = c.measureText(words).width + 8;
    const [at, down] = (this.dot = [this.x(y[most] * factor), this.y(x[most])]);
    c.fillStyle = c.strokeStyle = COLORS.ink;
    c.beginPath();
    c.arc(at, down, 3.5, 0, 7);
    c.fill();
    if (this.pulled) return; // what is wanted is written there
    const edge = this.tracks.length ? this.box.track : TRACK.least;
    const beside = at - wide >= edge;
    const left = beside ? at - wide : Math.max(Math.min(edge, base - wide), this.tracks.length ? edge : 4 * zoom);
    const high = tall + LABEL.line * zoom; // with what it is
    const clear = (/** @type {number} */ top) => {
      for (let k = 0; k < x.length; k++) {
        const py = this.y(x[k]);
        if (py > top && py < top + high && this.x(y[k] * factor) < left + wide) return false;
      }
      return top >= first && top + high <= first + all;
    };
    const far = this.y(contacts[0][1]) + 8;
    const found = [...(beside ? [down - tall / 2] : []), down - high - 6, down + 8, far].find(clear);
    const [side, top] = found === undefined ? [base + 8, Math.max(down - tall / 2, first)] : [left, found];
    const ink = others.some(({ cursor }) => cursor) ? STYLES[style].color : COLORS.ink; // whose it is, of several
    this.words.say(words, side, top + 0.85 * tall, ink, font);
    this.words.say(text('opening.peak'), side, top + tall + 0.75 * LABEL.line * zoom, COLORS.faint);
    c.lineWidth = 0.5;
    c.beginPath();
    if (found === far) c.moveTo(left + wide / 2, far > down ? far : far + high);
    c.lineTo(at, down);
    c.stroke();
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
    let from = 0;
    for (const [left, right] of [...this.words.across(y), [width, width]]) {
      c.moveTo(from, y); // it strikes out no words
      c.lineTo(Math.max(left, from), y);
      from = Math.max(right, from);
    }
    c.stroke();
    for (const { track, place } of this.tracks) dot(c, track, place, t, y);
    if (!shown.drawn) {
      this.words.draw(c, '', 0, 0);
      return;
    }
    const [{ factor = 1, x, y: force }] = shown.forces;
    const value = between(x, force, t) * factor;
    c.fillStyle = COLORS.cursor;
    c.beginPath();
    c.arc(this.x(value), y, 4.5, 0, 7);
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
