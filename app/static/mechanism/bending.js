// How a link of a mechanism bends: amounts of its shapes over time, and from them deflection, moment and shear force.
import { indexAt } from '../charts/scale.js';
import { arrayOf, given } from '../wire/message.js';

/** @import { Out, What } from '../beam/field.js' */
/** @import { MechanismFrame } from '../messages.js' */

/** @type {Record<What, string>} */
const TABLES = { deflection: 'shape', velocity: 'shape', moment: 'moment', shear: 'shear' };
const ARRAYS = {
  shape: ['shapeOf', 'shapeScaleOf'],
  moment: ['momentOf', 'momentScaleOf'],
  shear: ['shearOf', 'shearScaleOf'],
}; // of the message, with the number of the link
const SURVEYED = 150; // instants at which the largest deflection is looked for

export class Bending {
  /**
   * @param {MechanismFrame} frame
   * @param {number} link  its number
   */
  constructor(frame, link) {
    this.time = given(frame.bendTime, 'bendTime');
    this.amounts = arrayOf(frame, `amountsOf${link}`);
    const [shapes, places] = frame.shapes[`shapeOf${link}`];
    this.shapes = shapes;
    this.places = places;
    /** @type {Record<string, Float64Array>} */
    this.tables = {};
    for (const [name, [rows, scales]] of Object.entries(ARRAYS)) {
      const scale = arrayOf(frame, `${scales}${link}`);
      this.tables[name] = arrayOf(frame, `${rows}${link}`).map((row, k) => row * scale[Math.floor(k / places)]);
    }
  }
  /**
   * Values along it at one instant: at all places, or at every `every`-th from `first`.
   * @param {number} t  [s]
   * @param {What} what
   * @param {Out} [out]
   * @param {number} [first]
   * @param {number} [every]
   */
  profile(t, what, out = new Float64Array(this.places), first = 0, every = 1) {
    const { amounts, places, shapes, time } = this;
    const table = this.tables[TABLES[what]];
    const k = Math.min(indexAt(time, t), time.length - 2);
    const step = time[k + 1] - time[k];
    const part = Math.min(Math.max((t - time[k]) / step, 0), 1);
    const [before, after] = what === 'velocity' ? [-1 / step, 1 / step] : [1 - part, part];
    for (let j = first; j < places; j += every) out[j] = 0;
    for (let i = 0; i < shapes; i++) {
      const amount = before * amounts[k * shapes + i] + after * amounts[(k + 1) * shapes + i];
      for (let j = first; j < places; j += every) out[j] += amount * table[i * places + j];
    }
    return out;
  }
  /** The largest deflection [m]. */
  get largest() {
    let most = 0;
    const row = new Float64Array(this.places);
    const end = this.time[this.time.length - 1];
    for (let k = 0; k < SURVEYED; k++)
      for (const value of this.profile((k / (SURVEYED - 1)) * end, 'deflection', row))
        most = Math.max(most, Math.abs(value));
    return most;
  }
}

/**
 * Links that bend, by their number; of others nothing.
 * @param {MechanismFrame} frame
 * @returns {(Bending | null)[]}
 */
export const bendingOf = (frame) =>
  frame.mechanism.links.map((_, n) => (frame.shapes[`shapeOf${n}`] ? new Bending(frame, n) : null));
