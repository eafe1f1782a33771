// Lines of equal value through a map, by marching squares over its pixels, not across a change in the number of
// contacts; and the parts of it that have the same number.

/** @import { Window } from './window.js' */
/** @import { Raster } from './raster.js' */

const EVERY = 2; // pixels of the picture, between which a line is straight
const LEAP = 0.012; // of the scale: less is no jump

/**
 * Round values between two, or their logarithms where the scale is.
 * @param {[low: number, high: number]} domain
 * @param {boolean} log
 */
export function levelsOf([low, high], log) {
  const made = [];
  if (log) {
    const long = high - low;
    const heads = long > 4 ? [1] : long > 2.4 ? [1, 3] : long > 1.1 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 8];
    for (let power = Math.floor(low); power <= high; power++)
      for (const head of heads) made.push(power + Math.log10(head));
    return made.filter((each) => each > low && each < high);
  }
  const rough = (high - low) / 7;
  const unit = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5].find((each) => each * unit >= rough) ?? 10) * unit;
  for (let k = Math.ceil(low / step + 1e-9); k * step < high - 1e-9 * step; k++) made.push(k * step);
  return made;
}

/**
 * Pieces of lines, x and y of both ends of each [px of the page, from the corner of the plot], by level.
 * @param {Raster} raster
 * @param {number[]} levels  ascending
 * @param {[low: number, high: number]} domain
 * @returns {Map<number, number[]>}
 */
export function contoursOf({ contacts, sheet, step, values }, levels, domain) {
  const [w, h] = [sheet.width, sheet.height];
  /** @type {Map<number, number[]>} */
  const lines = new Map(levels.map((level) => [level, []]));
  const lists = levels.map((level) => /** @type {number[]} */ (lines.get(level)));
  const unit = step * EVERY;
  const leap = LEAP * (domain[1] - domain[0]);
  for (let j = 0; j + EVERY < h; j += EVERY)
    for (let i = 0; i + EVERY < w; i += EVERY) {
      const k = j * w + i;
      const corners = [k, k + EVERY, k + EVERY * w, k + EVERY * w + EVERY];
      const [a, b, c, d] = [values[k], values[corners[1]], values[corners[2]], values[corners[3]]];
      const [low, high] = [Math.min(a, b, c, d), Math.max(a, b, c, d)];
      const same = contacts[k] === contacts[corners[1]] && contacts[k] === contacts[corners[2]];
      const alike = same && contacts[k] === contacts[corners[3]];
      if (contacts[k] <= 0 || !(high >= low) || (!alike && high - low > leap)) continue;
      for (let n = 0; n < levels.length && levels[n] <= high; n++)
        if (levels[n] > low) crossed(lists[n], levels[n], a, b, c, d, (i + 0.5) / EVERY, (j + 0.5) / EVERY, unit);
    }
  return lines;
}

/**
 * @param {number[]} line  that grows
 * @param {number} v
 * @param {number} a  of the corner, and to its right
 * @param {number} b
 * @param {number} c  below these
 * @param {number} d
 * @param {number} i
 * @param {number} j
 * @param {number} unit
 */
function crossed(line, v, a, b, c, d, i, j, unit) {
  const ends = [];
  if (a < v !== b < v) ends.push((v - a) / (b - a), 0);
  if (b < v !== d < v) ends.push(1, (v - b) / (d - b));
  if (c < v !== d < v) ends.push((v - c) / (d - c), 1);
  if (a < v !== c < v) ends.push(0, (v - a) / (c - a));
  for (let m = 0; m + 3 < ends.length; m += 4)
    line.push((i + ends[m]) * unit, (j + ends[m + 1]) * unit, (i + ends[m + 2]) * unit, (j + ends[m + 3]) * unit);
}

/**
 * Parts of a window with the same number of contacts: where each is widest, as points of the lattice, and how wide.
 * @param {Window} view  filled
 */
export function partsOf(view) {
  const { contacts, nx, ny } = view;
  const deep = depthOf(view);
  const seen = new Uint8Array(nx * ny);
  const parts = [];
  for (let start = 0; start < nx * ny; start++) {
    if (seen[start] || contacts[start] <= 0) continue;
    let [size, best] = [0, start];
    const stack = [start];
    seen[start] = 1;
    for (let k = stack.pop(); k !== undefined; k = stack.pop()) {
      size += deep[k] > 0 ? 1 : 0;
      if (deep[k] > deep[best]) best = k;
      const i = k % nx;
      for (const next of [i > 0 ? k - 1 : -1, i < nx - 1 ? k + 1 : -1, k - nx, k + nx]) {
        if (next < 0 || next >= nx * ny || seen[next] || contacts[next] !== contacts[start]) continue;
        seen[next] = 1;
        stack.push(next);
      }
    }
    if (size) parts.push({ size, i: best % nx, j: Math.floor(best / nx), depth: deep[best], count: contacts[best] });
  }
  return parts.sort((a, b) => b.size - a.size);
}

/**
 * Steps from each point to the nearest with other contacts, or to the edge of the plot.
 * @param {Window} view
 */
function depthOf(view) {
  const { contacts, nx, ny } = view;
  const inside = (/** @type {number} */ place) => place > 0.01 && place < 0.99;
  const deep = new Int16Array(nx * ny);
  for (let j = 1; j < ny; j++)
    for (let i = 1; i < nx; i++) {
      const k = j * nx + i;
      if (!view.spot(i, j).every(inside)) continue;
      const back = [k - 1, k - nx, k - nx - 1];
      const same = back.every((each) => contacts[each] === contacts[k]);
      deep[k] = same ? 1 + Math.min(...back.map((each) => deep[each])) : 0;
    }
  for (let j = ny - 1; j >= 0; j--)
    for (let i = nx - 1; i >= 0; i--) {
      const k = j * nx + i;
      const ahead = [k + 1, k + nx, k + nx + 1];
      const same = i < nx - 1 && j < ny - 1 && ahead.every((each) => contacts[each] === contacts[k]);
      deep[k] = same ? Math.min(deep[k], 1 + Math.min(...ahead.map((each) => deep[each]))) : 0;
    }
  return deep;
}
