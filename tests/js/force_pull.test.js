// The peak of the force that is pulled: which force a place is, and what keys make of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { forceAt, stepped } from '../../app/static/whatif/force_pull.js';

const SCALE = { box: { base: 100, track: 80 }, most: 24e3 };

test('a place is the force that the scale has there, and never nought', () => {
  assert.equal(forceAt(SCALE, 40), 18e3);
  assert.equal(forceAt(SCALE, 100 - 80 / 7), 3430); // three digits
  assert.equal(forceAt(SCALE, -20), 36e3); // beyond the end of the scale
  assert.equal(forceAt(SCALE, 100), 300);
  assert.equal(forceAt(SCALE, 500), 300);
});

test('arrows are one percent, pages ten, more to the left as the scale is', () => {
  const made = (...keys) => keys.map((key) => stepped(2e4, key));
  assert.deepEqual(made('ArrowLeft', 'ArrowUp', 'PageUp'), [20200, 20200, 22000]);
  assert.deepEqual(made('ArrowRight', 'ArrowDown', 'PageDown'), [19800, 19800, 18000]);
  assert.equal(stepped(12345, 'ArrowUp'), 12470);
  assert.equal(stepped(2e4, 'Enter'), null);
});
