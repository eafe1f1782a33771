// Bodies over place and time as a picture: each row is the same body later, moved as the body on top is.
import { contextOf } from '../charts/canvas.js';
import { HATCHED } from '../charts/hatch.js';
import { palette } from '../charts/styles.js';

/** @import { Range } from '../charts/scale.js' */

const FINE = { places: 121, rows: 300 }; // at most: so many are woven in the time of one frame
const COARSE = { places: 61, rows: 200 }; // of a field that costs a sum for each mode
const DIAGONALS = 6; // pixels between two lines over what is negative
const EDGE = 0xffb2a598; // of a body: blue, green and red from the left
const LINE = 0.86; // of the light around, that such a line has

/**
 * The palette as pixels, darker by a factor.
 * @param {number} light
 */
function pixelsOf(light) {
  const bytes = new Uint8ClampedArray((4 * palette.length) / 3).fill(255);
  for (let k = 0; k < palette.length; k++) bytes[4 * Math.floor(k / 3) + (k % 3)] = light * palette[k];
  return new Uint32Array(bytes.buffer);
}
const [PLAIN, LINED] = [pixelsOf(1), pixelsOf(LINE)];

/**
 * A field that has rows; displacement is asked of none that is bent across.
 * @typedef {object} Rows
 * @property {boolean} coarse  dear to compute: fewer points will do
 * @property {number} [places]  at which alone it is known
 * @property {(t: number, span: number, what: any, out: Float64Array) => unknown} mean
 * @property {(t: number, what: any, out: Float64Array) => unknown} profile
 * @property {(t: number) => Piece[]} [pieces]  of bodies apart, in place of both
 */
/** @typedef {[from: number, to: number, first: number, last: number]} Piece  its ends [px], and the values there */
/**
 * @typedef {object} Drawn
 * @property {number} left
 * @property {number} right
 * @property {number} rest
 * @property {(share: number) => number} [at]  where a share of its length lies, if not evenly
 */
/**
 * What is drawn over place and time, with the picture of the bodies above it.
 * @typedef {object} Shown
 * @property {Rows} field
 * @property {string} what
 * @property {number} largest  the end of the colours
 * @property {number} duration
 * @property {Drawn} drawn  where its ends are at rest, and is struck [px]
 * @property {number} scale  pixels in a unit of displacement; none of what is bent across
 */

/** @type {WeakMap<HTMLCanvasElement, ImageData>} */
const pictures = new WeakMap();

/**
 * Pixels of a canvas, the same as before where they are as many: a megabyte at each picture has memory tidied up often.
 * @param {HTMLCanvasElement} canvas
 * @param {CanvasRenderingContext2D} context
 */
function pictureOf(canvas, context) {
  const { height, width } = canvas;
  const last = pictures.get(canvas);
  if (last?.width === width && last.height === height) return last;
  const picture = context.createImageData(width, height);
  pictures.set(canvas, picture);
  return picture;
}

/**
 * Weave the rows of a stretch of time, from top to bottom; what no body covers is clear.
 * @param {HTMLCanvasElement} canvas  made as large as needed
 * @param {Shown} shown
 * @param {Range} stretch
 * @param {number} width
 * @param {number} height
 * @returns {Float64Array}  the value at the struck place, row by row
 */
export function weave(canvas, { drawn, duration, field, largest, scale, what }, [start, end], width, height) {
  const most = field.coarse ? COARSE : FINE;
  const rows = Math.min(most.rows, height);
  const places = field.places ?? most.places;
  if (canvas.width !== width || canvas.height !== rows) Object.assign(canvas, { width, height: rows });
  const context = contextOf(canvas);
  const picture = pictureOf(canvas, context);
  const pixels = new Uint32Array(picture.data.buffer).fill(0);
  const [values, moved] = [new Float64Array(places), new Float64Array(places)];
  const ends = new Float64Array(rows);
  const at = placesOf(drawn, places);
  const struck = at.findLastIndex((x, k) => k === 0 || x + at[k - 1] < 2 * drawn.rest);
  const span = (end - start) / rows;
  for (let row = 0; row < rows; row++) {
    const t = start + (row + 0.5) * span;
    if (t > duration) break;
    if (field.pieces) {
      for (const piece of field.pieces(t)) one(pixels, width, row, piece, largest);
      continue;
    }
    field.mean(t, span, what, values);
    if (scale) field.profile(t, 'displacement', moved);
    else moved.fill(0);
    ends[row] = values[struck];
    for (let k = 0; k < places; k++) moved[k] = at[k] + moved[k] * scale;
    fill(pixels, width, row, moved, values, largest);
  }
  context.putImageData(picture, 0, 0);
  return ends;
}

/**
 * Where places spread evenly over its length are at rest [px].
 * @param {Drawn} drawn
 * @param {number} count
 */
function placesOf({ at, left, right }, count) {
  const usual = (/** @type {number} */ share) => left + share * (right - left);
  return Float64Array.from({ length: count }, (_, k) => (at ?? usual)(k / (count - 1)));
}

/**
 * A body that moves as one, with its edges.
 * @param {Uint32Array} pixels
 * @param {number} width
 * @param {number} row
 * @param {Piece} piece
 * @param {number} largest
 */
function one(pixels, width, row, [from, to, first, last], largest) {
  fill(pixels, width, row, Float64Array.of(from, to), Float64Array.of(first, last), largest);
  for (const x of [Math.ceil(from - 0.5), Math.ceil(to - 0.5) - 1])
    if (x >= 0 && x < width) pixels[row * width + x] = EDGE;
}

/**
 * One row, between places that ascend.
 * @param {Uint32Array} pixels
 * @param {number} width
 * @param {number} row
 * @param {Float64Array} places  [px]
 * @param {Float64Array} values
 * @param {number} largest
 */
function fill(pixels, width, row, places, values, largest) {
  const half = (PLAIN.length - 1) / 2;
  const [unit, faint] = [half / largest, half - HATCHED * half];
  let x = Math.max(Math.ceil(places[0] - 0.5), 0);
  for (let k = 1; k < places.length; k++) {
    const last = Math.min(Math.ceil(places[k] - 0.5), width);
    const slope = (unit * (values[k] - values[k - 1])) / (places[k] - places[k - 1]);
    let place = half + unit * values[k - 1] + (x + 0.5 - places[k - 1]) * slope;
    for (let p = row * width + x; x < last; x++, p++, place += slope) {
      const color = place <= 0 ? 0 : place >= 2 * half ? 2 * half : (place + 0.5) | 0;
      pixels[p] = place < faint && (row + x) % DIAGONALS === 0 ? LINED[color] : PLAIN[color];
    }
  }
}
