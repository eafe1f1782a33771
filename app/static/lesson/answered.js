// How a lesson says that an answer is right, or what it has missed: signs and sentences, never a grade.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { elementsOf } from './nodes.js';

/** @import { Gaps, Piece } from './nodes.js' */

/** @param {boolean} right */
export const signOf = (right) => make('b', { textContent: right ? '✓' : '○', ariaHidden: 'true' });

/**
 * @param {boolean} right
 * @param {Piece[]} say
 * @param {Gaps} [gaps]
 */
export const saidOf = (right, say, gaps = {}) =>
  make('p', { className: 'lesson-said', tabIndex: -1 }, signOf(right), make('span', {}, ...elementsOf(say, gaps)));

/**
 * The button that answers.
 * @param {string} textContent
 * @param {() => void} onclick
 */
export const mainButton = (textContent, onclick) =>
  make('button', { type: 'button', className: 'lesson-main', textContent, onclick });

/**
 * The button that asks the same once more; what was answered first stays.
 * @param {() => void} onclick
 */
export function againButton(onclick) {
  const button = mainButton(text('lesson.try-again'), onclick);
  button.classList.add('plain');
  return button;
}

/**
 * How often a question was tried.
 * @param {number} count
 */
export const triesOf = (count) => make('p', { className: 'lesson-hint', textContent: text('lesson.tries', { count }) });

/**
 * For the summary, below what was said first: how often it was tried, and whether that came to be right.
 * @param {number} count
 * @param {boolean} later  a later answer is right, the first one is not
 */
export function afterwards(count, later) {
  if (count < 2) return [];
  if (!later) return [triesOf(count)];
  return [make('p', { className: 'lesson-later' }, signOf(true), ' ', text('lesson.later', { count }))];
}

const HANDS = ['keydown', 'pointerdown', 'popstate', 'wheel']; // what takes the page elsewhere

/**
 * What the page has said is seen, also where it stands below.
 * @param {Element} root
 * @param {Element} [above]  charts that come with the answer, and are still to grow
 */
export function brought(root, above) {
  const bring = () => root.querySelector('.lesson-said')?.scrollIntoView({ block: 'nearest' });
  bring();
  if (!above) return;
  const [grows, hand] = [new ResizeObserver(bring), new AbortController()];
  const { signal } = hand;
  grows.observe(above);
  signal.onabort = () => grows.disconnect();
  for (const type of HANDS) window.addEventListener(type, () => hand.abort(), { capture: true, signal });
}
