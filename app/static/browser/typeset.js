// Formulas in the texts of an element, set by elements.
import { FORMULA, partsOf } from '../text/typeset.js';
import { make } from './dom.js';

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
