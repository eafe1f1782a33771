// A field over time and place as a picture.
import { contextOf } from './canvas.js';
import { isHatched } from './hatch.js';
import { palette, shade } from './styles.js';

const DIAGONALS = 6; // pixels of the picture between two lines over what is negative
const LINE = 0.86; // of the light around, that such a line has

/** @typedef {import('./scale.js').Range} Range */

/**
 * Paint values as colours, one pixel each: columns from left to right, in each the rows from top to bottom.
 * @param {HTMLCanvasElement} image  made as large as needed
 * @param {Float32Array} values  (column, row), flat
 * @param {number} rows
 * @param {number} largest  the end of the colours
 */
export function paint(image, values, rows, largest) {
  const columns = values.length / rows;
  if (image.width !== columns || image.height !== rows) Object.assign(image, { width: columns, height: rows });
  const context = contextOf(image);
  const picture = context.createImageData(columns, rows);
  const pixels = picture.data.fill(255);
  for (let row = 0, p = 0; row < rows; row++)
    for (let column = 0; column < columns; column++, p += 4) {
      const value = values[column * rows + row];
      const k = shade(value, largest);
      const light = (row + column) % DIAGONALS === 0 && isHatched(value, largest) ? LINE : 1;
      pixels[p] = light * palette[k];
      pixels[p + 1] = light * palette[k + 1];
      pixels[p + 2] = light * palette[k + 2];
    }
  context.putImageData(picture, 0, 0);
}

/**
 * The value under a place of such a picture, NaN beside it.
 * @param {Float32Array} values
 * @param {number} rows
 * @param {Range} across  values at its left and right edge
 * @param {Range} down  values in the middle of its first and last row
 * @returns {(x: number, y: number) => number}
 */
export const reader = (values, rows, across, down) => (x, y) => {
  const columns = values.length / rows;
  const share = (x - across[0]) / (across[1] - across[0]);
  const column = Math.min(Math.floor(share * columns), columns - 1);
  const row = Math.round(((y - down[0]) / (down[1] - down[0])) * (rows - 1));
  return share >= 0 && share <= 1 && row >= 0 && row < rows ? values[column * rows + row] : NaN;
};
