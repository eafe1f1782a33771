// Ticks, ranges and values between samples.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  averaged,
  between,
  boxOf,
  decades,
  even,
  extremes,
  indexAt,
  logPlace,
  rangeOf,
  roundBelow,
  stairs,
  ticks,
} from '../../app/static/charts/scale.js';

const near = (found, expected, error = 1e-12) =>
  assert.ok(Math.abs(found - expected) <= error, `${found} is not ${expected}`);

test('a box holds all places', () => {
  assert.deepEqual(boxOf([1, 5, -2, 7, 0, 6]), [-2, 1, 5, 7]);
});

test('ticks are round, within the range, and as many as fit', () => {
  assert.deepEqual(ticks(0, 1, 5), { found: [0, 0.2, 0.4, 0.6000000000000001, 0.8, 1], digits: 1 });
  assert.deepEqual(ticks(-250, 90, 3).found, [-200, 0]);
  assert.deepEqual(ticks(-0.2, 4.8, 2).found, [0, 2, 4]); // never one alone
  assert.deepEqual(ticks(0.3, 3.2, 3), { found: [1, 2, 3], digits: 0 });
  assert.deepEqual(ticks(2e-6, 9e-6, 3).digits, 6);
  for (const [low, high] of [
    [0, 1],
    [-3, 7],
    [1e-9, 3e-9],
    [123456, 123460],
  ])
    for (const about of [1, 3, 8, 20]) {
      const { found, digits } = ticks(low, high, about);
      assert.ok(found.length <= about + 1, `${found.length} ticks, ${about} wanted`);
      assert.ok(found.every((value) => value >= low - 1e-12 && value <= high * (1 + 1e-12)));
      const written = found.map((value) => value.toFixed(digits));
      assert.equal(new Set(written).size, found.length, `${written} cannot be told apart`);
    }
});

test('powers of ten along a logarithmic axis', () => {
  assert.deepEqual(decades([0.001, 1000], 10), [-3, -2, -1, 0, 1, 2, 3]);
  assert.deepEqual(decades([0.001, 1000], 4), [-3, -1, 1, 3]);
  assert.deepEqual(decades([0.02, 0.05], 5), []);
  near(logPlace(10, [1, 100]), 0.5);
  near(logPlace(1, [1, 100]), 0);
  near(logPlace(1000, [1, 100]), 1.5);
});

test('a round factor is the largest of 1, 2 and 5 that is no larger', () => {
  for (const [value, expected] of [
    [1, 1],
    [1.99, 1],
    [2, 2],
    [4.9, 2],
    [73, 50],
    [0.0051, 0.005],
  ])
    near(roundBelow(value), expected, 1e-12 * expected);
});

test('a history is straight between samples, jumps where an instant stands twice, and stays at its ends', () => {
  const x = [0, 1, 1, 3];
  const y = [0, 2, 5, 9];
  near(between(x, y, 0.5), 1);
  near(between(x, y, 1), 5);
  near(between(x, y, 1 - 1e-9), 2, 1e-8);
  near(between(x, y, 2), 7);
  assert.equal(between(x, y, -4), 0);
  assert.equal(between(x, y, 99), 9);
  assert.equal(between([2], [7], 5), 7);
  assert.ok(Number.isNaN(between([], [], 5)));
  assert.deepEqual(
    [-1, 0, 0.5, 1, 2.9, 3].map((t) => indexAt(x, t)),
    [0, 0, 0, 2, 2, 3],
  );
});

test('even instants reach from nought to the end', () => {
  assert.deepEqual([...even(5, 2)], [0, 0.5, 1, 1.5, 2]);
});

test('stairs hold each value for a step', () => {
  const { x, y } = stairs([3, 5], 0.5);
  assert.deepEqual([...x], [0, 0.5, 0.5, 1]);
  assert.deepEqual([...y], [3, 3, 5, 5]);
});

test('averages keep the impulse, and are exact for a constant', () => {
  const step = 0.1;
  const force = Array.from({ length: 50 }, (_, k) => (k < 10 || k >= 40 ? 0 : k % 2));
  const { x, y } = averaged(force, step, 0.6);
  assert.equal(x.length, 51);
  near(
    y.reduce((sum, value) => sum + value * step, 0),
    force.reduce((sum, value) => sum + value * step, 0),
    1e-12,
  );
  near(averaged(Array(50).fill(4), step, 0.6).y[25], 4);
});

test('extremes count the samples in view and the values at its edges', () => {
  const samples = { x: [0, 1, 2, 3], y: [0, 10, -5, 1] };
  assert.deepEqual(extremes(samples, [0, 3]), [-5, 10]);
  assert.deepEqual(extremes(samples, [0.25, 0.5]), [2.5, 5]);
  assert.equal(extremes(samples, [4, 5]), null);
  assert.deepEqual(extremes({ x: [2, 0, 1], y: [7, 8, 9], path: true }, [0.5, 3]), [7, 9]);
  assert.equal(extremes({ x: [], y: [] }, [0, 1]), null);
});

test('a chart shows its leading series whole, and others as far as they may reach', () => {
  const view = [0, 1];
  const lead = { x: [0, 1], y: [0, 10] };
  const wild = { x: [0, 1], y: [0, 400] };
  const plain = { zoomed: false, zero: true, pad: [0, 0] };
  assert.deepEqual(rangeOf([lead], view, plain), [0, 10]);
  assert.deepEqual(rangeOf([{ ...lead, factor: -2 }], view, plain), [-20, 0]);
  assert.deepEqual(rangeOf([lead, { ...wild, reach: 2.5 }], view, plain), [0, 25]);
  assert.deepEqual(rangeOf([{ ...wild, reach: 2.5 }, lead], view, plain), [0, 25]); // in whatever order they are given
  assert.deepEqual(rangeOf([lead, { ...wild, reach: 0 }], view, plain), [0, 10]);
  assert.deepEqual(rangeOf([lead, { ...wild, reach: 'whole' }], view, plain), [0, 400]);
  assert.deepEqual(rangeOf([lead, { ...wild, reach: 'whole' }], view, { ...plain, zoomed: true }), [0, 10]);
  assert.deepEqual(rangeOf([{ ...lead, factor: 1e3 }], view, plain), [0, 1e4]);
});

test('room is left about the range, and nothing at all has one too', () => {
  const lead = { x: [0, 1], y: [4, 6] };
  assert.deepEqual(rangeOf([lead], [0, 1], { zoomed: false, pad: [0.5, 1] }), [3, 8]);
  assert.deepEqual(rangeOf([lead], [0, 1], { zoomed: false, zero: 'whole', pad: [0, 0] }), [0, 6]);
  assert.deepEqual(rangeOf([lead], [0, 1], { zoomed: true, zero: 'whole', pad: [0, 0] }), [4, 6]);
  const flat = { x: [0, 1], y: [0, 0] };
  assert.deepEqual(rangeOf([flat], [0, 1], { zoomed: false, zero: true, pad: [0, 0] }), [0, 1]);
  assert.deepEqual(rangeOf([flat], [0, 1], { zoomed: false, pad: [0, 0] }), [-1, 1]);
  assert.deepEqual(rangeOf([], [0, 1], { zoomed: false, pad: [0, 0] }), [-1, 1]);
});
