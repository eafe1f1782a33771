// The method beside, by modes of the rod, of the browser's own answers.
import { figuresOf } from './figures.js';

/** @import { AxialFrame, Chosen, LawRecord } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

/** Histories of a method beside. */
const BESIDE = ['otherTime', 'otherForce', 'otherMass', 'otherEnd', 'modalForce', 'fieldForce', 'balanceTime'];

/**
 * Whether it is by modes as they are usually marched.
 * @param {AxialFrame} frame
 */
export const byModes = ({ modalForce, other, usualSteps }) => Boolean(other && modalForce && usualSteps);

/**
 * The method beside an impact that was found here; nothing of it where only the server has it, or there is no room.
 * @param {Kernels} kernels
 * @param {AxialFrame} from  the server's answer to other choices
 * @param {AxialFrame} made  with its scales
 * @param {LawRecord} law
 * @returns {Partial<AxialFrame>}
 */
export function besideOf(kernels, from, made, law) {
  const { other } = from;
  const { chosen, contacts, duration, forceUnit, impactor, target, trip } = { ...made, contacts: made.exact.contacts };
  const side = from.rods[0].mirror > 0 ? 1 : -1;
  const modes = Number(chosen.modes);
  const [, touching] = contacts[contacts.length - 1];
  const found =
    other && byModes(from) && kernels.modes(target.mass / impactor.mass, side, law, modes, touching, duration);
  if (!found) return without(from);
  const step = duration / found.force.length;
  const at = (/** @type {number} */ time) => found.force[Math.floor(time / step + 1e-9)];
  const figures = figuresOf(made, other, { ...found, cycle: law.constants.length ? found : null }, at);
  const { diagnostics, restitution } = figures;
  const apart = law.constants.length ? restitution.newton_at_contact : null; // of rigid contact the modes chatter
  const { highest, touches, window } = found;
  return {
    ...{ modalForce: found.force, otherMass: found.mass, otherEnd: found.end, step, modes },
    other: {
      ...figures,
      restitution: { ...restitution, newton_at_contact: apart },
      diagnostics: {
        ...{ ...diagnostics, raw_contacts: touches, raw_peak_force: highest * forceUnit },
        ...{ resolved_time: window * trip, steps: found.force.length, estimated_error: null },
      },
    },
  };
}

/**
 * Without the method beside.
 * @param {AxialFrame} frame
 * @returns {Partial<AxialFrame>}
 */
const without = (frame) => ({
  ...Object.fromEntries(BESIDE.filter((name) => name in frame).map((name) => [name, undefined])),
  other: null,
  step: null,
});
