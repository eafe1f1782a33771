// What the page draws of a mass on a uniform rod, by the browser's own answer: a message like that of the server.
import { between } from '../charts/scale.js';
import { cycleOf, lawFor, setsLaw, takesRestitution, withLaw } from './law.js';

/** @import { AxialFigures, AxialFrame, Chosen, Contact, Energies} from '../messages.js' */
/** @import { Impact, Kernels } from './kernels.js' */

const FOLLOWED = ['mass_ratio', 'restitution', 'speed'];
const LINEAR = 1e-9; // a power of the speed that is none
const CUT = { before: 0.02, share: 0.1 }; // of T, and of the peak: what a force still is that a wave cuts off
const ERROR = { rigid: 1e-15, law: 1e-9 }; // the least that is claimed: rounding, and the tolerance of a step
/** Histories of the method beside, which only the server solves. */
const BESIDE = ['otherTime', 'otherForce', 'otherMass', 'otherEnd', 'modalForce', 'fieldForce', 'balanceTime'];

/**
 * Choices that it follows; all others are left to the server.
 * @param {AxialFrame} frame
 * @param {string} name
 */
export const follows = (frame, name) =>
  setsLaw(frame, name) || (FOLLOWED.includes(name) && (name !== 'restitution' || takesRestitution(frame)));

/**
 * Whether an answer of the server is one of these impacts, followed for as long as is usual.
 * @param {AxialFrame} frame
 */
export function isRod(frame) {
  const { chosen, draft, duration, exact, fall, impactor, rods, stretch, target } = frame;
  const [rod] = rods;
  const alone = rods.length === 1 && rod.mirror !== 0 && rod.drift === 0 && !target.rotation && !target.endMass;
  const mass = ['mass', 'sphere'].includes(impactor.kind) && impactor.mass > 0;
  const last = exact.contacts.at(-1)?.[1] ?? NaN;
  const usual = Math.abs(duration - last - 1) < 1e-9 && !draft && !stretch && !fall;
  return alone && mass && pressed(frame) && exact.travelling && usual && exact.name === chosen.method;
}

/**
 * Whether the faces press on each other in a way that is known: of how a material flows there is more to tell.
 * @param {AxialFrame} frame
 */
const pressed = ({ chosen, flowDepth, laws, touchFlow }) =>
  laws.some(({ name }) => name === chosen.law) && !flowDepth && !touchFlow;

/**
 * The same impact with other choices.
 * @param {Kernels} kernels
 * @param {AxialFrame} from  the server's answer to the last ones
 * @param {Chosen} chosen  that differ in what is followed alone
 * @returns {AxialFrame | null}
 */
export function rodWith(kernels, from, chosen) {
  const begun = performance.now();
  const change = Number(chosen.mass_ratio) / Number(from.chosen.mass_ratio);
  const mass = change === 1 || Number.isNaN(change) ? from.impactor.mass : from.target.mass / Number(chosen.mass_ratio);
  const beta = from.target.mass / mass;
  const speed = Number(chosen.speed);
  const times = speed / from.speed;
  const law = lawFor(kernels, from, chosen, times, felt(from, mass) / felt(from, from.impactor.mass));
  const side = from.rods[0].mirror > 0 ? 1 : -1;
  const impact = law && (law.constants.length ? kernels.law(beta, side, law) : kernels.rod(beta, side));
  if (!impact) return null;
  const scales = { speed, forceUnit: from.forceUnit * times, stressUnit: from.stressUnit * times };
  const { duration, histories: drawn } = impact;
  const made = {
    ...withLaw(from, law),
    ...scales,
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
  const exact = figuresOf(made, impact);
  exact.diagnostics = { ...exact.diagnostics, wall_time: (performance.now() - begun) / 1e3 };
  const settings = ['law', ...law.choices, ...(from.other?.byLaw && !law.damps ? [] : ['restitution'])];
  const same = mass === from.impactor.mass && settings.every((name) => chosen[name] === from.chosen[name]);
  const linear = law.bySpeed.every((power) => Math.abs(power) < LINEAR); // all grows with the speed
  const even = !from.otherMass || from.otherMass.length === drawn.mass.length; // not those of a stretch seen closer
  const steady = same && even && (times === 1 || linear);
  const beside = steady ? { other: from.other && faster(from.other, times) } : without(from);
  if (same && times === 1) exact.notes = from.exact.notes;
  return { ...made, exact, match: exact.restitution.newton, ...beside };
}

/**
 * The mass [kg] with which both bodies are felt if the striker has this one.
 * @param {AxialFrame} frame
 * @param {number} mass
 */
const felt = ({ target }, mass) => (target.held ? mass : mass / (1 + mass / target.mass));

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

/**
 * The same figures of an impact at another speed.
 * @param {AxialFigures} figures
 * @param {number} times  as fast
 * @returns {AxialFigures}
 */
function faster(figures, times) {
  /** @type {(contact: Contact) => Contact} */
  const scaled = ([start, end, impulse, peak]) => [start, end, impulse * times, peak && peak * times];
  const energy = /** @type {Energies} */ (
    Object.fromEntries(Object.entries(figures.energy).map(([name, value]) => [name, value * times * times]))
  );
  const grown = (/** @type {number | null} */ value) => value && value * times;
  return {
    ...figures,
    ...{ contacts: figures.contacts.map(scaled), energy, peakForce: grown(figures.peakForce) },
    peakIndentation: grown(figures.peakIndentation),
    residualIndentation: grown(figures.residualIndentation),
  };
}

/**
 * What rigid-body theory predicts [v], thesis (9.1).
 * @param {number} beta
 * @param {boolean} held
 * @param {number} restitution
 */
function predicted(beta, held, restitution) {
  const share = held ? 1 : beta / (1 + beta);
  const common = held ? 0 : 1 / (1 + beta);
  const impactor = 1 - share * (1 + restitution);
  return { impactor, target: held ? 0 : common + (common - impactor) / beta };
}

/**
 * @param {AxialFrame} frame  with its scales and histories
 * @param {Impact} found
 * @returns {AxialFigures}
 */
function figuresOf(frame, found) {
  const { apart, compressing, contacts, cycle, dissipated, duration, energy, final, impulse } = found;
  const { exact, exactForce, exactTime, forceUnit, impactor, speed, target, trip } = frame;
  const last = contacts[contacts.length - 1];
  const targetFinal = target.held ? 0 : found.target;
  const moving = (/** @type {number} */ mass, /** @type {number} */ v) => 0.5 * mass * (speed * v) ** 2;
  const whole = target.held ? 0 : moving(target.mass, targetFinal);
  const unit = forceUnit * speed * trip;
  const energies = {
    ...{ initial: moving(impactor.mass, 1), impactor: moving(impactor.mass, final), target_rigid: whole },
    ...{ target_vibration: unit * energy - whole, local: 0, dissipated: unit * dissipated },
  };
  const { initial, ...parts } = energies;
  const off = Object.values(parts).reduce((sum, part) => sum + part, -initial) / initial;
  const lost = 1 - final;
  const pushed = (forceUnit * trip * impulse) / (impactor.mass * speed);
  const gained = target.held ? lost : (target.mass * targetFinal) / impactor.mass;
  const unbalanced = Math.max(Math.abs(lost - pushed), Math.abs(gained - lost));
  return {
    ...exact,
    contacts: contacts.map(({ start, end, peak, push }) => [start, end, forceUnit * trip * push, forceUnit * peak]),
    cutOff: contacts.map((contact) => cutOff(contact, exactTime, exactForce)),
    left: contacts.map(({ after }) => after),
    final,
    targetFinal,
    stillTouching: last.end >= duration * (1 - 1e-9),
    peakIndentation: cycle && speed * trip * cycle.deepest,
    residualIndentation: cycle && speed * trip * cycle.dent,
    peakForce: forceUnit * Math.max(...contacts.map(({ peak }) => peak)),
    restitution: {
      newton: targetFinal - final,
      poisson: compressing > 0 ? impulse / compressing - 1 : null,
      newton_at_contact: apart,
    },
    energy: energies,
    diagnostics: {
      ...exact.diagnostics,
      energy_error: off,
      estimated_error: Math.max(Math.abs(off) + unbalanced, cycle ? ERROR.law : ERROR.rigid),
    },
    notes: [],
  };
}

/**
 * Whether the force was taken away at once by an arriving wave, rather than fading to zero.
 * @param {import('./kernels.js').Contact} contact
 * @param {import('../messages.js').Numbers} time
 * @param {import('../messages.js').Numbers} force  [Z v], as the peak
 */
function cutOff({ start, end, peak }, time, force) {
  const before = end - CUT.before;
  return end >= 1 - 1e-9 && before > start && between(time, force, before) > CUT.share * peak;
}
