// Histories of a stretch of time take the place of what the whole says there.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { withFiner } from '../../app/static/charts/scale.js';
import { refined } from '../../app/static/wire/closer.js';

const numbers = (table) => Object.fromEntries(Object.entries(table).map(([key, row]) => [key, Float64Array.from(row)]));
const read = (table) => Object.fromEntries(Object.entries(table).map(([key, row]) => [key, [...row]]));

test('rows of a stretch are replaced, whatever their width, and no others', () => {
  const whole = numbers({ reactionTime: [0, 1, 2, 3], reactions: [0, 0, 1, 10, 2, 20, 3, 30], duration: [3] });
  const part = numbers({ reactionTime: [1, 1.5, 2], reactions: [5, 6, 7, 8, 9, 10] });
  assert.deepEqual(read(refined(whole, part, [1, 2])), {
    reactionTime: [0, 1, 1.5, 2, 3],
    reactions: [0, 0, 5, 6, 7, 8, 9, 10, 3, 30],
  });
});

test('samples come between those about a stretch that has none, and after the last', () => {
  const whole = numbers({ time: [0, 1], impactorPath: [0, 10], bendTime: [0, 1], amountsOf2: [0, 1] });
  const part = numbers({ time: [0.25, 0.5], impactorPath: [4, 5], bendTime: [2], amountsOf2: [7] });
  const found = read(refined(whole, part, [0.25, 0.5]));
  assert.deepEqual(
    [found.time, found.impactorPath],
    [
      [0, 0.25, 0.5, 1],
      [0, 4, 5, 10],
    ],
  );
  const after = read(refined(whole, part, [2, 3]));
  assert.deepEqual(
    [after.bendTime, after.amountsOf2],
    [
      [0, 1, 2],
      [0, 1, 7],
    ],
  );
});

test('what only a stretch says is taken as it is', () => {
  const part = numbers({ mainTime: [1, 2], mainForce: [3, 4] });
  assert.deepEqual(read(refined({}, part, [1, 2])), { mainTime: [1, 2], mainForce: [3, 4] });
});

test('a history is finer between the first and the last of finer samples', () => {
  const found = withFiner({ x: [0, 1, 2, 3], y: [0, 1, 2, 3] }, { x: [1, 1.5, 2], y: [5, 6, 7] });
  assert.deepEqual(found, { x: [0, 1, 1.5, 2, 3], y: [0, 5, 6, 7, 3] });
});
