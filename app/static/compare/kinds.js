// What is compared of an impact, as the room of its kind has it.

/** @import { Contact, Frame } from '../messages.js' */
/** @import { Figure } from './figure.js' */
/** @import { Histories } from './histories.js' */

/**
 * What a kind hands out of its solutions; `which`: of two of one impact, the exact one or the method beside it.
 * @typedef {object} Compared
 * @property {boolean} trips  whether its unit of time is the round trip of a wave
 * @property {(frame: any, which: 'exact' | 'other') => Figure[]} figures
 * @property {(frame: any, which: 'exact' | 'other') => Histories | null} histories  none of an impulse without duration
 * @property {(frame: any) => Contact[]} contacts
 * @property {(frame: any) => Law} law
 * @property {(frame: any) => number | null} peakForce  [N]
 * @property {(now: any, kept: any, name: string) => string} resolution  what another number of modes, elements teaches
 * @property {Record<string, (now: any, kept: any) => string>} verdicts  what another setting teaches, by its name
 */
/** @typedef {{ exponent: number, rigid: boolean, yields: boolean }} Law  power of the indentation, how it begins */

/** @type {Record<string, Compared>} */
const ROOMS = {};

/** @param {Record<Frame['kind'], Compared>} rooms */
export const compares = (rooms) => Object.assign(ROOMS, rooms);

/** @param {Frame} frame */
export const roomOf = ({ kind }) => ROOMS[kind];

const FAR = 100; // times as large, from which a force of another scene says nothing beside this one

/**
 * Whether two solutions can be laid one upon the other: of one scene, or of two of the same kind and size.
 * @param {Frame} one
 * @param {Frame} other
 */
export function comparable(one, other) {
  if (one.kind !== other.kind) return false;
  if (one.chosen.scene === other.chosen.scene) return true;
  const [force, beside] = [one, other].map((frame) => roomOf(frame).peakForce(frame));
  const apart = force && beside ? Math.abs(Math.log(force / beside)) : 0;
  return apart < Math.log(FAR);
}
