// A rule: the page's words stand in its catalogues (app/text), not in its code.

const TWO_WORDS = /\p{L}{2,}[,.;:]?\s+\(?\p{L}{2,}/u;
const TITLE = /^\s*\p{Lu}\p{Ll}+(?:\s|$)/u;
const LETTERS = /\p{L}{2,}/u;
const SAID = new Set(['textContent', 'title', 'ariaLabel', 'placeholder', 'ariaValueText', 'innerText']);
const KEYS = ['Enter', 'Escape', 'Home', 'End'];
const PARTS = ['Rows', 'Scale', 'Time', 'Dashed', 'Thin']; // of names in the code
const NAMES = new Set(['Strikewave', 'None', 'Hz', 'Pa', 'µs', ...PARTS, ...KEYS]);
const CODE = /sans-serif$|^\s*<|^"/; // fonts, and pieces of markup
const SELECTING = new Set(['matchMedia', 'querySelector', 'querySelectorAll', 'closest', 'matches']);

/** What a call or a `new` is of. */
const calleeOf = ({ callee }) => callee.property?.name ?? callee.name ?? '';

/** Whether a string is for the machine: a class, a selector, an import, or what only programmers read. */
function forTheMachine(node) {
  const { parent } = node;
  if (/^(Import|Export)/.test(parent.type)) return true;
  if (parent.type === 'Property' && parent.value === node) return parent.key.name === 'className';
  if (parent.type === 'NewExpression') return calleeOf(parent) === 'Error';
  if (parent.type === 'CallExpression') return SELECTING.has(calleeOf(parent));
  return parent.type === 'AssignmentExpression' && parent.left.property?.name === 'className';
}

/** Whether it is what an element says. */
function said({ parent }) {
  const name = parent.type === 'Property' ? parent.key.name : parent.left?.property?.name;
  return SAID.has(name);
}

export default {
  rules: {
    catalogued: {
      meta: { type: 'problem', messages: { words: 'Words of the page belong in app/text: “{{words}}”' } },
      create(context) {
        const check = (node, words, whole = node) => {
          if (CODE.test(words) || NAMES.has(words.trim()) || forTheMachine(whole)) return;
          if (TWO_WORDS.test(words) || TITLE.test(words) || (said(whole) && LETTERS.test(words)))
            context.report({ node, messageId: 'words', data: { words } });
        };
        return {
          Literal: (node) => typeof node.value === 'string' && check(node, node.value),
          TemplateElement: (node) => check(node, node.value.cooked, node.parent),
        };
      },
    },
  },
};
