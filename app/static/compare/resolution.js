// How many modes or elements are enough, and for what: two solutions that differ in nothing else.
import { between } from '../charts/scale.js';
import { engineering, percent, signed } from '../text/format.js';
import { text } from '../text/catalogue.js';

/** @import { AxialFigures, AxialFrame, BendingFrame } from '../messages.js' */

/**
 * What is asked of both numbers: error of the last velocity as a share of the impact speed, of impulse and peak force.
 * @typedef {{ count: number, velocity: number, impulse: number, force: number, contacts: number }} Miss
 */

const ENOUGH = 0.01; // error that is small enough
const GRAZING = 'near-grazing'; // the note that warns of the number of contacts

/**
 * The smaller number that is enough, or that none is.
 * @param {Miss[]} misses  the one of fewer first
 * @param {(miss: Miss) => boolean} fits
 */
const enoughOf = (misses, fits) => {
  const found = misses.find(fits);
  const { count } = found ?? misses[misses.length - 1];
  return text('compare.verdict.enough', { count, how: found ? 'found' : misses.length > 1 ? 'both' : 'judged' });
};

/**
 * @param {Miss[]} misses
 * @param {number} contacts  that there are
 * @param {string} what  modes, elements
 * @param {boolean} [jumps]  whether the force does, so that its peak does not settle
 * @param {boolean} [grazing]  whether the contacts are too near to another number of them to be judged by
 */
function verdict(misses, contacts, what, jumps = false, grazing = false) {
  const velocity = enoughOf(misses, (miss) => miss.velocity <= ENOUGH);
  const impulse = enoughOf(misses, (miss) => miss.impulse <= ENOUGH);
  const found = enoughOf(misses, (miss) => miss.contacts === contacts);
  const force = enoughOf(misses, (miss) => miss.force <= ENOUGH);
  return text('compare.verdict.enough-for', { what, velocity, impulse, contacts: found, force, grazing, jumps });
}

/** @param {AxialFigures} solution */
const impulseOf = ({ contacts }) => contacts.reduce((sum, [, , impulse]) => sum + impulse, 0);

/**
 * How far either is from the exact solution.
 * @param {Miss[]} misses
 * @param {string} what
 * @param {boolean} [grazing]
 */
const listed = (misses, what, grazing = false) =>
  misses
    .map(({ contacts, count, force, impulse, velocity }) => {
      const by = { velocity: percent(velocity), impulse: percent(impulse), force: percent(force) };
      return text('compare.verdict.miss', { contacts, count, grazing, what, ...by });
    })
    .join(' ');

/**
 * Of a method beside the exact solution.
 * @param {AxialFrame} now
 * @param {AxialFrame} kept
 * @param {string} name
 */
export function ofResolution(now, kept, name) {
  const { contacts, final, peakForce, travelling } = now.exact;
  const misses = [kept, now].flatMap(({ chosen, other }) =>
    other?.peakForce && peakForce
      ? [
          {
            count: Number(chosen[name]),
            velocity: Math.abs((other.final ?? 0) - (final ?? 0)),
            impulse: Math.abs(impulseOf(other) / impulseOf(now.exact) - 1),
            force: Math.abs(other.peakForce / peakForce - 1),
            contacts: other.contacts.length,
          },
        ]
      : [],
  );
  if (misses.length < 2 || !peakForce) return '';
  misses.sort((a, b) => a.count - b.count);
  const jumps = now.rigid && now.rods.length > 0;
  const values = { contacts: contacts.length, velocity: signed(final ?? 0), force: engineering(peakForce, 'N') };
  const exact = text('compare.verdict.exact', { ...values, waves: travelling });
  const grazing = [now, kept].some((frame) => warnsOfCount(frame));
  const why = jumps && name === 'modes' ? [text('compare.verdict.jumps', { grazing })] : [];
  const first = verdict(misses, contacts.length, name, jumps, grazing);
  return [first, ...why, exact, listed(misses, name, grazing)].join(' ');
}

/**
 * Whether a warning stands beside it not to trust the number of contacts.
 * @param {AxialFrame} frame
 */
const warnsOfCount = ({ exact, other }) =>
  [exact, other].some((each) => (each?.notes ?? []).some(({ code }) => code === GRAZING));

/**
 * Of a beam, which has no exact solution: the larger number judges the smaller.
 * @param {BendingFrame} now
 * @param {BendingFrame} kept
 * @param {string} name
 */
export function ofBeamResolution(now, kept, name) {
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
  const judged = text('compare.verdict.judged', { high, contacts, what: name, alone: now.kind === 'beam' });
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
