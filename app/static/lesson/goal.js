// A slider of the page is moved until something is so; judged while it moves.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { engineering, figures } from '../text/format.js';
import { LABELS } from '../text/words.js';
import { saidOf } from './answered.js';
import { lastContact, meets, quantityOf } from './events.js';
import { wordsOf } from './nodes.js';

/** @import { Frame } from '../messages.js' */
/** @import { Lesson } from './lesson.js' */
/** @import { Part, Question } from './questions.js' */

/**
 * Which of the ranges a place is in, or is nearest to, as a ratio where all is positive.
 * @param {{ range: [number, number] | null }[]} found
 * @param {number} place
 */
export function rangeOf(found, place) {
  const off = found.map(({ range }) => {
    if (!range || (place >= range[0] && place <= range[1])) return 0;
    const end = place < range[0] ? range[0] : range[1];
    return end > 0 && place > 0 ? Math.abs(Math.log(place / end)) : Math.abs(place - end);
  });
  return off.indexOf(Math.min(...off));
}

/** @type {Record<string, string>} */
const UNITS = { contact_time: 's', impulse: 'N s', peak_force: 'N', peak_indentation: 'm' }; // of what a goal is about

/**
 * What a goal is about, as it is by now.
 * @param {Frame} frame
 * @param {string} quantity
 */
export function wordsOfGoal(frame, quantity) {
  const value = quantityOf(frame, quantity) ?? NaN;
  if (quantity in UNITS) return engineering(value, UNITS[quantity]);
  return `${figures(value)}${quantity.endsWith('_velocity') ? ' m/s' : ''}`;
}

/**
 * A choice of the page with its name.
 * @param {string} name
 * @param {number} value
 */
export function valueWords(name, value) {
  const { title, unit = '' } = LABELS[name];
  return text('lesson.value', { title, value: figures(value), unit });
}

/** @implements {Question} */
export class Goal {
  said_ = '';

  /**
   * @param {Lesson} lesson
   * @param {Part} part
   */
  constructor(lesson, part) {
    this.lesson = lesson;
    this.part = part;
    this.answer = lesson.answerOf(part.name, { place: part.start, found: [], done: false });
    this.says = make('div', { className: 'lesson-says' });
    this.root = make('div', { className: 'lesson-set' }, this.says);
  }
  get done() {
    return this.answer.done;
  }
  /** What the page is to show: the slider where it was left. */
  get choices() {
    const [low, high] = this.part.range;
    return { [this.part.slider]: Math.min(Math.max(this.answer.place, low), high) };
  }
  /** How far the slider reaches. */
  get bounds() {
    return { [this.part.slider]: this.part.range };
  }
  /** @param {Frame} frame */
  load(frame) {
    const { answer, lesson, part } = this;
    const place = Number(frame.chosen[part.slider]);
    if (lesson.coming || !Number.isFinite(place)) return; // another step's choices are still shown
    answer.place = place;
    const met = meets(frame, part.goal);
    const which = met ? rangeOf(part.found, place) : -1;
    const new_ = which >= 0 && !answer.found.some((/** @type {Part} */ each) => each.which === which);
    const fresh = new_ && lesson.rests(frame, part.slider); // a hand that only comes past has found nothing
    if (fresh) answer.found.push({ which, place });
    const first = fresh && !answer.done;
    answer.done ||= fresh;
    this.#say(frame, met, which);
    if (first) lesson.answered(this.said_, false);
    else lesson.keep();
  }
  /**
   * @param {Frame} frame
   * @param {boolean} met
   * @param {number} which  of the ranges
   */
  #say(frame, met, which) {
    const { answer, lesson, part } = this;
    const { end, peak, start } = lastContact(frame);
    const [from, to] = [start, end].map((t) => lesson.timeWords(t / lesson.unit));
    const gaps = { start: from, end: to, peak: engineering(peak, 'N'), value: wordsOfGoal(frame, part.goal.quantity) };
    const whole = answer.found.length >= part.found.length;
    const rest = whole ? (part.found.length > 1 ? part.all : null) : answer.found.length ? part.more : null;
    const say = met ? part.found[which].say : part.not_yet;
    const words = wordsOf(say, gaps);
    for (const each of answer.found) if (each.which === which) each.gaps ??= gaps; // of its place
    const more = rest ? [saidOf(whole, rest)] : [];
    for (const each of more) each.classList.add('lesson-more');
    this.says.replaceChildren(saidOf(met, say, gaps), ...more);
    const spoken = [words, rest ? wordsOf(rest) : ''].join(' ').trim();
    if (!met)
      this.said_ = ''; // what is not so yet changes all the time
    else if (spoken !== this.said_ && lesson.rests(frame, part.slider)) {
      lesson.speak(spoken);
      this.said_ = spoken;
    }
  }
  /** A hand has let go. */
  settle() {
    this.load(this.lesson.page.frame);
  }
  said() {
    const { found } = this.answer;
    const words = (/** @type {Part} */ { gaps, place, which }) => [
      make('p', { textContent: valueWords(this.part.slider, place) }),
      ...(which in this.part.found ? [saidOf(true, this.part.found[which].say, gaps ?? {})] : []),
    ];
    return [make('div', {}, ...found.flatMap(words))];
  }
}
