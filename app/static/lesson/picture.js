// What a step adds to the picture of its scene: arrows of force, and the line that was drawn; and what it still hides.
import { asks, questionOf } from './questions.js';
import { Sketch } from './sketch.js';

/** @import { Frame } from '../messages.js' */
/** @import { Lesson } from './lesson.js' */
/** @import { Part } from './questions.js' */

const OVER = 0.01; // of the peak, below which a force is over
const SHORT = 0.6; // of all that is solved: rows that end later show all of it
const ROOM = 1.25; // times as long as what is looked at

/**
 * The line that was drawn, beside the rod: where it was laid there, and in the end.
 * @param {Lesson} lesson
 */
function guessOf(lesson) {
  const { question, record, step } = lesson;
  const last = step.parts.some(({ kind }) => kind === 'summary');
  const parts = last ? record.steps.flatMap((each) => each.parts).filter(asks) : [];
  const questions = last ? parts.map((part) => questionOf(lesson, part)) : [question];
  const sketch = questions.find((each) => each instanceof Sketch && each.rolls);
  return sketch instanceof Sketch && (sketch.laid || (last && sketch.done)) ? sketch.series : null;
}

/**
 * The part that says what is shown by now; nothing where none does.
 * @param {Lesson} lesson
 * @returns {Partial<Part>}
 */
export function showingAt({ at, record }) {
  const parts = record.steps.slice(0, at + 1).flatMap((step) => step.parts);
  return parts.findLast(({ kind, show }) => kind === 'scene' && show) ?? {};
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

/**
 * Where the rows of a step end [T], if long before all that is solved: the force is over, and nothing is played later.
 * @param {Lesson} lesson
 * @param {Frame} frame
 * @param {string[]} shown  names of what is seen by now
 */
export function rowsUntil({ question, step }, frame, shown) {
  if (!('exact' in frame) || !shown.includes('rows') || question?.choices) return null;
  const { duration, exactForce: force, exactTime: time } = frame;
  const least = OVER * force.reduce((most, value) => Math.max(most, value), 0);
  const end = ROOM * (time[force.findLastIndex((value) => value > least)] ?? 0);
  const played = step.parts.flatMap(({ at, play }) => [at, ...(play ?? [])]).filter((t) => typeof t === 'number');
  const until = Math.max(end, ...played);
  return until > 0 && until < SHORT * duration ? until : null;
}
