// What the page knows of Panel: the properties that Python and the browser share.
import { said } from '../text/catalogue.js';

/**
 * The component of Panel. Any property can be read, and set where the server allows it.
 * @typedef {object} Properties
 * @property {(name: string, act: () => void) => void} on  call when a property has changed
 * @property {ArrayBuffer} frame  the message that answers the choices
 * @property {string} refused  why the last changes were not taken: notes, in JSON
 * @property {string} waiting  why the answer takes longer: a note, in JSON, or nothing
 * @property {string} disconnected  code of why this page is turned out
 * @property {Spec} spec
 * @property {Shared} shared
 */
/**
 * What the address says besides the choices: which property opens a panel, and which says what is asked in it.
 * @typedef {object} Shared
 * @property {Record<string, string>} panels
 * @property {Record<string, [name: string, panel: string, within?: string]>} asked
 */
/** @typedef {Properties & Record<string, any>} Model */

/**
 * Bounds or options of one choice.
 * @typedef {object} Bounds
 * @property {number | string} default
 * @property {number} low
 * @property {number} high
 * @property {boolean} whole
 * @property {string[]} [options]
 * @property {string} [exact]  of them, what is beside all others along an axis
 */
/** @typedef {Record<string, Bounds>} Spec */

/** @typedef {Record<string, any>} Answer  what the server found, as JSON; app/views says what is in it */

/**
 * Why the last changes were not taken; nothing if they were.
 * @param {Model} model
 */
export const refusalIn = ({ refused }) => (refused ? JSON.parse(refused).map(said).join('\n') : '');
