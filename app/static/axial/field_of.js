// The fields of a message: of its exact solution, and of the method beside it.
import { drawnFromOther } from './drawn.js';
import { Field, RigidField, WaveField } from './fields.js';
import { ModalField } from './modal_field.js';
import { SampledField } from './sampled_field.js';

/** @import { AxialFrame } from '../messages.js' */

/** @param {AxialFrame} frame */
export function exactFieldOf(frame) {
  if (frame.exactStress) return new SampledField(frame, 'exact');
  return frame.rods.length ? new WaveField(frame) : new Field(frame, 'exact');
}

/** @param {AxialFrame} frame */
export function otherFieldOf(frame) {
  if (frame.modalForce || frame.fieldForce) return new ModalField(frame);
  if (frame.fieldStress) return new SampledField(frame, 'other');
  return frame.rods.length ? new RigidField(frame) : new Field(frame, 'other');
}

/**
 * The field that the pictures of a message show.
 * @param {AxialFrame} frame
 */
export const fieldOf = (frame) => (drawnFromOther(frame) ? otherFieldOf(frame) : exactFieldOf(frame));
