// Spectra on the page: curves, natural frequencies as upright lines, and how much of the axis is in view.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { contentOf, heldUpTo } from '../../app/static/charts/spectrum.js';

test('natural frequencies are upright lines that widen no range, in the unit of the axis', () => {
  const lines = [{ name: 'waves', modes: null, values: [3, 2, 1] }];
  const found = contentOf({ frequency: [0, 1e4, 2e4], lines, natural: [5e3], unit: 'm' });
  assert.deepEqual([found.unit, found.xUnit], ['m', 'kHz']);
  const [curve, line] = found.series;
  assert.deepEqual([curve.x, curve.y, curve.style], [[0, 10, 20], [3, 2, 1], 'exact']);
  assert.deepEqual([line.x, line.reach, line.path], [[5, 5], 0, true]);
  assert.ok(line.y[0] === 0 && line.y[1] > 3);
  assert.equal(contentOf({ frequency: [0, 10], lines, natural: [], unit: 'm' }).xUnit, 'Hz');
});

test('as much of the axis is in view as holds much', () => {
  const x = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];
  assert.equal(heldUpTo(x, [5, 4, 1, 2, 2, 2, 0.1, 0, 0, 0]), 6);
  assert.equal(heldUpTo(x, [5, 4, 1, 2, 1, 1, 1, 1, 1, 1]), 9);
  assert.equal(heldUpTo(x, [0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), 9);
});
