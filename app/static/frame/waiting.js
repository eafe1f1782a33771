// Says what the visitor waits for, over the page, until it is there.
import { make } from '../browser/dom.js';
import { said } from '../text/catalogue.js';

/** @import { Model } from '../wire/model.js' */

const LATE = 300; // ms: an answer that comes sooner needs no word
const LOOK = 100;

export class Waiting {
  /** @type {Map<string, { sentence: string, since: number }>} */ signs = new Map(); // what is waited for, by name
  /** @type {number | undefined} */ saying;

  /** @type {HTMLElement | null} */ place = null; // over which it is said, once there is one

  /** @param {Model} model */
  constructor(model) {
    this.model = model;
    this.root = make('div', { className: 'waiting', role: 'status', hidden: true });
    model.on('waiting', () => this.say());
    this.say();
  }
  /**
   * An answer is on its way: said after a moment.
   * @param {string} name
   * @param {string} sentence
   * @param {number} [moment]  ms
   */
  soon(name, sentence, moment = LATE) {
    this.signs.set(name, { sentence, since: performance.now() + moment });
    this.say();
  }
  /** @param {string} name */
  over(name) {
    if (this.signs.delete(name)) this.say();
  }
  /**
   * Said at once, until it is `there()` and `then()` is done with it, or is no longer `wanted()`.
   * @param {string} name
   * @param {string} sentence
   * @param {() => unknown} there
   * @param {() => boolean} wanted
   * @param {() => void} then
   */
  expect(name, sentence, there, wanted, then) {
    const sign = { sentence, since: 0 };
    this.signs.set(name, sign);
    const look = () => {
      if (this.signs.get(name) !== sign) return;
      const found = there();
      if (!found && wanted()) {
        setTimeout(look, LOOK);
        return;
      }
      this.over(name);
      if (found) then();
    };
    look();
    this.say();
  }
  // What could not be done is waited for no more.
  clear() {
    this.signs.clear();
    this.say();
  }
  /** Where its place is now. */
  settle() {
    const box = this.root.hidden ? null : this.place?.getBoundingClientRect(); // for which the page is laid out
    if (!box?.width) return;
    const from = this.root.offsetParent?.getBoundingClientRect(); // in another's page, which scrolls
    const { width, height } = box;
    const at = { left: box.left - (from?.left ?? 0), top: box.top - (from?.top ?? 0), width, height };
    for (const [side, value] of Object.entries(at)) this.root.style.setProperty(side, `${value}px`);
  }
  say() {
    clearTimeout(this.saying);
    const now = performance.now();
    const all = [...this.signs.values()];
    const due = all.filter((sign) => sign.since <= now);
    const longer = this.model.waiting && said(JSON.parse(this.model.waiting));
    this.root.textContent = [due.at(-1)?.sentence, longer].filter(Boolean).join(' ');
    this.root.hidden = !this.root.textContent;
    this.place?.classList.toggle('covered', !this.root.hidden);
    this.settle();
    const later = all.filter((sign) => sign.since > now).map((sign) => sign.since);
    if (later.length) this.saying = window.setTimeout(() => this.say(), Math.min(...later) - now + 1);
  }
}
