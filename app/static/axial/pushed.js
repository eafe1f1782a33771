// The forces that two bodies exert on each other, as two arrows from where they touch: equally long at each instant.
import { letters, scale as zoom } from '../charts/canvas.js';
import { between } from '../charts/scale.js';
import { COLORS } from '../charts/styles.js';
import { arrow } from '../space/arrows.js';
import { engineering } from '../text/format.js';

/** @import { AxialFrame } from '../messages.js' */

const LONGEST = 0.2; // of the width, at the peak
const WIDE = 4; // pixels

/**
 * @param {CanvasRenderingContext2D} c
 * @param {AxialFrame} frame
 * @param {[x: number, y: number]} at  where they touch
 * @param {number} t
 * @param {number} width  of what is drawn [px]
 */
export function pushed(c, { exact, exactForce, exactTime, forceUnit }, [x, y], t, width) {
  const force = between(exactTime, exactForce, t) * forceUnit;
  const long = (LONGEST * width * force) / (exact.peakForce || Infinity);
  if (!(long > 2)) return;
  const words = engineering(force, 'N', 3);
  c.strokeStyle = c.fillStyle = COLORS.cursor;
  c.font = letters(15, '600 ');
  c.textBaseline = 'alphabetic';
  for (const way of [-1, 1]) {
    c.strokeStyle = c.fillStyle = COLORS.cursor;
    arrow(c, [x + 3 * way, y], [x + (3 + long) * way, y], WIDE);
    c.textAlign = way < 0 ? 'right' : 'left';
    c.lineWidth = 4;
    c.strokeStyle = COLORS.panel;
    c.strokeText(words, x + 12 * way, y - 12 * zoom);
    c.fillText(words, x + 12 * way, y - 12 * zoom);
  }
}
