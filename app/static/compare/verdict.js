// What the comparison of two solutions that differ in one setting teaches, in a sentence made of their figures.
import { engineering, percent, pretty, signed } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { comparedOf, figuresOf } from './figures.js';
import { kindsOf } from './settings.js';

/** @import { AxialFrame, Frame, SpaceFrame } from '../shell/message.js' */

const RESOLUTIONS = ['modes', 'elements'];
const LINEAR = 0.02; // how far from 1 a power is that is still one
const ALIKE = 0.01; // difference of two restitutions that is none

/**
 * @param {number} now
 * @param {number} kept
 */
const times = (now, kept) => Number((now / kept).toPrecision(2));

/**
 * Peak force, time in contact and restitution of both, where both have them.
 * @param {Frame} now
 * @param {Frame} kept
 */
function pairs(now, kept) {
  const which = comparedOf(now, kept);
  const [after, before] = [now, kept].map((frame) => new Map(figuresOf(frame, which).map((each) => [each.key, each])));
  const of = (/** @type {string} */ key) => {
    const [a, b] = [after.get(key)?.value, before.get(key)?.value];
    return a && b ? { now: a, kept: b } : null;
  };
  return { force: of('force'), time: of('real'), restitution: of('restitution') };
}

/**
 * A hammer with another mass: harder, or longer? And what becomes of the restitution.
 * @param {Frame} now
 * @param {Frame} kept
 */
function ofMass(now, kept) {
  const { force, restitution, time } = pairs(now, kept);
  const heavier = Number(kept.chosen.mass_ratio) / Number(now.chosen.mass_ratio);
  const found = [];
  if (force && time && time.now > 0 && time.kept > 0) {
    const [harder, longer] = [times(force.now, force.kept), times(time.now, time.kept)];
    const more = Math.abs(Math.log(longer)) > Math.abs(Math.log(harder)) ? 'time' : 'force';
    found.push(text('compare.verdict.mass', { times: Number(heavier.toPrecision(3)), harder, longer, more }));
  }
  if (restitution && Math.abs(restitution.now - restitution.kept) > ALIKE)
    found.push(text('compare.verdict.restitution', { now: signed(restitution.now), kept: signed(restitution.kept) }));
  return found.join(' ');
}

/**
 * As what power of the speed the force grows.
 * @param {Frame} now
 * @param {Frame} kept
 */
function ofSpeed(now, kept) {
  const { force } = pairs(now, kept);
  const faster = Number(now.chosen.speed) / Number(kept.chosen.speed);
  if (!force || faster <= 0) return '';
  const power = Math.log(force.now / force.kept) / Math.log(faster);
  const how = Math.abs(power - 1) < LINEAR ? 'linear' : power > 1 ? 'more' : 'less';
  const values = { faster: Number(faster.toPrecision(3)), harder: times(force.now, force.kept), power: pretty(power) };
  return text('compare.verdict.speed', { ...values, how });
}

/**
 * How far either number of modes or elements is from the exact solution.
 * @param {AxialFrame} now
 * @param {AxialFrame} kept
 * @param {string} name
 */
function ofResolution(now, kept, name) {
  const { contacts, peakForce } = now.exact;
  if (!peakForce || !now.other?.peakForce || !kept.other?.peakForce) return '';
  const miss = (/** @type {AxialFrame} */ { other }) => percent(Math.abs((other?.peakForce ?? 0) / peakForce - 1));
  return text('compare.verdict.resolution', {
    force: engineering(peakForce, 'N'),
    contacts: contacts.length,
    what: name,
    first: Number(kept.chosen[name]),
    second: Number(now.chosen[name]),
    off: miss(kept),
    offNow: miss(now),
  });
}

/**
 * What another contact law changes.
 * @param {Frame} now
 * @param {Frame} kept
 */
function ofLaw(now, kept) {
  const rigid = [now, kept].filter(({ chosen }) => chosen.law === 'rigid').length;
  const { time } = pairs(now, kept);
  if (rigid !== 1 || !time || now.kind === 'bodies' || kept.kind === 'bodies') return '';
  const soft = now.chosen.law === 'rigid' ? time.kept / kept.trip : time.now / now.trip;
  return text('compare.verdict.law', { trips: pretty(Number(soft.toPrecision(2))), waves: now.kind === 'axial' });
}

/**
 * What another support of the far end changes.
 * @param {AxialFrame} now
 * @param {AxialFrame} kept
 */
function ofSupport(now, kept) {
  const [fixed, free] = [kept, now].map(({ target }) => target.support === 'fixed');
  if (!fixed || free || now.exact.final === null) return '';
  const { energy, final } = now.exact;
  const waves = percent((energy.target_vibration ?? 0) / energy.initial);
  const equal = Math.abs(Number(now.chosen.mass_ratio) - 1) < ALIKE;
  return text('compare.verdict.support', { equal, velocity: signed(final), waves });
}

/**
 * What of a body is felt where it is struck.
 * @param {SpaceFrame} now
 * @param {SpaceFrame} kept
 */
function ofPlace(now, kept) {
  const felt = (/** @type {SpaceFrame} */ { figures }) => {
    const known = new Map(figures.map(([name, value]) => [name, Number(value)]));
    return [known.get('target-mass') ?? 0, known.get('target-felt-mass') ?? 0];
  };
  const [[mass, here], [, there]] = [felt(now), felt(kept)];
  if (!(here > 0) || Math.abs(there / mass - 1) > ALIKE || Math.abs(here / mass - 1) < ALIKE) return '';
  return text('compare.verdict.place', { mass, felt: here, parts: mass / here, more: mass / here - 1 });
}

/**
 * One sentence or two; nothing where several settings differ, or nothing can be said in general.
 * @param {Frame} now
 * @param {Frame} kept
 * @param {string[]} names  of the settings that differ
 */
export function verdictOf(now, kept, names) {
  const [name] = names;
  if (names.length !== 1 || now.kind !== kept.kind) return '';
  if (name === 'mass_ratio') return ofMass(now, kept);
  if (name === 'speed') return ofSpeed(now, kept);
  if (name === 'law') return ofLaw(now, kept);
  if (name === 'place' && now.kind === 'bodies' && kept.kind === 'bodies') return ofPlace(now, kept);
  if (now.kind !== 'axial' || kept.kind !== 'axial') return '';
  if (name === 'scene') return ofSupport(now, kept);
  return !kindsOf(now, kept).impact && RESOLUTIONS.includes(name) ? ofResolution(now, kept, name) : '';
}
