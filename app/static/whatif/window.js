// What a map shows of a lattice: which points it still needs, coarse ones first, and their values.
import { MISSING } from './lattice.js';
import { longOf, valueAt } from './places.js';
import { PLACE, WIDTH, shownOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Lattice } from './lattice.js' */
/** @import { Mapped } from './results.js' */

const FINEST = 12; // levels: steps of 2^-level
const COARSE = 8; // steps of the first picture, in steps of the finest
export const NEVER_SPARED = COARSE / 2; // steps between points that every whole map has
const ROW = 2 ** 24;
const STRAIGHT = 0.002; // of its scale, or of a decade: what a straight line may be off by

/** @typedef {{ x: Axis, y: Axis, x0: number, x1: number, y0: number, y1: number }} Axes  ends as places */
/** @typedef {[i: number, j: number]} Point  of a window */

export class Window {
  coarse = false; // whether coarse points are missing
  /** @type {Int32Array} */ index; // of points, by row; MISSING
  values = new Float64Array(0); // of the result that is shown; logarithms where its scale is
  contacts = new Int16Array(0); // 0: nothing known; negative: refused

  /**
   * @param {Lattice} lattice
   * @param {Axes} axes
   * @param {[width: number, height: number]} size  of the plot [px]
   * @param {number} cell  of a step of the lattice at least [px]
   * @param {number} [coarsest]  steps of the first picture, a power of two
   */
  constructor(lattice, axes, size, cell, coarsest = COARSE) {
    Object.assign(this, { axes, lattice, size });
    this.lattice = lattice;
    this.axes = axes;
    this.size = size;
    this.coarsest = coarsest;
    const along = (/** @type {number} */ from, /** @type {number} */ to, /** @type {number} */ pixels) => {
      const level = Math.floor(-Math.log2((cell * (to - from)) / pixels));
      const step = 2 ** -Math.min(Math.max(level, Math.log2(coarsest)), FINEST); // the first one divides one
      const first = Math.floor(from / step / coarsest + 1e-9) * coarsest;
      const last = Math.ceil(to / step / coarsest - 1e-9) * coarsest;
      return { step, first, count: Math.max(last - first, coarsest) + 1 };
    };
    const [across, up] = [along(axes.x0, axes.x1, size[0]), along(axes.y0, axes.y1, size[1])];
    this.steps = [across.step, up.step];
    this.units = this.steps.map((step) => step * 2 ** FINEST); // steps of the finest level
    this.first = [across.first, up.first];
    this.nx = across.count;
    this.ny = up.count;
    this.look();
  }
  /**
   * @param {number} i
   * @param {number} j
   */
  key(i, j) {
    return (i + this.first[0]) * this.units[0] * ROW + (j + this.first[1]) * this.units[1];
  }
  /**
   * Place in the plot, 0 to 1 each, of a point.
   * @param {number} i
   * @param {number} j
   */
  spot(i, j) {
    const { x0, x1, y0, y1 } = this.axes;
    return [
      ((i + this.first[0]) * this.steps[0] - x0) / (x1 - x0),
      ((j + this.first[1]) * this.steps[1] - y0) / (y1 - y0),
    ];
  }
  /**
   * Values of both axes there; between points with parts of steps.
   * @param {number} i
   * @param {number} j
   */
  row(i, j) {
    const { x, y } = this.axes;
    return [valueAt(x, (i + this.first[0]) * this.steps[0]), valueAt(y, (j + this.first[1]) * this.steps[1])];
  }
  /**
   * Whether a point is in the plot.
   * @param {number} i
   * @param {number} j
   */
  seen(i, j) {
    return this.spot(i, j).every((place) => place > -1e-9 && place < 1 + 1e-9);
  }
  /**
   * The value of the nearest point to a place.
   * @param {number} X  0 to 1, as is the other
   * @param {number} Y
   */
  near(X, Y) {
    const { axes, first, steps } = this;
    const i = Math.round((axes.x0 + X * (axes.x1 - axes.x0)) / steps[0]) - first[0];
    const j = Math.round((axes.y0 + Y * (axes.y1 - axes.y0)) / steps[1]) - first[1];
    return this.values[j * this.nx + i];
  }
  /**
   * Why the nearest point to a place is refused, if it is.
   * @param {number} X
   * @param {number} Y
   */
  why(X, Y) {
    const { axes, first, steps } = this;
    const i = (axes.x0 + X * (axes.x1 - axes.x0)) / steps[0] - first[0];
    const j = (axes.y0 + Y * (axes.y1 - axes.y0)) / steps[1] - first[1];
    if (!this.#refused(Math.round(i), Math.round(j))) return null;
    for (let s = 1; s <= this.coarsest; s *= 2) {
      const found = this.lattice.why.get(this.key(s * Math.round(i / s), s * Math.round(j / s)));
      if (found) return found; // a finer point has none of its own where it was filled from coarser ones
    }
    return null;
  }
  /**
   * @param {number} i
   * @param {number} j
   */
  #refused(i, j) {
    return this.contacts[j * this.nx + i] < 0;
  }
  /** Find again which points are known. */
  look() {
    const { lattice, nx, ny } = this;
    this.index = new Int32Array(nx * ny);
    for (let j = 0, k = 0; j < ny; j++)
      for (let i = 0; i < nx; i++, k++) this.index[k] = lattice.points.get(this.key(i, j)) ?? MISSING;
  }
  /** How many points are known, and of those of the first picture how many there are. */
  get counts() {
    const { coarsest, index, nx, ny } = this;
    const first = { found: 0, all: 0 };
    let known = 0;
    for (let j = 0, k = 0; j < ny; j++)
      for (let i = 0; i < nx; i++, k++) {
        const there = index[k] === MISSING ? 0 : 1;
        known += there;
        if (i % coarsest || j % coarsest || !this.#inside(i, j, coarsest)) continue;
        first.found += there;
        first.all += 1;
      }
    return { first, known };
  }
  /**
   * Whether a point can be: within the ends of both axes, and of a window with this many steps about it.
   * @param {number} i
   * @param {number} j
   * @param {number} about
   */
  #inside(i, j, about) {
    const { axes, first, steps } = this;
    const [p, q] = [(i + first[0]) * steps[0], (j + first[1]) * steps[1]];
    const [a, b] = [about * steps[0], about * steps[1]];
    const within = p > axes.x0 - a - 1e-9 && p < axes.x1 + a + 1e-9 && q > axes.y0 - b - 1e-9 && q < axes.y1 + b + 1e-9;
    return within && p > -1e-9 && q > -1e-9 && p < longOf(axes.x) + 1e-9 && q < longOf(axes.y) + 1e-9;
  }
  /**
   * What is missing and needed, by level, the nearest to a place first; beside a change of contacts before all others.
   * @param {[x: number, y: number]} near  0 to 1 each
   * @param {boolean} whole  no point is spared
   * @param {boolean} [first]  only of the first level at which anything is missing
   * @returns {Point[][]}
   */
  plan([x, y], whole, first = false) {
    const { coarsest, index, lattice, nx, ny, size } = this;
    const wanted = [];
    this.coarse = false;
    for (let stride = coarsest; stride >= 1; stride /= 2) {
      /** @type {[far: number, i: number, j: number][]} */
      const level = [];
      let under = false; // whether some are under way
      for (let j = 0; j < ny; j += stride)
        for (let i = 0; i < nx; i += stride) {
          if (stride < coarsest && !(i % (2 * stride)) && !(j % (2 * stride))) continue;
          if (index[j * nx + i] !== MISSING || !this.#inside(i, j, stride)) continue;
          const key = this.key(i, j);
          if (stride === coarsest) this.coarse = true;
          if (!whole && stride < coarsest && lattice.spared.has(key)) continue;
          if (lattice.asked.has(key)) {
            under = true;
            continue;
          }
          const torn = stride < coarsest && this.#torn(i, j, stride);
          if (!whole && !torn && stride < NEVER_SPARED && this.#straight(i, j, stride)) {
            lattice.spared.add(key);
            continue;
          }
          const [X, Y] = this.spot(i, j);
          level.push([Math.hypot((X - x) * size[0], (Y - y) * size[1]) - (torn ? 1e6 : 0), i, j]);
        }
      if (level.length) wanted.push(level.sort((a, b) => a[0] - b[0]).map(([, i, j]) => /** @type {Point} */ ([i, j])));
      if (first && (under || level.length)) break;
    }
    return wanted;
  }
  /**
   * Points that were spared beside others with other contacts: there a change goes between them.
   * @returns {Point[]}
   */
  mend() {
    const { index, lattice, nx, ny } = this;
    if (!this.contacts.length) this.fill('contacts');
    /** @type {Point[]} */
    const found = [];
    for (let j = 0; j < ny; j++)
      for (let i = 0; i < nx; i++) {
        const k = j * nx + i;
        if (index[k] !== MISSING || !this.contacts[k] || lattice.asked.has(this.key(i, j))) continue;
        const near = [i ? k - 1 : k, i < nx - 1 ? k + 1 : k, k - nx, k + nx];
        const torn = near.some((each) => this.contacts[each] && this.contacts[each] !== this.contacts[k]);
        if (torn && this.#inside(i, j, 1)) found.push([i, j]);
      }
    return found;
  }
  /**
   * The corners about a point of a finer level.
   * @param {number} i
   * @param {number} j
   * @param {number} stride
   */
  *#corners(i, j, stride) {
    const { nx, ny } = this;
    const s = 2 * stride;
    const [a, b] = [i - (i % s), j - (j % s)];
    for (const [p, q] of [[a, b], [a + s, b], [a, b + s], [a + s, b + s]]) // prettier-ignore
      if (p < nx && q < ny) yield /** @type {Point} */ ([p, q]);
  }
  /**
   * Whether these differ in their number of contacts.
   * @param {number} i
   * @param {number} j
   * @param {number} stride
   */
  #torn(i, j, stride) {
    const { index, lattice, nx } = this;
    const all = [...this.#corners(i, j, stride)].map(([p, q]) => lattice.contacts(index[q * nx + p]));
    const known = all.filter((each) => each !== 0);
    return known.some((each) => each !== known[0]);
  }
  /**
   * Whether a straight line between them will do: by their second differences, of every result.
   * @param {number} i
   * @param {number} j
   * @param {number} stride
   */
  #straight(i, j, stride) {
    const { index, lattice, nx, ny } = this;
    const s = 2 * stride;
    for (const [p, q] of this.#corners(i, j, stride)) {
      if (index[q * nx + p] === MISSING && !lattice.spared.has(this.key(p, q))) return false;
      for (const [x, y] of [
        [s, 0],
        [0, s],
      ]) {
        // prettier-ignore
        if (p - x < 0 || q - y < 0 || p + x >= nx || q + y >= ny) continue;
        const all = [index[(q - y) * nx + p - x], index[q * nx + p], index[(q + y) * nx + p + x]];
        if (!all.includes(MISSING) && this.#bent(all)) return false;
      }
    }
    return true;
  }
  /** @param {number[]} points  three in a row */
  #bent(points) {
    const { data, names } = this.lattice;
    return names.some((name) => {
      const { log, whole } = shownOf(name);
      const of = (/** @type {number} */ point) => data[point * WIDTH + PLACE[name]];
      const [before, here, after] = points.map((point) => (log ? Math.log10(of(point)) : of(point)));
      const bend = Math.abs(before + after - 2 * here);
      return !whole && bend > 8 * STRAIGHT * (log ? 1 : this.scales[name]);
    });
  }
  /** How far each result reaches in what is known, so that what is small beside that is. */
  get scales() {
    const { count, data, names } = this.lattice;
    if (this.#scaled?.count === count) return this.#scaled.scales;
    /** @type {Record<string, number>} */
    const scales = {};
    for (const name of names) {
      let [low, high] = [Infinity, -Infinity];
      for (let k = 0; k < count; k++) {
        const value = data[k * WIDTH] ? NaN : data[k * WIDTH + PLACE[name]];
        if (value < low) low = value;
        if (value > high) high = value;
      }
      scales[name] = high > low ? high - low : Infinity;
    }
    this.#scaled = { count, scales };
    return scales;
  }
  /** @type {{ count: number, scales: Record<string, number> } | null} */ #scaled = null;
  /**
   * Values of a result, and contacts, at all points; holes are filled from coarser levels.
   * @param {Mapped} name
   */
  fill(name) {
    const { index, lattice, nx, ny } = this;
    const n = nx * ny;
    this.values = new Float64Array(n).fill(NaN);
    this.contacts = new Int16Array(n);
    const { log } = shownOf(name);
    for (let k = 0; k < n; k++) {
      this.contacts[k] = lattice.contacts(index[k]);
      if (this.contacts[k] <= 0) continue;
      const value = lattice.value(name, index[k]);
      this.values[k] = log ? Math.log10(value) : value;
    }
    for (let s = this.coarsest / 2; s >= 1; s /= 2)
      for (let j = 0; j < ny; j += s)
        for (let i = 0; i < nx; i += s) {
          const [across, up] = [i % (2 * s), j % (2 * s)];
          if ((across || up) && !this.contacts[j * nx + i]) this.#hole(i, j, across, up);
        }
  }
  /**
   * @param {number} i
   * @param {number} j
   * @param {number} across  steps to known ones, both ways
   * @param {number} up
   */
  #hole(i, j, across, up) {
    const { contacts, nx, ny, values } = this;
    const ends = across && up ? [[-1, -1], [1, 1], [1, -1], [-1, 1]] : [[-1, -1], [1, 1]]; // prettier-ignore
    const near = ends
      .map(([a, b]) => [i + a * across, j + b * up])
      .filter(([p, q]) => p >= 0 && q >= 0 && p < nx && q < ny && contacts[q * nx + p])
      .map(([p, q]) => q * nx + p);
    if (!near.length) return;
    const same = near.filter((each) => contacts[each] === contacts[near[0]]);
    contacts[j * nx + i] = contacts[near[0]];
    values[j * nx + i] = same.reduce((sum, each) => sum + values[each], 0) / same.length;
  }
  /**
   * @param {number} i
   * @param {number} j
   * @param {number} way  0: to the right, 1: upwards
   */
  #edgeName(i, j, way) {
    return `${this.key(i, j)} ${way} ${this.steps[way]}`;
  }
  /**
   * Where contacts change between two points, 0 to 1, and whether that is found.
   * @param {number} i
   * @param {number} j
   * @param {number} way
   */
  change(i, j, way) {
    const edge = this.lattice.edges.get(this.#edgeName(i, j, way));
    return edge
      ? { at: (edge.low + edge.high) / 2, found: edge.steps >= this.lattice.halvings }
      : { at: 0.5, found: false };
  }
  /**
   * Edges on which contacts change that are not found yet: half of each is looked at.
   */
  halves() {
    const { index, lattice, nx, ny } = this;
    const found = [];
    for (let j = 0; j < ny; j++)
      for (let i = 0; i < nx; i++) {
        const here = lattice.contacts(index[j * nx + i]);
        if (here <= 0) continue;
        for (const way of [0, 1]) {
          const [p, q] = way ? [i, j + 1] : [i + 1, j];
          const there = p < nx && q < ny ? lattice.contacts(index[q * nx + p]) : here;
          if (there <= 0 || there === here) continue;
          const name = this.#edgeName(i, j, way);
          const edge = lattice.edges.get(name) ?? { low: 0, high: 1, from: here, steps: 0 };
          lattice.edges.set(name, edge);
          if (edge.steps >= lattice.halvings || lattice.halving.has(name)) continue;
          const at = (edge.low + edge.high) / 2;
          found.push({ name, edge, at, row: way ? this.row(i, j + at) : this.row(i + at, j) });
        }
      }
    return found;
  }
}
