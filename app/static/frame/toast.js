// A sentence that stands over the page for a while, as when something was refused that has no field in view.
import { unbroken } from '../text/format.js';
import { make } from '../browser/dom.js';

const STANDS = 8000; // ms

export class Toast {
  root = make('div', { className: 'toast', role: 'status', hidden: true });
  /** @type {number | undefined} */ #hush;

  /** @param {string} sentences  by line; they are shown one at a time */
  say(sentences) {
    const [first, ...rest] = sentences.split('\n');
    this.root.textContent = unbroken(first);
    this.root.hidden = false;
    clearTimeout(this.#hush);
    this.#hush = window.setTimeout(() => {
      this.root.hidden = true;
      if (rest.length) this.say(rest.join('\n'));
    }, STANDS);
  }
}
