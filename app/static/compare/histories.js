// What charts overlay of a solution, in SI units, whatever kind of impact it is.

/** @import { Samples } from '../charts/scale.js' */
/** @import { Contact } from '../messages.js' */

/**
 * Over time [s]: force [N], displacements [m], velocities [m/s] where they are known, contacts.
 * @typedef {object} Histories
 * @property {Samples | null} force
 * @property {Samples | null} impactor
 * @property {Samples | null} struck
 * @property {Samples | null} impactorRate
 * @property {Samples | null} struckRate
 * @property {[start: number, end: number][]} contacts
 */

/**
 * @param {Contact[]} contacts
 * @param {number} unit  of their times [s]
 */
export const spansOf = (contacts, unit) =>
  contacts.map(([start, end]) => /** @type {[number, number]} */ ([start * unit, end * unit]));
