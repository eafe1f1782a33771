// In the bar: which lesson this is, its steps, and ways to begin again and to leave it.
import { make } from '../browser/dom.js';
import { framed } from '../browser/home.js';
import { lessonAt } from '../frame/address.js';
import { text } from '../text/catalogue.js';
import { Forget } from './forget.js';
import { Print } from './print.js';
import { Projector, PROJECTOR } from './projector.js';

/** @import { Lesson } from './lesson.js' */

export class Bar {
  /** @param {Lesson} lesson */
  constructor(lesson) {
    this.lesson = lesson;
    this.name = make('span', { className: 'lesson-name' });
    this.steps = lesson.record.steps.map((_, k) =>
      make('button', { type: 'button', textContent: k + 1, onclick: () => lesson.enter(k) }),
    );
    const list = make('ol', { className: 'lesson-steps' }, ...this.steps.map((each) => make('li', {}, each)));
    this.forget = new Forget(lesson);
    const act = (/** @type {string} */ sign, /** @type {string} */ code, /** @type {() => void} */ onclick) => {
      const words = make('span', { className: 'lesson-word', textContent: text(code) });
      const button = make('button', { type: 'button', onclick }, make('span', { textContent: sign }), words);
      button.title = button.ariaLabel = text(code);
      return button;
    };
    const again = this.forget.button;
    const leave = act('✕', 'lesson.leave', () => location.assign(lessonAt()));
    this.projector = new Projector(lesson);
    const extras = [this.projector.button, new Print(lesson).button];
    const alone = [...extras, again, leave];
    const acts = make('div', { className: 'lesson-acts' }, ...(framed ? [again] : alone));
    this.root = make('div', { className: 'lesson-bar' }, this.name, list, acts);
  }
  /** What the address says besides. */
  get said() {
    return this.projector.on ? `&${PROJECTOR}` : '';
  }
  /** Titles of steps that were not reached say too much: they are numbers only. */
  show() {
    const { at, progress, record, title } = this.lesson;
    this.name.textContent = text('lesson.of', { title });
    this.name.title = title;
    this.steps.forEach((button, k) => {
      const reached = k <= progress.far;
      const name = text('lesson.step', { step: k + 1, reached, title: reached ? record.steps[k].title : '' });
      button.ariaLabel = button.title = name;
      button.ariaCurrent = k === at ? 'step' : null;
      button.classList.toggle('reached', reached);
    });
    this.steps[at].scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }
}
