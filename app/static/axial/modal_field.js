// The field of one rod by its modes.
import { attachedModes } from './attached_modes.js';
import { given } from '../wire/message.js';
import { evenly } from '../charts/scale.js';
import { Field } from './fields.js';

/** @import { AxialFrame } from '../messages.js' */
/** @import { Range } from '../charts/scale.js' */
/** @import { What } from './fields.js' */

const SAMPLES = 12; // of a history, in the shortest period
const [LEAST_SAMPLES, MOST_SAMPLES] = [400, 2400];
const SAVED_NUMBERS = 400_000; // of states that are kept, to go back to

/** The modal field: the browser carries the same oscillators through the same forces as the server did. */
export class ModalField extends Field {
  coarse = true;
  at = 0; // number of the step that is reached
  rigid = [0, 0]; // displacement and velocity of the rod as a whole
  /** @type {{ q: Float32Array, w: Float32Array, rigid: number[] }[]} */ saved = [];
  /** @type {Map<number, Float64Array | null>} by points */ left = new Map();
  /** @type {Map<number, { cosines: Float64Array, sines: Float64Array }>} */ shapes = new Map();

  /** @param {AxialFrame} frame */
  constructor(frame) {
    super(frame, 'other');
    this.force = given(frame.modalForce ?? frame.fieldForce, 'modalForce');
    this.h = given(frame.step, 'step');
    this.from = frame.rods[0].from;
    this.to = frame.rods[0].to;
    const fixed = frame.rods[0].mirror > 0;
    this.free = !fixed;
    const n = frame.modes;
    const { h } = this;
    this.steps = this.force.length;
    this.stride = Math.max(1, Math.ceil((this.steps * n) / SAVED_NUMBERS));
    this.attached = frame.attached && this.free ? attachedModes(n) : null;
    const own = Float64Array.from({ length: n }, (_, i) => 2 * Math.PI * (fixed ? i + 0.5 : i + 1));
    this.omega = this.attached?.omega ?? own;
    const felt = this.attached?.felt ?? new Float64Array(n).fill(2);
    this.cosine = this.omega.map((w) => Math.cos(w * h));
    this.sine = this.omega.map((w) => Math.sin(w * h));
    this.kickQ = this.omega.map((w, i) => ((4 * felt[i]) / (w * w)) * Math.sin((w * h) / 2) ** 2);
    this.kickW = this.omega.map((w, i) => ((2 * felt[i]) / (w * w)) * Math.sin(w * h));
    this.q = new Float64Array(n);
    this.w = new Float64Array(n);
    // what the modes left out carry of the force, averaged over what is resolved
    this.kept = frame.modalForce ? this.omega.map((w, i) => (2 * felt[i]) / w) : null;
    this.smoothing = Math.max(2 * h, frame.rigid ? (2 * Math.PI) / this.omega[n - 1] : 0);
    this.impulses = new Float64Array(this.steps + 1);
    for (let k = 0; k < this.steps; k++) this.impulses[k + 1] = this.impulses[k] + h * this.force[k];
  }
  step() {
    const { q, w, cosine, sine, kickQ, kickW, h } = this;
    const force = this.force[this.at];
    for (let i = 0; i < q.length; i++) {
      const a = q[i];
      const b = w[i];
      q[i] = cosine[i] * a + sine[i] * b + kickQ[i] * force;
      w[i] = cosine[i] * b - sine[i] * a + kickW[i] * force;
    }
    if (this.free) {
      // the free rod as a whole: x'' = 2 F
      this.rigid[0] += h * (this.rigid[1] + h * force);
      this.rigid[1] += 2 * h * force;
    }
    this.at++;
  }
  /**
   * Bring the oscillators to the instant next to t.
   * @param {number} t
   */
  seek(t) {
    const target = Math.min(Math.max(Math.round(t / this.h), 0), this.steps);
    const row = Math.floor(target / this.stride);
    if (target < this.at || row * this.stride > this.at + this.stride) {
      const from = Math.min(row, this.saved.length - 1);
      if (from < 0) {
        this.q.fill(0);
        this.w.fill(0);
        this.rigid = [0, 0];
        this.at = 0;
      } else {
        const s = this.saved[from];
        this.q.set(s.q);
        this.w.set(s.w);
        this.rigid = [...s.rigid];
        this.at = from * this.stride;
      }
    }
    for (;;) {
      if (this.at % this.stride === 0 && this.at / this.stride === this.saved.length)
        this.saved.push({ q: Float32Array.from(this.q), w: Float32Array.from(this.w), rigid: [...this.rigid] });
      if (this.at >= target) break;
      this.step();
    }
  }
  /**
   * Every mode at every place, evenly spread: its shape, and its stress over its frequency.
   * @param {number} points
   */
  table(points) {
    const shapes = this.attached?.shapes ?? this.shapes;
    const known = shapes.get(points);
    if (known) return known;
    const shares = Float64Array.from({ length: points }, (_, j) => j / (points - 1));
    const made = this.rows(shares);
    this.left.set(points, this.beside(shares, made.sines));
    shapes.set(points, made);
    return made;
  }
  /**
   * The same at any places.
   * @param {Float64Array} shares  of the length
   */
  rows(shares) {
    if (this.attached) return this.attached.rows(shares);
    const [n, points] = [this.omega.length, shares.length];
    const made = { cosines: new Float64Array(n * points), sines: new Float64Array(n * points) };
    for (let i = 0; i < n; i++)
      for (let j = 0; j < points; j++) {
        const angle = (this.omega[i] * shares[j]) / 2;
        made.cosines[i * points + j] = Math.cos(angle);
        made.sines[i * points + j] = Math.sin(angle);
      }
    return made;
  }
  /**
   * The stress that the modes left out carry under a steady force of 1 at these places, or nothing.
   * @param {Float64Array} shares  of the length
   * @param {Float64Array} sines  of the modes there
   */
  beside(shares, sines) {
    const { free, kept } = this;
    if (!kept) return null;
    return shares.map((share, j) =>
      kept.reduce((left, each, i) => left - each * sines[i * shares.length + j], free ? 1 - share : 1),
    );
  }
  /** The force about the instant that is reached, which they follow as if it were steady. */
  resolved() {
    const { at, h, impulses, smoothing, steps } = this;
    const reach = smoothing / (2 * h);
    const [start, end] = [Math.max(at - reach, 0), Math.min(at + reach, steps)];
    const upTo = (/** @type {number} */ place) => {
      const k = Math.min(Math.floor(place), steps - 1);
      return impulses[k] + (place - k) * (impulses[k + 1] - impulses[k]);
    };
    return (upTo(end) - upTo(start)) / ((end - start) * h);
  }
  /**
   * How much there is of a mode.
   * @param {number} i
   * @param {What} what
   */
  amount(i, what) {
    if (what === 'displacement') return this.q[i];
    return (what === 'stress' ? this.q[i] : this.w[i]) * this.omega[i];
  }
  /** @param {What} what  of the rod as a whole */
  whole(what) {
    return what === 'stress' ? 0 : what === 'velocity' ? this.rigid[1] : this.rigid[0];
  }
  /**
   * @param {number} place
   * @param {Range} stretch
   * @param {What} what
   */
  history(place, [start, end], what) {
    const shares = Float64Array.of((place - this.from) / (this.to - this.from));
    const { cosines, sines } = this.rows(shares);
    const beside = what === 'stress' ? this.beside(shares, sines) : null;
    const shape = what === 'stress' ? sines : cosines;
    const count = Math.min(Math.max(SAMPLES * this.omega.length * (end - start), LEAST_SAMPLES), MOST_SAMPLES);
    return evenly([start, end], Math.ceil(count), (t) => {
      this.seek(t);
      let sum = this.whole(what) + (beside ? beside[0] * this.resolved() : 0);
      for (let i = 0; i < shape.length; i++) sum += this.amount(i, what) * shape[i];
      return sum;
    });
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Float64Array} out
   */
  profile(t, what, out) {
    this.seek(t);
    const points = out.length;
    const { cosines, sines } = this.table(points);
    const beside = this.left.get(points);
    const shape = what === 'stress' ? sines : cosines;
    out.fill(this.whole(what));
    if (what === 'stress' && beside) {
      const force = this.resolved();
      for (let j = 0; j < points; j++) out[j] = beside[j] * force;
    }
    for (let i = 0; i < this.omega.length; i++) {
      const amount = this.amount(i, what);
      for (let j = 0, k = i * points; j < points; j++, k++) out[j] += amount * shape[k];
    }
    return out;
  }
}
