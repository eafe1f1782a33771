// Fields of a struck beam, rebuilt from the message, in SI units.
// Deflection is positive the way the impactor goes; M = EI y'', V = dM/dx.
import { evenly } from '../charts/scale.js';
import { arrayOf, given } from '../wire/message.js';

/** @import { Range, Samples } from '../charts/scale.js' */
/** @import { BendingFrame } from '../messages.js' */

/** @typedef {'moment' | 'velocity' | 'shear' | 'deflection'} What */
/** @typedef {Float32Array | Float64Array} Out */

/** @type {What[]} */
export const FIELDS = ['moment', 'velocity', 'shear', 'deflection'];
const COLUMNS = 240; // of a picture
const SAVED_NUMBERS = 20_000; // of states that are kept, to go back to
const SPARSE = 7; // of so many values one tells where the colours end
const SURVEYED = 96; // instants of the first look
const MANY = 60; // modes, whose sum is dear
const MOMENTS = 1200; // of a history at a place
const EVERY = 2; // of so many places one, at each of them

/** @type {Record<string, Float64Array>} */
const rooms = {};
/**
 * Room for numbers that each field of its size uses anew; of those that are shown at a time, each has its own.
 * @param {string} name
 * @param {number} size
 */
function scratch(name, size) {
  if (rooms[name]?.length !== size) rooms[name] = new Float64Array(size);
  return rooms[name].fill(0);
}

/**
 * A value for each field.
 * @template Value
 * @param {(what: What) => Value} value
 * @returns {Record<What, Value>}
 */
const forEach = (value) => ({
  moment: value('moment'),
  velocity: value('velocity'),
  shear: value('shear'),
  deflection: value('deflection'),
});

const NOTHING = 1e-30;

export class BeamField {
  coarse = false; // dear to compute: fewer points will do
  largest = forEach(() => NOTHING); // values over the whole impact
  usual = forEach(() => NOTHING); // where the colours end

  /**
   * @param {BendingFrame} frame
   * @param {string} room  in which its numbers are
   */
  constructor(frame, room) {
    this.frame = frame;
    this.from = 0;
    this.to = frame.beam?.length ?? 0;
    this.places = frame.places;
    this.room = room;
  }
  /**
   * Whether there is any of it.
   * @param {What} what
   */
  has(what) {
    return this.largest[what] > NOTHING;
  }
  /** Whether nothing bends it, as it is struck along its length. */
  get lengthwise() {
    return !this.has('moment');
  }
  /**
   * Values along the beam at one instant: at all places, or at every `every`-th from `first`.
   * @param {number} _t
   * @param {What} _what
   * @param {Out} [out]
   * @param {number} [_first]
   * @param {number} [_every]
   * @returns {Out}
   */
  profile(_t, _what, out = new Float64Array(this.places), _first, _every) {
    return out;
  }
  /**
   * Values over places [m] at one instant.
   * @param {number} t
   * @param {What} what
   * @returns {Samples | null}
   */
  along(t, what) {
    if (!this.has(what)) return null;
    const row = this.profile(t, what, scratch('along', this.places));
    return evenly([0, this.frame.beam.length], this.places - 1, (_, j) => row[j]);
  }
  /**
   * Values over a stretch of time at a place [m], straight between those of the field.
   * @param {number} place
   * @param {Range} stretch
   * @param {What} what
   * @returns {Samples | null}
   */
  over(place, stretch, what) {
    if (!this.has(what)) return null;
    const { places } = this;
    const share = (place / this.frame.beam.length) * (places - 1);
    const j = Math.min(Math.max(Math.floor(share), 0), places - 2);
    const row = scratch('over', places);
    return evenly(stretch, MOMENTS, (t) => {
      this.profile(t, what, row, j, places);
      this.profile(t, what, row, j + 1, places);
      return row[j] + (share - j) * (row[j + 1] - row[j]);
    });
  }
  /**
   * Values about an instant, averaged over a span of time in which much of it may swing to and fro.
   * @param {number} t
   * @param {number} _span
   * @param {What} what
   * @param {Out} out
   */
  mean(t, _span, what, out) {
    return this.profile(t, what, out);
  }
  // A first look over the whole impact: the largest value of everything, and where the colours end.
  survey() {
    const { places, frame } = this;
    const row = scratch('row', places);
    const across = Math.ceil(places / EVERY);
    const seen = forEach((what) => scratch(`surveyed ${what}`, SURVEYED * across));
    for (let c = 0; c < SURVEYED; c++) {
      const t = ((c + 0.5) / SURVEYED) * frame.duration;
      for (const what of FIELDS) {
        this.profile(t, what, row, c % EVERY, EVERY); // by turns other places, so that none is left out
        for (let j = c % EVERY, k = c * across; j < places; j += EVERY, k++) seen[what][k] = row[j];
      }
    }
    for (const what of FIELDS) {
      let most = 1e-30;
      for (const value of seen[what]) most = Math.max(most, Math.abs(value));
      this.largest[what] = most;
      this.usual[what] = this.usualOf(seen[what], most);
    }
  }
  /**
   * The end of the colours of a picture: few values lie beyond.
   * @param {Out} values
   * @param {number} most
   */
  usualOf(values, most) {
    const sizes = new Float32Array(Math.ceil(values.length / SPARSE));
    for (let k = 0; k < sizes.length; k++) sizes[k] = Math.abs(values[k * SPARSE]);
    sizes.sort();
    return Math.max(sizes[Math.floor(0.99 * (sizes.length - 1))], 0.2 * most, 1e-30);
  }
  /**
   * The picture (column of time, place) of one quantity over a stretch of time, flat.
   * @param {Range} stretch
   * @param {What} what
   */
  picture([start, end], what) {
    const { places } = this;
    const drawn = new Float32Array(COLUMNS * places);
    for (let c = 0; c < COLUMNS; c++) {
      const t = start + ((c + 0.5) / COLUMNS) * (end - start);
      this.profile(t, what, drawn.subarray(c * places, (c + 1) * places));
    }
    return drawn;
  }
}

/** The modal field: the browser carries the same oscillators through the same forces as the server did. */
export class ModalBeamField extends BeamField {
  at = 0; // number of the step that is reached
  saved = 0; // rows of displacements, rates and the two of the whole, one every `stride` steps

  /**
   * @param {BendingFrame} frame
   * @param {string} room
   */
  constructor(frame, room) {
    super(frame, room);
    const omega = given(frame.modalFrequencies, 'modalFrequencies');
    const push = given(frame.modalAtContact, 'modalAtContact');
    const damping = given(frame.damping, 'damping');
    this.h = given(frame.step, 'step');
    this.forces = given(frame.modalForce, 'modalForce');
    this.smoothing = given(frame.smoothing, 'smoothing');
    this.drift = given(frame.drift, 'drift');
    const { h } = this;
    const n = omega.length;
    const list = (/** @type {(i: number) => number} */ value) => Float64Array.from(omega, (_, i) => value(i));
    // over a step the force is constant: each oscillator turns, and fades, about push F / omega^2
    const damped = list((i) => omega[i] * Math.sqrt(1 - damping ** 2));
    const fade = list((i) => Math.exp(-damping * omega[i] * h));
    const cosine = list((i) => fade[i] * Math.cos(damped[i] * h));
    this.fromRate = list((i) => (fade[i] * Math.sin(damped[i] * h)) / damped[i]);
    this.stay = list((i) => cosine[i] + damping * omega[i] * this.fromRate[i]);
    this.keep = list((i) => cosine[i] - damping * omega[i] * this.fromRate[i]);
    this.pull = list((i) => omega[i] ** 2 * this.fromRate[i]);
    this.middle = list((i) => push[i] / omega[i] ** 2);
    this.q = new Float64Array(n);
    this.v = new Float64Array(n);
    this.amounts = new Float64Array(n); // over a span
    this.coarse = n > MANY;
    this.steps = this.forces.length;
    this.stride = Math.max(1, Math.ceil((this.steps * n) / SAVED_NUMBERS));
    this.rows = scratch(`${room} rows`, (Math.floor(this.steps / this.stride) + 1) * (2 * n + 2));
    this.rigid = [0, this.drift]; // displacement and velocity of the beam as a whole
    const shape = this.table('shape');
    this.tables = { deflection: shape, velocity: shape, moment: this.table('moment'), shear: this.table('shear') };
    const nothing = null; // what modes left out do to movement cannot be seen
    const beside = {
      moment: given(frame.momentBeside, 'momentBeside'),
      shear: given(frame.shearBeside, 'shearBeside'),
    };
    this.beside = { ...beside, deflection: nothing, velocity: nothing };
    this.impulses = new Float64Array(this.steps + 1);
    for (let k = 0; k < this.steps; k++) this.impulses[k + 1] = this.impulses[k] + h * this.forces[k];
    this.survey();
  }
  /**
   * A table (mode, place), sent as whole numbers with a scale for each mode.
   * @param {string} name
   */
  table(name) {
    const rows = arrayOf(this.frame, `${name}Rows`);
    const scale = arrayOf(this.frame, `${name}Scale`);
    const found = scratch(`${this.room} table ${name}`, rows.length);
    for (let i = 0, k = 0; i < scale.length; i++)
      for (let j = 0; j < this.places; j++, k++) found[k] = rows[k] * scale[i];
    return found;
  }
  begin() {
    this.q.fill(0);
    this.v.fill(0);
    this.rigid = [0, this.drift];
    this.at = 0;
  }
  step() {
    const { q, v, stay, keep, pull, fromRate, middle, h } = this;
    const force = this.forces[this.at];
    const { rigidMass } = this.frame;
    for (let i = 0; i < q.length; i++) {
      const a = q[i] - middle[i] * force;
      const b = v[i];
      q[i] = middle[i] * force + stay[i] * a + fromRate[i] * b;
      v[i] = keep[i] * b - pull[i] * a;
    }
    if (rigidMass) {
      const gained = (h * force) / rigidMass;
      this.rigid[0] += h * (this.rigid[1] + 0.5 * gained);
      this.rigid[1] += gained;
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
      const from = Math.min(row, this.saved - 1);
      if (from < 0) this.begin();
      else this.restore(from);
    }
    for (;;) {
      if (this.at === this.saved * this.stride) this.save();
      if (this.at >= target) break;
      this.step();
    }
  }
  save() {
    const { q, v, rigid, rows } = this;
    const n = q.length;
    const start = this.saved * (2 * n + 2);
    rows.set(q, start);
    rows.set(v, start + n);
    [rows[start + 2 * n], rows[start + 2 * n + 1]] = rigid;
    this.saved++;
  }
  /** @param {number} row */
  restore(row) {
    const { q, v, rows } = this;
    const n = q.length;
    const start = row * (2 * n + 2);
    q.set(rows.subarray(start, start + n));
    v.set(rows.subarray(start + n, start + 2 * n));
    this.rigid = [rows[start + 2 * n], rows[start + 2 * n + 1]];
    this.at = row * this.stride;
  }
  /**
   * The force about an instant, which the modes left out follow as if it were steady.
   * @param {number} [at]  in steps
   * @param {number} [least]  steps to both sides
   */
  force(at = this.at, least = 1) {
    const { impulses, steps, h } = this;
    const reach = Math.max(this.smoothing / (2 * h), least);
    const start = Math.max(at - reach, 0);
    const end = Math.min(at + reach, steps);
    const upTo = (/** @type {number} */ place) => {
      const k = Math.min(Math.floor(place), steps - 1);
      return impulses[k] + (place - k) * (impulses[k + 1] - impulses[k]);
    };
    return (upTo(end) - upTo(start)) / ((end - start) * h);
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Out} out
   */
  profile(t, what, out = new Float64Array(this.places), first = 0, every = 1) {
    this.seek(t);
    const whole = what === 'velocity' ? this.rigid[1] : what === 'deflection' ? this.rigid[0] : 0;
    const amounts = what === 'velocity' ? this.v : this.q;
    return this.sum(what, amounts, whole, this.beside[what] ? this.force() : 0, out, first, every);
  }
  /**
   * @param {number} t
   * @param {number} span
   * @param {What} what
   * @param {Out} out
   */
  mean(t, span, what, out) {
    const { amounts, h, steps } = this;
    const last = Math.min(Math.round((t + span / 2) / h), steps);
    this.seek(t - span / 2);
    const first = this.at;
    if (last - first < 2) return this.profile(t, what, out);
    amounts.fill(0);
    let whole = 0;
    for (; this.at < last; this.seek((this.at + 1) * h)) {
      const now = what === 'velocity' ? this.v : this.q;
      for (let i = 0; i < now.length; i++) amounts[i] += now[i];
      whole += what === 'velocity' ? this.rigid[1] : what === 'deflection' ? this.rigid[0] : 0;
    }
    const count = last - first;
    for (let i = 0; i < amounts.length; i++) amounts[i] /= count;
    const force = this.beside[what] ? this.force((first + last) / 2, count / 2) : 0;
    return this.sum(what, amounts, whole / count, force, out, 0, 1);
  }
  /**
   * Modes by how much there is of each, the beam as a whole, and what a force does by the modes left out.
   * @param {What} what
   * @param {Float64Array} amounts
   * @param {number} whole
   * @param {number} force
   * @param {Out} out
   * @param {number} first
   * @param {number} every
   */
  sum(what, amounts, whole, force, out, first, every) {
    const { places } = this;
    const { rigidShape } = this.frame;
    const table = this.tables[what];
    const n = amounts.length;
    for (let j = first; j < places; j += every) out[j] = whole && rigidShape ? whole * rigidShape[j] : 0;
    for (let i = 0; i < n; i += 2) {
      // two modes at a time: half as many readings and writings of the sum
      const one = amounts[i];
      const two = i + 1 < n ? amounts[i + 1] : 0;
      const a = i * places;
      const b = i + 1 < n ? a + places : a;
      for (let j = first; j < places; j += every) out[j] += one * table[a + j] + two * table[b + j];
    }
    const beside = this.beside[what];
    if (beside && force) for (let j = first; j < places; j += every) out[j] += force * beside[j];
    return out;
  }
}
