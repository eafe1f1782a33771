// What the comparison of two solutions that differ in one setting teaches, in a sentence made of their figures.
import { percent, pretty, signed } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { comparedOf, figuresOf } from './figures.js';
import { roomOf } from './kinds.js';
import { kindsOf } from '../form/settings.js';
import { ofSpeed } from './speed.js';

/** @import { Frame } from '../messages.js' */

const RESOLUTIONS = ['modes', 'elements'];
const SAME = 0.02; // share by which two figures differ that count as one
const RINGS = 1e-3; // share of the energy left in waves that is worth a word
const RESTITUTION = 'constant'; // the question that asks for it
const ALIKE = 0.01; // difference of two restitutions that is none

/**
 * @param {number} now
 * @param {number} kept
 */
const times = (now, kept) => Number((now / kept).toPrecision(2));

/**
 * Figures that both have, as pairs.
 * @param {Frame} now
 * @param {Frame} kept
 */
function pairs(now, kept) {
  const which = comparedOf(now, kept);
  const [after, before] = [now, kept].map((frame) => new Map(figuresOf(frame, which).map((each) => [each.key, each])));
  return (/** @type {string} */ key) => {
    const [a, b] = [after.get(key)?.value, before.get(key)?.value];
    return typeof a === 'number' && typeof b === 'number' ? { now: a, kept: b } : null;
  };
}

/** @param {number} ratio */
const alike = (ratio) => Math.abs(ratio - 1) < SAME;

/**
 * A hammer with another mass: harder, or longer?
 * @param {Frame} now
 * @param {Frame} kept
 */
function ofForce(now, kept) {
  const of = pairs(now, kept);
  const [force, time] = [of('force'), of('real')];
  if (!force?.now || !force.kept || !time?.now || !time.kept) return '';
  const heavier = Number(kept.chosen.mass_ratio) / Number(now.chosen.mass_ratio);
  const [harder, longer] = [force.now / force.kept, time.now / time.kept];
  const changed = Math.abs(Math.log(longer)) > Math.abs(Math.log(harder)) ? 'time' : 'force';
  return text('compare.verdict.mass', {
    times: Number(heavier.toPrecision(3)),
    harder: alike(harder) ? 1 : times(force.now, force.kept),
    longer: alike(longer) ? 1 : times(time.now, time.kept),
    more: alike(harder) && alike(longer) ? 'neither' : changed,
  });
}

/**
 * What becomes of the restitution, what that is, and why it changes.
 * @param {Frame} now
 * @param {Frame} kept
 * @param {boolean} asked  whether it is to be said where it stays the same, too
 */
function ofRestitution(now, kept, asked) {
  const of = pairs(now, kept);
  const whole = of('restitution');
  const found = whole ?? of('restitution-at-contact');
  if (!found) return '';
  const changed = Math.abs(found.now - found.kept) > ALIKE;
  if (!changed && !asked) return '';
  const [waves, lost] = [of('waves'), of('lost')];
  const most = (/** @type {{ now: number, kept: number } | null} */ part) => (part ? Math.max(part.now, part.kept) : 0);
  const rings = most(waves) > RINGS;
  const cause = rings && !whole ? 'swings' : most(lost) > ALIKE ? 'lost' : rings ? 'waves' : 'contact';
  return text('compare.verdict.restitution', {
    now: signed(found.now),
    kept: signed(found.kept),
    changed,
    points: !whole,
    cause,
    waves: percent(waves?.now ?? 0),
    wavesKept: percent(waves?.kept ?? 0),
  });
}

/**
 * A hammer with another mass; what was asked comes first.
 * @param {Frame} now
 * @param {Frame} kept
 * @param {string} asked
 */
function ofMass(now, kept, asked) {
  const first = asked === RESTITUTION;
  const both = [ofForce(now, kept), ofRestitution(now, kept, first)];
  return (first ? both.reverse() : both).filter(Boolean).join(' ');
}

/** @param {Frame} frame */
const rigidOf = (frame) => roomOf(frame).law(frame).rigid;

/**
 * What another contact law changes.
 * @param {Frame} now
 * @param {Frame} kept
 */
function ofLaw(now, kept) {
  const rigid = [now, kept].filter(rigidOf).length;
  const time = pairs(now, kept)('real');
  if (rigid !== 1 || !time || !('trip' in now) || !('trip' in kept)) return '';
  const soft = rigidOf(now) ? time.kept / kept.trip : time.now / now.trip;
  return text('compare.verdict.law', { trips: pretty(Number(soft.toPrecision(2))), waves: roomOf(now).trips });
}

/**
 * One sentence or two; nothing where several settings differ, or nothing can be said in general.
 * @param {Frame} now
 * @param {Frame} kept
 * @param {string[]} names  of the settings that differ
 * @param {string} [asked]  the ready-made comparison that this is
 */
export function verdictOf(now, kept, names, asked = '') {
  const [name] = names;
  if (names.length !== 1 || now.kind !== kept.kind) return '';
  if (name === 'mass_ratio') return ofMass(now, kept, asked);
  if (name === 'speed') return ofSpeed(now, kept);
  if (name === 'law') return ofLaw(now, kept);
  const { resolution, verdicts } = roomOf(now);
  if (name in verdicts) return verdicts[name](now, kept);
  const counted = !kindsOf(now, kept).impact && RESOLUTIONS.includes(name);
  return counted ? resolution(now, kept, name) : '';
}
