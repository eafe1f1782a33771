// All results as small maps: a click has one change places with the large one.
import { make, write } from '../browser/dom.js';
import { contextOf } from '../charts/canvas.js';
import { text } from '../text/catalogue.js';
import { COLOR, disc } from './ink.js';
import { MOST_CONTACTS, colouring, paletteOf } from './colours.js';
import { shortOf, shownOf, titleOf, written } from './results.js';

/** @import { Window } from './window.js' */
/** @import { Domain } from './plane.js' */
/** @import { Result } from './results.js' */

const EVERY = 250; // ms between those that are drawn
const ROUNDING = 1e-6; // of values: a scale that shows less would draw rounding
const SIZE = /** @type {const} */ ([128, 88]); // pixels of a small map

/**
 * @typedef {object} Tile
 * @property {HTMLButtonElement} button
 * @property {HTMLCanvasElement} canvas
 * @property {HTMLElement} value
 * @property {ImageData | null} image  of the map, without the point
 */

/**
 * The ends of a scale that holds what a window shows.
 * @param {Window} view  filled with that result
 * @param {Result} result
 * @returns {Domain | null}
 */
export function domainOf(view, result) {
  const { contacts, nx, ny, values } = view;
  const { log, nought, whole } = shownOf(result);
  if (whole) return [0.5, MOST_CONTACTS + 0.5];
  let [low, high] = [Infinity, -Infinity];
  for (let j = 0, k = 0; j < ny; j++)
    for (let i = 0; i < nx; i++, k++) {
      if (contacts[k] <= 0 || view.index[k] < 0 || !view.seen(i, j)) continue;
      if (values[k] < low) low = values[k];
      if (values[k] > high) high = values[k];
    }
  if (!Number.isFinite(low) || !Number.isFinite(high)) return null;
  if (log) return [Math.floor(low * 10 - 0.2) / 10, Math.ceil(high * 10 + 0.2) / 10];
  if (nought) low = Math.min(low, 0);
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low < ROUNDING * size || !size) [low, high] = [low - 0.1 * (size || 1), high + 0.1 * (size || 1)]; // flat
  const long = high - low;
  const unit = 10 ** Math.floor(Math.log10(long)) / 5;
  return [Math.floor(low / unit + 1e-9) * unit, Math.ceil(high / unit - 1e-9) * unit];
}

export class Tiles {
  /** @type {Map<Result, Tile>} */ all = new Map();
  drawn = 0; // when
  due = 0;

  /** @param {(result: Result) => void} choose */
  constructor(choose) {
    this.seen = ''; // what the small maps show
    this.choose = choose;
    this.root = make('div', { className: 'whatif-tiles', role: 'group', ariaLabel: text('whatif.results') });
  }
  /** @param {Result[]} results  that there are */
  offer(results) {
    if (results.join() === [...this.all.keys()].join()) return;
    this.all = new Map(
      results.map((name) => {
        const canvas = make('canvas', { width: 1, height: 1 });
        const value = make('strong');
        const title = make('span', { textContent: shortOf(name), title: titleOf(name) });
        const button = make('button', { type: 'button', onclick: () => this.choose(name) }, canvas, title, value);
        return [name, { button, canvas, value, image: null }];
      }),
    );
    this.seen = '';
    this.root.replaceChildren(...[...this.all.values()].map(({ button }) => button));
  }
  /**
   * Values of the scene.
   * @param {(result: Result) => number} valueOf
   * @param {Result} chosen
   */
  say(valueOf, chosen) {
    for (const [name, { button, value }] of this.all) {
      write(value, written(name, valueOf(name)));
      button.ariaPressed = String(name === chosen);
    }
  }
  /**
   * Whether they were drawn a moment ago; then it is said when it is time.
   * @param {() => void} then
   */
  wait(then) {
    const rest = this.drawn + EVERY - performance.now();
    if (rest > 0) this.due ||= window.setTimeout(() => [(this.due = 0), then()], rest);
    return rest > 0;
  }
  /**
   * The small maps; their values are looked at anew only where they have changed.
   * @param {Window} view
   * @param {[x: number, y: number]} at  of the scene, 0 to 1 each
   * @param {string} seen  what the window shows
   */
  draw(view, at, seen) {
    const anew = seen !== this.seen;
    this.seen = seen;
    this.drawn = performance.now();
    for (const [name, tile] of this.all) {
      if (anew) tile.image = imageOf(view, tile.canvas, name);
      if (tile.image) drawSmall(tile.canvas, tile.image, at);
    }
    return anew;
  }
}

/**
 * @param {Window} view
 * @param {HTMLCanvasElement} canvas
 * @param {Result} name
 */
function imageOf(view, canvas, name) {
  view.fill(name);
  const domain = domainOf(view, name);
  if (!domain) return null;
  const [width, height] = SIZE;
  if (canvas.width !== width) Object.assign(canvas, { width, height });
  const image = contextOf(canvas).createImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const colour = colouring(paletteOf(name), domain);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      pixels[y * width + x] = colour(view.near((x + 0.5) / width, 1 - (y + 0.5) / height));
  return image;
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {ImageData} image
 * @param {[x: number, y: number]} at
 */
function drawSmall(canvas, image, at) {
  const c = contextOf(canvas);
  const [width, height] = SIZE;
  c.putImageData(image, 0, 0);
  disc(c, at[0] * width, (1 - at[1]) * height, 6, COLOR.accent);
  c.lineWidth = 3;
  c.strokeStyle = COLOR.ring;
  c.stroke();
}
