// Contact laws of the browser's own answers: their constants at other choices, and what the page shows of them.
import { LAWS } from './room.js';

/** @import { AxialFrame, Chosen, LawRecord } from '../messages.js' */
/** @import { Cycle, Impact, Kernels } from './kernels.js' */

const BEYOND = 1.02; // times the parting: up to there indentation and force are drawn over each other
const PRESSURE = 1.5; // of Hertz in the middle, times the mean one
const CYCLE = ['cycleDepth', 'cycleLoading', 'cycleUnloading', 'blowDepth', 'blowForce'];
const TOUCH = ['touchTime', 'touchRadius', 'touchPressure', 'touchFlow'];
const FLOW = ['flowDepth', 'flowPressure', 'flowRadius', 'flowElastic', 'testsDepth', 'testsPressure', 'testsForce'];

/**
 * A message with the laws that can be chosen.
 * @typedef {Pick<AxialFrame, 'acting' | 'chosen' | 'flowDepth' | 'laws' | 'leastRestitution' | 'touchFlow'>} Lawful
 */

/** @typedef {'blowDepth' | 'flowDepth' | 'flowElastic' | 'touchFlow' | 'touchPressure' | 'touchRadius'} Touching */

/**
 * Whether a choice is that of the law, or of a stiffness.
 * @param {Lawful} frame
 * @param {string} name
 */
export const setsLaw = ({ laws }, name) => name === 'law' || laws.some(({ stiffness }) => stiffness === name);

/**
 * Whether the law of an answer takes another restitution by itself.
 * @param {Lawful} frame
 */
export function takesRestitution({ chosen, laws }) {
  const law = laws.find(({ name }) => name === chosen.law);
  return Boolean(law && (!law.damps || law.damping));
}

/**
 * The law that is chosen, with the constants that it then has; nothing where the server alone knows these.
 * @param {Kernels} kernels
 * @param {Lawful} from
 * @param {Chosen} chosen
 * @param {number} speed  times as high
 * @param {number} mass  that both bodies are felt with, times as large
 * @returns {LawRecord | null}
 */
export function lawFor(kernels, { chosen: before, laws, leastRestitution }, chosen, speed, mass) {
  const law = laws.find(({ name }) => name === chosen.law);
  if (!law || (law.constants.length && !LAWS.includes(law.name))) return null;
  const changed = law.choices.filter((name) => chosen[name] !== before[name]);
  const restored = chosen.restitution !== before.restitution;
  if (law.damps && restored && !law.damping) return null;
  if (changed.some((name) => name !== law.stiffness)) return null;
  const harder = stiffened(law, before, chosen);
  const powers = (/** @type {number} */ k) =>
    speed ** law.bySpeed[k] * mass ** law.byMass[k] * harder ** (law.byStiffness[k] ?? 0);
  const constants = law.constants.map((value, k) => value * powers(k));
  if (!restored || !law.damping) return { ...law, constants };
  const [place, unit] = law.damping;
  const { nominal, number } = kernels.dashpot(law.name, Math.max(Number(chosen.restitution), leastRestitution));
  constants[place] = number * unit * powers(place);
  return { ...law, nominal, constants };
}

/**
 * How many times as stiff it is by its own choice.
 * @param {LawRecord} law
 * @param {Chosen} before
 * @param {Chosen} chosen
 */
const stiffened = ({ stiffness }, before, chosen) =>
  stiffness ? Number(chosen[stiffness]) / Number(before[stiffness]) : 1;

/**
 * The mass [kg] with which both bodies are felt.
 * @param {number} mass  of what strikes
 * @param {{ held: boolean, mass: number }} target
 */
export const felt = (mass, target) => (target.held ? mass : mass / (1 + mass / target.mass));

/**
 * A message without what belongs to an impact by another law, and with the choices that act by this one. How a material
 * flows as it is pressed on slowly stays where the law does: up to the depth that the server has shown.
 * @template {Lawful} F
 * @param {F} from
 * @param {LawRecord} law
 * @param {Chosen} chosen
 * @returns {F}
 */
export function withLaw(from, law, chosen) {
  const { choices, name, yields } = law;
  const unknown = yields && !(from.flowDepth && from.touchFlow); // then only the server can say how it flows
  const gone = name !== from.chosen.law ? [...CYCLE, ...TOUCH, ...FLOW] : unknown ? [...TOUCH, ...FLOW] : [];
  /** @type {Record<string, any>} */
  const kept = Object.fromEntries(Object.entries(from).filter(([each]) => !gone.includes(each)));
  const harder = stiffened(law, from.chosen, chosen);
  if (kept.flowPressure) kept.flowPressure = kept.flowPressure.map((/** @type {number} */ p) => p * harder);
  const others = from.laws.flatMap((other) => other.choices);
  const acting = [...from.acting.filter((each) => !others.includes(each)), ...choices];
  return /** @type {F} */ ({ ...kept, acting });
}

/**
 * Indentation and force by the law, and what the impact did [m, N].
 * @param {Pick<AxialFrame, 'forceUnit' | 'speed' | 'trip' | Touching>} made
 * @param {Pick<Impact, 'contacts' | 'duration'>} impact
 * @param {Cycle} cycle
 * @returns {Partial<AxialFrame>}
 */
export function cycleOf(made, { contacts, duration }, cycle) {
  const { forceUnit, speed, trip } = made;
  const unit = speed * trip;
  const [depth, force] = [cycle.depths.map((a) => a * unit), cycle.presses.map((f) => f * forceUnit)];
  const newtons = (/** @type {Float64Array} */ values) => values.map((f) => f * forceUnit);
  const found = {
    cycleDepth: cycle.loading.map((_, k, all) => (k / (all.length - 1)) * cycle.deepest * unit),
    ...{ cycleLoading: newtons(cycle.loading), cycleUnloading: newtons(cycle.unloading) },
    ...{ blowDepth: depth, blowForce: force },
  };
  const until = Math.min(duration, BEYOND * contacts[contacts.length - 1].end) * trip;
  const touch = touchOf(
    made,
    depth,
    force,
    cycle.widths?.map((width) => width * unit),
  );
  return { ...found, ...(touch && { touchTime: depth.map((_, k, all) => (k / (all.length - 1)) * until), ...touch }) };
}

/**
 * The circle on which two smooth bodies touch, by Hertz or as the material flows, where the server has shown another.
 * @param {Pick<AxialFrame, Touching>} before
 * @param {Float64Array} depth
 * @param {Float64Array} force
 * @param {Float64Array} [widths]  square of its radius over that of the faces [m]
 */
function touchOf({ blowDepth, flowDepth, flowElastic, touchFlow, touchPressure, touchRadius }, depth, force, widths) {
  if (!touchRadius || !blowDepth) return null;
  const deepest = touchRadius.indexOf(Math.max(...touchRadius));
  if (!touchFlow || !flowDepth || !flowElastic || !touchPressure) {
    const round = touchRadius[deepest] ** 2 / blowDepth[deepest]; // radius of the faces, as a^2 = alpha R
    return {
      touchRadius: depth.map((a) => Math.sqrt(Math.max(a, 0) * round)),
      touchPressure: depth.map((a, k) => (a > 0 ? (PRESSURE * force[k]) / (Math.PI * a * round) : 0)),
    };
  }
  const last = flowDepth.length - 1;
  const round = flowElastic[last] ** 2 / flowDepth[last];
  const strength = touchPressure[deepest] / touchFlow[deepest];
  const squares = force.map((f, k) => (f > 0 && widths ? round * widths[k] : 0));
  const pressure = squares.map((square, k) => (square > 0 ? force[k] / (Math.PI * square) : 0));
  return {
    ...{ touchRadius: squares.map((square) => Math.sqrt(square)), touchPressure: pressure },
    touchFlow: pressure.map((each) => each / strength),
  };
}
