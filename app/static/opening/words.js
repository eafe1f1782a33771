// Words on a picture, none of which lies on another: those that are said first stand.
import { contextOf, letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { make } from '../browser/dom.js';

/** @typedef {{ words: string, x: number, y: number, color: string, font: string, align: CanvasTextAlign }} Written */
/** @typedef {[left: number, top: number, right: number, bottom: number]} Box */
/** @typedef {Written & { box: Box }} Word */

const HALO = 4; // pixels

/**
 * @param {CanvasRenderingContext2D} c
 * @param {Written} word
 * @returns {Box}
 */
function boxOf(c, { align, font, words, x, y }) {
  c.font = font;
  const { actualBoundingBoxAscent: up, actualBoundingBoxDescent: down, width } = c.measureText(words);
  const left = x - (align === 'right' ? width : align === 'center' ? width / 2 : 0);
  return [left, y - up, left + width, y + down];
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {Word} word
 */
function write(c, { align, color, font, words, x, y }) {
  Object.assign(c, { font, textAlign: align, textBaseline: 'alphabetic', lineWidth: HALO });
  c.strokeStyle = COLORS.panel;
  c.strokeText(words, x, y);
  c.fillStyle = color;
  c.fillText(words, x, y);
}

export class Words {
  /** @type {Word[]} */ all = [];
  edge = Infinity; // of the picture, at the right [px]
  #ruler = contextOf(make('canvas'));

  /**
   * @param {string} words
   * @param {number} x
   * @param {number} y  of the line they stand on
   * @param {string} color
   * @param {string} [font]
   * @param {CanvasTextAlign} [align]
   * @returns {boolean}  whether there is room for it
   */
  say(words, x, y, color, font = letters(13), align = 'left') {
    let word = this.#measured({ words, x, y, color, font, align });
    const beyond = word.box[2] - this.edge;
    if (beyond > 0) word = this.#measured({ ...word, x: x - beyond });
    const clear = this.#clear(word);
    if (clear) this.all.push(word);
    return clear;
  }
  /**
   * @param {Written} word
   * @returns {Word}
   */
  #measured(word) {
    return { ...word, box: boxOf(this.#ruler, word) };
  }
  /** @param {Word} word */
  #clear({ box: [left, top, right, bottom] }) {
    return this.all.every(({ box: [from, high, to, low] }) => right < from || left > to || bottom < high || top > low);
  }
  /**
   * Stretches in which words lie on a height, from the left.
   * @param {number} y
   * @returns {[from: number, to: number][]}
   */
  across(y) {
    const boxes = this.all.map(({ box }) => box);
    const on = boxes.filter(([, top, , bottom]) => top - HALO < y && y < bottom + HALO);
    return on
      .map(([left, , right]) => /** @type {[number, number]} */ ([left - HALO, right + HALO]))
      .sort(([a], [b]) => a - b);
  }
  /**
   * All of them, and what is said of the instant where it lies on none.
   * @param {CanvasRenderingContext2D} c
   * @param {string} now
   * @param {number} x
   * @param {number} y
   */
  draw(c, now, x, y) {
    for (const each of this.all) write(c, each);
    const word = this.#measured({ words: now, x, y, color: COLORS.cursor, font: letters(13, '600 '), align: 'left' });
    if (this.#clear(word)) write(c, word);
  }
}
