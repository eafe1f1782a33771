// What the page draws of a mass that strikes another on a spring, by the browser's own answer: a message like that of
// the server, by balances and beside them the spring that carries the mass.
import { balanceImpact, balancedFigures } from './balance.js';
import { felt, withLaw } from './law.js';
import { predicted } from './rod.js';
import { onSpring } from './spring.js';

/** @import { AxialFigures, AxialFrame, Chosen } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

const FOLLOWED = ['mass_ratio', 'restitution', 'speed'];
const BESIDE = ['structural', 'structural-massless'];

/**
 * Choices that it follows.
 * @param {AxialFrame} _
 * @param {string} name
 */
export const follows = (_, name) => FOLLOWED.includes(name);

/**
 * Whether an answer of the server is one of these impacts.
 * @param {AxialFrame} frame
 */
export const isSprung = ({ balance, chosen, exact, fall, other, target }) =>
  Boolean(balance && target.kind === 'spring-mass' && !fall && exact.name === chosen.method) &&
  (!other || BESIDE.includes(String(other.model)));

/**
 * The same impact with other choices.
 * @param {Kernels} kernels
 * @param {AxialFrame} from  the server's answer to the last ones
 * @param {Chosen} chosen  that differ in what is followed alone
 * @returns {AxialFrame | null}
 */
export function sprungWith(kernels, from, chosen) {
  const begun = performance.now();
  const { balance, target, trip } = from;
  const same = chosen.mass_ratio === from.chosen.mass_ratio;
  const mass = same ? from.impactor.mass : target.mass / Number(chosen.mass_ratio);
  const speed = Number(chosen.speed);
  const forceUnit = (felt(mass, target) / trip) * speed;
  const scales = { forceUnit, impactor: { ...from.impactor, mass }, speed, stressUnit: forceUnit };
  const made = { ...withLaw(from, from.laws[0], chosen), ...scales, chosen };
  const found = balance && balanceImpact(kernels, made, 0);
  if (!found) return null;
  const { duration } = found;
  const drawn = {
    ...{
      ...made,
      duration,
      exactMass: found.mass,
      exactEnd: found.end,
      exactTime: found.time,
      exactForce: found.force,
    },
    motionTime: found.mass.map((_, k, all) => (k / (all.length - 1)) * duration),
    prediction: from.prediction && predicted(target.mass / mass, target.held, Number(chosen.restitution)),
  };
  const exact = sudden(balancedFigures(drawn, from.exact, found, begun));
  const whole = { ...drawn, exact, match: exact.restitution.newton };
  const beside = from.other && besideOf(kernels, whole);
  if (from.other && !beside) return null; // then the server solves both for longer
  const unchanged = Object.keys(chosen).every((name) => Object.is(chosen[name], from.chosen[name]));
  if (unchanged) exact.notes = from.exact.notes;
  if (unchanged && beside && from.other) beside.other.notes = from.other.notes;
  return { ...whole, ...beside };
}

/**
 * Of balances that take no time: nothing tells what force there is.
 * @param {AxialFigures} figures
 * @returns {AxialFigures}
 */
const sudden = ({ contacts, ...figures }) => ({
  ...figures,
  peakForce: null,
  contacts: contacts.map(([start, end, push]) => [start, end, push, null]),
});

/**
 * @param {Kernels} kernels
 * @param {AxialFrame} made
 */
function besideOf(kernels, made) {
  const { balance, forceUnit, impactor, other, speed, target, trip } = made;
  const unit = (forceUnit * trip) / speed;
  const moving = target.mass / unit;
  const stiffness = moving * ((balance?.frequencies[0] ?? 0) * trip) ** 2;
  const carried = other?.model === BESIDE[0] ? moving : 0;
  return onSpring(kernels, made, impactor.mass / unit, carried, stiffness)?.beside ?? null;
}
