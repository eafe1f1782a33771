// What is compared of an impact, as the room of its kind has it.
import { compared as axial } from '../axial/compared.js';
import { compared as beam } from '../beam/compared.js';
import { compared as bodies } from '../space/compared.js';

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
 * @property {(frame: any) => boolean} restitutionSolves  whether restitution is of methods and rigid-body theory alone
 * @property {(now: any, kept: any, name: string) => string} resolution  what another number of modes, elements teaches
 * @property {Record<string, (now: any, kept: any) => string>} verdicts  what another setting teaches, by its name
 */
/** @typedef {{ exponent: number, rigid: boolean, yields: boolean }} Law  power of the indentation, how it begins */

/** @type {Record<Frame['kind'], Compared>} */
const ROOMS = { axial, beam, mechanism: beam, bodies };

/** @param {Frame} frame */
export const roomOf = ({ kind }) => ROOMS[kind];
