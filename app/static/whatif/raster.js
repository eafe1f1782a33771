// Colours of a map: values between four points of the lattice, never across a change in the number of contacts, where
// the line that parts a cell says which side a pixel is on.

/** @import { Window } from './window.js' */

/** @typedef {[x: number, y: number][]} Cut  where a change crosses the sides of a cell, 0 to 1 */
/** @typedef {{ ends: Cut, found: boolean }} Torn */

const ALIKE = 0;
const TORN = 1;
const UNKNOWN = 2;
const REFUSED = 3;
const NEAR = 0.02; // of a cell: the weight that the farthest corner still has
const BEYOND = 0.2; // of the range of its corners, that a cell at a change may leave it by

export class Raster {
  sheet = document.createElement('canvas');
  values = new Float32Array(0); // by pixel
  contacts = new Int16Array(0);
  /** @type {Map<number, Torn>} */ torn = new Map(); // cells through which a change goes
  step = 1; // pixels of the page in one of these
  refused = false; // whether anything in view is

  /**
   * Find values and colours of all pixels.
   * @param {Window} view  filled
   * @param {number} step
   * @param {(value: number) => number} colour  as a pixel has it
   */
  draw(view, step, colour) {
    const [width, height] = view.size.map((each) => Math.ceil(each / step));
    const { sheet } = this;
    this.step = step;
    if (sheet.width !== width || sheet.height !== height || this.values.length !== width * height) {
      Object.assign(sheet, { width, height });
      this.values = new Float32Array(width * height);
      this.contacts = new Int16Array(width * height);
    }
    const c = /** @type {CanvasRenderingContext2D} */ (sheet.getContext('2d'));
    const image = c.createImageData(width, height);
    const pixels = new Uint32Array(image.data.buffer);
    const kinds = this.#kinds(view);
    this.refused = kinds.includes(REFUSED) || view.contacts.some((count) => count < 0);
    const { axes, first, nx, steps } = view;
    const across = ((axes.x1 - axes.x0) / steps[0] / view.size[0]) * step; // steps of the lattice in a pixel
    for (let py = 0, at = 0; py < height; py++) {
      const up = 1 - ((py + 0.5) * step) / view.size[1];
      const y = Math.max((axes.y0 + up * (axes.y1 - axes.y0)) / steps[1] - first[1], 0);
      const j = Math.min(Math.floor(y), view.ny - 2);
      for (let px = 0; px < width; px++, at++) {
        const x = axes.x0 / steps[0] - first[0] + (px + 0.5) * across;
        const i = Math.min(Math.floor(x), nx - 2);
        const k = j * nx + i;
        if (kinds[k] === ALIKE) this.#within(view, at, k, x - i, y - j);
        else this.#beside(view, at, kinds[k], k, x - i, y - j);
        pixels[at] = colour(this.values[at]);
      }
    }
    c.putImageData(image, 0, 0);
  }
  /**
   * Of each cell what it is.
   * @param {Window} view
   */
  #kinds(view) {
    const { contacts, nx, ny } = view;
    const kinds = new Uint8Array(nx * ny);
    this.torn = new Map();
    for (let j = 0; j < ny - 1; j++)
      for (let i = 0; i < nx - 1; i++) {
        const k = j * nx + i;
        const [a, b, c, d] = [contacts[k], contacts[k + 1], contacts[k + nx], contacts[k + nx + 1]];
        if (a > 0 && a === b && a === c && a === d) continue;
        if (!a || !b || !c || !d) kinds[k] = UNKNOWN;
        else if (Math.min(a, b, c, d) < 0) kinds[k] = REFUSED;
        else {
          kinds[k] = TORN;
          this.torn.set(k, cutOf(view, i, j));
        }
      }
    return kinds;
  }
  /**
   * @param {Window} view
   * @param {number} at  pixel
   * @param {number} k  cell
   * @param {number} fx
   * @param {number} fy
   */
  #within({ contacts, nx, values }, at, k, fx, fy) {
    const [a, c] = [values[k], values[k + nx]];
    const low = a + fx * (values[k + 1] - a);
    this.values[at] = low + fy * (c + fx * (values[k + nx + 1] - c) - low);
    this.contacts[at] = contacts[k];
  }
  /**
   * In a cell that is not alike: as the corners on this side say.
   * @param {Window} view
   * @param {number} at
   * @param {number} kind
   * @param {number} k
   * @param {number} fx
   * @param {number} fy
   */
  #beside(view, at, kind, k, fx, fy) {
    const { contacts, nx, values } = view;
    this.values[at] = NaN;
    this.contacts[at] = 0;
    if (kind === UNKNOWN) return;
    const torn = this.torn.get(k);
    const corner = torn ? sideOf(torn.ends, fx, fy, k, nx) : nearest(fx, fy, k, nx);
    const count = contacts[corner];
    this.contacts[at] = count;
    if (count <= 0) return;
    let [sum, weight, low, high] = [0, 0, Infinity, -Infinity];
    for (let q = 0; q < 4; q++) {
      const [x, y] = [q & 1, q >> 1];
      const near = k + x + y * nx;
      if (contacts[near] > 0) [low, high] = [Math.min(low, values[near]), Math.max(high, values[near])];
      if (contacts[near] !== count) continue;
      const share = ((x ? fx : 1 - fx) + NEAR) * ((y ? fy : 1 - fy) + NEAR);
      const grown = slope(view, near, 1, count) * (fx - x) + slope(view, near, nx, count) * (fy - y);
      sum += share * (values[near] + grown);
      weight += share;
    }
    const room = BEYOND * (high - low);
    this.values[at] = Math.min(Math.max(sum / weight, low - room), high + room);
  }
}

/**
 * By values on one side of a change alone.
 * @param {Window} view
 * @param {number} at
 * @param {number} way  to the next point: along a row, or to the next one
 * @param {number} count
 */
function slope({ contacts, values }, at, way, count) {
  const is = (/** @type {number} */ k) => contacts[k] === count;
  const [back, ahead] = [is(at - way), is(at + way)];
  if (back && ahead) return (values[at + way] - values[at - way]) / 2;
  if (back && is(at - 2 * way)) return 1.5 * values[at] - 2 * values[at - way] + 0.5 * values[at - 2 * way];
  if (ahead && is(at + 2 * way)) return -1.5 * values[at] + 2 * values[at + way] - 0.5 * values[at + 2 * way];
  return back ? values[at] - values[at - way] : ahead ? values[at + way] - values[at] : 0;
}

/**
 * The line that parts a cell.
 * @param {Window} view
 * @param {number} i
 * @param {number} j
 * @returns {Torn}
 */
function cutOf(view, i, j) {
  const { contacts, nx } = view;
  const k = j * nx + i;
  const [a, b, c, d] = [contacts[k], contacts[k + 1], contacts[k + nx], contacts[k + nx + 1]];
  /** @type {Cut} */
  const ends = [];
  let found = true;
  const at = (/** @type {number} */ p, /** @type {number} */ q, /** @type {number} */ way) => {
    const change = view.change(p, q, way);
    found &&= change.found;
    return change.at;
  };
  if (a !== b) ends.push([at(i, j, 0), 0]);
  if (c !== d) ends.push([at(i, j + 1, 0), 1]);
  if (a !== c) ends.push([0, at(i, j, 1)]);
  if (b !== d) ends.push([1, at(i + 1, j, 1)]);
  return { ends, found };
}

/**
 * @param {number} fx
 * @param {number} fy
 * @param {number} k
 * @param {number} nx
 */
const nearest = (fx, fy, k, nx) => k + (fx > 0.5 ? 1 : 0) + (fy > 0.5 ? nx : 0);

/**
 * The nearest corner on the same side of the line.
 * @param {Cut} ends
 * @param {number} fx
 * @param {number} fy
 * @param {number} k
 * @param {number} nx
 */
function sideOf(ends, fx, fy, k, nx) {
  if (ends.length !== 2) return nearest(fx, fy, k, nx);
  const [[ax, ay], [bx, by]] = ends;
  const side = (/** @type {number} */ x, /** @type {number} */ y) => (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0;
  const mine = side(fx, fy);
  let [best, found] = [Infinity, nearest(fx, fy, k, nx)];
  for (let q = 0; q < 4; q++) {
    const [x, y] = [q & 1, q >> 1];
    const far = (x - fx) ** 2 + (y - fy) ** 2;
    if (side(x, y) === mine && far < best) [best, found] = [far, k + x + y * nx];
  }
  return found;
}
