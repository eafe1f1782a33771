// The field of a beam by methods whose fields cannot be rebuilt in the browser.
import { indexAt } from '../charts/scale.js';
import { given } from '../wire/message.js';
import { BeamField } from './field.js';

/** @import { BendingFrame } from '../messages.js' */
/** @import { Out, What } from './field.js' */

/** Fields sampled by the server, closer together at first. */
export class SampledBeamField extends BeamField {
  /**
   * @param {BendingFrame} frame
   * @param {string} room
   */
  constructor(frame, room) {
    super(frame, room);
    this.time = given(frame.fieldTime, 'fieldTime');
    this.tables = {
      deflection: given(frame.fieldDeflection, 'fieldDeflection'),
      velocity: given(frame.fieldVelocity, 'fieldVelocity'),
      moment: given(frame.fieldMoment, 'fieldMoment'),
      shear: given(frame.fieldShear, 'fieldShear'),
    };
    this.survey();
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Out} out
   */
  profile(t, what, out = new Float64Array(this.places), first = 0, every = 1) {
    const { places, time } = this;
    const table = this.tables[what];
    const low = Math.min(indexAt(time, t), time.length - 2);
    const part = Math.min(Math.max((t - time[low]) / (time[low + 1] - time[low]), 0), 1);
    const [a, b] = [low * places, (low + 1) * places];
    for (let j = first; j < places; j += every) out[j] = (1 - part) * table[a + j] + part * table[b + j];
    return out;
  }
}
