// The button that forgets all answers: it asks first, and what it has forgotten can be brought back for a while.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/** @import { Lesson } from './lesson.js' */

const ASKS = 5000; // ms for which it waits for a second press
const MINDS = 10_000; // ms for which what is forgotten can be brought back
/** @typedef {'again' | 'sure' | 'undo-forget'} State  as its sentences are called */

export class Forget {
  /** @type {State} */ state = 'again';
  /** @type {number | undefined} */ timer;
  /** @type {(() => void) | null} */ bring = null; // back what was forgotten

  /** @param {Lesson} lesson */
  constructor(lesson) {
    this.lesson = lesson;
    this.words = make('span', { className: 'lesson-word' });
    const sign = make('span', { textContent: '⟲', ariaHidden: 'true' });
    this.button = make('button', { type: 'button', className: 'lesson-forget' }, sign, this.words);
    this.button.onclick = () => this.#press();
    this.#turn('again');
    for (const type of ['pointerdown', 'keydown']) window.addEventListener(type, (event) => this.#other(event), true);
  }
  /**
   * @param {State} state
   * @param {number} [wait]  ms after which it is as at first
   */
  #turn(state, wait = 0) {
    this.state = state;
    this.button.classList.toggle('sure', state !== 'again');
    this.button.ariaLabel = this.button.title = this.words.textContent = text(`lesson.${state}`);
    clearTimeout(this.timer);
    if (wait) this.timer = window.setTimeout(() => this.#turn('again'), wait);
  }
  /**
   * Who does anything else does not want it.
   * @param {Event} event
   */
  #other(event) {
    if (this.state === 'sure' && !event.composedPath().includes(this.button)) this.#turn('again');
  }
  #press() {
    const { lesson, state } = this;
    if (state === 'again') {
      this.#turn('sure', ASKS);
      lesson.speak(text('lesson.sure'));
    } else if (state === 'sure') {
      this.bring = lesson.restart();
      this.#turn('undo-forget', MINDS);
      lesson.speak(text('lesson.forgotten'));
    } else {
      this.#turn('again');
      this.bring?.();
    }
  }
}
