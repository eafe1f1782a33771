// Lessons in the gallery: how far the visitor has come.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { reached } from '../../app/static/courses/courses.js';

const OF = JSON.stringify([
  ['choice', 'next', 3],
  ['sketch', 'force', 5],
]);

test('a lesson is done when its last step is reached and all of it answered', () => {
  const progress = (far, ...done) => ({ of: OF, far, answers: { next: { done: done[0] }, force: { done: done[1] } } });
  assert.deepEqual(reached(progress(0), 6), { answered: false, far: 0, done: false });
  assert.deepEqual(reached(progress(2, true), 6), { answered: true, far: 2, done: false });
  assert.deepEqual(reached(progress(5, true), 6), { answered: true, far: 5, done: false });
  assert.deepEqual(reached(progress(5, true, true), 6), { answered: true, far: 5, done: true });
  assert.deepEqual(reached(progress(9, true, true), 6), { answered: true, far: 5, done: true }); // it was longer once
});

test('what was kept and cannot be read counts as nothing', () => {
  const nothing = { answered: false, far: -1, done: false };
  for (const kept of [null, {}, { of: 'x' }, { of: '3', far: 1 }, { of: OF, far: 2 }])
    assert.deepEqual(reached(kept, 6), nothing);
});
