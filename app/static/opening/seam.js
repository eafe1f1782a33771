// A body too thin for its rows to be seen: drawn as a seam that opens with the force through it.
import { letters, scale as zoom } from '../charts/canvas.js';
import { between } from '../charts/scale.js';
import { COLORS, css } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { engineering } from '../text/format.js';

/** @import { Numbers } from '../messages.js' */
/** @import { Section } from './section.js' */

const OPEN = 0.42; // of its width to both sides, where the force is the largest
const LEAST = 0.002; // of that, below which it is closed
const LINE = 17 * zoom; // pixels
const LEAST_WIDE = 52 * zoom; // pixels in which words have room

/**
 * @typedef {object} Filled
 * @property {number} left  [px]
 * @property {number} right
 * @property {ArrayLike<number>} x  times
 * @property {Numbers} force  [N]
 * @property {number} largest  force at the end of the colours [N]
 */

/**
 * @param {CanvasRenderingContext2D} c
 * @param {Section} section
 * @param {Filled} filled
 */
export function seam(c, section, { force, largest, left, right, x }) {
  const { tall, top } = section.box;
  const [start, end] = section.stretch;
  const [middle, most] = [(left + right) / 2, force.reduce((a, b) => Math.max(a, b), 0)];
  const at = (/** @type {number} */ row) => between(x, force, start + (row / tall) * (end - start));
  c.clearRect(left, top, right - left, tall);
  c.fillStyle = COLORS.contact;
  c.fillRect(left, top, right - left, tall);
  if (!(most > 0)) return;
  const half = (/** @type {number} */ value) => (Math.max(value, 0) / most) * OPEN * (right - left);
  for (let row = 0; row < tall; row++) {
    const value = at(row + 0.5);
    if (value < LEAST * most) continue;
    c.fillStyle = css(value, largest);
    c.fillRect(middle - half(value), top + row, 2 * half(value), 1);
  }
  c.strokeStyle = COLORS.ink;
  c.lineWidth = 1.6;
  for (const side of [-1, 1]) {
    c.beginPath();
    for (let row = 0; row <= tall; row++) c.lineTo(middle + side * half(at(row)), top + row);
    c.stroke();
  }
  if (right - left < LEAST_WIDE) return;
  const peak = section.y(x[force.indexOf(most)]);
  const below = Math.min(peak + 2 * LINE, top + tall - 8);
  section.words.say(text('opening.through'), middle, top + LINE, COLORS.ink, letters(13), 'center');
  section.words.say(engineering(most, 'N', 3), middle, below, COLORS.ink, letters(18, '600 '), 'center');
}
