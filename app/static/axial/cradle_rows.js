// What the opening draws of a row of balls below its stage: their paths, as wide as they are, with the push in them.
import { between } from '../charts/scale.js';
import { figures } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { rowOf } from './cradle.js';

/** @import { AxialFrame } from '../messages.js' */
/** @import { Piece } from '../opening/rows.js' */
/** @import { Stage } from './stage.js' */

const LEAST = 5e-4; // of the impact speed, that is more than nothing
const [LEAVES, BACK] = [0.25, -0.2]; // of it, with which a ball is seen to leave, and the striker to turn back

/**
 * Velocities in the end, the striker's first [v].
 * @param {AxialFrame} frame
 */
export const lastOf = (frame) => rowOf(frame).velocities.map((velocity) => velocity[velocity.length - 1]);

/**
 * How many balls of the row leave, whether that is all of them, and whether the striker turns back.
 * @param {AxialFrame} frame
 */
export function leavingOf(frame) {
  const [own, ...others] = lastOf(frame);
  const count = others.filter((velocity) => velocity > LEAVES).length;
  return { count, way: own < BACK ? 'back' : count === others.length ? 'all' : count > 1 ? 'some' : 'one' };
}

/**
 * The rows: in a ball that moves as one the force goes evenly from one contact to the other.
 * @param {AxialFrame} frame
 * @param {Stage} stage
 */
export function cradleRows(frame, { row, scale }) {
  const { forces, paths, strongest } = rowOf(frame);
  const { motionTime: time } = frame;
  const none = new Float64Array(time.length);
  const push = (/** @type {number} */ k, /** @type {number} */ t) => between(time, forces[k] ?? none, t);
  /** @type {(t: number) => Piece[]} */
  const pieces = (t) =>
    row.map(({ hung, size }, k) => {
      const x = hung + between(time, paths[k], t) * scale;
      return [x - size / 2, x + size / 2, push(k - 1, t), push(k, t)];
    });
  const ends = [0, frame.duration].map(pieces);
  const left = Math.min(...ends.map(([[from]]) => from));
  const right = Math.max(...ends.map((all) => all[all.length - 1][1]));
  const rest = ends[0][0][1];
  const still = () => undefined;
  const feet = lastOf(frame).map((velocity, k) => {
    const [from, to] = ends[1][k];
    const speed = Math.abs(velocity) < LEAST ? '0' : figures(velocity * frame.speed, 2);
    return { x: (from + to) / 2, words: speed };
  });
  return {
    drawn: { left, right, rest },
    feet: { about: text('opening.speeds'), all: feet },
    field: { coarse: false, mean: still, pieces, profile: still },
    largest: strongest,
  };
}
