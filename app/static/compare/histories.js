// What charts overlay of a solution, in SI units, whatever kind of impact it is.
import { averaged, pair } from '../charts/scale.js';
import { given } from '../shell/message.js';

/** @import { Samples } from '../charts/scale.js' */
/** @import { AxialFrame, BendingFrame, Contact, Frame, Numbers } from '../messages.js' */

/**
 * Over time [s]: force [N], displacements [m], velocities [m/s] where they are known, contacts.
 * @typedef {object} Histories
 * @property {Samples | null} force
 * @property {Samples | null} impactor
 * @property {Samples | null} struck
 * @property {Samples | null} impactorRate
 * @property {Samples | null} struckRate
 * @property {[start: number, end: number][]} contacts
 */

/**
 * @param {Samples | null} samples
 * @param {number} x  factors
 * @param {number} y
 * @returns {Samples | null}
 */
const scaled = (samples, x, y) =>
  samples && {
    x: Float32Array.from(Array.from(samples.x), (value) => value * x),
    y: Float32Array.from(Array.from(samples.y), (value) => value * y),
  };

/**
 * @param {Contact[]} contacts
 * @param {number} unit  of their times [s]
 */
const spansOf = (contacts, unit) =>
  contacts.map(([start, end]) => /** @type {[number, number]} */ ([start * unit, end * unit]));

/**
 * @param {AxialFrame} frame
 * @returns {Samples | null}  the force of the other method, as its chart shows it
 */
function otherForce({ modalForce, other, otherForce: y, otherTime, step, trip }) {
  if (!modalForce || !other) return pair(otherTime, y);
  return averaged(modalForce, given(step, 'step'), given(other.diagnostics.resolved_time, 'resolved_time') / trip);
}

/**
 * @param {AxialFrame} frame
 * @param {'exact' | 'other'} which
 * @returns {Histories}
 */
function ofAxial(frame, which) {
  const { forceUnit, speed, trip } = frame;
  const exact = which === 'exact';
  const [impactor, struck] = exact ? [frame.exactMass, frame.exactEnd] : [frame.otherMass, frame.otherEnd];
  const path = (/** @type {Numbers | undefined} */ y) => scaled(pair(frame.motionTime, y), trip, speed * trip);
  const force = exact ? { x: frame.exactTime, y: frame.exactForce } : otherForce(frame);
  return {
    force: scaled(force, trip, forceUnit),
    impactor: path(impactor),
    struck: path(struck),
    impactorRate: null,
    struckRate: null,
    contacts: spansOf(frame[which]?.contacts ?? [], trip),
  };
}

/**
 * @param {BendingFrame} frame
 * @returns {Histories}
 */
function ofBeam(frame) {
  const { impactorPath, impactorRate, modalForce, struckPath, struckRate, time } = frame;
  const over = (/** @type {Numbers} */ y) => ({ x: time, y });
  let force = pair(frame.mainTime, frame.mainForce);
  if (modalForce) {
    const step = given(frame.step, 'step');
    force = averaged(modalForce, step, (frame.law.rigid && frame.main.diagnostics.resolved_time) || step);
  }
  return {
    force,
    impactor: over(impactorPath),
    struck: over(struckPath),
    impactorRate: over(impactorRate),
    struckRate: over(struckRate),
    contacts: spansOf(frame.contacts, 1),
  };
}

/**
 * Histories of a solution; none of an impulse in space, which takes no time.
 * @param {Frame} frame
 * @param {'exact' | 'other'} which  of the two solutions of an impact along an axis
 * @returns {Histories | null}
 */
export function historiesOf(frame, which) {
  if (frame.kind === 'bodies') return null;
  return 'main' in frame ? ofBeam(frame) : ofAxial(frame, which);
}
