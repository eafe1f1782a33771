// Symbols and choices explain themselves under the pointer and in the focus: symbol, unit, meaning, source.
import { family, text } from '../text/catalogue.js';
import { typeset } from '../browser/typeset.js';
import { make } from '../browser/dom.js';

/** @type {Record<string, string>} */
const TOKENS = { T: 'T', v: 'v', e: 'e', 'm₂/m₁': 'mass_ratio' };
const TOKEN = /(?<![\p{L}\p{N}·/⁻_])(T|v|e|m₂\/m₁)(?![\p{L}\p{N}²³'’(])/u;
const GAP = 6; // pixels between a symbol and what is said of it

export class Symbols {
  /** @type {HTMLElement | null} */ shown = null;

  /** @param {HTMLElement} page */
  constructor(page) {
    this.page = page;
    this.tip = make('div', { className: 'term-tip', role: 'tooltip', id: 'term-tip', hidden: true });
    page.append(this.tip);
    const from = (/** @type {Event} */ event) => {
      const [first] = event.composedPath();
      return first instanceof Element ? /** @type {HTMLElement | null} */ (first.closest('[data-term]')) : null;
    };
    page.addEventListener('pointerover', (event) => {
      const found = from(event);
      if (found) this.show(found);
      else if (!this.tip.contains(/** @type {Node} */ (event.composedPath()[0]))) this.hide();
    });
    page.addEventListener('pointerleave', () => this.hide());
    page.addEventListener('pointerdown', (event) => {
      if (event.pointerType !== 'touch') this.hide();
    });
    page.addEventListener('focusin', (event) => {
      const [first] = event.composedPath();
      if (first instanceof Element && first.matches(':focus-visible')) this.show(from(event), true);
    });
    for (const done of ['focusout', 'input', 'change']) page.addEventListener(done, () => this.hide());
    page.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') this.hide();
    });
  }
  /**
   * Beside the controls, which it must not cover, where there is room; else above the symbol, or below.
   * @param {HTMLElement | null} element
   * @param {boolean} [focused]  and not under the pointer, which may want what the tip lies on
   */
  show(element, focused = false) {
    const { name, meaning, source, symbol, unit } = family(`term.${element?.dataset.term}`);
    if (!element || !name || element === this.shown) return;
    this.hide();
    this.shown = element;
    element.setAttribute('aria-describedby', this.tip.id);
    const head = make('b', { textContent: [symbol, name].filter(Boolean).join(': ') });
    const rest = [];
    if (unit) rest.push(text('symbol.unit', { unit }));
    if (source) rest.push(text('symbol.source', { source }));
    this.tip.replaceChildren(head, make('span', { textContent: meaning }), make('small', {}, rest.join(' · ')));
    typeset(this.tip);
    this.tip.hidden = false;
    this.tip.style.pointerEvents = focused ? 'none' : '';
    const at = element.getBoundingClientRect();
    const { width, height } = this.tip.getBoundingClientRect();
    const beside = (element.closest('.controls')?.getBoundingClientRect().right ?? Infinity) + GAP;
    const above = at.top - GAP - height > 0; // below a name is what it names
    if (beside + width < window.innerWidth) {
      this.tip.style.left = `${beside}px`;
      this.tip.style.top = `${Math.min(at.top, window.innerHeight - height - 4)}px`;
      return;
    }
    this.tip.style.left = `${Math.max(4, Math.min(at.left, window.innerWidth - width - 4))}px`;
    this.tip.style.top = `${above ? at.top - GAP - height : at.bottom + GAP}px`;
  }
  hide() {
    this.shown?.removeAttribute('aria-describedby');
    this.shown = null;
    this.tip.hidden = true;
  }
  /**
   * Have the symbols in a text explain themselves; the first of each can be reached with the keyboard.
   * @param {HTMLElement} root
   */
  mark(root) {
    typeset(root);
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    /** @type {Text[]} */
    const texts = [];
    while (walker.nextNode()) {
      const node = /** @type {Text} */ (walker.currentNode);
      if (TOKEN.test(node.data) && !node.parentElement?.closest('[data-term], .formula, button, canvas'))
        texts.push(node);
    }
    const met = new Set([...root.querySelectorAll('.term[tabindex]')].map((each) => each.textContent));
    for (const node of texts) node.replaceWith(...this.#split(node.data, met));
  }
  /**
   * @param {string} words
   * @param {Set<string | null>} met  symbols that can be reached already
   */
  #split(words, met) {
    return words.split(new RegExp(TOKEN, 'u')).map((part) => {
      if (!(part in TOKENS)) return part;
      const sign = make('span', { className: 'term', textContent: part });
      sign.dataset.term = TOKENS[part];
      if (!met.has(part)) sign.tabIndex = 0;
      met.add(part);
      return sign;
    });
  }
}
