// What another speed does to the force, and why, as far as the contact law says it.
import { pretty } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { roomOf } from './kinds.js';

/** @import { Contact, Frame } from '../messages.js' */

const NEAR = 0.02; // how far two powers of the speed may lie apart that are one

/**
 * The power of the speed with which the force of two compact bodies grows under the law of this impact.
 * @param {Frame} frame
 */
function powerOfLaw(frame) {
  const { exponent } = roomOf(frame).law(frame);
  return (2 * exponent) / (exponent + 1);
}

/**
 * Why the force grows as this power; where the law alone does not say it, that it does not.
 * @param {number} power
 * @param {Frame} frame
 */
function reasonOf(power, frame) {
  const law = powerOfLaw(frame);
  const { yields } = roomOf(frame).law(frame);
  const linear = law === 1;
  if (Math.abs(power - 1) < NEAR) return linear ? 'linear' : 'waves';
  if (yields && power < law) return 'yields';
  return power > 1 && power < law + NEAR ? 'stiffer' : 'unexplained';
}

/** @param {Contact[]} contacts */
const strongest = (contacts) =>
  contacts.reduce((best, [, , , peak], k) => ((peak ?? 0) > (contacts[best][3] ?? 0) ? k : best), 0);

/** @param {Frame} frame */
const contactsOf = (frame) => roomOf(frame).contacts(frame);

/** @param {number} ratio */
const rounded = (ratio) => Number(ratio.toPrecision(2));

/**
 * As what power of the speed the force grows. Peaks of different contacts are no power of the speed: then that of the
 * first contact is described.
 * @param {Frame} now
 * @param {Frame} kept
 */
export function ofSpeed(now, kept) {
  const [after, before] = [contactsOf(now), contactsOf(kept)];
  const faster = Number(now.chosen.speed) / Number(kept.chosen.speed);
  if (!after.length || !before.length || faster <= 0) return '';
  const [k, j] = [strongest(after), strongest(before)];
  const same = k === j;
  const [peak, was] = [after[k][3], before[j][3]];
  const [first, firstWas] = same ? [peak, was] : [after[0][3], before[0][3]];
  if (!peak || !was || !first || !firstWas) return '';
  const power = Math.log(first / firstWas) / Math.log(faster);
  const how = reasonOf(power, now);
  const values = { faster: Number(faster.toPrecision(3)), harder: rounded(peak / was), same, now: k + 1, kept: j + 1 };
  const grows = { power: pretty(Number(power.toPrecision(3))), how, law: pretty(rounded(powerOfLaw(now))) };
  return text('compare.verdict.speed', { ...values, ...grows, first: rounded(first / firstWas) });
}
