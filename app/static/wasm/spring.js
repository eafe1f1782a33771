// The quasi-static method beside, of a fixed rod that bends as a spring, of the browser's own answers.
import { between } from '../charts/scale.js';
import { figuresOf } from './figures.js';
import { FIELD } from './room.js';

/** @import { AxialFrame } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

const [STIFFNESS, MASS] = [2, 0.5]; // of any uniform rod [Z / T, Z T]

/**
 * Whether the method beside bends the rod so.
 * @param {AxialFrame} frame
 */
export const bySpring = ({ other, springCarries }) => Boolean(other && springCarries !== null);

/**
 * The method beside an impact that was found here. Nothing where its bodies still touch as the time ends: then the
 * server solves both for longer.
 * @param {Kernels} kernels
 * @param {AxialFrame} made  with its scales, and the method beside of other choices
 * @returns {Partial<AxialFrame> | null}
 */
export function besideBySpring(kernels, made) {
  const { impactor, shapes, springCarries, target } = made;
  const striker = (MASS * impactor.mass) / target.mass;
  const found = onSpring(kernels, made, striker, MASS * (springCarries ?? 0), STIFFNESS);
  if (!found) return null;
  return {
    ...found.beside,
    ...{ fieldStress: found.stress, fieldVelocity: found.velocity, fieldDisplacement: found.displacement },
    shapes: { ...shapes, fieldStress: FIELD, fieldVelocity: FIELD, fieldDisplacement: FIELD },
  };
}

/**
 * What any spring does beside an impact that was found here, and its fields as those of a rod.
 * @param {Kernels} kernels
 * @param {AxialFrame} made
 * @param {number} mass  [Z T], as is that which goes with its end
 * @param {number} moving
 * @param {number} stiffness  [Z / T]
 */
export function onSpring(kernels, made, mass, moving, stiffness) {
  const begun = performance.now();
  const { duration, forceUnit, other, trip } = made;
  const found = other && kernels.spring(mass, moving, stiffness, duration);
  if (!found) return null;
  const at = (/** @type {number} */ time) => between(found.forceTime, found.force, time);
  const figures = figuresOf(made, other, { ...found, target: 0, local: 0, cycle: null }, at);
  const diagnostics = {
    ...figures.diagnostics,
    ...{ initial_impulse: found.atOnce * forceUnit * trip, peak_root_force: found.root * forceUnit },
    ...{ steps: found.steps, wall_time: (performance.now() - begun) / 1e3 },
  };
  return {
    ...{ stress: found.stress, velocity: found.velocity, displacement: found.displacement },
    beside: {
      ...{ otherMass: found.mass, otherEnd: found.end, otherTime: found.forceTime, otherForce: found.force },
      other: { ...figures, diagnostics },
    },
  };
}
