// Fields of the struck link of a mechanism.
import { BeamField } from '../beam/field.js';
import { fieldOf } from '../beam/field_of.js';
import { bendingOf } from './bending.js';

/** @import { Out, What } from '../beam/field.js' */
/** @import { MechanismFrame } from '../messages.js' */

/** Of one that moves on; a rigid link does not bend. */
class MovingField extends BeamField {
  /**
   * @param {MechanismFrame} frame
   * @param {string} room
   */
  constructor(frame, room) {
    super(frame, room);
    this.bending = bendingOf(frame)[frame.mechanism.struck];
    this.survey();
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Out} [out]
   * @param {number} [first]
   * @param {number} [every]
   */
  profile(t, what, out = new Float64Array(this.places), first = 0, every = 1) {
    return this.bending ? this.bending.profile(t, what, out, first, every) : out.fill(0);
  }
}

/**
 * @param {MechanismFrame} frame
 * @param {string} [room]  of a field that is shown beside another
 */
export const linkField = (frame, room = '') => (frame.moving ? new MovingField(frame, room) : fieldOf(frame, room));
