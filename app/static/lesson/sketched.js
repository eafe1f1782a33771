// The line that was drawn, and the one that is so, as a small picture of the summary.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { BIN } from './judge.js';

const [WIDE, TALL] = [240, 110]; // units of the picture
const SVG = 'http://www.w3.org/2000/svg';

/**
 * @param {string} tag
 * @param {Record<string, string | number>} attributes
 */
function shape(tag, attributes) {
  const found = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) found.setAttribute(name, String(value));
  return found;
}

/**
 * Straight pieces between values, a bin of time apart, within the axis; none where nothing is drawn.
 * @param {(number | null)[]} line
 * @param {[low: number, high: number]} axis
 */
export function wayOf(line, [low, high]) {
  let before = false;
  return line
    .flatMap((value, k) => {
      if (value === null || Number.isNaN(value)) {
        before = false;
        return [];
      }
      const x = (k / Math.max(line.length - 1, 1)) * WIDE;
      const y = (1 - (Math.min(Math.max(value, low), high) - low) / (high - low)) * TALL;
      const piece = `${before ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`;
      before = true;
      return [piece];
    })
    .join('');
}

/**
 * @param {(number | null)[]} mine
 * @param {number[] | undefined} so  what happens; answers of earlier days do not have it
 * @param {[low: number, high: number]} axis
 * @param {string} name  of what is drawn
 */
export function sketched(mine, so, axis, name) {
  const picture = shape('svg', { viewBox: `-2 -2 ${WIDE + 4} ${TALL + 4}`, role: 'img', class: 'sum-sketch' });
  picture.setAttribute('aria-label', name);
  const zero = wayOf([0, 0], axis);
  picture.append(shape('path', { d: zero, class: 'zero' }));
  if (so) picture.append(shape('path', { d: wayOf(so, axis), class: 'so' }));
  picture.append(shape('path', { d: wayOf(mine, axis), class: 'mine' }));
  const sign = (/** @type {string} */ className, /** @type {string} */ words) => make('span', { className }, words);
  const legend = [sign('mine', text('lesson.yours')), ...(so ? [sign('so', text('lesson.happens'))] : [])];
  return make('figure', { className: 'sum-sketched' }, picture, make('figcaption', {}, ...legend));
}

/**
 * What happens, at the instants of a line.
 * @param {number} count  of them
 * @param {(t: number) => number} value
 */
export const soOf = (count, value) => Array.from({ length: count }, (_, k) => Number(value(k * BIN).toPrecision(4)));
