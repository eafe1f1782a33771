// What choices and their values are called on the page.
import { family, methodOf, named, text } from './catalogue.js';
import { share } from './format.js';

const LEAST_PEAK = 0.01; // error of a peak force that is worth a word

/** @import { Note } from './catalogue.js' */
/** @typedef {{ name: string, modes?: number | null, elements?: number | null, model?: string | null }} Called */

/** @param {Called} solution */
export const shortly = ({ name, model }) => methodOf(name, model ?? '', '-short');

/**
 * A method with its resolution, as a reader calls it.
 * @param {Called} solution
 */
export const called = ({ name, modes, elements, model }) =>
  modes && 'modes' in family(`method.${name}`)
    ? text(`method.${name}.modes`, { modes })
    : elements && 'elements' in family(`method.${name}`)
      ? text(`method.${name}.elements`, { elements })
      : methodOf(name, model ?? '');

/**
 * @typedef {object} Errors  none: unknown, or too small to matter
 * @property {number | null} rebound  of the impact speed
 * @property {number | null} [peak]  of the peak force
 */
/**
 * Estimated errors of a solution; a sum of modes or elements may ripple behind a front.
 * @param {{ diagnostics: { estimated_error: number | null }, notes: Note[] }} solution
 * @returns {Errors}
 */
export const errorsOf = ({ diagnostics, notes }) => ({
  rebound: diagnostics.estimated_error,
  peak: Number(notes.find(({ code }) => code.endsWith('-ripples'))?.values.share ?? 0) / 100,
});

/**
 * Of which solution a picture is, and how wrong that may be.
 * @param {string} method  what it is called
 * @param {Errors} errors
 * @returns {string[]}
 */
export const byOf = (method, { rebound, peak }) => [
  text('opening.by', { method }),
  ...(rebound ? [text('opening.rebound', { error: share(rebound) })] : []),
  ...(peak && peak >= LEAST_PEAK ? [text('opening.peak-force', { error: share(peak) })] : []),
];

/**
 * What a choice is called, its unit, and what its options are called.
 * @typedef {{ title: string, unit?: string, beside?: string, options?: Record<string, string> }} Label
 */
export const METHODS = family('name.method-choice');

/** @param {string} name */
const labelOf = (name) => ({
  title: text(`control.${name}`),
  unit: family('unit')[name],
  beside: family('beside')[name],
  options: name === 'method' ? METHODS : family(`name.${name}`), // of a list
});
/** @type {Record<string, Label>} */
export const LABELS = Object.fromEntries(Object.keys(family('control')).map((name) => [name, labelOf(name)]));

export const GROUND = 'ground'; // as the link that stands still is called
/**
 * What a link is called: those of scenes that come with the program in the language of the page.
 * @param {string} name
 */
export const linkOf = (name) => named('link', name);

/**
 * What links, or the parts of a name, are called.
 * @param {string[]} links
 */
export const jointOf = (links) => links.map(linkOf).join(' – ');
