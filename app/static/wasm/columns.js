// What is found of each of many impacts.

/** @import { AxialFigures, AxialFrame, BeamFrame, Frame } from '../messages.js' */

/**
 * What there is of each, in SI units, as solvers/studies/figures.py names it; `vibration` and `dissipated` as shares of
 * the energy before. NaN where there is none; `status`: 0, or 1 where there is no answer here.
 */
export const COLUMNS = [
  ...['status', 'contacts', 'impactor_velocity', 'target_velocity', 'peak_force', 'contact_time', 'newton'],
  ...['vibration', 'dissipated', 'peak_indentation', 'peak_stress'],
];

/** @typedef {Record<string, number | null>} Row  by column */

/**
 * @param {Row | null} row
 * @returns {Float64Array}
 */
export const listed = (row) => Float64Array.from(COLUMNS, (name, k) => (k > 0 ? (row?.[name] ?? NaN) : row ? 0 : 1));

/**
 * Those of a whole answer, if there is one of a kind that says them all.
 * @param {Frame | null} found
 */
export const figuresOfWhole = (found) =>
  listed(found?.kind === 'axial' ? ofAxial(found) : found?.kind === 'beam' ? ofBeam(found) : null);

/**
 * What all whole answers have.
 * @param {Pick<AxialFigures, 'energy' | 'peakForce' | 'peakIndentation' | 'restitution'>} figures
 */
const common = ({ energy, peakForce, peakIndentation, restitution }) => ({
  ...{ peak_force: peakForce, newton: restitution.newton, peak_indentation: peakIndentation },
  vibration: energy.target_vibration / energy.initial,
  dissipated: energy.dissipated / energy.initial,
});

/**
 * @param {AxialFrame} found
 * @returns {Row}
 */
function ofAxial({ exact, speed, trip }) {
  return {
    ...common(exact),
    contacts: exact.contacts.length,
    contact_time: trip * exact.contacts.reduce((sum, [start, end]) => sum + end - start, 0),
    ...{ impactor_velocity: speed * (exact.final ?? NaN), target_velocity: speed * exact.targetFinal },
  };
}

/**
 * @param {BeamFrame} found
 * @returns {Row}
 */
const ofBeam = ({ main, span }) => ({
  ...common(main),
  ...{ contacts: main.contacts, contact_time: span.real },
  ...{ impactor_velocity: main.final, target_velocity: main.targetFinal },
});
