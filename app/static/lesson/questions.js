// The questions of a lesson by their kind, and the simplest of them: a choice of one sentence.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { mainButton, saidOf } from './answered.js';
import { elementsOf, wordsOf } from './nodes.js';
import { NumberQuestion } from './number.js';
import { Order } from './order.js';
import { Goal } from './goal.js';
import { Sketch } from './sketch.js';

/** @import { Frame } from '../messages.js' */
/** @import { Lesson } from './lesson.js' */

/** @typedef {Record<string, any>} Part  of a step, as app/lessons/record.py writes it */
/**
 * @typedef {object} Question
 * @property {HTMLElement} root
 * @property {boolean} done  whether it is answered
 * @property {HTMLElement} [chart]  that stands in the place of the rows
 * @property {Record<string, number>} [choices]  of the page, that it is about
 * @property {boolean} [predicts]  what happens is not to be seen before
 * @property {(frame: Frame) => void} [load]
 * @property {(t: number) => void} [show]
 * @property {() => void} [draw]
 * @property {() => Node[]} said  for the summary: what was answered, and what is so
 */

/** @implements {Question} */
class Choice {
  predicts = true;

  /**
   * @param {Lesson} lesson
   * @param {Part} part
   */
  constructor(lesson, part) {
    this.lesson = lesson;
    this.part = part;
    this.answer = lesson.answerOf(part.name, { picked: -1, done: false });
    this.root = make('div', { className: 'lesson-choice' });
    this.#render();
  }
  get done() {
    return this.answer.done;
  }
  #render() {
    const { answer, lesson, part } = this;
    const { picked, done } = answer;
    const radios = part.options.map((/** @type {Part} */ option, /** @type {number} */ k) => {
      const input = make('input', { type: 'radio', name: part.name, checked: k === picked, disabled: done });
      input.onchange = () => {
        answer.picked = k;
        lesson.keep();
        show.disabled = false;
      };
      const label = make('label', {}, input, make('span', {}, ...elementsOf(option.text)));
      label.classList.toggle('taken', done && k === picked);
      return label;
    });
    const show = mainButton(text('lesson.show'), () => this.#tell());
    show.disabled = picked < 0;
    const about = make('legend', { textContent: text('lesson.one-of') });
    const all = make('fieldset', {}, about, ...radios);
    this.root.replaceChildren(all, ...(done ? [this.#said()] : [show]));
  }
  #said() {
    const { right, say } = this.part.options[this.answer.picked];
    return saidOf(Boolean(right), say);
  }
  #tell() {
    if (this.answer.picked < 0) return;
    this.answer.done = true;
    this.#render();
    this.lesson.answered(wordsOf(this.part.options[this.answer.picked].say));
  }
  said() {
    const { answer, part } = this;
    const right = part.options.filter((/** @type {Part} */ option) => option.right);
    const join = (/** @type {Part[]} */ options) =>
      make('p', {}, ...options.flatMap((option, k) => [...(k ? ['; '] : []), ...elementsOf(option.text)]));
    return [join([part.options[answer.picked]]), join(right)];
  }
}

/** @type {Record<string, new (lesson: Lesson, part: Part) => Question>} */
const KINDS = { choice: Choice, number: NumberQuestion, order: Order, set: Goal, sketch: Sketch };

/** @param {Part} part */
export const asks = (part) => Object.hasOwn(KINDS, part.kind);

/**
 * @param {Lesson} lesson
 * @param {Part} part
 */
export const questionOf = (lesson, part) => new KINDS[part.kind](lesson, part);
