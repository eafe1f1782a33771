// What has struck and left the picture: the way to it, and how far beyond it is.
import { letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { figures, scaled } from '../text/format.js';

/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {[x: number, y: number]} Point */

export const ARROW = 20; // pixels
const FLOWN = 26; // below the words at the upper edge

/**
 * @param {Context} c
 * @param {Point} from
 * @param {Point} way  in pixels
 * @param {string} [colour]
 */
export function arrow(c, [x, y], [dx, dy], colour = COLORS.halfSpace) {
  const length = Math.hypot(dx, dy);
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(7, length);
  c.strokeStyle = c.fillStyle = colour;
  c.lineWidth = 2;
  c.beginPath();
  c.moveTo(x, y);
  c.lineTo(x + dx - head * ux, y + dy - head * uy);
  c.stroke();
  c.beginPath();
  c.moveTo(x + dx, y + dy);
  c.lineTo(x + dx - head * ux - 0.5 * head * uy, y + dy - head * uy + 0.5 * head * ux);
  c.lineTo(x + dx - head * ux + 0.5 * head * uy, y + dy - head * uy - 0.5 * head * ux);
  c.fill();
}

/**
 * @param {string} striker
 * @param {number} distance  beyond the edge of the picture [m]
 */
export function awayOf(striker, distance) {
  const [times, unit] = scaled(distance, 'm');
  return text('motion.gone', { striker, away: `${figures(distance * times, 2)} ${unit}` });
}

/**
 * The way up to what has struck a beam and left the picture, and how far beyond it is.
 * @param {Context} c
 * @param {string} striker
 * @param {Point} place  of its face
 * @param {number} scale  pixels in a metre
 * @param {boolean} narrow  whether words at the upper edge leave it no room beside the way
 */
export function flown(c, striker, [x, y], scale, narrow) {
  arrow(c, [x, FLOWN + ARROW], [0, -ARROW], COLORS.edge);
  if (y >= 0) return; // just so
  const said = awayOf(striker, -y / scale);
  c.font = letters(13);
  c.fillStyle = COLORS.faint;
  c.textBaseline = 'middle';
  c.textAlign = 'right';
  c.fillText(said, x - 8, FLOWN + (narrow ? 1.7 : 0.6) * ARROW);
}
