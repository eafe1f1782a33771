// All results as small maps: a click has one change places with the large one.
import { make, write } from '../browser/dom.js';
import { contextOf } from '../charts/canvas.js';
import { text } from '../text/catalogue.js';
import { MOST_CONTACTS, colouring, paletteOf } from './colours.js';
import { shownOf, titleOf, written } from './results.js';

/** @import { Window } from './lattice.js' */
/** @import { Domain } from './plane.js' */
/** @import { Result } from './results.js' */

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
  if (log) return high - low > 1e-6 ? [Math.floor(low * 10 - 0.2) / 10, Math.ceil(high * 10 + 0.2) / 10] : null;
  if (nought) low = Math.min(low, 0);
  const long = high - low || Math.abs(high) || 1;
  const unit = 10 ** Math.floor(Math.log10(long)) / 5;
  return [Math.floor(low / unit + 1e-9) * unit, Math.ceil(high / unit - 1e-9) * unit];
}

export class Tiles {
  /** @type {Map<Result, { button: HTMLButtonElement, canvas: HTMLCanvasElement, value: HTMLElement }>} */ all =
    new Map();

  /** @param {(result: Result) => void} choose */
  constructor(choose) {
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
        const title = make('span', { textContent: titleOf(name) });
        const button = make('button', { type: 'button', onclick: () => this.choose(name) }, canvas, title, value);
        return [name, { button, canvas, value }];
      }),
    );
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
   * The small maps.
   * @param {Window} view
   * @param {[x: number, y: number]} at  of the scene, 0 to 1 each
   */
  draw(view, at) {
    for (const [name, { canvas }] of this.all) {
      view.fill(name);
      const domain = domainOf(view, name);
      if (domain) drawSmall(view, canvas, name, domain, at);
    }
  }
}

/**
 * @param {Window} view
 * @param {HTMLCanvasElement} canvas
 * @param {Result} name
 * @param {Domain} domain
 * @param {[x: number, y: number]} at
 */
function drawSmall(view, canvas, name, domain, at) {
  const [width, height] = [128, 88];
  if (canvas.width !== width) Object.assign(canvas, { width, height });
  const c = contextOf(canvas);
  const image = c.createImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const colour = colouring(paletteOf(name), domain);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      pixels[y * width + x] = colour(view.near((x + 0.5) / width, 1 - (y + 0.5) / height));
  c.putImageData(image, 0, 0);
  c.beginPath();
  c.arc(at[0] * width, (1 - at[1]) * height, 6, 0, 2 * Math.PI);
  c.fillStyle = '#00715a';
  c.fill();
  c.lineWidth = 3;
  c.strokeStyle = '#fff';
  c.stroke();
}
