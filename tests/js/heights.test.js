// Rods that lead leave room for what is said above and below them, however low the picture is.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { middleOf, thickOf } from '../../app/static/axial/heights.js';

const [ABOVE, BELOW] = [24, 42]; // pixels of words

test('no word lies on a rod, where the picture is as low as beside a map', () => {
  for (let height = 82; height < 400; height += 3) {
    const thick = thickOf(height, true, true);
    const middle = middleOf(height, thick, true, true, false);
    assert.ok(middle - thick / 2 >= ABOVE - 1e-9, `above at ${height}`);
    assert.ok(middle + thick / 2 <= height - BELOW + 1e-9, `below at ${height}`);
    assert.ok(thick >= 14);
  }
});

test('in a high picture rods are as thick as they were, and near its middle', () => {
  assert.equal(thickOf(200, true, true), 84);
  assert.equal(middleOf(200, 84, true, true, false), 94);
  assert.equal(thickOf(1000, true, true), 132);
});

test('bodies without rods and pendulums have nothing below them', () => {
  assert.equal(middleOf(100, 30, true, false, false), 47);
  assert.equal(middleOf(100, 30, true, true, true), 68);
});
