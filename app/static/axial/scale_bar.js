// What the colours of rods mean, at the lower right of the stage.
import { letters, scale as zoom } from '../charts/canvas.js';
import { hatch } from '../charts/hatch.js';
import { COLORS, css } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';

/** @import { Stage } from './stage.js' */

const [TALL, POINT] = [7, 8]; // pixels
const BEYOND = 1.02; // ends: a little more has the same colour

/**
 * What colours mean, pointed at both ends where some of it lies beyond them.
 * Returns where its words below and above begin.
 * @param {CanvasRenderingContext2D} c
 * @param {Stage} stage
 * @param {number} width
 * @param {number} height
 */
export function scaleBar(c, { field, frame, largest: end, what }, width, height) {
  const bar = Math.min(150 * zoom, 0.42 * width); // as long as the words of its ends
  const x = width - bar - (frame.target.held ? 44 : 16); // beside a wall
  const y = height - 8 - 16 * zoom;
  const unit = what === 'stress' ? frame.stressUnit / 1e6 : frame.speed;
  const largest = end * unit;
  const show = (/** @type {number} */ v) =>
    localised(Math.abs(v) >= 10 ? v.toFixed(0) : v.toPrecision(2)).replace('-', '−');
  const point = field.peak(what) > BEYOND * end ? POINT : 0;
  for (let k = 0; k < bar; k++) {
    c.fillStyle = css((k / bar) * 2 - 1, 1);
    const tall = TALL * Math.min((Math.min(k, bar - k - 1) + 1) / (point || 1), 1);
    c.fillRect(x + k, y + (TALL - tall) / 2, 1.2, tall);
  }
  hatch(c, [[x + point, x + 0.47 * bar]], y, TALL);
  c.fillStyle = COLORS.faint;
  c.font = letters(13);
  const [least, most] = [text('axial.stage.least', { what }), text('axial.stage.most', { what })];
  c.textAlign = 'left';
  if (c.measureText(`${least} ${most}`).width < bar) c.fillText(least, x, y - 4);
  c.textAlign = 'right';
  c.fillText(most, x + bar, y - 4);
  const words = `± ${show(largest)} ${what === 'stress' ? 'MPa' : 'm/s'}`;
  c.fillText(words, x + bar, y + TALL + 13 * zoom);
  return [x + bar - c.measureText(words).width, x];
}
