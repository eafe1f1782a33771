// A small moving picture of a scene, as the server keeps it: whole numbers, of each frame but the first their change.
import { cleared } from '../charts/canvas.js';
import { css } from '../charts/styles.js';
import { make } from '../browser/dom.js';

/**
 * @typedef {object} Part
 * @property {'line' | 'disc' | 'area'} shape
 * @property {'body' | 'striker' | 'ground' | 'joint' | 'faint' | 'panel'} ink
 * @property {number} size  how thick, or the radius
 * @property {number} points  in each frame
 * @property {number[]} x
 * @property {number[]} y
 * @property {number[]} [values]  of the pieces between the points
 */
/** @typedef {{ width: number, height: number, shades: number }} Sheet  of all pictures, in their own units */

const INKS = {
  body: '#8a9bad',
  striker: '#3d4b59',
  ground: '#55636f',
  joint: '#ffffff',
  faint: '#b9c4cf',
  panel: '#ffffff',
};
const STILL = 0.42; // of its time, where it stands
const EDGE = '#4a5968';
const RIM = 2.5; // of an edge around them

/**
 * Numbers of a frame by how they differ from those before: all frames, one after the other.
 * @param {number[]} stored
 * @param {number} points
 */
export function unpacked(stored, points) {
  const found = Float64Array.from(stored);
  for (let k = points; k < found.length; k++) found[k] += found[k - points];
  return found;
}

/**
 * The numbers of an instant, from 0 to 1, straight between frames.
 * @param {Float64Array} all
 * @param {number} points
 * @param {number} t
 */
export function at(all, points, t) {
  const last = all.length / points - 1;
  const k = Math.min(Math.floor(t * last), Math.max(last - 1, 0));
  const part = last > 0 ? t * last - k : 0;
  const next = last > 0 ? (k + 1) * points : 0;
  return Array.from({ length: points }, (_, p) => (1 - part) * all[k * points + p] + part * all[next + p]);
}

export class Picture {
  canvas = make('canvas');

  /**
   * @param {Part[]} parts
   * @param {Sheet} sheet
   */
  constructor(parts, sheet) {
    this.sheet = sheet;
    this.parts = parts.map((part) => ({
      ...part,
      x: unpacked(part.x, part.points),
      y: unpacked(part.y, part.points),
      values: part.values && unpacked(part.values, part.points - 1),
    }));
    this.canvas.style.aspectRatio = `${sheet.width} / ${sheet.height}`;
  }
  /** @param {number} [t]  from 0 to 1 */
  draw(t = STILL) {
    const found = cleared(this.canvas, this.canvas);
    if (!found) return;
    const { c, width } = found;
    c.scale(width / this.sheet.width, width / this.sheet.width);
    for (const part of this.parts) {
      const [x, y] = [at(part.x, part.points, t), at(part.y, part.points, t)];
      c.fillStyle = c.strokeStyle = INKS[part.ink];
      c.lineWidth = part.size;
      if (part.shape === 'disc') disc(c, x[0], y[0], part);
      else if (part.values) coloured(c, x, y, at(part.values, part.points - 1, t), this.sheet.shades);
      else {
        trace(c, x, y);
        if (part.shape === 'area') c.fill();
        else c.stroke();
      }
    }
  }
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {number[]} x
 * @param {number[]} y
 */
function trace(c, x, y) {
  c.beginPath();
  for (let k = 0; k < x.length; k++) c.lineTo(x[k], y[k]);
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {number} x
 * @param {number} y
 * @param {{ size: number, ink: string }} part
 */
function disc(c, x, y, { ink, size }) {
  c.beginPath();
  c.arc(x, y, size, 0, 7);
  c.fill();
  if (ink !== 'joint') return;
  c.strokeStyle = EDGE;
  c.lineWidth = 3;
  c.stroke();
}

/**
 * A line, nearly straight, whose colours run along it, within an edge that shows where it is pale.
 * @param {CanvasRenderingContext2D} c
 * @param {number[]} x
 * @param {number[]} y
 * @param {number[]} values
 * @param {number} largest
 */
function coloured(c, x, y, values, largest) {
  const thick = c.lineWidth;
  const last = values.length;
  const [before, after] = [beyond(x, y, 1, 0), beyond(x, y, last - 1, last)];
  c.strokeStyle = EDGE;
  c.lineWidth = thick + 2 * RIM;
  trace(c, [before[0], ...x, after[0]], [before[1], ...y, after[1]]);
  c.stroke();
  const colours = c.createLinearGradient(x[0], y[0], x[last], y[last]);
  values.forEach((value, k) => colours.addColorStop((k + 0.5) / last, css(value, largest)));
  c.strokeStyle = colours;
  c.lineWidth = thick;
  trace(c, x, y);
  c.stroke();
}

/**
 * As far as the edge reaches beyond the end of a line.
 * @param {number[]} x
 * @param {number[]} y
 * @param {number} from  the point before the last
 * @param {number} to
 * @returns {[number, number]}
 */
function beyond(x, y, from, to) {
  const [dx, dy] = [x[to] - x[from], y[to] - y[from]];
  const share = RIM / (Math.hypot(dx, dy) || 1);
  return [x[to] + share * dx, y[to] + share * dy];
}

const LASTS = 3200; // ms of a picture as it runs
const RESTS = 700; // before it begins again
const SLOW = 2.2; // times as long where it runs by itself

/** Which pictures run, of all that there are; none where a visitor wants nothing to move. */
export class Running {
  /** @type {Map<Picture, number>} */ since = new Map();
  /** @type {number | undefined} */ frame;
  still = matchMedia('(prefers-reduced-motion: reduce)');
  touched = matchMedia('(hover: none)').matches; // nothing can point at a picture: they run while they are seen

  /** @param {Picture} picture */
  start(picture) {
    if (this.still.matches || this.since.has(picture)) return;
    this.since.set(picture, performance.now());
    this.frame ??= requestAnimationFrame(() => this.#tick());
  }
  /** @param {Picture} picture */
  stop(picture) {
    if (this.since.delete(picture)) picture.draw();
  }
  stopAll() {
    for (const picture of [...this.since.keys()]) this.stop(picture);
  }
  #tick() {
    const now = performance.now();
    const lasts = LASTS * (this.touched ? SLOW : 1);
    for (const [picture, since] of this.since) picture.draw(Math.min(((now - since) % (lasts + RESTS)) / lasts, 1));
    this.frame = this.since.size ? requestAnimationFrame(() => this.#tick()) : undefined;
  }
}
