// What the opening says beside bodies in space: the impulse, and how they go and turn before and after it.
import { letters, scale as larger } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { brief } from '../text/format.js';
import { bodyOf } from './smooth.js';
import { size } from './vectors.js';

/** @import { BodyRecord, SpaceFrame } from '../messages.js' */

const TOP = 62 * larger; // pixels, below the buttons that turn the picture
const LINE = 21 * larger;
const COLUMNS = [0, 118, 226].map((x) => x * larger); // names, before and after
const LEAST = { wide: 330 * larger, high: TOP + 6.5 * LINE }; // in which all of it has room

/**
 * @param {BodyRecord} body
 * @returns {[before: string, after: string][]}
 */
function rowsOf({ after, before }) {
  const both = [before, after];
  const speeds = both.map(({ velocity }) => `${brief(size(velocity))} m/s`);
  const spins = both.map(({ spin }) => `${brief(size(spin))} rad/s`);
  const turns = both.some(({ spin }) => size(spin) > 0);
  return /** @type {[string, string][]} */ (turns ? [speeds, spins] : [speeds]);
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {SpaceFrame} frame
 * @param {Record<'impactor' | 'target', string>} ink
 * @param {{ left: number, width: number, height: number }} room
 */
export function summary(c, { bodies, impulse }, ink, { height, left, width }) {
  if (width < LEAST.wide || height < LEAST.high) return;
  const [, first, second] = COLUMNS.map((x) => left + x);
  let y = TOP;
  const write = (/** @type {string} */ words, /** @type {number} */ x, /** @type {string} */ color) => {
    c.fillStyle = color;
    c.fillText(words, x, y);
  };
  c.textAlign = 'left';
  c.textBaseline = 'alphabetic';
  c.font = letters(26, '600 ');
  const words = `${brief(impulse)} N s`;
  write(words, left, COLORS.ink);
  const beside = left + c.measureText(words).width + 10;
  c.font = letters(13);
  write(text('space.impulse'), beside, COLORS.faint);
  y += 1.5 * LINE;
  write(text('space.before'), first, COLORS.faint);
  write(text('space.after'), second, COLORS.faint);
  for (const which of /** @type {const} */ (['impactor', 'target'])) {
    if (bodies[which].shape === 'stop') continue;
    rowsOf(bodies[which]).forEach(([before, after], k) => {
      y += LINE;
      c.font = letters(13, '600 ');
      if (k === 0) write(bodyOf(which), left, ink[which]);
      c.font = letters(13);
      write(before, first, COLORS.ink);
      write(after, second, COLORS.ink);
    });
  }
}
