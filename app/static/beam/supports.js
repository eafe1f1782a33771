// The supports of a beam, drawn on the stage and read for what they bear.
import { family, text } from '../text/catalogue.js';
import { engineering } from '../text/format.js';

/** @import { BendingFrame, Support } from '../messages.js' */
/** @import { Support as Bearing } from '../charts/supports.js' */

const END = family('beam.end');

/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {(c: Context, x: number, y: number, thick: number, way: number) => void} Draw  way: 1 on the right */

/** @type {Draw} */
function clamp(c, x, y, thick, way) {
  const tall = Math.max(1.3 * thick, 22);
  c.fillStyle = '#55636f';
  c.fillRect(way < 0 ? x - 5 : x, y - tall, 5, 2 * tall);
  c.strokeStyle = '#8a97a3';
  c.lineWidth = 1;
  c.beginPath();
  for (let s = -tall; s < tall; s += 8) {
    c.moveTo(x + 5 * way, y + s + 8);
    c.lineTo(x + 16 * way, y + s);
  }
  c.stroke();
}

/**
 * A pin on its floor; a roller stands on two wheels.
 * @param {Context} c
 * @param {number} x
 * @param {number} y
 * @param {number} thick
 * @param {boolean} rolls
 */
function hinge(c, x, y, thick, rolls) {
  const top = y + thick / 2;
  const base = top + 15;
  c.fillStyle = '#d4dce4';
  c.strokeStyle = '#55636f';
  c.lineWidth = 1.3;
  c.beginPath();
  c.moveTo(x, top);
  c.lineTo(x - 9, base);
  c.lineTo(x + 9, base);
  c.closePath();
  c.fill();
  c.stroke();
  for (const dx of rolls ? [-5, 5] : []) {
    c.beginPath();
    c.arc(x + dx, base + 3.5, 3, 0, 7);
    c.stroke();
  }
  const floor = rolls ? base + 7 : base;
  c.beginPath();
  c.moveTo(x - 16, floor);
  c.lineTo(x + 16, floor);
  for (let s = -12; s <= 16; s += 7) {
    c.moveTo(x + s, floor);
    c.lineTo(x + s - 6, floor + 6);
  }
  c.stroke();
}

/** @type {Record<'clamp' | 'pin' | 'roller', Draw>} */
const DRAWN = {
  clamp,
  pin: (c, x, y, thick) => hinge(c, x, y, thick, false),
  roller: (c, x, y, thick) => hinge(c, x, y, thick, true),
};
/** @type {Record<Support, (keyof typeof DRAWN)[]>} */
const SUPPORTS = {
  cantilever: ['clamp'],
  'pinned-pinned': ['pin', 'roller'],
  'clamped-clamped': ['clamp', 'clamp'],
  joined: [],
  'free-free': [],
  'pinned-free': ['pin'],
};

/**
 * @param {Context} c
 * @param {Support} support
 * @param {[left: number, right: number]} ends  of the beam
 * @param {number} y  of its axis
 * @param {number} thick
 */
export function drawSupports(c, support, ends, y, thick) {
  SUPPORTS[support].forEach((name, k) => DRAWN[name](c, ends[k], y, thick, k ? 1 : -1));
}

/**
 * What is read of each. The shear force V pushes the beam the way of the impact at its first end, and back at its last.
 * @param {BendingFrame} frame
 * @returns {Bearing[]}
 */
export const supportsOf = ({ beam: { length, support } }) =>
  SUPPORTS[support].map((name, k, { length: count }) => ({
    name: count > 1 ? text('support.at', { name: END[name], place: engineering(k * length, 'm') }) : END[name],
    place: k * length,
    force: ['shear', k ? 1 : -1],
    ...(name === 'clamp' ? { moment: /** @type {Bearing['moment']} */ (['moment', 1]) } : {}),
  }));
