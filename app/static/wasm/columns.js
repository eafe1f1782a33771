// What is found of each of many impacts: names as in solvers/studies/figures.py; `vibration` and `dissipated` are
// shares of the energy at first. In SI units, NaN where there is none; a `status` other than 0 says that there are
// none at all.

/** @import { AxialFrame, BeamFrame, Frame } from '../messages.js' */

export const COLUMNS = [
  ...['status', 'contacts', 'impactor_velocity', 'target_velocity', 'peak_force', 'contact_time'],
  ...['newton', 'vibration', 'dissipated', 'peak_indentation', 'peak_stress'],
];

/**
 * Those of an answer that is there; nothing of kinds whose answers do not say them all.
 * @param {Frame} frame
 * @returns {Float64Array | null}
 */
export function columnsOf(frame) {
  if (frame.kind === 'axial') return axialColumns(frame);
  return frame.kind === 'beam' ? bentColumns(frame) : null;
}

/**
 * Of both alike.
 * @param {import('../messages.js').Figures} figures
 */
function shared({ energy, peakForce, peakIndentation, restitution }) {
  return {
    newton: restitution.newton ?? NaN,
    peak: peakForce ?? NaN,
    vibration: energy.target_vibration / energy.initial,
    dissipated: energy.dissipated / energy.initial,
    indentation: peakIndentation ?? NaN,
  };
}

/** @param {AxialFrame} frame */
function axialColumns({ exact, speed, target, trip }) {
  const { dissipated, indentation, newton, peak, vibration } = shared(exact);
  const time = exact.contacts.reduce((sum, [start, end]) => sum + end - start, 0) * trip;
  const gone = target.held ? NaN : exact.targetFinal * speed;
  const velocity = (exact.final ?? NaN) * speed;
  const count = exact.contacts.length;
  return Float64Array.of(0, count, velocity, gone, peak, time, newton, vibration, dissipated, indentation, NaN);
}

/** @param {BeamFrame} frame */
function bentColumns({ beam, main, span }) {
  const { dissipated, indentation, newton, peak, vibration } = shared(main);
  const gone = beam.held ? NaN : main.targetFinal;
  const velocity = main.final ?? NaN;
  const { contacts } = main;
  return Float64Array.of(0, contacts, velocity, gone, peak, span.real, newton, vibration, dissipated, indentation, NaN);
}
