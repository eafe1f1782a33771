// The questions of a lesson by their kind, and the simplest of them: a choice of one sentence.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { afterwards, againButton, mainButton, saidOf, triesOf } from './answered.js';
import { elementsOf, wordsOf } from './nodes.js';
import { NumberQuestion } from './number.js';
import { Order } from './order.js';
import { Goal } from './goal.js';
import { Boundary, drawsOverMap } from './boundary.js';
import { Sketch } from './sketch.js';

/** @import { Frame } from '../messages.js' */
/** @import { Lesson } from './lesson.js' */

/** @typedef {Record<string, any>} Part  of a step, as app/lessons/record.py writes it */
/**
 * What the browser keeps of a lesson.
 * @typedef {object} Progress
 * @property {string} of  questions as they were
 * @property {number} far  the latest step
 * @property {Record<string, any>} answers
 * @property {number} [salt]  of their code
 * @property {Record<string, number>} [ends]  of colours, in all steps so far
 */
/**
 * @typedef {object} Question
 * @property {HTMLElement} root
 * @property {boolean} done  whether it is answered
 * @property {boolean} [tried]  whether it was, in vain perhaps
 * @property {HTMLElement} [chart]  that stands in the place of the rows
 * @property {string} [over]  a chart of the step that it is drawn on
 * @property {Record<string, number>} [choices]  of the page, that it is about
 * @property {Record<string, [low: number, high: number]>} [bounds]  between which these may be
 * @property {boolean} [predicts]  what happens is not to be seen before
 * @property {(frame: Frame) => void} [load]
 * @property {() => void} [settle]  a hand has let go of a slider
 * @property {(t: number) => void} [show]
 * @property {() => void} [draw]
 * @property {() => Node[]} said  for the summary: what was answered, and what is so
 */

/** Beside an option that is right. */
const rightSign = () =>
  make('b', { className: 'lesson-right', textContent: '✓', role: 'img', ariaLabel: text('lesson.right') });

/** @implements {Question} */
class Choice {
  predicts = true;
  /** @type {{ picked: number, done: boolean } | null} */ trial; // once it is answered

  /**
   * @param {Lesson} lesson
   * @param {Part} part
   */
  constructor(lesson, part) {
    this.lesson = lesson;
    this.part = part;
    this.answer = lesson.answerOf(part.name, { picked: -1, done: false, more: 0 }); // `picked` at first
    const { last } = this.answer;
    this.trial = last === undefined ? null : { picked: last, done: true };
    this.root = make('div', { className: 'lesson-choice' });
    this.#render();
  }
  get done() {
    return this.answer.done;
  }
  #render() {
    const { lesson, part } = this;
    const now = this.trial ?? this.answer;
    const { picked, done } = now;
    const radios = part.options.map((/** @type {Part} */ option, /** @type {number} */ k) => {
      const input = make('input', { type: 'radio', name: part.name, checked: k === picked, disabled: done });
      input.onchange = () => {
        now.picked = k;
        lesson.keep();
        show.disabled = false;
      };
      const found = done && option.right && part.options[picked].right;
      const sign = found ? [rightSign()] : [];
      const label = make('label', {}, input, make('span', {}, ...elementsOf(option.text)), ...sign);
      label.classList.toggle('taken', done && k === picked);
      return label;
    });
    const show = mainButton(text('lesson.show'), () => this.#tell());
    show.disabled = picked < 0;
    const about = make('legend', { textContent: text(done ? 'lesson.chosen' : 'lesson.one-of') });
    const all = make('fieldset', {}, about, ...radios);
    this.root.replaceChildren(all, ...(done ? this.#said(picked) : [show]));
  }
  /** @param {number} picked */
  #said(picked) {
    const more = this.answer.more ?? 0;
    const again = againButton(() => {
      this.trial = { picked: -1, done: false };
      this.#render();
      this.root.querySelector('input')?.focus();
    });
    const { right } = this.part.options[picked];
    return [this.#judged(picked), ...(more ? [triesOf(1 + more)] : []), ...(right ? [] : [again])];
  }
  /** @param {number} picked */
  #judged(picked) {
    const { right, say } = this.part.options[picked];
    return saidOf(Boolean(right), say);
  }
  #tell() {
    const { answer } = this;
    const now = this.trial ?? answer;
    if (now.picked < 0) return;
    now.done = true;
    const { right, say } = this.part.options[now.picked];
    if (this.trial) Object.assign(answer, { more: (answer.more ?? 0) + 1, last: now.picked });
    if (this.trial && right) answer.later = true;
    this.#render();
    this.lesson.answered(wordsOf(say));
  }
  said() {
    const { answer, part } = this;
    const right = part.options.filter((/** @type {Part} */ option) => option.right);
    const join = (/** @type {Part[]} */ options) =>
      make('p', {}, ...options.flatMap((option, k) => [...(k ? ['; '] : []), ...elementsOf(option.text)]));
    const first = part.options[answer.picked];
    const tries = afterwards(1 + (answer.more ?? 0), !first.right && answer.later);
    const mine = make('div', {}, join([first]), this.#judged(answer.picked), ...tries);
    return first.right && right.length === 1 ? [mine] : [mine, join(right)];
  }
}

/** @type {Record<string, new (lesson: Lesson, part: Part) => Question>} */
const KINDS = { choice: Choice, number: NumberQuestion, order: Order, set: Goal, sketch: Sketch };

/** @param {Part} part */
export const asks = (part) => Object.hasOwn(KINDS, part.kind);

/**
 * @param {Lesson} lesson
 * @param {Part} part
 * @returns {Question}
 */
export const questionOf = (lesson, part) => new (drawsOverMap(part) ? Boundary : KINDS[part.kind])(lesson, part);
