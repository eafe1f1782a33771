// Formulas as scene files write them, `a^2 = alpha R`: Greek letters and raised numbers by their signs; letters that
// are raised or lowered and have none, K_h, e^(-2 β), a^(3/2), by elements.
import { make } from '../shell/dom.js';
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
const FORMULA = new RegExp(
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
 * Set the formulas in the texts of an element.
 * @param {HTMLElement} root
 */
export function typeset(root) {
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  /** @type {Text[]} */
  const texts = [];
  while (walker.nextNode()) {
    const node = /** @type {Text} */ (walker.currentNode);
    if (FORMULA.test(node.data)) texts.push(node);
  }
  for (const node of texts)
    node.replaceWith(
      ...partsOf(node.data).map(({ text, kind, beside }) =>
        kind ? make('span', { className: 'formula' }, text, make(kind, { textContent: beside })) : text,
      ),
    );
}

/**
 * The same as plain letters, to be read aloud.
 * @param {string} words
 */
export const spoken = (words) =>
  partsOf(words)
    .map(({ text, beside = '' }) => text + beside)
    .join('');
