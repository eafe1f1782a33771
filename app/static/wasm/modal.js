// The method beside, by modes of the rod, of the browser's own answers.
import { attachedModes } from '../axial/attached_modes.js';
import { figuresOf } from './figures.js';

/** @import { AxialFrame, LawRecord } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

const MOST_ATTACHED = 100; // modes that are found anew within a picture

/**
 * Whether it is by modes as they are usually marched.
 * @param {AxialFrame} frame
 */
export const byModes = ({ fieldForce, givesWay, modalForce, other, usualSteps }) =>
  Boolean(other && usualSteps && (modalForce || (fieldForce && !givesWay)));

/**
 * The method beside an impact that was found here. Nothing where there is no room, or where its bodies still touch as
 * the time ends: then the server solves both for longer.
 * @param {Kernels} kernels
 * @param {AxialFrame} made  with its scales, and the method beside of other choices
 * @param {LawRecord} law
 * @returns {Partial<AxialFrame> | null}
 */
export function besideOf(kernels, made, law) {
  const begun = performance.now();
  const { attached, chosen, duration, exact, forceUnit, givesWay, impactor, other, rods, target, trip } = made;
  if (!other) return {};
  const side = rods[0].mirror > 0 ? 1 : -1;
  const modes = Number(chosen.modes);
  const [, touching] = exact.contacts[exact.contacts.length - 1];
  if (!givesWay && (!law.constants.length || (attached && modes > MOST_ATTACHED))) return null;
  const kind = givesWay ? 'own' : attached ? 'given' : 'stiff';
  const of = attached ? ofFrame(modes) : undefined;
  const found = kernels.modes(target.mass / impactor.mass, side, law, modes, touching, duration, kind, of);
  if (!found) return null;
  const { contacts, force, highest, touches, window } = found;
  if (contacts[contacts.length - 1].end >= duration * (1 - 1e-12)) return null;
  const step = duration / force.length;
  const at = (/** @type {number} */ time) => force[Math.floor(time / step + 1e-9)];
  const figures = figuresOf(made, other, { ...found, cycle: law.constants.length ? found : null }, at);
  const { diagnostics, restitution } = figures;
  const apart = law.constants.length ? restitution.newton_at_contact : null; // of rigid contact the modes chatter
  return {
    ...{ otherMass: found.mass, otherEnd: found.end, step, modes },
    ...(givesWay ? { modalForce: force } : { fieldForce: force, ...doubled(force, step) }),
    other: {
      ...figures,
      restitution: { ...restitution, newton_at_contact: apart },
      diagnostics: {
        ...{ ...diagnostics, raw_contacts: touches, raw_peak_force: highest * forceUnit },
        ...{ resolved_time: window * trip, steps: force.length, estimated_error: null },
        wall_time: (performance.now() - begun) / 1e3,
      },
    },
  };
}

/**
 * Modes of a free rod by a frame fixed to its struck end, with amplitudes where it is struck.
 * @param {number} count
 */
export function ofFrame(count) {
  const { felt, omega } = attachedModes(count);
  return { frequencies: omega, atContact: felt.map((each) => Math.sqrt(2 * each)) };
}

/**
 * A force that is constant over each step.
 * @param {Float64Array} force
 * @param {number} step
 */
const doubled = (force, step) => ({
  otherTime: new Float64Array(2 * force.length).map((_, k) => ((k + 1) >> 1) * step),
  otherForce: new Float64Array(2 * force.length).map((_, k) => force[k >> 1]),
});
