// A number and its unit are asked for: what is near it, what usual mistakes give, and how often it was tried.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { afterwards, brought, mainButton, saidOf, triesOf } from './answered.js';
import { wordsOf } from './nodes.js';

/** @import { Piece } from './nodes.js' */
/** @import { Lesson } from './lesson.js' */
/** @import { Part, Question } from './questions.js' */

const NUMBER = /^([-+]?\d{0,12}(?:[.,]\d{0,12})?(?:e[-+]?\d{1,2})?)([^\d\s.,][^\d]{0,7})?$/i;
const POWERS = 1e-9; // of ten, that are no whole ones
const FAR = 9; // powers of ten that a unit can be off
const NEAR = 0.03; // of the answer

/**
 * @typedef {object} Asked  see app/lessons/lesson.py
 * @property {number} answer
 * @property {string} unit
 * @property {number} tolerance
 * @property {string[]} units
 * @property {number[]} factors
 * @property {Piece[]} yes
 * @property {Piece[]} no
 * @property {{ say: Piece[], answer: number | null, numbers: number[], power_of_ten: boolean }[]} mistakes
 */

/**
 * What was written: a number with a decimal comma or point, and the unit behind it, where there is one.
 * @param {string} written
 * @param {string[]} units
 * @returns {{ value: number, unit: string } | null}
 */
export function read(written, units) {
  const plain = written
    .slice(0, 60)
    .replace(/[\s\u00a0\u202f]/g, '')
    .replaceAll('−', '-')
    .replace(/[×·*]10\^?/, 'e');
  const [, digits = '', behind = ''] = NUMBER.exec(plain) ?? [];
  const value = /\d/.test(digits) ? Number(digits.replace(',', '.')) : NaN;
  const sign = behind.replace(/^[uμ](?=[a-zA-Z])/, 'µ');
  const unit = units.find((each) => each.replace(/\s/g, '') === sign) ?? '';
  return Number.isFinite(value) && (!behind || unit) ? { value, unit } : null;
}

/**
 * Whether a number in one of the units is right, and else which mistake gives it; -1: none that is usual.
 * @param {Asked} asked
 * @param {number} value
 * @param {string} unit
 * @returns {{ right: boolean, mistake: number }}
 */
export function judgeNumber({ answer, factors, mistakes, tolerance, unit: own, units }, value, unit) {
  const factor = (/** @type {string} */ name) => factors[units.indexOf(name)] ?? 1;
  const inOwn = (value * factor(unit)) / factor(own);
  const part = tolerance / (Math.abs(answer) || 1);
  const near = (/** @type {number} */ a, /** @type {number} */ b) => Math.abs(a - b) <= part * Math.abs(b) + 1e-12;
  if (Math.abs(inOwn - answer) <= tolerance * (1 + POWERS)) return { right: true, mistake: -1 };
  const tens = Math.round(Math.log10(Math.abs(inOwn / answer)));
  const shifted = Number.isFinite(tens) && tens !== 0 && Math.abs(tens) <= FAR && near(inOwn / 10 ** tens, answer);
  const mistake = mistakes.findIndex((each) => {
    if (each.answer !== null) return near(inOwn, each.answer);
    if (each.power_of_ten) return shifted;
    return each.numbers.some((digits) => near(value, digits));
  });
  return { right: false, mistake };
}

/**
 * Whether a number that is not right is off by no more than one that was rounded, or read off a line.
 * @param {Asked} asked
 * @param {number} value
 * @param {string} unit
 */
export function isNear({ answer, factors, unit: own, units }, value, unit) {
  const factor = (/** @type {string} */ name) => factors[units.indexOf(name)] ?? 1;
  return Math.abs((value * factor(unit)) / factor(own) - answer) <= NEAR * Math.abs(answer);
}

/**
 * A unit behind its number; a ratio has none.
 * @param {string} unit
 */
export const unitWord = (unit) => (unit === '1' ? '' : unit);
/**
 * @param {number} value
 * @param {string} unit
 */
export const quantityWords = (value, unit, digits = 6) => `${figures(value, digits)} ${unitWord(unit)}`.trim();

/** @typedef {{ written: string, unit: string, done: boolean, said: number }} Trial  `said`: of the mistakes */

/** @implements {Question} */
export class NumberQuestion {
  /**
   * @param {Lesson} lesson
   * @param {Part} part
   */
  constructor(lesson, part) {
    this.lesson = lesson;
    this.part = /** @type {Part & Asked} */ (part);
    const fresh = { written: '', unit: part.units[0], tries: 0, done: false, said: -2, first: null };
    this.answer = lesson.answerOf(part.name, fresh);
    this.input = make('input', { type: 'text', inputMode: 'decimal', autocomplete: 'off', maxLength: 40 });
    this.input.ariaLabel = text('lesson.number');
    this.input.value = this.answer.written;
    this.unit = make('select', { ariaLabel: text('lesson.unit') });
    this.unit.append(...part.units.map((/** @type {string} */ value) => make('option', { value, textContent: value })));
    this.unit.value = this.answer.unit;
    const own = make('span', { textContent: unitWord(part.unit) });
    this.said_ = make('div', { className: 'lesson-says' });
    const check = mainButton(text('lesson.check'), () => this.#check());
    this.input.onkeydown = ({ key }) => {
      if (key === 'Enter') this.#check(); // and returns nothing, as false would cancel the key
    };
    this.input.oninput = this.unit.onchange = () => {
      Object.assign(this.answer, { written: this.input.value, unit: this.unit.value });
      lesson.keep();
    };
    const row = make('div', { className: 'lesson-row' }, this.input, part.units.length > 1 ? this.unit : own, check);
    this.root = make('div', { className: 'lesson-number' }, row, this.said_);
    this.#render();
  }
  get done() {
    return this.answer.done;
  }
  get tried() {
    return this.answer.tries > 0;
  }
  #render() {
    const { done, said, tries } = this.answer;
    this.input.readOnly = done;
    this.unit.disabled = done;
    this.root.classList.toggle('done', done);
    if (said < -1) this.said_.replaceChildren();
    else this.said_.replaceChildren(this.#judged(said, done), triesOf(tries));
  }
  /**
   * @param {number} said  of the mistakes
   * @param {boolean} right
   * @param {Trial} [trial]
   */
  #judged(said, right, trial) {
    return saidOf(right, this.#sentences(said, right, trial));
  }
  /**
   * @param {number} said  of the mistakes
   * @param {boolean} right
   * @param {Trial} trial
   */
  #sentences(said, right, trial = this.answer) {
    const { mistakes, no, yes } = this.part;
    if (right) return yes;
    const found = read(trial.written, this.part.units);
    const near = found && isNear(this.part, found.value, trial.unit) && [{ kind: 'text', text: text('lesson.near') }];
    return mistakes[said]?.say ?? (near || no);
  }
  #check() {
    const { answer, input, lesson, part, unit } = this;
    if (answer.done) return;
    const found = read(input.value, part.units);
    if (!found) {
      const hint = make('p', { className: 'lesson-hint', textContent: text('lesson.no-number') });
      this.said_.replaceChildren(hint);
      lesson.speak(hint.textContent ?? '');
      return;
    }
    if (found.unit) unit.value = found.unit;
    const { mistake, right } = judgeNumber(part, found.value, unit.value);
    Object.assign(answer, { written: input.value, unit: unit.value, said: mistake, done: right });
    answer.first ??= { written: input.value, value: found.value, unit: unit.value, said: mistake, done: right };
    answer.tries += 1;
    this.#render();
    if (right) lesson.answered(wordsOf(part.yes));
    else {
      lesson.keep();
      lesson.speak(wordsOf(this.#sentences(mistake, false)));
      input.focus();
      input.select();
      brought(this.root);
    }
  }
  said() {
    const { answer, part } = this;
    /** @type {Trial} */
    const first = answer.first ?? answer;
    const found = read(first.written, part.units);
    const words = make('p', { textContent: found ? quantityWords(found.value, first.unit) : '–' });
    const tries = afterwards(answer.tries, answer.done && !first.done);
    const mine = make('div', {}, words, this.#judged(first.said, first.done, first), ...tries);
    return first.done ? [mine] : [mine, make('p', { textContent: quantityWords(part.answer, part.unit, 4) })];
  }
}
