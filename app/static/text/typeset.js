// Formulas as scene files write them, `a^2 = alpha R`: Greek letters and raised numbers by their signs; letters that
// are raised or lowered and have none, K_h, e^(-2 β), a^(3/2), by elements.
import { raised } from './format.js';

/** @type {Record<string, string>} */
const SIGNS = {
  ...{ alpha: 'α', beta: 'β', gamma: 'γ', delta: 'δ', eta: 'η', kappa: 'κ', lambda: 'λ', mu: 'μ', nu: 'ν' },
  ...{ omega: 'ω', phi: 'φ', pi: 'π', psi: 'ψ', rho: 'ρ', sigma: 'σ', sqrt: '√' },
};
const WORD = new RegExp(`(?<![A-Za-z])(?:${Object.keys(SIGNS).join('|')})(?![A-Za-z])`, 'g');
const POWER = /\^(-?\d+(?:\.\d+)?)(?![\d/])/g;

/**
 * Words with the signs that their formulas have.
 * @param {string} words
 */
export const withSigns = (words) =>
  words.replace(WORD, (name) => SIGNS[name]).replace(POWER, (_, power) => raised(Number(power)));

const LETTER = String.raw`(?<![\p{L}\p{N}_.])\p{L}{1,2}`;
export const FORMULA = new RegExp(
  String.raw`(${LETTER}_[\p{L}\p{N}]{1,2}(?![\p{L}\p{N}_])|(?:${LETTER})?\^(?:\([^()]*\)|-?\d+\/\d+|\p{L}))`,
  'u',
);

/**
 * Parts of a text: as they are, or with what is lowered or raised beside them.
 * @param {string} words
 * @returns {{ text: string, kind?: 'sub' | 'sup', beside?: string }[]}
 */
export const partsOf = (words) =>
  words
    .split(FORMULA)
    .filter(Boolean)
    .map((part) => {
      if (!FORMULA.test(part)) return { text: part };
      const [base, beside] = part.split(/[_^]/);
      const kind = part.includes('^') ? 'sup' : 'sub';
      return { text: base, kind, beside: beside.replace(/^\((.*)\)$/, '$1') };
    });

/**
 * The same as plain letters, to be read aloud.
 * @param {string} words
 */
export const spoken = (words) =>
  partsOf(words)
    .map(({ text, beside = '' }) => text + beside)
    .join('');
