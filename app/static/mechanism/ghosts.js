// Where the links of a mechanism that moves on are at other instants: thin lines, so that its way is seen at rest, too.

/** @import { Numbers } from '../messages.js' */
/** @import { Context, Point } from './mechanism.js' */

const APART = 0.1; // of the mechanism, that the fastest end goes from one to the next
const FAR = 0.2; // of it, that some end must go at least
const EACH = 24; // that are drawn before and after the instant shown
const PALE = [0.55, 0.15]; // of the nearest, and of the last

/** @typedef {{ t: number, ends: Numbers }} Ghost  the ends of all links, one after the other [m] */

/**
 * Those of a motion, which is known at instants; none of one that hardly moves.
 * @param {Numbers} times
 * @param {Numbers} points  ends of all links as they begin [m]
 * @param {Numbers} moves  how far they have come (times, ends) [m]
 * @param {number} size  of the mechanism [m]
 * @returns {Ghost[]}
 */
export function ghostsOf(times, points, moves, size) {
  const all = points.length;
  const at = (/** @type {number} */ k) => moves.subarray(k * all, (k + 1) * all);
  const apart = (/** @type {Numbers} */ one, /** @type {Numbers} */ other) => {
    let most = 0;
    for (let i = 0; i < all; i += 2) most = Math.max(most, Math.hypot(other[i] - one[i], other[i + 1] - one[i + 1]));
    return most;
  };
  /** @type {Ghost[]} */
  const found = [];
  let [last, far] = [at(0), 0];
  times.forEach((t, k) => {
    const now = at(k);
    far = Math.max(far, apart(at(0), now));
    if (k && apart(last, now) < APART * size) return;
    last = now;
    found.push({ t, ends: points.map((place, i) => place + now[i]) });
  });
  return far > FAR * size ? found : [];
}

/**
 * The nearest in time to an instant, the paler the further from it.
 * @param {Context} c
 * @param {Ghost[]} ghosts
 * @param {number} t
 * @param {(x: number, y: number) => Point} pixel
 */
export function drawGhosts(c, ghosts, t, pixel) {
  const next = ghosts.findIndex((ghost) => ghost.t > t);
  const now = next < 0 ? ghosts.length : next;
  c.save();
  c.strokeStyle = '#4a5968';
  c.lineWidth = 1;
  for (let k = Math.max(now - EACH, 0); k < Math.min(now + EACH, ghosts.length); k++) {
    const { ends } = ghosts[k];
    const far = k < now ? now - 1 - k : k - now;
    c.globalAlpha = PALE[0] + (far / EACH) * (PALE[1] - PALE[0]);
    c.beginPath();
    for (let i = 0; i < ends.length; i += 4) {
      c.moveTo(...pixel(ends[i], ends[i + 1]));
      c.lineTo(...pixel(ends[i + 2], ends[i + 3]));
    }
    c.stroke();
  }
  c.restore();
}
