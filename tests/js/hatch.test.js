import assert from 'node:assert/strict';
import { test } from 'node:test';

import { isHatched, stretchesOf } from '../../app/static/charts/hatch.js';

test('tension is hatched, compression and almost nothing are not', () => {
  assert.deepEqual(
    [-1, -0.05, -0.03, 0, 1].map((value) => isHatched(value, 1)),
    [true, true, false, false, false],
  );
});

test('neighbours that are hatched are one stretch', () => {
  const chosen = [true, true, false, true, false, false, true];
  const found = stretchesOf(
    chosen.length,
    (k) => chosen[k],
    (k) => 10 * k,
  );
  assert.deepEqual(found, [
    [0, 20],
    [30, 40],
    [60, 70],
  ]);
  assert.deepEqual(
    stretchesOf(
      0,
      () => true,
      (k) => k,
    ),
    [],
  );
});
