// The field of a message.
import { ModalBeamField } from './field.js';
import { SampledBeamField } from './sampled_field.js';

/** @import { BendingFrame } from '../messages.js' */

/**
 * @param {BendingFrame} frame
 * @param {string} [room]  of a field that is shown beside another
 */
export function fieldOf(frame, room = '') {
  return frame.modalForce ? new ModalBeamField(frame, room) : new SampledBeamField(frame, room);
}
