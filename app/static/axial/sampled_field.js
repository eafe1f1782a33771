// The field of rods by methods whose fields cannot be rebuilt in the browser.
import { evenly } from '../charts/scale.js';
import { given } from '../wire/message.js';
import { Field } from './fields.js';

/** @import { Range } from '../charts/scale.js' */
/** @import { AxialFrame } from '../messages.js' */
/** @import { What } from './fields.js' */

/** Fields sampled by the server, straight between their instants and places. */
export class SampledField extends Field {
  coarse = true;

  /**
   * @param {AxialFrame} frame
   * @param {'exact' | 'other'} solution
   */
  constructor(frame, solution) {
    super(frame, solution);
    const exact = solution === 'exact';
    this.from = frame.rods[0]?.from ?? 0;
    this.to = frame.rods.at(-1)?.to ?? 0;
    this.tables = {
      stress: given(exact ? frame.exactStress : frame.fieldStress, 'stress'),
      velocity: given(exact ? frame.exactVelocity : frame.fieldVelocity, 'velocity'),
      displacement: given(exact ? frame.exactDisplacement : frame.fieldDisplacement, 'displacement'),
    };
    const [instants, places] = frame.shapes[exact ? 'exactStress' : 'fieldStress'];
    this.instants = instants;
    this.places = places;
  }
  /**
   * The largest anywhere.
   * @param {What} what
   */
  largest(what) {
    return this.tables[what].reduce((/** @type {number} */ most, value) => Math.max(most, Math.abs(value)), 1e-12);
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Float64Array} out
   */
  profile(t, what, out) {
    const { frame, instants, places } = this;
    const n = out.length - 1;
    const field = this.tables[what];
    const row = Math.min(Math.max(t / frame.duration, 0), 1) * (instants - 1);
    const i = Math.min(Math.floor(row), instants - 2);
    const a = row - i;
    for (let k = 0; k <= n; k++) {
      const place = (k / n) * (places - 1);
      const j = Math.min(Math.floor(place), places - 2);
      const b = place - j;
      const p = i * places + j;
      out[k] =
        (1 - a) * ((1 - b) * field[p] + b * field[p + 1]) +
        a * ((1 - b) * field[p + places] + b * field[p + places + 1]);
    }
    return out;
  }
  /**
   * @param {number} place
   * @param {Range} _stretch
   * @param {What} what
   */
  history(place, _stretch, what) {
    const along = (this.to > this.from ? (place - this.from) / (this.to - this.from) : 0) * (this.places - 1);
    const j = Math.min(Math.max(Math.floor(along), 0), this.places - 2);
    const table = this.tables[what];
    return evenly([0, this.frame.duration], this.instants - 1, (_, i) => {
      const p = i * this.places + j;
      return table[p] + (along - j) * (table[p + 1] - table[p]);
    });
  }
}
