// What a line that was drawn has of what happens: the exact curve has all of it, and each mistake is named.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { BIN, blank, joined, judged } from '../../app/static/lesson/judge.js';

const UNTIL = 2.6; // T
const FIRST = 36.7; // kN
const [APART, AGAIN, OVER] = [1.688, 2.0276, 2.1959]; // T
const RATE = 1.6; // 1/T: twice the mass ratio of 0.8

/** Of a rigid mass on a rod that is fixed at its far end, until it parts for good. */
function exact(t) {
  if (t < 1) return FIRST * Math.exp(-RATE * t);
  const s = t - 1;
  const pushed = FIRST * Math.exp(-RATE * t) + 2 * FIRST * (1 - RATE * s) * Math.exp(-RATE * s);
  if (t < APART) return Math.max(pushed, 0);
  return t >= AGAIN && t < OVER ? (53.7 * (OVER - t)) / (OVER - AGAIN) : 0;
}
const CRITERIA = [
  { criterion: 'falls', at: [0, 1], slack: 5, within: 0.1 },
  { criterion: 'jump', at: 1, within: 0.12, by: 25 },
  { criterion: 'zero-from', at: APART, within: 0.15 },
  { criterion: 'push', at: [AGAIN, OVER], within: 0.2, above: 8 },
  { criterion: 'zero-beyond', at: OVER, within: 0.12, slack: 4 },
];
const drawn = (value) => blank(UNTIL).map((_, k) => value(k * BIN));
const outcomes = (line, criteria = CRITERIA) => judged(line, criteria, [0, 120], exact).map(({ outcome }) => outcome);
/** Straight from point to point; the same time twice is a jump. */
const through = (...points) =>
  drawn((t) => {
    const k = points.findLastIndex(([from]) => from <= t + 1e-9);
    const [a, b] = [points[k], points[k + 1] ?? [UNTIL, points[k][1]]];
    return b[0] > a[0] ? a[1] + ((t - a[0]) / (b[0] - a[0])) * (b[1] - a[1]) : a[1];
  });
const UP = [
  [0, 37],
  [0.99, 8],
  [1, 80],
];
const DOWN = [
  [1.69, 0],
  [2.03, 0],
  [2.04, 50],
  [2.2, 0],
  [2.6, 0],
];

test('the exact curve has all of it', () => {
  assert.deepEqual(outcomes(drawn(exact)), ['yes', 'yes', 'yes', 'yes', 'yes']);
});

test('so has one that is drawn by hand, not quite as high, and with a hand that trembles', () => {
  const shaky = drawn((t) => Math.max(0.85 * exact(t * 1.02) + (exact(t) ? 1.5 * Math.sin(31 * t) : 0), 0));
  assert.deepEqual(outcomes(shaky), ['yes', 'yes', 'yes', 'yes', 'yes']);
  assert.deepEqual(outcomes(through(...UP, ...DOWN)), ['yes', 'yes', 'yes', 'yes', 'yes']);
});

test('a line with gaps is joined, and its ends go on', () => {
  const line = through(...UP, ...DOWN).map((value, k) => (k % 7 && k !== 99 && k !== 100 ? NaN : value));
  assert.deepEqual(outcomes(line).slice(0, 3), ['yes', 'yes', 'yes']);
  assert.deepEqual(joined([NaN, 2, NaN, 4, NaN]), [2, 2, 3, 4, 4]);
  assert.deepEqual(joined([NaN, NaN]), [0, 0]);
});

test('a force that rises or stays does not fall', () => {
  assert.equal(outcomes(through([0, 37], [1, 37], [1, 80], ...DOWN))[0], 'no');
  assert.equal(outcomes(through([0, 0], [0.5, 60], [0.99, 20], [1, 80], ...DOWN))[0], 'no');
  assert.equal(outcomes(through([0, 37], [0.91, 8], [0.93, 80], ...DOWN))[0], 'yes'); // its jump is a little early
});

test('a force that rises is told from one that falls', () => {
  const rises = [{ criterion: 'rises', at: [0, 1], slack: 5, within: 0.1 }];
  assert.deepEqual(outcomes(through([0, 0], [1, 60], [2.6, 0]), rises), ['yes']);
  assert.deepEqual(outcomes(through([0, 60], [1, 0], [2.6, 0]), rises), ['no']);
});

test('a jump is early, late, too small, or none', () => {
  const jump = (...points) => outcomes(through(...points))[1];
  assert.equal(jump([0, 37], [0.49, 20], [0.5, 80], ...DOWN), 'early');
  assert.equal(jump([0, 37], [1.39, 8], [1.4, 80], ...DOWN), 'late');
  assert.equal(jump([0, 37], [0.99, 8], [1, 22], ...DOWN), 'small');
  assert.equal(jump([0, 37], [1.69, 0], [2.6, 0]), 'none');
  assert.equal(jump([0, 37], [0.6, 5], [1.4, 80], [1.69, 0], [2.6, 0]), 'none'); // a slope
  assert.equal(jump([0, 37], [0.8, 10], [1.3, 60], [1.69, 0], [2.6, 0]), 'none');
});

test('a push behind a rest is no late jump, and a touch at the beginning no early one', () => {
  assert.equal(outcomes(through([0, 0], [0.05, 37], [1.69, 0], ...DOWN.slice(1)))[1], 'none');
  assert.equal(outcomes(through([0, 37], [0.97, 0], [1, 0], [1, 80], ...DOWN))[1], 'yes'); // no rest before it
});

test('they part early, late, or never', () => {
  const parts = (end, ...more) => outcomes(through(...UP, [end, 0], ...more, [2.6, 0]))[2];
  assert.equal(parts(1.3), 'early');
  assert.equal(parts(2.2), 'late');
  assert.equal(outcomes(through(...UP, [2.6, 30]))[2], 'none');
  const [, , late] = judged(through(...UP, [2.18, 0], [2.6, 0]), CRITERIA, [0, 120], exact);
  assert.ok(Math.abs(late.yours - 2.18) < 0.05);
  assert.deepEqual([late.right, late.ring[0], late.to], [APART, late.yours, [APART, 0]]); // as the picture says
});

test('a second push is one behind a rest, at its time and high enough', () => {
  const push = (...points) => outcomes(through(...UP, [1.69, 0], ...points, [2.6, 0]))[3];
  assert.equal(push(), 'none');
  assert.equal(push([1.95, 0], [2.05, 30], [2.2, 0]), 'yes');
  assert.equal(push([2.03, 0], [2.1, 6], [2.2, 0]), 'none');
  assert.equal(push([2.42, 0], [2.45, 30], [2.55, 0]), 'none');
  assert.equal(outcomes(through(...UP, [2.3, 10], [2.6, 0]))[3], 'none');
});

test('beyond the last contact there is nothing', () => {
  assert.equal(outcomes(through(...UP, ...DOWN.slice(0, 3), [2.2, 20], [2.6, 20]))[4], 'no');
  assert.equal(outcomes(through(...UP, ...DOWN.slice(0, 3), [2.2, 3], [2.6, 3]))[4], 'yes');
});

test('nothing that is drawn breaks it', () => {
  for (const line of [blank(UNTIL), drawn(() => 0), drawn(() => 120), drawn((t) => (t < 1 ? -5 : NaN))])
    assert.equal(outcomes(line).length, CRITERIA.length);
});
