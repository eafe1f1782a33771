// A pendulum that strikes: it hangs from its pivot, and a bar that bends is drawn by the shapes in the message.
import { COLORS } from '../charts/styles.js';
import { axis } from './bodies.js';

/** @import { AxialFrame, Numbers } from '../messages.js' */

const THICK = 15; // of the bar [px]
const TOP = 22; // of the pivot, from the edge of the picture [px]
const PIN = 4.5; // radius [px]
const PARTS = 24; // of the bar as it is drawn

/** @typedef {(part: number) => number} Shape  displacement [v T] along the bar, from its pivot (0) to its end (1) */

/**
 * How a bar lies by samples (instants, places).
 * @param {Numbers} bar
 * @param {number[]} shape  of the samples
 * @param {number} part  of the whole time
 * @returns {Shape}
 */
function sampled(bar, [instants, places], part) {
  const when = Math.min(Math.max(part, 0), 1) * (instants - 1);
  const row = Math.min(Math.floor(when), instants - 2);
  const value = (/** @type {number} */ k, /** @type {number} */ i) => bar[k * places + i];
  return (along) => {
    const place = Math.min(Math.max(along, 0), 1) * (places - 1);
    const i = Math.min(Math.floor(place), places - 2);
    const [early, late] = [row, row + 1].map((k) => value(k, i) + (place - i) * (value(k, i + 1) - value(k, i)));
    return early + (when - row) * (late - early);
  };
}

/**
 * How the pendulum lies: bent, or straight through the place where it strikes.
 * @param {AxialFrame} frame
 * @param {'exact' | 'other'} solution
 * @param {number} t
 * @param {number} face  displacement of that place [v T]
 * @returns {Shape}
 */
export function shapeOf(frame, solution, t, face) {
  const { impactor, shapes, duration } = frame;
  const struck = /** @type {number} */ (impactor.place) / /** @type {number} */ (impactor.length);
  const name = solution === 'exact' ? 'exactBar' : 'otherBar';
  const bar = frame[name];
  return bar ? sampled(bar, shapes[name], t / duration) : (part) => (face * part) / struck;
}

/**
 * A rod that turns about an axis at its root and is struck across, bent as it is.
 * @param {CanvasRenderingContext2D} c
 * @param {AxialFrame} frame
 * @param {number} t
 * @param {{ rest: number, middle: number, scale: number, height: number }} place  struck face at rest, px per v T
 */
export function turningBar(c, frame, t, { rest, middle, scale, height }) {
  const { duration, shapes, target, turningBar: bar } = frame;
  if (!bar || !target.rotation) return;
  const shape = sampled(bar, shapes.turningBar, t / duration);
  const long = Math.min((middle - TOP) / target.rotation.at, height - TOP - 8);
  const centre = rest + THICK / 2;
  c.strokeStyle = '#8fb4d6';
  c.lineWidth = THICK;
  c.beginPath();
  for (let k = 0; k <= PARTS; k++) c.lineTo(centre + shape(k / PARTS) * scale, TOP + (k / PARTS) * long);
  c.stroke();
  axis(c, centre, TOP, 2 * THICK);
}

/**
 * How long the bar is drawn [px].
 * @param {AxialFrame} frame
 * @param {number} middle  where it strikes
 * @param {number} height  of the picture
 */
export function drawnLength({ impactor }, middle, height) {
  const struck = /** @type {number} */ (impactor.place) / /** @type {number} */ (impactor.length);
  return Math.min((middle - TOP) / struck, height - TOP - 8);
}

/**
 * The bar and its pivot; dashed the straight bar where rigid-body theory has it.
 * @param {CanvasRenderingContext2D} c
 * @param {AxialFrame} frame
 * @param {Shape} shape
 * @param {{ rest: number, middle: number, scale: number, height: number }} place  struck face at rest, px per v T
 * @param {number | null} prediction  displacement of the place where it strikes [v T]
 */
export function pendulum(c, frame, shape, { rest, middle, scale, height }, prediction) {
  const { impactor } = frame;
  const struck = /** @type {number} */ (impactor.place) / /** @type {number} */ (impactor.length);
  const long = drawnLength(frame, middle, height);
  const centre = rest - THICK / 2;
  const line = (/** @type {Shape} */ moved) => {
    c.beginPath();
    for (let k = 0; k <= PARTS; k++) c.lineTo(centre + moved(k / PARTS) * scale, TOP + (k / PARTS) * long);
    c.stroke();
  };
  c.save();
  if (prediction !== null) {
    c.setLineDash([5, 4]);
    c.strokeStyle = COLORS.prediction;
    c.lineWidth = 1.5;
    line((part) => (prediction * part) / struck);
    c.setLineDash([]);
  }
  c.lineCap = 'butt';
  c.strokeStyle = '#3b4a59';
  c.lineWidth = THICK;
  line(shape);
  c.fillStyle = '#ffffff';
  c.strokeStyle = '#1c2733';
  c.lineWidth = 2;
  c.beginPath();
  c.arc(centre, TOP, PIN, 0, 7);
  c.fill();
  c.stroke();
  c.strokeStyle = '#55636f'; // the support of the pivot
  for (let k = -2; k <= 2; k++) {
    c.beginPath();
    c.moveTo(centre + 7 * k, TOP - 9);
    c.lineTo(centre + 7 * k + 6, TOP - 16);
    c.stroke();
  }
  c.beginPath();
  c.moveTo(centre - 20, TOP - 9);
  c.lineTo(centre + 20, TOP - 9);
  c.stroke();
  c.restore();
}

export const WIDTH = THICK;
