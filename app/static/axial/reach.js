// How far what is drawn moves, so that it stays in the picture.

/** @import { AxialFrame } from '../messages.js' */
/** @import { Field } from './fields.js' */

const INSTANTS = 200; // at which bodies are looked at
const OF_RODS = 40; // and ends of rods, which are dearer to compute

/**
 * Ranges of movement [m]: the largest, the deepest indentation, how far back the striker or the first rod goes, and how
 * far ahead the last rod.
 * @param {AxialFrame} frame
 * @param {Field} field
 * @returns {{ reach: number, pressed: number, back: number, ahead: number }}
 */
export function reachOf(frame, field) {
  const { duration, impactor, rods } = frame;
  const unit = frame.speed * frame.trip;
  let [reach, pressed, back, ahead] = [1e-12, 0, 0, 0];
  for (let k = 0; k <= INSTANTS; k++) {
    const t = (k / INSTANTS) * duration;
    const [mass, face] = [field.mass(t), field.face(t)];
    reach = Math.max(reach, Math.abs(mass), Math.abs(face));
    pressed = Math.max(pressed, mass - face);
    back = Math.max(back, -mass);
  }
  const ends = new Float64Array(2);
  for (let k = 0; k <= OF_RODS && rods.length; k++) {
    field.profile((k / OF_RODS) * duration, 'displacement', ends);
    back = Math.max(back, -ends[0]);
    ahead = Math.max(ahead, ends[1]);
  }
  for (const moved of frame.exactRow ?? []) ahead = Math.max(ahead, moved);
  reach = Math.max(reach, ahead);
  const soft = !['rod', 'pulse'].includes(impactor.kind);
  return { reach: reach * unit, pressed: soft ? pressed * unit : 0, back: back * unit, ahead: ahead * unit };
}
