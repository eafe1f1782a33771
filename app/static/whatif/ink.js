// What maps and curves are drawn with: words, marks, lines of many pieces.
import { letters, scale } from '../charts/canvas.js';

/** @typedef {CanvasRenderingContext2D} Context */

export const COLOR = {
  ...{ ink: '#1c2733', soft: '#5b6c7d', accent: '#00715a', onAccent: '#fff', ring: '#fff', pill: '#e4f1ed' },
  ...{ contour: '#2b151040', label: '#2b1a14', boundary: '#15202b', casing: '#ffffffb3', edge: '#ffffffd0' },
  ...{ hatch: '#aab6c1', cross: '#15202b90', kept: '#8a3fb5', line: '#dbe3ea' },
};

/**
 * @param {Context} c
 * @param {number[]} line  x and y of both ends of each piece
 * @param {string} color
 * @param {number} width
 */
export function stroke(c, line, color, width) {
  c.beginPath();
  for (let k = 0; k < line.length; k += 4) {
    c.moveTo(line[k], line[k + 1]);
    c.lineTo(line[k + 2], line[k + 3]);
  }
  c.strokeStyle = color;
  c.lineWidth = width;
  c.stroke();
}

/**
 * A straight mark from a place on, as the context strokes.
 * @param {Context} c
 * @param {number} x
 * @param {number} y
 * @param {number} across
 * @param {number} down
 */
export function mark(c, x, y, across, down) {
  c.beginPath();
  c.moveTo(x, y);
  c.lineTo(x + across, y + down);
  c.stroke();
}

/**
 * @param {Context} c
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 * @param {string} color
 */
export function disc(c, x, y, radius, color) {
  c.beginPath();
  c.arc(x, y, radius, 0, 2 * Math.PI);
  c.fillStyle = color;
  c.fill();
}

/**
 * @typedef {object} Hand
 * @property {number} [size]  pixels, where nobody wants letters larger
 * @property {string} [weight]
 * @property {CanvasTextAlign} [align]
 * @property {string} [color]
 * @property {string} [edge]  colour about the letters
 */
/**
 * @param {Context} c
 * @param {string} words
 * @param {number} x
 * @param {number} y
 * @param {Hand} [hand]
 */
export function word(c, words, x, y, { size = 13, weight = '', align = 'center', color = COLOR.ink, edge } = {}) {
  c.font = letters(size, weight);
  c.textAlign = align;
  c.textBaseline = 'middle';
  if (edge) {
    c.strokeStyle = edge;
    c.lineWidth = 4;
    c.lineJoin = 'round';
    c.strokeText(words, x, y);
  }
  c.fillStyle = color;
  c.fillText(words, x, y);
}

/**
 * Words on a ground of their own, within so many pixels from the left.
 * @param {Context} c
 * @param {string} words
 * @param {number} x
 * @param {number} y
 * @param {'left' | 'center' | 'right'} align
 * @param {number} within
 */
export function pill(c, words, x, y, align, within) {
  c.font = letters(13, '600 ');
  const wide = c.measureText(words).width + 14;
  const from = x - (align === 'left' ? 0 : align === 'right' ? wide : wide / 2);
  const left = Math.max(2, Math.min(within - wide - 2, from));
  for (const [edge, color] of /** @type {const} */ ([
    [4, '#fff'],
    [0, COLOR.pill],
  ])) {
    // prettier-ignore
    c.beginPath();
    c.roundRect(left - edge, y - 11 * scale, wide + 2 * edge, 22 * scale, 6);
    c.fillStyle = color;
    c.fill();
  }
  word(c, words, left + 7, y + 0.5, { weight: '600 ', align: 'left', color: COLOR.accent });
}
