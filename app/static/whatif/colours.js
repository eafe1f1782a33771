// Colours of a map by what it shows: force, stress and energy as what is compressed, velocities as what moves, times
// grey.
import { make } from '../browser/dom.js';
import { contextOf } from '../charts/canvas.js';
import { shownOf } from './results.js';

/** @import { Mapped } from './results.js' */

const STEPS = 512;
export const RAMPS = {
  heat: ['#f6f8f9', '#fdece1', '#fbd3bd', '#f7b592', '#f08d5e', '#e26636', '#c8421f', '#9e271b', '#6d0f17'],
  cold: ['#f5f8fa', '#ddebf6', '#b9d8ee', '#86b9e0', '#4f93cc', '#2a6db1', '#124a8c', '#0a2f66'],
  steel: ['#f6f8f9', '#dfe6ec', '#bcc8d2', '#93a3b1', '#687b8b', '#3f5160', '#15202b'],
  steps: ['#eef2f5', '#f8b898', '#e4784a', '#b03a20', '#3d040a'], // neighbours differ in lightness alone, too
  models: [
    ...['#f4f7f9', '#e2ecf5', '#cfe0ef', '#bcd4e9'], // nothing rings
    ...['#f6bf9f', '#f1a67e', '#e98c5e', '#dc7141', '#c4542b', '#9e3a1b', '#722314'], // by ever more modes
    '#3d0b0c',
  ],
};
export const NONE = 0xffffffff; // where nothing is known yet

/** @param {string} hex */
const channels = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));

/** @param {number[]} channels */
const packed = ([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;

/**
 * @param {keyof typeof RAMPS} name
 */
function made(name) {
  const all = RAMPS[name].map(channels);
  return Uint32Array.from({ length: STEPS }, (_, n) => {
    if (name === 'steps' || name === 'models')
      return packed(all[Math.min(Math.floor((n / STEPS) * all.length), all.length - 1)]);
    const place = (n / (STEPS - 1)) * (all.length - 1);
    const k = Math.min(Math.floor(place), all.length - 2);
    return packed(all[k].map((value, c) => Math.round(value + (place - k) * (all[k + 1][c] - value))));
  });
}

/** @param {number} n  The colour of a model, from 1. */
export const colourOfModel = (n) => RAMPS.models[n - 1];

/** @type {Map<string, Uint32Array>} */
const MADE = new Map();

/**
 * Colours of a result, from the lowest value to the highest, as pixels have them.
 * @param {Mapped} name
 */
export function paletteOf(name) {
  const { colours } = shownOf(name);
  const known = MADE.get(colours) ?? made(colours);
  MADE.set(colours, known);
  return known;
}

/** The highest number of contacts that has a colour of its own. */
export const MOST_CONTACTS = RAMPS.steps.length;

/**
 * The colour of a value on a scale.
 * @param {Uint32Array} palette
 * @param {[low: number, high: number]} domain
 */
export function colouring(palette, [low, high]) {
  const last = palette.length - 1;
  const grow = palette.length / (high - low);
  return (/** @type {number} */ value) =>
    Number.isNaN(value) ? NONE : palette[Math.min(Math.max(Math.floor((value - low) * grow), 0), last)];
}

/** @type {Map<Uint32Array, HTMLCanvasElement>} */
const STRIPS = new Map();

/**
 * All colours from the highest value down, as a picture that is one pixel wide.
 * @param {Uint32Array} palette
 */
export function stripOf(palette) {
  const known = STRIPS.get(palette);
  if (known) return known;
  const strip = make('canvas', { width: 1, height: palette.length });
  const c = contextOf(strip);
  const image = c.createImageData(1, palette.length);
  new Uint32Array(image.data.buffer).set(palette.toReversed());
  c.putImageData(image, 0, 0);
  STRIPS.set(palette, strip);
  return strip;
}
