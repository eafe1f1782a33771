// What is compared of impacts on a beam, and on a link that is shown as one.
import { averaged, between, pair } from '../charts/scale.js';
import { energies, figure } from '../compare/figure.js';
import { spansOf } from '../compare/histories.js';
import { ENOUGH, listed, verdict } from '../compare/resolution.js';
import { given } from '../wire/message.js';
import { text } from '../text/catalogue.js';
import { engineering, percent } from '../text/format.js';

/** @import { Histories } from '../compare/histories.js' */
/** @import { Compared } from '../compare/kinds.js' */
/** @import { BendingFrame, Numbers, Restitution } from '../messages.js' */

/**
 * Of bodies as wholes; where one turns about a pin, so that it has none, of the struck points.
 * @param {Restitution} restitution
 */
const restitutionOf = ({ newton, newton_at_contact: points }) => [
  newton === null ? figure('restitution-at-contact', 'number', points) : figure('restitution', 'number', newton),
];

/** @param {BendingFrame} frame */
function figuresOf({ main, span }) {
  return [
    figure('force', 'force', main.peakForce),
    figure('apparent', 'time', span.apparent),
    figure('real', 'time', span.real),
    figure('contacts', 'count', main.contacts),
    figure('impulse', 'impulse', main.impulse),
    figure('rebound', 'velocity', main.final),
    ...restitutionOf(main.restitution),
    figure('indentation', 'length', main.peakIndentation),
    ...energies(main.energy),
  ];
}

/**
 * @param {BendingFrame} frame
 * @returns {Histories}
 */
function historiesOf(frame) {
  const { impactorPath, impactorRate, modalForce, struckPath, struckRate, time } = frame;
  const over = (/** @type {Numbers} */ y) => ({ x: time, y });
  let force = pair(frame.mainTime, frame.mainForce);
  if (modalForce) {
    const step = given(frame.step, 'step');
    force = averaged(modalForce, step, (frame.law.rigid && frame.main.diagnostics.resolved_time) || step);
  }
  return {
    force,
    impactor: over(impactorPath),
    struck: over(struckPath),
    impactorRate: over(impactorRate),
    struckRate: over(struckRate),
    contacts: spansOf(frame.contacts, 1),
  };
}

/**
 * Of a beam, which has no exact solution: the larger number judges the smaller.
 * @param {BendingFrame} now
 * @param {BendingFrame} kept
 * @param {string} name
 */
function ofResolution(now, kept, name) {
  const [coarse, fine] = [now, kept].sort((a, b) => Number(a.chosen[name]) - Number(b.chosen[name]));
  const [low, high] = [coarse, fine].map(({ chosen }) => Number(chosen[name]));
  const { contacts, final, peakForce } = fine.main;
  if (coarse.main.name !== fine.main.name || !peakForce || !coarse.main.peakForce) return '';
  const miss = {
    count: low,
    velocity: Math.abs((coarse.main.final ?? 0) - (final ?? 0)) / now.speed,
    impulse: Math.abs(coarse.main.impulse / fine.main.impulse - 1),
    force: Math.abs(coarse.main.peakForce / peakForce - 1),
    contacts: coarse.main.contacts,
  };
  const alike = miss.velocity <= ENOUGH && miss.force <= ENOUGH && miss.contacts === contacts;
  const judged = text('compare.verdict.judged', { high, contacts, what: name, alone: !('mechanism' in now) });
  const why = alike && name === 'modes' ? [slowerThan(coarse, low)].filter(Boolean) : [];
  const at = percent(instantOf(coarse, fine) / now.speed);
  const instants = alike ? [text('compare.verdict.instants', { at })] : [];
  return [verdict([miss], contacts, name), ...why, judged, listed([miss], name), ...instants].join(' ');
}

/**
 * Why so few modes are enough: their fastest swings several times while a contact lasts.
 * @param {BendingFrame} frame
 * @param {number} modes
 */
function slowerThan({ contacts, modeFrequencies }, modes) {
  const fastest = modeFrequencies?.[modes - 1];
  if (!fastest) return '';
  const longest = Math.max(...contacts.map(([start, end]) => end - start));
  const period = (2 * Math.PI) / fastest;
  if (longest < period) return '';
  const values = { modes, period: engineering(period, 's'), lasts: engineering(longest, 's') };
  return text('compare.verdict.slow-contact', values);
}

/**
 * How far the velocities of the struck place lie apart at most, at one instant [m/s].
 * @param {BendingFrame} one
 * @param {BendingFrame} other  of about the same duration
 */
function instantOf(one, other) {
  const last = other.time[other.time.length - 1];
  let most = 0;
  one.time.forEach((t, k) => {
    if (t <= last) most = Math.max(most, Math.abs(between(other.time, other.struckRate, t) - one.struckRate[k]));
  });
  return most;
}

/** @type {Compared} */
export const compared = {
  trips: false,
  figures: figuresOf,
  histories: historiesOf,
  contacts: (/** @type {BendingFrame} */ { contacts }) => contacts,
  law: (/** @type {BendingFrame} */ { law }) => law,
  peakForce: (/** @type {BendingFrame} */ { main }) => main.peakForce,
  resolution: ofResolution,
  verdicts: {},
};
