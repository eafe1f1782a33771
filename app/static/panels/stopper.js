// The button that stops what takes long, and has it worked out again.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/** @import { Model } from '../wire/model.js' */

const LATE = 500; // ms before it can be stopped: an answer that comes soon needs no button

export class Stopper {
  left = false; // the visitor has stopped it
  running = false;
  /** @type {number | undefined} */ appearing;

  /**
   * @param {Model} model
   * @param {string} property  whether it is under way
   * @param {() => void} changed
   */
  constructor(model, property, changed) {
    this.root = make('button', { type: 'button', className: 'whole', hidden: true });
    this.root.onclick = () => {
      this.left = model[property];
      model[property] = !this.left;
      changed();
    };
    this.under = () => Boolean(model[property]);
    model.on(property, changed);
  }
  /** @param {boolean} stopped  the answer is what was known when it was stopped */
  show(stopped) {
    const running = this.under();
    this.root.textContent = text(running ? 'panel.cancel' : 'panel.work-out');
    if (running !== this.running) {
      clearTimeout(this.appearing);
      this.root.hidden = true;
      if (running) {
        this.left = false;
        this.appearing = window.setTimeout(() => (this.root.hidden = false), LATE);
      }
    }
    this.running = running;
    if (!running) this.root.hidden = !stopped;
  }
}
