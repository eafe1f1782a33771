// A lesson before a class: large letters, nothing to set, and keys that a presenter's remote sends.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/** @import { Lesson } from './lesson.js' */

export const PROJECTOR = 'projector'; // in the address
const LARGER = 1.3; // times, all letters

export class Projector {
  on = false;

  /** @param {Lesson} lesson */
  constructor(lesson) {
    this.lesson = lesson;
    const name = text('lesson.projector');
    this.button = make('button', { type: 'button', textContent: text('lesson.larger'), title: name, ariaLabel: name });
    this.button.className = 'lesson-project';
    this.button.onclick = () => this.#anew();
  }
  /** The page is loaded anew, as letters of its pictures are as large as they were when it came; answers are kept. */
  #anew() {
    this.on = !this.on;
    this.lesson.page.history.write();
    location.reload();
  }
  /** @param {boolean} on */
  turn(on) {
    const { page } = this.lesson;
    this.on = on;
    this.button.ariaPressed = String(on);
    page.root.classList.toggle('projected', on);
    document.documentElement.style.fontSize = on ? `${100 * LARGER}%` : '';
    if (!page.frame) return;
    page.layout.place();
    page.history.later();
  }
  /**
   * What keys do, once it is on. Whether they do anything.
   * @param {KeyboardEvent} event
   */
  key({ key }) {
    const { lesson } = this;
    const { player } = lesson.page;
    /** @type {Record<string, () => void>} */
    const keys = {
      ArrowRight: () => lesson.enter(lesson.at + 1),
      PageDown: () => lesson.enter(lesson.at + 1),
      ArrowLeft: () => lesson.enter(lesson.at - 1),
      PageUp: () => lesson.enter(lesson.at - 1),
      f: () => player.playing && player.toggle(),
    };
    const act = this.on && keys[key.length === 1 ? key.toLowerCase() : key];
    if (act) act();
    return Boolean(act);
  }
}
