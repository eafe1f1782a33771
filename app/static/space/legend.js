// What is written on the stage for bodies in space: how they spin; time, a length, and which way the axes run.
import { letters, scale as larger } from '../charts/canvas.js';
import { roundBelow } from '../charts/scale.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { brief } from '../text/format.js';
import { arrow, head, label, measure } from './arrows.js';
import { AXES } from './box.js';
import { add, dot, size, times } from './vectors.js';

/** @import { SpaceFrame, Vector } from '../shell/message.js' */
/** @import { Box, Context, Point } from './arrows.js' */
/** @import { BodiesStage } from './stage.js' */

const FONT = letters(12);
/** @type {Point} */
const PLACE = [12, 10]; // of the time
const BUTTONS = [170, 34]; // pixels that they take at the upper right
const RADIUS = 20; // pixels of the arc of a spin
const HANDLE = 7; // pixels about a handle or a line
const PIECES = 8; // of half a line
const LEAST_AXIS = 3; // pixels of its axis, below which it is seen from its end

/**
 * A spin as an arc about the centre, and its axis.
 * @param {Context} c
 * @param {BodiesStage} stage
 * @param {Point} centre
 * @param {Vector} spin
 * @param {boolean} labelled
 * @param {Point} aside  the side on which it is written, of length 1
 */
export function spinOf(c, stage, [x, y], spin, labelled, [ax, ay]) {
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
  if (labelled) label(c, `${brief(size(spin))} rad/s`, [x + ax * (RADIUS + 8), y + ay * (RADIUS + 8)], [ax, ay]);
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
 * Where no label may lie: on the time, below the picture, and under the buttons that turn the picture.
 * @param {Context} c
 * @param {SpaceFrame} frame
 * @param {number} t
 * @param {number} width
 * @param {number} height
 * @returns {Box[]}
 */
export function corners(c, frame, t, width, height) {
  c.font = FONT;
  const [left, top] = placeOfTime(c, frame, t, width);
  return [
    [0, 0, left + c.measureText(timeOf(frame, t)).width + 4, top + 14 * larger],
    [width - BUTTONS[0] * larger, 0, width, BUTTONS[1] * larger],
    [0, height, width, Infinity], // below the picture
  ];
}

/**
 * Where handles and bodies are: of a line small squares along it, of others the middle.
 * @param {BodiesStage} stage
 * @param {number} t
 */
export function drawnAt(stage, t) {
  const about = (/** @type {Point} */ [x, y], /** @type {number} */ half) =>
    /** @type {Box} */ ([x - half, y - half, x + half, y + half]);
  const found = [about(stage.hands.tip, HANDLE), about([stage.x, stage.y], HANDLE)];
  for (const { axes = AXES, radius = 0, shape, sides = [0, 0, 0], name } of stage.bodies) {
    if (shape === 'stop') continue;
    const { centre, turned } = stage.pose(name, t);
    const long = sides.filter((side) => side > 0).length === 1 ? sides.findIndex((side) => side > 0) : -1;
    const half = Math.max(radius, Math.min(...sides) / 2) * stage.scale;
    if (long < 0) found.push(about(stage.at(centre), Math.max(half, HANDLE)));
    for (let k = -PIECES; k <= PIECES && long >= 0; k++) {
      const along = turned(times(axes[long], (sides[long] * k) / (2 * PIECES)));
      found.push(about(stage.at(add(centre, along)), HANDLE));
    }
  }
  return found;
}

/**
 * Where the time is written: beside the buttons, or below them where there is no room.
 * @param {Context} c  its font set
 * @param {SpaceFrame} frame
 * @param {number} t
 * @param {number} width
 * @returns {Point}
 */
function placeOfTime(c, frame, t, width) {
  const beside = PLACE[0] + c.measureText(timeOf(frame, t)).width < width - BUTTONS[0] * larger;
  return beside ? PLACE : [PLACE[0], BUTTONS[1] * larger + 4];
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
  c.fillText(timeOf(frame, t), ...placeOfTime(c, frame, t, width));
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
