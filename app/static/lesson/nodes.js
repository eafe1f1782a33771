// Sentences of a lesson, which come as pieces, as elements of the page.
import { make } from '../browser/dom.js';
import { typeset } from '../browser/typeset.js';
import { unbroken } from '../text/format.js';
import { withSigns } from '../text/typeset.js';

/** @typedef {{ kind: string, text?: string, nodes?: Piece[], target?: string }} Piece */
/** @typedef {Record<string, string>} Gaps  what stands in them */

/** @type {Record<string, 'p' | 'ul' | 'ol' | 'li' | 'em' | 'strong'>} */
const TAGS = { paragraph: 'p', list: 'ul', steps: 'ol', item: 'li', emphasis: 'em', strong: 'strong' };

/** @param {string} [target]  http or https, as the reader has made sure */
const safe = (target = '') => (/^https?:\/\//.test(target) ? target : '');

/** @param {string} words */
function formula(words) {
  const root = make('span', { className: 'formula', textContent: withSigns(words) });
  typeset(root);
  return root;
}

/**
 * @param {Piece} piece
 * @param {Gaps} gaps
 * @returns {Node}
 */
function elementOf({ kind, nodes = [], target, text = '' }, gaps) {
  if (Object.hasOwn(TAGS, kind)) return make(TAGS[kind], {}, ...elementsOf(nodes, gaps));
  /** @type {Record<string, () => Node>} */
  const others = {
    link: () => make('a', { href: safe(target), target: '_blank', rel: 'noopener' }, ...elementsOf(nodes, gaps)),
    code: () => make('code', { textContent: text }),
    formula: () => formula(text),
    break: () => make('br'),
    value: () => document.createTextNode(unbroken(gaps[text] ?? '')),
  };
  return Object.hasOwn(others, kind) ? others[kind]() : document.createTextNode(unbroken(text));
}

/**
 * @param {Piece[]} pieces
 * @param {Gaps} [gaps]
 * @returns {Node[]}
 */
export const elementsOf = (pieces, gaps = {}) => pieces.map((piece) => elementOf(piece, gaps));

/**
 * The same as words alone, to be read aloud.
 * @param {Piece[]} pieces
 * @param {Gaps} [gaps]
 * @returns {string}
 */
export const wordsOf = (pieces, gaps = {}) =>
  pieces
    .map(({ kind, nodes, text = '' }) => (nodes ? wordsOf(nodes, gaps) : kind === 'value' ? (gaps[text] ?? '') : text))
    .join('');
