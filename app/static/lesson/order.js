// Sentences are put in their order: by buttons that say the new place, or by dragging a line at its handle.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { afterwards, brought, mainButton, saidOf, triesOf } from './answered.js';
import { timeOf } from './events.js';
import { elementsOf, wordsOf } from './nodes.js';

/** @import { Frame } from '../messages.js' */
/** @import { Lesson } from './lesson.js' */
/** @import { Part, Question } from './questions.js' */

/**
 * An order that is not the right one, always the same.
 * @param {number} count
 */
export function mixed(count) {
  const step = count > 2 ? count - 2 : 1; // takes turns from either end
  const found = [...Array(count).keys()].sort((a, b) => ((a * step + 1) % count) - ((b * step + 1) % count) || a - b);
  return found.every((each, k) => each === k) ? found.reverse() : found;
}

/**
 * @typedef {{ order: number[], tries: number, checked: boolean, done: boolean,
 *   first: { order: number[], right: number } | null }} Answer
 */

/** @implements {Question} */
export class Order {
  /**
   * @param {Lesson} lesson
   * @param {Part} part
   */
  constructor(lesson, part) {
    this.lesson = lesson;
    this.part = part;
    const fresh = { order: mixed(part.items.length), tries: 0, checked: false, done: false, first: null };
    /** @type {Answer} */
    this.answer = lesson.answerOf(part.name, fresh);
    this.list = make('ol', { className: 'lesson-lines' });
    this.check = mainButton(text('lesson.check'), () => this.#check());
    this.says = make('div', { className: 'lesson-says' });
    this.root = make('div', { className: 'lesson-order' }, this.list, this.check, this.says);
    this.#render();
  }
  get done() {
    return this.answer.done;
  }
  get tried() {
    return this.answer.tries > 0;
  }
  /** Times are known. */
  load() {
    if (this.done) this.#render();
  }
  /** How many are in their place. */
  get #right() {
    return this.answer.order.filter((each, k) => each === k).length;
  }
  /** @param {number} [right] */
  #gaps(right = this.#right) {
    return { right: String(right), all: String(this.part.items.length) };
  }
  #render() {
    const { part } = this;
    const { checked, done, order, tries } = this.answer;
    this.list.replaceChildren(...order.map((n, k) => this.#line(n, k)));
    this.check.hidden = done;
    const say = checked ? [saidOf(done, done ? part.yes : part.no, this.#gaps())] : [];
    this.says.replaceChildren(...say, ...(tries ? [triesOf(tries)] : []));
  }
  /**
   * @param {number} item
   * @param {number} place
   */
  #line(item, place) {
    const { answer, lesson, part } = this;
    const { at, text: words } = part.items[item];
    const time = answer.done && at !== null ? timeOf(at, lesson.events) : NaN;
    const sign = answer.checked && !answer.done && item === place ? '✓' : '';
    const line = make(
      'li',
      {},
      make('b', {
        className: 'lesson-handle',
        textContent: answer.done ? place + 1 : `⠿ ${place + 1}`,
        ariaHidden: 'true',
      }),
      make('span', {}, ...elementsOf(words)),
      make('em', { textContent: Number.isFinite(time) ? lesson.timeWords(time) : sign }),
    );
    if (answer.done) return line;
    const move = (/** @type {string} */ code, /** @type {string} */ textContent, /** @type {number} */ by) => {
      const button = make('button', { type: 'button', textContent, onclick: () => this.#move(place, by) });
      button.ariaLabel = text(code, { line: wordsOf(words) });
      button.disabled = !(place + by in answer.order);
      return button;
    };
    line.append(move('lesson.up', '▲', -1), move('lesson.down', '▼', 1));
    this.#dragged(line, place);
    return line;
  }
  /**
   * @param {number} from
   * @param {number} by
   */
  #move(from, by) {
    const { answer, lesson, part } = this;
    const to = from + by;
    const [moved] = answer.order.splice(from, 1);
    answer.order.splice(to, 0, moved);
    answer.checked = false;
    lesson.keep();
    this.#render();
    const buttons = [...(this.list.children[to]?.querySelectorAll('button') ?? [])];
    const [up, down] = buttons;
    const wanted = by < 0 ? up : down;
    (wanted?.disabled ? buttons.find((each) => !each.disabled) : wanted)?.focus({ preventScroll: true });
    const line = wordsOf(part.items[moved].text);
    lesson.speak(text('lesson.place', { line, place: to + 1, all: answer.order.length }));
  }
  /**
   * The handle alone takes a finger, so that the page still scrolls.
   * @param {HTMLElement} line
   * @param {number} place
   */
  #dragged(line, place) {
    const handle = /** @type {HTMLElement} */ (line.firstElementChild);
    handle.onpointerdown = (down) => {
      if (down.button !== 0) return;
      down.preventDefault();
      handle.setPointerCapture(down.pointerId);
      line.classList.add('held');
      const high = line.offsetHeight;
      const by = (/** @type {PointerEvent} */ { clientY }) => {
        const lines = Math.round((clientY - down.clientY) / high);
        return Math.min(Math.max(lines, -place), this.answer.order.length - 1 - place);
      };
      handle.onpointermove = (event) => (line.style.translate = `0 ${event.clientY - down.clientY}px`);
      handle.onpointerup = handle.onpointercancel = (event) => {
        handle.onpointermove = handle.onpointerup = handle.onpointercancel = null;
        const lines = event.type === 'pointerup' ? by(event) : 0;
        if (lines) this.#move(place, lines);
        else this.#render();
      };
    };
  }
  #check() {
    const { answer, lesson, part } = this;
    answer.tries += 1;
    answer.first ??= { order: [...answer.order], right: this.#right };
    answer.checked = true;
    answer.done = this.#right === answer.order.length;
    this.#render();
    const words = wordsOf(answer.done ? part.yes : part.no, this.#gaps());
    if (answer.done) lesson.answered(words);
    else {
      lesson.keep();
      lesson.speak(words);
      brought(this.root);
    }
  }
  said() {
    const { answer, part } = this;
    const all = part.items.length;
    const first = answer.first?.right ?? all;
    const words = make('p', { textContent: text('lesson.placed', { right: first, all }) });
    const right = first === all;
    const tries = afterwards(answer.tries, answer.done && !right);
    const mine = make('div', {}, words, saidOf(right, right ? part.yes : part.no, this.#gaps(first)), ...tries);
    const lines = part.items.map((/** @type {Part} */ { text: line }) => make('li', {}, ...elementsOf(line)));
    return right ? [mine] : [mine, make('ol', {}, ...lines)];
  }
}
