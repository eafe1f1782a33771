// What the page draws of a rigid mass on a uniform rod, by the browser's own answer: a message like that of the server.
import { between } from '../charts/scale.js';

/** @import { AxialFigures, AxialFrame, Chosen, Contact, Energies } from '../messages.js' */
/** @import { Impact, Kernels } from './kernels.js' */

/** Choices that it follows; all others are left to the server. */
export const FOLLOWED = ['mass_ratio', 'restitution', 'speed'];
const CUT = { before: 0.02, share: 0.1 }; // of T, and of the peak: what a force still is that a wave cuts off
const ROUNDING = 1e-15; // the least error that is claimed
/** Histories of the method beside, which only the server solves. */
const BESIDE = ['otherTime', 'otherForce', 'otherMass', 'otherEnd', 'modalForce', 'fieldForce', 'balanceTime'];

/**
 * Whether an answer of the server is one of these impacts, followed for as long as is usual.
 * @param {AxialFrame} frame
 */
export function isRod({ chosen, draft, duration, exact, fall, impactor, rigid, rods, stretch, target }) {
  const [rod] = rods;
  const alone = rods.length === 1 && rod.mirror !== 0 && rod.drift === 0 && !target.rotation && !target.endMass;
  const mass = ['mass', 'sphere'].includes(impactor.kind) && impactor.mass > 0;
  const last = exact.contacts.at(-1)?.[1] ?? NaN;
  const usual = Math.abs(duration - last - 1) < 1e-9 && !draft && !stretch && !fall;
  return alone && mass && rigid && exact.travelling && usual && exact.name === chosen.method;
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
  const change = Number(chosen.mass_ratio) / Number(from.chosen.mass_ratio);
  const mass = change === 1 || Number.isNaN(change) ? from.impactor.mass : from.target.mass / Number(chosen.mass_ratio);
  const beta = from.target.mass / mass;
  const impact = kernels.rod(beta, from.rods[0].mirror > 0 ? 1 : -1);
  if (!impact) return null;
  const speed = Number(chosen.speed);
  const times = speed / from.speed;
  const scales = { speed, forceUnit: from.forceUnit * times, stressUnit: from.stressUnit * times };
  const { duration, histories: drawn } = impact;
  const made = {
    ...from,
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
  const exact = figuresOf(made, impact);
  exact.diagnostics = { ...exact.diagnostics, wall_time: (performance.now() - begun) / 1e3 };
  const steady = mass === from.impactor.mass && (from.other?.byLaw || chosen.restitution === from.chosen.restitution);
  const beside = steady ? { other: from.other && faster(from.other, times) } : without(from);
  return { ...made, exact, match: exact.restitution.newton, ...beside };
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
  const peakForce = figures.peakForce && figures.peakForce * times;
  return { ...figures, contacts: figures.contacts.map(scaled), energy, peakForce };
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
 * @param {Impact} impact
 * @returns {AxialFigures}
 */
function figuresOf(frame, { compressing, contacts, duration, energy, impulse, target: moved }) {
  const { exact, exactForce, exactTime, forceUnit, impactor, speed, target, trip } = frame;
  const last = contacts[contacts.length - 1];
  const targetFinal = target.held ? 0 : moved;
  const moving = (/** @type {number} */ mass, /** @type {number} */ v) => 0.5 * mass * (speed * v) ** 2;
  const whole = target.held ? 0 : moving(target.mass, targetFinal);
  const energies = {
    ...{ initial: moving(impactor.mass, 1), impactor: moving(impactor.mass, last.after), target_rigid: whole },
    ...{ target_vibration: forceUnit * speed * trip * energy - whole, local: 0, dissipated: 0 },
  };
  const { initial, ...parts } = energies;
  const off = Object.values(parts).reduce((sum, part) => sum + part, -initial) / initial;
  const lost = 1 - last.after;
  const push = (forceUnit * trip * impulse) / (impactor.mass * speed);
  const gained = target.held ? lost : (target.mass * targetFinal) / impactor.mass;
  const unbalanced = Math.max(Math.abs(lost - push), Math.abs(gained - lost));
  return {
    ...exact,
    contacts: contacts.map(({ start, end, before, after, peak }) => {
      const given = impactor.mass * speed * (before - after);
      return [start, end, given, forceUnit * peak];
    }),
    cutOff: contacts.map((contact) => cutOff(contact, exactTime, exactForce)),
    left: contacts.map(({ after }) => after),
    final: last.after,
    targetFinal,
    stillTouching: last.end >= duration * (1 - 1e-9),
    peakForce: forceUnit * Math.max(...contacts.map(({ peak }) => peak)),
    restitution: {
      newton: targetFinal - last.after,
      poisson: compressing > 0 ? impulse / compressing - 1 : null,
      newton_at_contact: last.face - last.after,
    },
    energy: energies,
    diagnostics: {
      ...exact.diagnostics,
      energy_error: off,
      estimated_error: Math.max(Math.abs(off) + unbalanced, ROUNDING),
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
