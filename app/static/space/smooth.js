// An impact without friction over its impulse: every velocity changes in proportion to it.
import { text } from '../text/catalogue.js';
import { add, cross, dot, size, times, triple } from './vectors.js';

/** @import { Numbers, SpaceFrame, Vector } from '../messages.js' */

const POINTS = 32; // of the energy, which is no straight line
const LEAST = 1e-9; // of the largest spin, that is a change

/** @typedef {'impactor' | 'target'} Which */
/** @typedef {{ which: Which, values: [before: number, after: number] }} Change  of one body */
/**
 * @typedef {object} Smooth
 * @property {[before: number, after: number]} parting  of the points that touch [m/s]
 * @property {Change[]} along  velocities of the centres along the normal [m/s]
 * @property {Change[]} spins  about the axis about which it changes [rad/s]
 * @property {number[]} energy  of both [J], over the impulse
 */

/**
 * @param {SpaceFrame} frame
 * @returns {Smooth}
 */
export function smoothOf(frame) {
  const { bodies, impulse, push } = frame;
  const way = times(push, 1 / impulse);
  const known = /** @type {Which[]} */ (['impactor', 'target']).filter((which) => bodies[which].shape !== 'stop');
  const centre = { impactor: middle(frame.impactorPath), target: middle(frame.targetPath) };
  const at = (/** @type {Which} */ which, /** @type {'before' | 'after'} */ when) => {
    const { spin, velocity } = bodies[which][when];
    return dot(add(velocity, cross(spin, centre[which]), -1), way); // the point is that far behind the centre
  };
  const apart = (/** @type {'before' | 'after'} */ when) =>
    known.reduce((sum, which) => sum + (which === 'target' ? 1 : -1) * at(which, when), 0);
  const along = known.map((which) => {
    const { after, before } = bodies[which];
    return /** @type {Change} */ ({ which, values: [dot(before.velocity, way), dot(after.velocity, way)] });
  });
  const most = Math.max(...known.flatMap((which) => [bodies[which].before, bodies[which].after]).map(turning));
  const spins = known.flatMap((which) => {
    const { after, before } = bodies[which];
    const change = add(after.spin, before.spin, -1);
    if (!(size(change) > LEAST * most)) return [];
    const axis = times(change, 1 / size(change));
    return [/** @type {Change} */ ({ which, values: [dot(before.spin, axis), dot(after.spin, axis)] })];
  });
  const parting = /** @type {[number, number]} */ ([apart('before'), apart('after')]);
  return { parting, along, spins, energy: energyOf(frame, parting) };
}

/** @param {{ spin: Vector }} state */
const turning = ({ spin }) => size(spin);

/**
 * Where a centre is as they meet.
 * @param {Numbers} path
 */
const middle = (path) => triple(path, 3 * Math.floor(path.length / 6));

/**
 * What the push has done on the points that touch, added to what was there.
 * @param {SpaceFrame} frame
 * @param {[before: number, after: number]} parting
 */
function energyOf({ figures, impulse }, [before, after]) {
  const first = Number(figures.find(([name]) => name === 'energy-before')?.[1] ?? 0);
  return Array.from({ length: POINTS + 1 }, (_, k) => {
    const share = k / POINTS;
    return first + share * impulse * (before + 0.5 * share * (after - before));
  });
}

/** @param {Which} which  in words */
export const bodyOf = (which) => text(which === 'impactor' ? 'opening.track.strikes' : 'opening.track.body');
