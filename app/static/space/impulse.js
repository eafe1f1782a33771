// The impulse on the stage for bodies in space, as it grows, and the cone within which dry friction keeps it.
import { letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { brief } from '../text/format.js';
import { arrow, edged, label } from './arrows.js';
import { add, cross, dot, size, times, triple } from './vectors.js';

/** @import { Numbers, SpaceFrame, Vector } from '../messages.js' */
/** @import { Context, Point } from './arrows.js' */
/** @import { BodiesStage } from './stage.js' */
/** @typedef {'impactor' | 'target'} Which */

export const LONG = 1.1; // of the longest velocity: all of the impulse
const HIGH = 1.15; // of the normal impulse: the cone
const ROUND = 48; // corners of the circle at its end
const PALE = 0.16; // of its inside
const WIDEST = 1.6; // of the longest velocity: its radius

/** Degrees between the normal and the cone. @param {SpaceFrame} frame */
export const coneOf = ({ friction }) => (Math.atan(friction) * 180) / Math.PI;

/**
 * Where a share of the normal impulse is on the course of sliding.
 * @param {Numbers} press
 * @param {number} share
 * @returns {(values: Numbers, wide: number, first: number) => Vector}  three numbers of each row, at that share
 */
function alongCourse(press, share) {
  const given = share * press[press.length - 1];
  const next = Math.max(
    press.findIndex((each) => each > given),
    1,
  );
  const part = (given - press[next - 1]) / (press[next] - press[next - 1] || 1);
  return (values, wide, first) =>
    add(times(triple(values, wide * (next - 1) + first), 1 - part), triple(values, wide * next + first), part);
}

/**
 * The impulse on the target that has been given [N s].
 * @param {SpaceFrame} frame
 * @param {number} share  of the normal impulse
 * @returns {Vector}
 */
export function givenAt({ push, slideImpulse, slidePress }, share) {
  if (!slideImpulse || !slidePress || share >= 1) return times(push, share);
  return alongCourse(slidePress, share)(slideImpulse, 3, 0);
}

/**
 * How a body goes and turns by then.
 * @param {SpaceFrame} frame
 * @param {Which} which
 * @param {number} share
 * @returns {{ velocity: Vector, spin: Vector }}
 */
export function movingAt(frame, which, share) {
  const { after, before, mass = Infinity } = frame.bodies[which];
  if (share <= 0 || share >= 1) return share > 0 ? after : before;
  const { slidePress, slideSpins } = frame;
  const [way, first] = which === 'target' ? [1, 3] : [-1, 0];
  const turning =
    slidePress && slideSpins
      ? alongCourse(slidePress, share)(slideSpins, 6, first)
      : add(times(before.spin, 1 - share), after.spin, share);
  return { velocity: add(before.velocity, givenAt(frame, share), way / mass), spin: turning };
}

/**
 * Pixels of one newton second.
 * @param {BodiesStage} stage
 */
const longOf = ({ frame, long }) => (LONG * long) / frame.impulse;

/**
 * The bodies that it moves, and which way it pushes them.
 * @param {SpaceFrame} frame
 * @returns {[Which, number][]}
 */
const pushed = ({ bodies }) =>
  /** @type {[Which, number][]} */ ([
    ['impactor', -1],
    ['target', 1],
  ]).filter(([which]) => bodies[which].shape !== 'stop');

/**
 * What the cone looks like, in pixels from the contact, upward positive: its outline, and the circle at its end.
 * @param {BodiesStage} stage
 * @returns {{ outline: Point[], end: Point[] } | null}  nothing without friction
 */
export function coneSeen(stage) {
  const { frame, long, toward, up } = stage;
  const { friction, normal, push } = frame;
  if (!(friction > 0)) return null;
  const [, way] = pushed(frame)[0];
  const axis = times(normal, way);
  const high = Math.min(HIGH * dot(push, normal) * longOf(stage), (WIDEST * long) / friction);
  const aside = cross(axis, Math.abs(dot(axis, toward)) < 0.9 ? toward : up);
  const one = times(aside, 1 / size(aside));
  const [h, e, f] = [axis, one, cross(axis, one)].map((each, k) => stage.flat(times(each, k ? friction * high : high)));
  const at = (/** @type {number} */ turn) =>
    /** @type {Point} */ ([0, 1].map((k) => h[k] + e[k] * Math.cos(turn) + f[k] * Math.sin(turn)));
  const end = Array.from({ length: ROUND + 1 }, (_, k) => at((2 * Math.PI * k) / ROUND));
  // where lines from the tip touch the circle: with d = h + e cos + f sin, where d x d' = 0
  const area = ([a, b] = [0, 0], [c, d] = [0, 0]) => a * d - b * c;
  const [across, along] = [area(h, f), area(h, e)];
  const level = -area(e, f) / (Math.hypot(across, along) || 1);
  if (!(Math.abs(level) < 1)) return { outline: end, end }; // one looks into it
  const [middle, half] = [-Math.atan2(along, across), Math.acos(level)];
  const ahead = (/** @type {number} */ turn) => at(turn)[0] * h[0] + at(turn)[1] * h[1];
  const far = ahead(middle) > ahead(middle + Math.PI);
  const [from, to] = far ? [middle - half, middle + half] : [middle + half, middle - half + 2 * Math.PI];
  const rim = Array.from({ length: ROUND + 1 }, (_, k) => at(from + ((to - from) * k) / ROUND));
  return { outline: [[0, 0], ...rim], end };
}

/**
 * @param {Context} c
 * @param {BodiesStage} stage
 * @param {number} share  of the normal impulse that has been given
 * @param {number} strength
 */
export function drawImpulse(c, stage, share, strength) {
  const { frame, x, y } = stage;
  const seen = coneSeen(stage);
  c.globalAlpha = strength;
  if (seen) drawCone(c, stage, seen);
  const [across, up] = stage.flat(times(givenAt(frame, share), longOf(stage)));
  c.strokeStyle = c.fillStyle = COLORS.cursor;
  for (const [, way] of pushed(frame)) arrow(c, [x, y], [x + way * across, y - way * up], 3.2);
  c.beginPath();
  c.arc(x, y, 4, 0, 7);
  c.fill();
  c.globalAlpha = 1;
}

/**
 * @param {Context} c
 * @param {BodiesStage} stage
 * @param {{ outline: Point[], end: Point[] }} seen
 */
function drawCone(c, { x, y }, { end, outline }) {
  const { globalAlpha } = c;
  const trace = (/** @type {Point[]} */ points) => {
    c.beginPath();
    for (const [across, up] of points) c.lineTo(x + across, y - up);
  };
  c.strokeStyle = c.fillStyle = COLORS.modal;
  trace(outline);
  c.closePath();
  c.globalAlpha = PALE * globalAlpha;
  c.fill();
  c.globalAlpha = globalAlpha;
  edged(c, 1.4);
  trace(end);
  edged(c, 1.4);
}

/**
 * How large the impulse is, and what the cone is.
 * @param {Context} c
 * @param {BodiesStage} stage
 * @param {number} share
 */
export function nameImpulse(c, stage, share) {
  const { frame, x, y } = stage;
  /** @type {Point} */
  const side = Math.abs(stage.flat(frame.normal)[0]) > 0.5 ? [0, -1] : [1, 0];
  /** @type {Point} */
  const beside = [x + (stage.stopped ? stage.reach + 8 : 12) * side[0], y + 14 * side[1]];
  c.fillStyle = COLORS.cursor;
  c.font = letters(13, 'bold ');
  label(c, `J = ${brief(size(givenAt(frame, share)))} N s`, beside, side);
  if (!(frame.friction > 0)) return;
  c.fillStyle = COLORS.modal;
  const aside = side[0] ? 2 * x - beside[0] : beside[0]; // to the other side, so that each has room
  label(c, text('space.cone', { angle: coneOf(frame) }), [aside, beside[1]], [-side[0], side[1]]);
}
