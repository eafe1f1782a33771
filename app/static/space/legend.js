// What is written on the stage for bodies in space: how they spin; time, a length, and which way the axes run.
import { letters, scale as larger } from '../charts/canvas.js';
import { roundBelow } from '../charts/scale.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { brief } from '../text/format.js';
import { arrow, edged, head, label, measure } from './arrows.js';
import { AXES } from './box.js';
import { LONG } from './impulse.js';
import { add, dot, size, times } from './vectors.js';

/** @import { Vector } from '../messages.js' */
/** @import { Box, Context, Point } from './arrows.js' */
/** @import { BodiesStage } from './stage.js' */

const FONT = letters(13);
/** @type {Point} */
const PLACE = [12, 10]; // of the time
const BUTTONS = [170, 34]; // pixels that they take at the upper right
const RADIUS = 20; // pixels of the arc of a spin
const [ORIGIN, AXIS] = [34, 24]; // pixels of the axes of the world from the lower left corner, and of each
const HANDLE = 7; // pixels about a handle or a line
const EDGE = 3; // pixels about a body
const ARROW = 5; // pixels about an arrow
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
  c.beginPath();
  c.arc(x, y, RADIUS, -start, -end, way > 0);
  edged(c, 1.6);
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

/**
 * @param {BodiesStage} stage
 * @param {number} t
 */
function timeOf({ frame, share }, t) {
  const side = t < 0 ? 'before' : t > 0 || share === 1 ? 'after' : 'during';
  return text('space.when', { side, time: `${brief(Math.abs(t) * frame.duration * 1e3)} ms` });
}

/**
 * Where no label may lie: on the time, on the length to measure by, beside or below the picture, and under the buttons
 * that turn it.
 * @param {Context} c
 * @param {BodiesStage} stage
 * @param {number} t
 * @returns {Box[]}
 */
export function corners(c, stage, t) {
  const { high: height, scale, wide: width } = stage;
  c.font = FONT;
  const [left, top] = placeOfTime(c, stage, t, width);
  return [
    [0, 0, left + c.measureText(timeOf(stage, t)).width + 4, top + 14 * larger],
    [width - BUTTONS[0] * larger, 0, width, BUTTONS[1] * larger],
    [0, height, width, Infinity], // below the picture
    [width, 0, Infinity, Infinity], // beside it, where the tracks are
    [ORIGIN - AXIS, height - ORIGIN - AXIS, ORIGIN + AXIS, height - ORIGIN + AXIS],
    [
      width - 20 - Math.max(roundBelow((0.2 * width) / scale) * scale, 40 * larger),
      height - 34 * larger,
      width,
      height,
    ],
  ];
}

/**
 * Where handles, arrows and bodies are, also those from before: of what is longer than wide squares along it, of others
 * the middle.
 * @param {BodiesStage} stage
 * @param {number} t
 */
export function drawnAt(stage, t) {
  const about = (/** @type {Point} */ [x, y], /** @type {number} */ half) =>
    /** @type {Box} */ ([x - half, y - half, x + half, y + half]);
  const found = [about(stage.hands.tip, HANDLE), about([stage.x, stage.y], HANDLE)];
  for (const { axes = AXES, before, radius = 0, shape, sides = [0, 0, 0], name } of stage.bodies) {
    if (shape === 'stop') continue;
    const { centre, turned } = stage.pose(name, t);
    const [, wide, most] = [...sides].sort((a, b) => a - b);
    const half = Math.max(Math.max(radius, wide / 2) * stage.scale + EDGE, HANDLE);
    const axis = axes[sides.indexOf(most)];
    const pieces = Math.ceil(((most - wide) * stage.scale) / (4 * half)); // to both sides, without gaps
    for (let k = -pieces; k <= pieces; k++) {
      const along = turned(times(axis, pieces && ((most - wide) * k) / (2 * pieces)));
      found.push(about(stage.at(add(centre, along)), half));
    }
    if (t < 0) continue;
    const from = stage.at(stage.pose(name, -1).centre);
    found.push(about(from, Math.max(radius * stage.scale, HANDLE)));
    found.push(...onWay(from, stage.flat(times(before.velocity, stage.long / stage.speed))));
    const away = stage.flat(times(stage.frame.push, (LONG * stage.long) / (stage.frame.impulse || 1)));
    found.push(...onWay([stage.x, stage.y], name === 'target' ? away : [-away[0], -away[1]]));
  }
  return found;
}

/**
 * Squares along an arrow.
 * @param {Point} from
 * @param {[across: number, up: number]} way
 * @returns {Box[]}
 */
function onWay([x, y], [across, up]) {
  const count = Math.ceil(Math.hypot(across, up) / (2 * ARROW));
  return Array.from({ length: count }, (_, k) => {
    const [a, b] = [x + (across * (k + 1)) / count, y - (up * (k + 1)) / count];
    return [a - ARROW, b - ARROW, a + ARROW, b + ARROW];
  });
}

/**
 * Where the time is written: beside the buttons, or below them where there is no room.
 * @param {Context} c  its font set
 * @param {BodiesStage} stage
 * @param {number} t
 * @param {number} width
 * @returns {Point}
 */
function placeOfTime(c, stage, t, width) {
  const beside = PLACE[0] + c.measureText(timeOf(stage, t)).width < width - BUTTONS[0] * larger;
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
export function legend(c, stage, t, width, height) {
  const { across, scale, up } = stage;
  const bar = roundBelow((0.2 * width) / scale);
  c.strokeStyle = c.fillStyle = COLORS.faint;
  c.font = FONT;
  measure(c, width - 16, height - 14, bar * scale, `${brief(bar)} m`);
  c.textAlign = 'left';
  c.textBaseline = 'top';
  c.fillText(timeOf(stage, t), ...placeOfTime(c, stage, t, width));
  /** @type {Point} */
  const origin = [ORIGIN, height - ORIGIN];
  ['x', 'y', 'z'].forEach((axis, i) => {
    const [dx, dy] = [across[i] * AXIS, -up[i] * AXIS];
    if (Math.hypot(dx, dy) < 5) return;
    /** @type {Point} */
    const tip = [origin[0] + dx, origin[1] + dy];
    arrow(c, origin, tip, 1.2);
    label(c, axis, tip, [dx, dy]);
  });
}
