// A line that is drawn: a value for each bin of time, what takes a stroke back, and the pen that keys move.
import { BIN, blank, NOTHING } from './judge.js';

const MOST_UNDONE = 60; // strokes
const STEP = { along: 0.1, up: 1 / 24 }; // of the pen: T, and of the axis
const FINE = 5; // times finer with Shift
const MOST_POINTS = 400; // that can be typed
const POWER = '(?:e\\+?-?\\d{1,2})?';
const POINT = RegExp(`^(-?\\d{1,6}(?:[.,]\\d{0,6})?${POWER})[\\s;:]{1,9}(-?\\d{1,15}(?:[.,]\\d{0,6})?${POWER})$`, 'i');

/**
 * Points as they are typed, a line each: time and value; the same time twice is a jump.
 * @param {string} written
 * @returns {[t: number, value: number][]}
 */
export function pointsOf(written) {
  const number = (/** @type {string} */ digits) => Number(digits.replace(',', '.'));
  return written
    .split('\n')
    .slice(0, MOST_POINTS)
    .flatMap((each) => {
      const [, t, value] = POINT.exec(each.replaceAll('−', '-').trim().slice(0, 60)) ?? [];
      return t === undefined ? [] : [/** @type {[number, number]} */ ([number(t), number(value)])];
    });
}

export class Drawn {
  /** @type {number[][]} */ undone = [];
  /** @type {[t: number, value: number] | null} */ pen = null; // that keys move
  /** @type {[t: number, value: number] | null} */ anchor = null; // from which its line comes
  lifted = false;

  /**
   * @param {{ until: number, axis: [low: number, high: number], given: [t: number, value: number] | null,
   *   zeroed?: boolean }} chart  `zeroed`: whether what is close to zero is zero
   * @param {(number | null)[] | null} [line]  as it was kept
   */
  constructor({ axis, given, until, zeroed = true }, line = null) {
    this.zeroed = zeroed;
    this.axis = axis;
    this.until = until;
    this.given = given;
    const empty = blank(until);
    this.line = line?.length === empty.length ? line.map((value) => value ?? NaN) : empty;
    if (!line && given) this.line[this.#bin(given[0])] = given[1];
  }
  /** @param {number} t */
  #bin(t) {
    return Math.min(Math.max(Math.round(t / BIN), 0), this.line.length - 1);
  }
  /** To be kept: what JSON can say. */
  get kept() {
    return this.line.map((value) => (Number.isNaN(value) ? null : Number(value.toPrecision(4))));
  }
  /** How far it reaches [T]; -1: nothing is drawn. */
  get reach() {
    return this.line.findLastIndex((value) => !Number.isNaN(value)) * BIN;
  }
  /** From where on anything is drawn [T]. */
  get from() {
    return this.line.findIndex((value) => !Number.isNaN(value)) * BIN;
  }
  /** Whether anything but the given point is there. */
  get begun() {
    return this.line.filter((value) => !Number.isNaN(value)).length > (this.given ? 1 : 0);
  }
  /** What follows can be taken back. */
  stroke() {
    this.undone.push(this.line.slice());
    if (this.undone.length > MOST_UNDONE) this.undone.shift();
  }
  undo() {
    const before = this.undone.pop();
    if (!before) return false;
    this.line = before;
    if (this.pen) {
      const t = Math.max(this.reach, 0);
      this.pen = [t, this.#value(t)];
      this.anchor = this.pen;
    }
    return true;
  }
  clear() {
    this.stroke();
    this.line = blank(this.until);
    if (this.given) this.line[this.#bin(this.given[0])] = this.given[1];
    this.pen = this.anchor = null;
  }
  /** @param {number} t */
  #value(t) {
    const value = this.line[this.#bin(t)];
    return Number.isNaN(value) ? (this.given?.[1] ?? Math.max(this.axis[0], 0)) : value;
  }
  /** @param {number} value */
  #snapped(value) {
    const [low, high] = this.axis;
    const within = Math.min(Math.max(value, low), high);
    return this.zeroed && Math.abs(within) < NOTHING * (high - low) ? 0 : within;
  }
  /**
   * A straight piece of it, in place of what was there.
   * @param {[t: number, value: number]} from
   * @param {[t: number, value: number]} to
   */
  ink(from, to) {
    const [a, b] = [this.#bin(from[0]), this.#bin(to[0])];
    const way = Math.sign(b - a);
    const count = Math.abs(b - a);
    for (let k = 1; k <= count; k++) this.line[a + way * k] = this.#snapped(from[1] + (k / count) * (to[1] - from[1]));
    if (!count) this.line[b] = this.#snapped(to[1]);
  }
  /** @param {[t: number, value: number][]} points */
  type(points) {
    if (!points.length) return;
    this.stroke();
    this.ink(points[0], points[0]);
    for (let k = 1; k < points.length; k++) this.ink(points[k - 1], points[k]);
  }
  /** The pen, at the end of what is drawn where it was nowhere. */
  take() {
    if (this.pen) return this.pen;
    const t = this.begun ? this.reach : 0;
    this.pen = [t, this.#value(t)];
    this.anchor = this.pen;
    return this.pen;
  }
  /**
   * What a key does. Whether it does anything.
   * @param {string} key
   * @param {boolean} fine
   */
  key(key, fine) {
    const by = fine ? 1 / FINE : 1;
    const high = STEP.up * (this.axis[1] - this.axis[0]) * by;
    /** @type {Record<string, () => void>} */
    const keys = {
      ArrowRight: () => this.#on(STEP.along * by),
      End: () => this.#on(this.until),
      ArrowLeft: () => this.#back(STEP.along * by),
      ArrowUp: () => this.#set(high),
      ArrowDown: () => this.#set(-high),
      Enter: () => (this.anchor = this.take()),
      ' ': () => (this.lifted = !this.lifted),
      Backspace: () => this.undo(),
    };
    if (!Object.hasOwn(keys, key)) return false;
    this.take();
    keys[key]();
    return true;
  }
  /** @param {number} by  T */
  #on(by) {
    const [t, value] = this.take();
    if (t >= this.until) return;
    this.anchor = [t, value];
    this.pen = [Math.min(Number((t + by).toFixed(4)), this.until), value];
    this.stroke();
    if (!this.lifted) this.ink(this.anchor, this.pen);
  }
  /** @param {number} by  T */
  #back(by) {
    const [t] = this.take();
    const to = Math.max(Number((t - by).toFixed(4)), 0);
    this.pen = [to, this.#value(to)];
    this.anchor = this.pen;
  }
  /** @param {number} by */
  #set(by) {
    const [t, value] = this.take();
    const [low, high] = this.axis;
    this.pen = [t, Math.min(Math.max(Number((value + by).toPrecision(6)), low), high)];
    if (this.lifted) return;
    const from = this.anchor ?? this.pen;
    if (this.#bin(from[0]) === this.#bin(t)) this.stroke(); // a jump, which goes back by itself
    this.ink(from, this.pen);
  }
}
