// A solution that is kept: the message as it came, at most 100 kB, and what is taken from it when it is asked for.
import { decode } from '../wire/message.js';
import { roomOf } from './kinds.js';

/** @import { Frame } from '../messages.js' */
/** @import { Histories } from './histories.js' */
/** @import { Letter } from '../frame/kept.js' */

export class Run {
  /** @type {Record<string, Histories | null>} */ #histories = {};
  /** @type {Frame | null} */ #frame = null;
  called = ''; // in charts, in place of its letter
  asked = ''; // the ready-made comparison for which it was kept

  /**
   * @param {Letter} letter  by which it is called and coloured
   * @param {ArrayBuffer} bytes
   */
  constructor(letter, bytes) {
    this.letter = letter;
    this.bytes = bytes;
  }
  /** @returns {Frame} */
  get frame() {
    return (this.#frame ??= decode(this.bytes));
  }
  /** @param {'exact' | 'other'} which */
  histories(which) {
    return (this.#histories[which] ??= roomOf(this.frame).histories(this.frame, which));
  }
}
