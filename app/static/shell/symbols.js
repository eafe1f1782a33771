// Symbols and choices explain themselves under the pointer and in the focus: symbol, unit, meaning, source.
import { make } from './dom.js';

/**
 * @typedef {object} Term
 * @property {string} symbol
 * @property {string} name
 * @property {string} unit
 * @property {string} meaning
 * @property {string} [source]
 */

const UNIT = 'unit';
const SOURCE = 'source';
/** @type {Record<string, Term>} */
export const TERMS = {
  T: {
    symbol: 'T',
    name: 'round trip',
    unit: 's',
    meaning: 'the time in which a wave runs to the far end of the rod and back: T = 2 L / c',
    source: 'thesis (4.10)',
  },
  v: { symbol: 'v', name: 'impact speed', unit: 'm/s', meaning: 'the speed at which the bodies approach each other' },
  e: {
    symbol: 'e',
    name: 'coefficient of restitution',
    unit: '1',
    meaning: 'speed of parting over speed of approach, of the bodies as wholes; 1 loses nothing, 0 keeps them together',
    source: 'thesis (4.39)',
  },
  mass_ratio: {
    symbol: 'm₂/m₁',
    name: 'mass ratio',
    unit: '1',
    meaning: 'mass of the struck body (2) over that of the striker (1): to the left the hammer is heavier',
    source: 'thesis (3.9)',
  },
  speed: {
    symbol: 'v',
    name: 'impact speed',
    unit: 'm/s',
    meaning: 'the speed at which the bodies approach each other',
  },
  law: {
    symbol: 'F(α)',
    name: 'contact law',
    unit: 'N',
    meaning: 'the force of contact as it follows from the indentation α and its rate',
    source: 'thesis, chapters 5 to 7',
  },
  linear_stiffness: {
    symbol: 'K_l',
    name: 'stiffness of a linear contact',
    unit: 'N/m',
    meaning: 'force of contact over indentation: F = K_l α',
  },
  hertz_stiffness: {
    symbol: 'K_h',
    name: 'stiffness of Hertz’s contact',
    unit: 'N/m^1.5',
    meaning: 'F = K_h α^1.5; it follows from the radii and the elasticity of both bodies',
    source: 'thesis, chapter 5',
  },
  force_at_depth: {
    symbol: 'F(10 µm)',
    name: 'force at an indentation of 10 µm',
    unit: 'N',
    meaning: 'says how stiff a power law is, whose constant has another unit with every exponent',
  },
  exponent: { symbol: 'n', name: 'exponent', unit: '1', meaning: 'of the contact law F = K αⁿ; 1.5 is Hertz’s' },
  yield_indentation: {
    symbol: 'α_Y',
    name: 'indentation at yield',
    unit: 'm',
    meaning: 'beyond it the contact yields, and part of the indentation stays',
    source: 'thesis, chapter 7',
  },
  restitution: {
    symbol: 'e',
    name: 'coefficient of restitution',
    unit: '1',
    meaning: 'speed of parting over speed of approach; 1 loses nothing, 0 keeps the bodies together',
    source: 'thesis (4.39)',
  },
  modes: {
    symbol: 'n',
    name: 'modes',
    unit: '1',
    meaning: 'natural modes of vibration that the modal solution keeps, from the lowest up',
    source: 'thesis (8.6)',
  },
  elements: { symbol: 'n_e', name: 'elements', unit: '1', meaning: 'finite elements along the struck body' },
  place: { symbol: 'x/L', name: 'struck place', unit: '1', meaning: 'distance from the first end over the length' },
  support: { symbol: '', name: 'support', unit: '', meaning: 'how the ends of the beam are held' },
  theory: {
    symbol: '',
    name: 'theory of the beam',
    unit: '',
    meaning:
      'Euler–Bernoulli: bending alone; Timoshenko: also shear and turning of sections, so waves have a top speed',
  },
  slenderness: { symbol: 'L/h', name: 'length over depth', unit: '1', meaning: 'how slender the beam is' },
  damping: { symbol: 'ζ', name: 'modal damping', unit: '1', meaning: 'share of critical damping in every mode' },
};
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
      if (first instanceof Element && first.matches(':focus-visible')) this.show(from(event));
    });
    page.addEventListener('focusout', () => this.hide());
    page.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') this.hide();
    });
  }
  /** @param {HTMLElement | null} element */
  show(element) {
    const term = element && TERMS[element.dataset.term ?? ''];
    if (!term || element === this.shown) return;
    this.hide();
    this.shown = element;
    element.setAttribute('aria-describedby', this.tip.id);
    const { symbol, name, unit, meaning, source } = term;
    const head = make('b', { textContent: [symbol, name].filter(Boolean).join(': ') });
    const rest = [unit && unit !== '1' ? `${UNIT} ${unit}` : '', source ? `${SOURCE} ${source}` : ''].filter(Boolean);
    this.tip.replaceChildren(head, make('span', { textContent: meaning }), make('small', {}, rest.join(' · ')));
    this.tip.hidden = false;
    const at = element.getBoundingClientRect();
    const { width, height } = this.tip.getBoundingClientRect();
    const below = at.bottom + GAP + height < window.innerHeight;
    this.tip.style.left = `${Math.max(4, Math.min(at.left, window.innerWidth - width - 4))}px`;
    this.tip.style.top = `${below ? at.bottom + GAP : at.top - GAP - height}px`;
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
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    /** @type {Text[]} */
    const texts = [];
    while (walker.nextNode()) {
      const text = /** @type {Text} */ (walker.currentNode);
      if (TOKEN.test(text.data) && !text.parentElement?.closest('[data-term], button, canvas')) texts.push(text);
    }
    const met = new Set([...root.querySelectorAll('.term[tabindex]')].map((each) => each.textContent));
    for (const text of texts) text.replaceWith(...this.#split(text.data, met));
  }
  /**
   * @param {string} text
   * @param {Set<string | null>} met  symbols that can be reached already
   */
  #split(text, met) {
    return text.split(new RegExp(TOKEN, 'u')).map((part) => {
      if (!(part in TOKENS)) return part;
      const sign = make('span', { className: 'term', textContent: part });
      sign.dataset.term = TOKENS[part];
      if (!met.has(part)) sign.tabIndex = 0;
      met.add(part);
      return sign;
    });
  }
}
