// The quasi-static method beside, of a fixed rod that bends as a spring, of the browser's own answers.
import { between } from '../charts/scale.js';
import { figuresOf } from './figures.js';
import { FIELD } from './room.js';

/** @import { AxialFrame } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

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
  const begun = performance.now();
  const { duration, forceUnit, impactor, other, shapes, springCarries, target, trip } = made;
  const found = other && kernels.spring(target.mass / impactor.mass, springCarries ?? 0, duration);
  if (!found) return null;
  const at = (/** @type {number} */ time) => between(found.forceTime, found.force, time);
  const figures = figuresOf(made, other, { ...found, target: 0, local: 0, cycle: null }, at);
  return {
    ...{ otherMass: found.mass, otherEnd: found.end, otherTime: found.forceTime, otherForce: found.force },
    ...{ fieldStress: found.stress, fieldVelocity: found.velocity, fieldDisplacement: found.displacement },
    shapes: { ...shapes, fieldStress: FIELD, fieldVelocity: FIELD, fieldDisplacement: FIELD },
    other: {
      ...figures,
      diagnostics: {
        ...figures.diagnostics,
        ...{ initial_impulse: found.atOnce * forceUnit * trip, peak_root_force: found.root * forceUnit },
        ...{ steps: found.steps, wall_time: (performance.now() - begun) / 1e3 },
      },
    },
  };
}
