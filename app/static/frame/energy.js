// Where the energy went, as shares of all that was given.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures, percent, unbroken } from '../text/format.js';

/** @import { Energies } from '../messages.js' */

const LEAST_SHARE = 5e-5; // of the energy, that is worth a word
const LEAST_GAP = 1e-3; // of the energy, that is said: with less it is the momentum that does not add up
const LARGEST_GAP = 1e-2; // of the energy, with which shares of it are drawn

/**
 * Whether the books of energy are open: shares of what does not add up would tell nothing.
 * @param {{ diagnostics: { energy_error: number }, notes: { code: string }[] }} solution
 */
export const booksOpen = ({ diagnostics, notes }) =>
  Math.abs(diagnostics.energy_error) > LARGEST_GAP || notes.some(({ code }) => code === 'books-open');

/**
 * The sentence in place of shares.
 * @param {number} gap  of the energy
 */
export const openOf = (gap) => text('story.energy-open', { gap: percent(gap), missing: gap >= LEAST_GAP });

/**
 * @param {HTMLElement} root  where shares would be
 * @param {{ diagnostics: { energy_error: number } }} solution
 */
export const showOpenBooks = (root, { diagnostics }) =>
  root.replaceChildren(make('p', { textContent: openOf(Math.abs(diagnostics.energy_error)) }));

/**
 * What drives and weight have given since, each, and all that was given with what there was before [J].
 * @param {Energies} energy
 */
export function givenOf(energy) {
  const [drives, weight] = ['drives', 'weight'].map((key) => Math.max(-(energy[key] ?? 0), 0)); // else taken up
  return { drives, weight, whole: energy.initial + drives + weight };
}

/**
 * Shares of the energy as a bar and in words, of all that was given: before the impact, and by drives and weight since.
 * What is next to nothing is left out.
 * @param {HTMLElement} root
 * @param {Energies} energy
 * @param {[key: string, name: string][]} names
 * @param {boolean} [always]  in joules too, also where nothing was given since
 */
export function showEnergy(root, energy, names, always = false) {
  const { drives, weight, whole } = givenOf(energy);
  const shows = (/** @type {number} */ part) => part >= LEAST_SHARE * whole;
  const joules = always || shows(drives) || shows(weight);
  const shown = names.filter(([key]) => shows(energy[key] ?? 0));
  const bar = make('div', { className: 'bar' });
  const parts = shown.map(([key, name]) => {
    const share = energy[key] / whole;
    const piece = make('i', { className: key });
    piece.style.flexGrow = String(share);
    bar.append(piece);
    const chip = make('i', { className: `chip ${key}` });
    const size = joules ? `${figures(energy[key])} J (${percent(share)})` : percent(share);
    return make('span', { className: 'key' }, chip, unbroken(`${name} ${size}`));
  });
  const before = { initial: `${figures(energy.initial)} J`, driven: shows(drives), falls: shows(weight) };
  const given = { drives: `${figures(drives)} J`, weight: `${figures(weight)} J` };
  const total = joules ? [make('p', { textContent: text('story.energy-before', { ...before, ...given }) })] : [];
  root.replaceChildren(...total, bar, make('p', {}, ...parts));
}
