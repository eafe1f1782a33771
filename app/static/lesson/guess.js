// The line that was drawn, beside the rod: where it was laid there, and in the end.
import { asks, questionOf } from './questions.js';
import { Sketch } from './sketch.js';

/** @import { Lesson } from './lesson.js' */

/** @param {Lesson} lesson */
export function guessOf(lesson) {
  const { question, record, step } = lesson;
  const last = step.parts.some(({ kind }) => kind === 'summary');
  const parts = last ? record.steps.flatMap((each) => each.parts).filter(asks) : [];
  const questions = last ? parts.map((part) => questionOf(lesson, part)) : [question];
  const sketch = questions.find((each) => each instanceof Sketch);
  return sketch && (sketch.laid || (last && sketch.done)) ? sketch.series : null;
}
