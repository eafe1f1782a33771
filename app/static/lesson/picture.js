// What a step adds to the picture of its scene: arrows of force, and the line that was drawn; and what it still hides.
import { asks, questionOf } from './questions.js';
import { Sketch } from './sketch.js';

/** @import { Lesson } from './lesson.js' */

/**
 * The line that was drawn, beside the rod: where it was laid there, and in the end.
 * @param {Lesson} lesson
 */
function guessOf(lesson) {
  const { question, record, step } = lesson;
  const last = step.parts.some(({ kind }) => kind === 'summary');
  const parts = last ? record.steps.flatMap((each) => each.parts).filter(asks) : [];
  const questions = last ? parts.map((part) => questionOf(lesson, part)) : [question];
  const sketch = questions.find((each) => each instanceof Sketch);
  return sketch && (sketch.laid || (last && sketch.done)) ? sketch.series : null;
}

/**
 * @param {Lesson} lesson
 * @param {string[]} shown  names of what is seen by now
 * @param {boolean} closed  whether what happens is still to be said
 */
export function dress(lesson, shown, closed) {
  const { opening, views } = lesson.page;
  Object.assign(views.axial.stage, { pushes: shown.includes('forces') && !closed });
  Object.assign(views.fall.stage, { hides: closed });
  opening.section.guess = guessOf(lesson);
}
