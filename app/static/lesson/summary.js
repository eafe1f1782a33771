// At the end of a lesson: what was said, and what is so, side by side.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { handed } from './handed.js';
import { elementsOf } from './nodes.js';
import { asks, questionOf } from './questions.js';

/** @import { Lesson } from './lesson.js' */
/** @import { Part } from './questions.js' */

/**
 * @param {Lesson} lesson
 * @param {Part} part
 */
export function summaryOf(lesson, part) {
  const { steps } = lesson.record;
  const parts = steps.flatMap((step, k) =>
    step.parts.filter(asks).map((each) => {
      const question = questionOf(lesson, each);
      const name = k <= lesson.progress.far ? step.title : String(k + 1);
      const back = make('button', { type: 'button', textContent: name, onclick: () => lesson.enter(k) });
      const all = question.done || question.tried ? question.said() : [make('p', { textContent: text('lesson.open') })];
      const rows = all.flatMap((node, n) => [
        make('dt', { textContent: text(n ? 'lesson.was' : 'lesson.said') }),
        make('dd', {}, node),
      ]);
      return make('section', { className: 'lesson-sum' }, make('h3', {}, back), make('dl', {}, ...rows));
    }),
  );
  const end = make('p', { className: 'lesson-end' }, ...elementsOf(part.say));
  return make('div', {}, end, handed(lesson), ...parts); // which must not be missed below the fold
}
