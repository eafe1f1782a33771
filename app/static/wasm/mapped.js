// Figures alone of one impact, by the browser's own answers: for maps of thousands of them.
import { isBent, strikingAcross } from './bending.js';
import { figuresOfWhole, listed } from './columns.js';
import { isRod, strikingBy } from './rod.js';

/** @import { AxialFrame, BeamFrame, Chosen, Frame } from '../messages.js' */
/** @import { Answers } from './answers.js' */
/** @import { Row } from './columns.js' */

const POSITIVE = ['mass_ratio', 'speed'];

/**
 * Whether these are choices that a slider may take, and of which an answer of the server tells.
 * @param {Answers} answers
 * @param {Frame} frame
 * @param {Chosen} chosen
 */
function answered(answers, frame, chosen) {
  const changed = Object.keys(chosen).filter((name) => !Object.is(chosen[name], frame.chosen[name]));
  const numbers = changed.every((name) => typeof chosen[name] !== 'number' || Number.isFinite(chosen[name]));
  const positive = POSITIVE.every((name) => !changed.includes(name) || Number(chosen[name]) > 0);
  const restored = Number(chosen.restitution);
  const restitution = !changed.includes('restitution') || (restored >= 0 && restored <= 1);
  return numbers && positive && restitution && answers.covers(frame, changed);
}

/**
 * One impact; of axial ones the exact solution, whichever method is chosen.
 * @param {Answers} answers
 * @param {Frame} frame  of the server
 * @param {Chosen} chosen
 * @param {number} [tolerance]  of a step of waves through a contact law; 0: that of what is drawn
 * @returns {Float64Array}  (COLUMNS,)
 */
export function figuresAt(answers, frame, chosen, tolerance = 0) {
  if (!answered(answers, frame, chosen)) return listed(null);
  if (frame.kind === 'axial' && isRod(frame)) {
    answers.restLater();
    return listed(ofRod(answers, frame, chosen, tolerance));
  }
  if (frame.kind === 'beam' && isBent(frame)) {
    answers.restLater();
    return listed(ofBeam(answers, frame, chosen));
  }
  return figuresOfWhole(answers.answer(frame, chosen));
}

/**
 * Of a mass on a rod, without histories.
 * @param {Answers} answers
 * @param {AxialFrame} frame
 * @param {Chosen} chosen
 * @param {number} tolerance
 * @returns {Row | null}
 */
function ofRod({ kernels }, frame, chosen, tolerance) {
  const striking = strikingBy(kernels, frame, chosen);
  if (!striking) return null;
  const { asked, beta, law, mass, side, speed, times } = striking;
  const found = kernels.figures(beta, side, law, asked, tolerance);
  if (!found) return null;
  const { forceUnit, stressUnit, target, trip } = frame;
  const force = forceUnit * times;
  const targetFinal = target.held ? 0 : found.target;
  const initial = 0.5 * mass * speed ** 2;
  const whole = target.held ? 0 : 0.5 * target.mass * (speed * targetFinal) ** 2;
  const energy = force * speed * trip;
  const together = found.parting >= found.duration * (1 - 1e-12); // nothing is restored yet
  return {
    ...{
      contacts: found.contacts,
      contact_time: trip * found.touching,
      newton: together ? null : targetFinal - found.final,
    },
    ...{ impactor_velocity: speed * found.final, target_velocity: speed * targetFinal, peak_force: force * found.peak },
    vibration: (energy * found.energy - whole) / initial,
    dissipated: (energy * found.dissipated) / initial,
    peak_indentation: law.constants.length ? speed * trip * found.deepest : null,
    peak_stress: stressUnit * times * found.stress,
  };
}

/**
 * Of a mass across a beam, likewise.
 * @param {Answers} answers
 * @param {BeamFrame} frame
 * @param {Chosen} chosen
 * @returns {Row | null}
 */
function ofBeam({ kernels }, frame, chosen) {
  const striking = strikingAcross(kernels, frame, chosen);
  if (!striking) return null;
  const { law, march, mass, speed, struck } = striking;
  const found = kernels.beamFigures(struck, law);
  if (!found) return null;
  const targetFinal = frame.beam.held ? 0 : found.target;
  const initial = 0.5 * mass;
  const whole = 0.5 * (frame.rigidMass ?? 0) * (found.target / march.mean) ** 2;
  const together = found.parting >= found.duration * (1 - 1e-12); // nothing is restored yet
  return {
    ...{ contacts: found.contacts, contact_time: found.touching },
    newton: together ? null : targetFinal - found.final,
    ...{ impactor_velocity: speed * found.final, target_velocity: speed * targetFinal, peak_force: speed * found.peak },
    vibration: (found.energy - whole) / initial,
    dissipated: found.dissipated / initial,
    peak_indentation: law.constants.length ? speed * found.deepest : null,
    peak_stress: null,
  };
}
