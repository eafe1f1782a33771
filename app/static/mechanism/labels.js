// Words on the stage of a mechanism: names of links, where they lie neither on links and joints nor on other words; and
// where a mass is that has left the picture.
import { letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { linkOf } from '../text/words.js';
import { ARROW, arrow, awayOf } from '../beam/flown.js';

/** @import { Context, Mechanism, Point } from './mechanism.js' */

/** @typedef {[left: number, top: number, right: number, bottom: number]} Box  in pixels */

const PLACES = [0.5, 0.28, 0.72, 0.12, 0.88]; // along a link, the best first
const FURTHER = [0, 12, 26, 44]; // pixels from it, besides what the words need
const HALF_LINE = 9; // pixels
const ROOM = 3; // pixels between words and what is drawn
const PIN = 7; // pixels about a joint
const GROUND = [16, 24]; // pixels beside and below one on the ground
const [EDGE, TOP] = [10, 48]; // pixels, as near to the edges as which the way to a mass is drawn
const PIECES = 8; // of a link that bends, as far as words are concerned

/**
 * @param {Box} one
 * @param {Box} other
 */
const overlap = (one, other) => one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3];

/**
 * Whether a straight piece passes through a box.
 * @param {Point} from
 * @param {Point} to
 * @param {Box} box
 */
function crosses(from, to, [left, top, right, bottom]) {
  let [enters, leaves] = [0, 1];
  for (const [start, way, low, high] of [
    [from[0], to[0] - from[0], left, right],
    [from[1], to[1] - from[1], top, bottom],
  ]) {
    if (way === 0 && (start < low || start > high)) return false;
    if (way === 0) continue;
    const [one, other] = [(low - start) / way, (high - start) / way];
    enters = Math.max(enters, Math.min(one, other));
    leaves = Math.min(leaves, Math.max(one, other));
  }
  return enters < leaves;
}

export class Labels {
  /** @type {number[]} */ taken = []; // by link, which of its places: words that need not move stay

  /** @param {Mechanism} mechanism */
  constructor(mechanism) {
    this.mechanism = mechanism;
  }
  /**
   * Where words may lie beside a link, as their middles.
   * @param {number} n
   * @param {number} half  of their width
   * @returns {Point[]}
   */
  #places(n, half) {
    const { mechanism } = this;
    const { struck } = mechanism.linkage;
    const line = mechanism.placed[n];
    const [[fx, fy], [lx, ly]] = [line[0], line[line.length - 1]];
    const length = Math.hypot(lx - fx, ly - fy) || 1;
    const [across, down] = [-(ly - fy) / length, (lx - fx) / length];
    const [wx, wy] = mechanism.way;
    const away = across * wx + down * wy < 0 ? -1 : 1; // the striker comes from the other side
    const least = 0.5 * mechanism.thick(n) + ROOM + half * Math.abs(across) + HALF_LINE * Math.abs(down);
    const order = n === struck ? [PLACES[1], PLACES[0], ...PLACES.slice(2)] : PLACES;
    return FURTHER.flatMap((more) =>
      [away, -away].flatMap((side) =>
        order.map((share) => {
          const [a, b] = mechanism.along(n, share);
          const aside = side * (least + more);
          return /** @type {Point} */ ([a + aside * across, b + aside * down]);
        }),
      ),
    );
  }
  /**
   * What is drawn besides links.
   * @returns {Box[]}
   */
  #obstacles() {
    const { linkage, along } = this.mechanism;
    /** @type {Box[]} */
    const found = linkage.joints.map(({ link, links, share }) => {
      const [x, y] = along.call(this.mechanism, link, share);
      const [beside, below] = links.includes('ground') ? GROUND : [PIN, PIN];
      return [x - beside, y - PIN, x + beside, y + below];
    });
    const held = this.#held();
    return held ? [...found, held] : found;
  }
  /** What strikes, where it is. @returns {Box | null} */
  #held() {
    const { held } = this.mechanism;
    if (!held) return null;
    const half = 0.5 * Math.max(held.width, held.height) + ROOM;
    return [held.x - half, held.y - half, held.x + half, held.y + half];
  }
  /** Where it comes past at other instants. @returns {Box[]} */
  #ways() {
    const { past, wide } = this.mechanism;
    const half = 0.5 * wide;
    return past.map(([x, y]) => [x - half, y - half, x + half, y + half]);
  }
  /** Links as a few straight pieces each. @returns {{ pieces: Point[], half: number }[]} */
  #lines() {
    const { mechanism } = this;
    return mechanism.placed.map((line, n) => {
      const step = Math.max(Math.floor((line.length - 1) / PIECES), 1);
      const pieces = line.filter((_, k) => k % step === 0 || k === line.length - 1);
      return { pieces, half: 0.5 * mechanism.thick(n) + 1 };
    });
  }
  /**
   * @param {Context} c
   * @param {Box[]} words  that are written already
   */
  draw(c, words) {
    const { mechanism, taken } = this;
    const { height, linkage, width } = mechanism;
    const boxes = [...words, ...this.#obstacles()];
    const [held, ways, lines] = [this.#held(), this.#ways(), this.#lines()];
    /** @type {(box: Box) => number} */
    const hidden = (box) => {
      const [left, top, right, bottom] = box;
      const beyond = left < 2 || top < 2 || right > width - 2 || bottom > height - 2 ? 8 : 0;
      const under = lines.filter(({ pieces, half }) => {
        const wide = /** @type {Box} */ ([left - half, top - half, right + half, bottom + half]);
        return pieces.some((to, k) => k > 0 && crosses(pieces[k - 1], to, wide));
      });
      return beyond + under.length + boxes.filter((other) => overlap(box, other)).length;
    };
    c.font = letters(13);
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    c.lineWidth = 3;
    c.strokeStyle = 'rgba(255,255,255,.85)';
    c.fillStyle = COLORS.faint;
    linkage.links.forEach((link, n) => {
      const name = linkOf(link.name);
      const half = 0.5 * c.measureText(name).width;
      const places = this.#places(n, half);
      const boxOf = (/** @type {number} */ k) => {
        const [x, y] = places[k];
        return /** @type {Box} */ ([x - half - 1, y - HALF_LINE, x + half + 1, y + HALF_LINE]);
      };
      const order = [...(taken[n] === undefined ? [] : [taken[n]]), ...places.keys()];
      const free = order.filter((k) => !hidden(boxOf(k)));
      const apart = free.find((k) => !ways.some((other) => overlap(boxOf(k), other))) ?? free[0];
      const best = apart ?? order.reduce((a, b) => (hidden(boxOf(b)) < hidden(boxOf(a)) ? b : a));
      taken[n] = best;
      if (held && overlap(boxOf(best), held)) return; // what strikes is over it
      boxes.push(boxOf(best));
      const [x, y] = places[best];
      c.strokeText(name, x, y);
      c.fillText(name, x, y);
    });
  }
}

/**
 * The way to the mass, which has left the picture, and how far beyond it is.
 * @param {Context} c
 * @param {Mechanism} mechanism
 * @param {Point} place  of it
 */
export function gone(c, mechanism, [x, y]) {
  const { center, factor, flight, frame, height, scale, width } = mechanism;
  mechanism.held = null;
  const [across, down] = [x - center[0], y - center[1]];
  const share = (/** @type {number} */ way, /** @type {number} */ from, /** @type {number} */ to) =>
    way === 0 ? Infinity : (to - from) / way;
  const edge = Math.min(
    share(across, center[0], across > 0 ? width - EDGE : EDGE),
    share(down, center[1], down > 0 ? height - EDGE : TOP),
  );
  const [a, b] = [center[0] + edge * across, center[1] + edge * down];
  const long = Math.hypot(across, down);
  const [ax, ay] = [(ARROW * across) / long, (ARROW * down) / long];
  arrow(c, [a - ax, b - ay], [ax, ay], COLORS.edge);
  const far = Math.hypot(Math.max(-x, x - width, 0), Math.max(-y, y - height, 0)) / (scale * (flight || factor));
  if (!far) return; // just so
  const left = a < center[0];
  c.font = letters(13);
  c.fillStyle = COLORS.faint;
  c.textBaseline = 'middle';
  c.textAlign = left ? 'left' : 'right';
  const said = awayOf(frame.impactor.kind, far);
  const [from, middle] = [a + (left ? -4 : 4), b + (b > center[1] ? -1 : 1) * (ARROW + 8)];
  c.fillText(said, from, middle);
  const wide = c.measureText(said).width;
  mechanism.away = [left ? from : from - wide, middle - HALF_LINE, left ? from + wide : from, middle + HALF_LINE];
}
