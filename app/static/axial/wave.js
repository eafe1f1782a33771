// Waves that run through a rod, as the picture reads them.
import { between, indexAt } from '../charts/scale.js';

/** @import { Range } from '../charts/scale.js' */
/** @import { Numbers } from '../messages.js' */

const CELLS = 8192; // of the time that is shown

/**
 * Instants spread evenly, one for each place from `first` to before `last`.
 * @typedef {{ first: number, last: number, start: number, step: number }} Steps
 */

/** One wave that a rod end sends, on even cells: value, and integral from the beginning. */
export class Wave {
  strongest = 0;
  /** @type {Float64Array | null} */ bold = null;
  boldPerTrip = 0;
  span = 0; // over which the means are
  means = new Float64Array(0);

  /**
   * @param {Numbers} time
   * @param {Numbers} value
   * @param {number} duration
   */
  constructor(time, value, duration) {
    this.history = { x: time, y: value }; // at a jump a time stands twice
    this.duration = duration;
    this.perTrip = CELLS / duration;
    this.value = new Float64Array(CELLS + 1);
    this.sum = new Float64Array(CELLS + 1);
    const sums = new Float64Array(time.length);
    for (let j = 1; j < time.length; j++)
      sums[j] = sums[j - 1] + 0.5 * (value[j] + value[j - 1]) * (time[j] - time[j - 1]);
    for (let k = 0, j = 0; k <= CELLS; k++) {
      const t = (k + 0.5) / this.perTrip; // cell middles: jumps stay within one cell
      const u = k / this.perTrip;
      while (j < time.length - 2 && time[j + 1] <= t) j++;
      const part = time[j + 1] > time[j] ? Math.min((t - time[j]) / (time[j + 1] - time[j]), 1) : 1;
      this.value[k] = value[j] + part * (value[j + 1] - value[j]);
      let i = j;
      while (i > 0 && time[i] > u) i--;
      const step = Math.max(u - time[i], 0);
      const width = time[i + 1] - time[i];
      const slope = width > 0 ? (value[i + 1] - value[i]) / width : 0;
      this.sum[k] = sums[i] + Math.min(step, width) * (value[i] + 0.5 * slope * Math.min(step, width));
    }
    for (const v of value) this.strongest = Math.max(this.strongest, Math.abs(v));
    this.embolden();
  }
  // Pulses narrower than a pixel are drawn a pixel wide: of every pixel's worth of time, the strongest value.
  embolden() {
    const pixel = Math.max(0.0045, this.duration / 480);
    const count = Math.min(Math.ceil(this.duration / pixel), CELLS);
    const each = (CELLS + 1) / count;
    let whole = 0;
    let seen = 0;
    const bold = new Float64Array(count + 1);
    for (let k = 0; k <= CELLS; k++) {
      const cell = Math.min(Math.floor(k / each), count);
      const v = this.value[k];
      if (Math.abs(v) > Math.abs(bold[cell])) bold[cell] = v;
      whole = Math.max(whole, Math.abs(v));
    }
    for (let k = 0; k < count; k += 2) seen = Math.max(seen, Math.abs(this.value[Math.floor((k + 0.9) * each)]));
    if (seen > 0.6 * whole) return;
    this.bold = bold;
    this.boldPerTrip = count / this.duration;
  }
  /**
   * As the message has it, with every jump where it is.
   * @param {number} t
   */
  sharp(t) {
    return t < 0 ? 0 : between(this.history.x, this.history.y, t);
  }
  /**
   * The instants in a stretch of time between which it is straight, its beginning among them.
   * @param {Range} stretch
   * @returns {number[]}
   */
  corners([start, end]) {
    const { x } = this.history;
    const found = start <= 0 && end >= 0 ? [0] : [];
    for (let k = indexAt(x, start); k < x.length && x[k] <= end; k++)
      if (x[k] >= start && x[k] !== found[found.length - 1]) found.push(x[k]);
    return found;
  }
  /** @param {number} t */
  total(t) {
    if (t <= 0) return 0;
    const place = Math.min(t * this.perTrip, CELLS - 1e-9);
    const i = Math.floor(place);
    return this.sum[i] + (place - i) * (this.sum[i + 1] - this.sum[i]);
  }
  /**
   * Add values at instants spread evenly to what is there, from `first` to before `last`.
   * @param {Float64Array} out
   * @param {Steps} steps
   * @param {number} factor
   */
  addValues(out, { first, last, start, step }, factor) {
    const [values, rate] = this.bold ? [this.bold, this.boldPerTrip] : [this.value, this.perTrip];
    this.#add(out, first, last, values, start * rate, step * rate, factor);
  }
  /**
   * The same of means over a span about each instant, as near as cells are.
   * @param {Float64Array} out
   * @param {Steps} steps
   * @param {number} factor
   * @param {number} span
   */
  addMeans(out, { first, last, start, step }, factor, span) {
    if (this.span !== span) this.#average(span);
    this.#add(out, first, last, this.means, (start + span / 2) * this.perTrip, step * this.perTrip, factor);
  }
  /**
   * The same of integrals from the beginning.
   * @param {Float64Array} out
   * @param {Steps} steps
   * @param {number} factor
   */
  addTotals(out, { first, last, start, step }, factor) {
    const { perTrip, sum } = this;
    for (let k = first; k < last; k++) {
      const place = Math.min((start + step * (k - first)) * perTrip, CELLS - 1e-9);
      if (place <= 0) continue;
      const i = Math.floor(place);
      out[k] += factor * (sum[i] + (place - i) * (sum[i + 1] - sum[i]));
    }
  }
  /**
   * @param {Float64Array} out
   * @param {number} first
   * @param {number} last
   * @param {Float64Array} values  of cells
   * @param {number} start  in cells
   * @param {number} step
   * @param {number} factor
   */
  #add(out, first, last, values, start, step, factor) {
    for (let k = first; k < last; k++) {
      const cell = Math.floor(start + step * (k - first));
      if (cell >= 0) out[k] += factor * values[Math.min(cell, values.length - 1)];
    }
  }
  /** @param {number} span */
  #average(span) {
    this.span = span;
    const cells = Math.floor(span * this.perTrip);
    this.means = new Float64Array(CELLS + 1 + cells);
    for (let k = 0; k < this.means.length; k++) {
      const t = (k + 0.5) / this.perTrip; // the end of the span
      this.means[k] = (this.total(t) - this.total(t - span)) / span;
    }
  }
}

/** The same wave a transit time later, as it was or turned over: what the far end of a uniform rod sends back. */
export class Mirrored {
  /**
   * @param {Wave} wave
   * @param {number} sign
   * @param {number} transit
   */
  constructor(wave, sign, transit) {
    this.wave = wave;
    this.sign = sign;
    this.transit = transit;
  }
  /** @param {number} t */
  sharp(t) {
    return this.sign * this.wave.sharp(t - this.transit);
  }
  /** @param {Range} stretch */
  corners([start, end]) {
    return this.wave.corners([start - this.transit, end - this.transit]).map((t) => t + this.transit);
  }
  /** @param {number} t */
  total(t) {
    return this.sign * this.wave.total(t - this.transit);
  }
  /** @param {Steps} steps */
  #sent(steps) {
    return { ...steps, start: steps.start - this.transit };
  }
  /**
   * @param {Float64Array} out
   * @param {Steps} steps
   * @param {number} factor
   */
  addValues(out, steps, factor) {
    this.wave.addValues(out, this.#sent(steps), this.sign * factor);
  }
  /**
   * @param {Float64Array} out
   * @param {Steps} steps
   * @param {number} factor
   * @param {number} span
   */
  addMeans(out, steps, factor, span) {
    this.wave.addMeans(out, this.#sent(steps), this.sign * factor, span);
  }
  /**
   * @param {Float64Array} out
   * @param {Steps} steps
   * @param {number} factor
   */
  addTotals(out, steps, factor) {
    this.wave.addTotals(out, this.#sent(steps), this.sign * factor);
  }
}
