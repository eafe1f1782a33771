// What the page draws of a mass on a uniform rod, by the browser's own answer: a message like that of the server.
import { between } from '../charts/scale.js';
import { besideByBalance, byBalance } from './balance.js';
import { figuresOf, unbalanced } from './figures.js';
import { cycleOf, felt, lawFor, setsLaw, takesRestitution, withLaw } from './law.js';
import { besideOf, byModes } from './modal.js';
import { besideBySpring, bySpring } from './spring.js';

/** @import { AxialFrame, Chosen, LawRecord } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

const FOLLOWED = ['mass_ratio', 'restitution', 'speed'];
const ERROR = { rigid: 1e-15, law: 1e-9 }; // the least that is claimed: rounding, and the tolerance of a step

/**
 * Choices that it follows; all others are left to the server.
 * @param {AxialFrame} frame
 * @param {string} name
 */
export const follows = (frame, name) =>
  setsLaw(frame, name) ||
  (name === 'modes' && byModes(frame)) ||
  (FOLLOWED.includes(name) && (name !== 'restitution' || takesRestitution(frame)));

/**
 * Whether an answer of the server is one of these impacts, followed for as long as is usual.
 * @param {AxialFrame} frame
 */
export function isRod(frame) {
  const { asked, chosen, draft, duration, exact, fall, impactor, other, rods, stretch, target } = frame;
  const [rod] = rods;
  const alone = rods.length === 1 && rod.mirror !== 0 && rod.drift === 0 && !target.rotation && !target.endMass;
  const mass = ['mass', 'sphere'].includes(impactor.kind) && impactor.mass > 0;
  const last = exact.contacts.at(-1)?.[1] ?? NaN;
  const lasts = asked > 0 || Math.abs(duration - last - 1) < 1e-9;
  const usual = lasts && !draft && !stretch && !fall;
  const beside = !other || byModes(frame) || bySpring(frame) || byBalance(frame);
  const shown = [exact.name, other?.name].includes(String(chosen.method)) && beside;
  return alone && mass && pressed(frame) && exact.travelling && usual && shown;
}

/**
 * Whether the faces press on each other in a way that is known: of how a material flows there is more to tell.
 * @param {AxialFrame} frame
 */
const pressed = ({ chosen, flowDepth, laws, touchFlow }) =>
  laws.some(({ name }) => name === chosen.law) && !flowDepth && !touchFlow;

/**
 * What strikes, and how, by other choices; nothing where the server alone knows the law.
 * @param {Kernels} kernels
 * @param {AxialFrame} from  the server's answer to the last ones
 * @param {Chosen} chosen  that differ in what is followed alone
 */
export function strikingBy(kernels, from, chosen) {
  const change = Number(chosen.mass_ratio) / Number(from.chosen.mass_ratio);
  const mass = change === 1 || Number.isNaN(change) ? from.impactor.mass : from.target.mass / Number(chosen.mass_ratio);
  const speed = Number(chosen.speed);
  const times = speed / from.speed;
  const heavier = felt(mass, from.target) / felt(from.impactor.mass, from.target);
  const law = lawFor(kernels, from, chosen, times, heavier);
  const side = /** @type {1 | -1} */ (from.rods[0].mirror > 0 ? 1 : -1);
  return law && { asked: from.asked, beta: from.target.mass / mass, law, mass, side, speed, times };
}

/**
 * The same impact with other choices.
 * @param {Kernels} kernels
 * @param {AxialFrame} from  the server's answer to the last ones
 * @param {Chosen} chosen  that differ in what is followed alone
 * @returns {AxialFrame | null}
 */
export function rodWith(kernels, from, chosen) {
  const begun = performance.now();
  const striking = strikingBy(kernels, from, chosen);
  if (!striking) return null;
  const { asked, beta, law, mass, side, speed, times } = striking;
  const through = law.constants.length > 0;
  const impact = through ? kernels.law(beta, side, law, asked) : asked ? null : kernels.rod(beta, side);
  if (!impact) return null;
  const scales = { speed, forceUnit: from.forceUnit * times, stressUnit: from.stressUnit * times };
  const { duration, histories: drawn } = impact;
  const made = {
    ...withLaw(from, law, chosen),
    ...{ damps: law.damps, exponent: law.exponent, nominal: law.nominal, yields: law.yields },
    ...{ ...scales, rigid: !law.constants.length },
    chosen,
    duration,
    impactor: { ...from.impactor, mass },
    prediction: from.prediction && predicted(beta, from.target.held, Number(chosen.restitution)),
    f0Time: drawn.waveTime,
    f0: drawn.wave,
    motionTime: drawn.mass.map((_, k) => (k / (drawn.mass.length - 1)) * duration),
    exactMass: drawn.mass,
    exactEnd: drawn.end,
    exactWhole: from.exactWhole && drawn.whole,
    exactTime: drawn.forceTime,
    exactForce: drawn.force,
  };
  if (impact.cycle) Object.assign(made, cycleOf(made, impact, impact.cycle));
  const at = (/** @type {number} */ time) => between(drawn.forceTime, drawn.force, time);
  const exact = figuresOf(made, from.exact, { ...impact, local: 0 }, at);
  const unsure = Math.abs(exact.diagnostics.energy_error) + unbalanced(made, impact);
  exact.diagnostics.estimated_error = Math.max(unsure, impact.cycle ? ERROR.law : ERROR.rigid);
  exact.diagnostics.wall_time = (performance.now() - begun) / 1e3;
  const whole = { ...made, exact, match: exact.restitution.newton };
  const beside = besideIt(kernels, whole, law);
  if (!beside) return null;
  if (mass === from.impactor.mass && times === 1 && same(from, chosen, law)) {
    exact.notes = from.exact.notes;
    if (beside.other && from.other && chosen.modes === from.chosen.modes) beside.other.notes = from.other.notes;
  }
  return { ...whole, ...beside };
}

/**
 * The method beside, whichever it is.
 * @param {Kernels} kernels
 * @param {AxialFrame} made
 * @param {LawRecord} law
 */
function besideIt(kernels, made, law) {
  if (bySpring(made)) return besideBySpring(kernels, made);
  return byBalance(made) ? besideByBalance(kernels, made) : besideOf(kernels, made, law);
}

/**
 * Whether the law acts as in the server's answer.
 * @param {AxialFrame} from
 * @param {Chosen} chosen
 * @param {LawRecord} law
 */
const same = (from, chosen, law) =>
  ['law', ...law.choices, ...(law.damps ? ['restitution'] : [])].every((name) => chosen[name] === from.chosen[name]);

/**
 * What rigid-body theory predicts [v], thesis (9.1).
 * @param {number} beta
 * @param {boolean} held
 * @param {number} restitution
 */
export function predicted(beta, held, restitution) {
  const share = held ? 1 : beta / (1 + beta);
  const common = held ? 0 : 1 / (1 + beta);
  const impactor = 1 - share * (1 + restitution);
  return { impactor, target: held ? 0 : common + (common - impactor) / beta };
}
