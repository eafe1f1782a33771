// The scene of a step is still to come: the picture of the one before is put aside, and a question waits for its own.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/** @import { Page } from '../page.js' */

const NAME = 'step'; // of what is waited for
const GRACE = 200; // ms: a picture that is there sooner takes the place of the one before
const WAITING = '.lesson-asked, .sketch, .player, .dock.left'; // what would be about that one

export class Coming {
  /** @type {HTMLElement[]} */ held = [];
  /** @type {number | undefined} */ timer;
  why = make('p', { className: 'lesson-refused' }); // that there is no picture

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
  }
  /** @param {boolean} first  whether nothing of this lesson was seen as yet */
  begin(first) {
    const { root, waiter } = this.page;
    this.why.remove();
    this.held = [...root.querySelectorAll(WAITING)].filter((each) => each instanceof HTMLElement);
    for (const each of this.held) each.inert = true;
    const grace = first || root.classList.contains('coming') ? 0 : GRACE;
    waiter.place = root.querySelector('.stages');
    waiter.soon(NAME, text('page.solving'), grace);
    clearTimeout(this.timer);
    const aside = () => root.classList.add('coming');
    if (grace) this.timer = window.setTimeout(aside, grace);
    else aside();
  }
  /**
   * It cannot be: why, stays where its picture would be.
   * @param {string} sentences  by line
   */
  refuse(sentences) {
    const { root } = this.page;
    this.end();
    clearTimeout(this.timer);
    root.classList.add('coming');
    this.why.textContent = sentences;
    root.querySelector('.stages')?.append(this.why);
  }
  /** It is waited for no more, whether it has come or not. */
  end() {
    this.page.waiter.over(NAME);
  }
  /** @param {HTMLElement} place  where it is said what is waited for from now on */
  over(place) {
    const { root, waiter } = this.page;
    clearTimeout(this.timer);
    this.why.remove();
    for (const each of this.held) each.inert = false;
    root.classList.remove('coming');
    waiter.place = place;
    this.end();
    waiter.say();
  }
}
