// What is written on the stage for bodies in space: how they spin; time, a length, and which way the axes run.
import { letters } from '../charts/canvas.js';
import { roundBelow } from '../charts/scale.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { brief } from '../text/format.js';
import { arrow, head, label, measure } from './arrows.js';
import { dot, size, times } from './vectors.js';

/** @import { SpaceFrame, Vector } from '../shell/message.js' */
/** @import { Context, Point } from './arrows.js' */
/** @import { BodiesStage } from './stage.js' */

const FONT = letters(12);
/** @type {Point} */
const PLACE = [12, 10]; // of the time
const BUTTONS = [170, 34]; // pixels that they take at the upper right
const RADIUS = 20; // pixels of the arc of a spin
const LEAST_AXIS = 3; // pixels of its axis, below which it is seen from its end

/**
 * A spin as an arc about the centre, and its axis.
 * @param {Context} c
 * @param {BodiesStage} stage
 * @param {Point} centre
 * @param {Vector} spin
 * @param {boolean} labelled
 */
export function spinOf(c, stage, [x, y], spin, labelled) {
  const seen = dot(spin, stage.toward) / stage.spin;
  const way = seen < 0 ? -1 : 1;
  const sweep = Math.max(Math.abs(seen) * 1.6 * Math.PI, 0.5);
  const start = 0.35 * Math.PI;
  const end = start + way * sweep;
  c.lineWidth = 1.6;
  c.beginPath();
  c.arc(x, y, RADIUS, -start, -end, way > 0);
  c.stroke();
  head(c, [x + RADIUS * Math.cos(end), y - RADIUS * Math.sin(end)], [-way * Math.sin(end), -way * Math.cos(end)], 7);
  if (labelled) label(c, `${brief(size(spin))} rad/s`, [x, y + RADIUS + 8], [0, 1]);
  const [dx, dy] = stage.flat(times(spin, (1.6 * RADIUS) / size(spin)));
  if (Math.hypot(dx, dy) < LEAST_AXIS) return;
  c.setLineDash([5, 3]);
  c.lineWidth = 1.2;
  c.beginPath();
  c.moveTo(x - dx, y + dy);
  c.lineTo(x + dx, y - dy);
  c.stroke();
  c.setLineDash([]);
}

/** @param {SpaceFrame} frame @param {number} t */
const timeOf = (frame, t) =>
  text('space.when', { before: t < 0, time: `${brief(Math.abs(t) * frame.duration * 1e3)} ms` });

/**
 * Where no label may lie: on the time, and under the buttons that turn the picture.
 * @param {Context} c
 * @param {SpaceFrame} frame
 * @param {number} t
 * @param {number} width
 * @returns {[left: number, top: number, right: number, bottom: number][]}
 */
export function corners(c, frame, t, width) {
  c.font = FONT;
  return [
    [0, 0, PLACE[0] + c.measureText(timeOf(frame, t)).width + 4, PLACE[1] + 14],
    [width - BUTTONS[0], 0, width, BUTTONS[1]],
  ];
}

/**
 * Time, a length to measure by, and which way the axes of the world run.
 * @param {Context} c
 * @param {BodiesStage} stage
 * @param {number} t
 * @param {number} width
 * @param {number} height
 */
export function legend(c, { across, frame, scale, up }, t, width, height) {
  const bar = roundBelow((0.2 * width) / scale);
  c.strokeStyle = c.fillStyle = COLORS.faint;
  c.font = FONT;
  measure(c, width - 16, height - 14, bar * scale, `${brief(bar)} m`);
  c.textAlign = 'left';
  c.textBaseline = 'top';
  c.fillText(timeOf(frame, t), ...PLACE);
  /** @type {Point} */
  const origin = [34, height - 34];
  ['x', 'y', 'z'].forEach((axis, i) => {
    const [dx, dy] = [across[i] * 24, -up[i] * 24];
    if (Math.hypot(dx, dy) < 5) return;
    /** @type {Point} */
    const tip = [origin[0] + dx, origin[1] + dy];
    arrow(c, origin, tip, 1.2);
    label(c, axis, tip, [dx, dy]);
  });
}
