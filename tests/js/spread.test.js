// What many impacts say, against functions whose quantiles and shares are known.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { binsOf, haltonAt, mattersOf, quantilesOf, shareAbove } from '../../app/static/whatif/spread.js';

const near = (found, expected, error) =>
  assert.ok(Math.abs(found - expected) <= error, `${found} is not ${expected} within ${error}`);

/** Points of Halton's, −1 to 1. */
const points = (count, inputs) =>
  Array.from({ length: count }, (_, n) => haltonAt(n, inputs).map((share) => 2 * share - 1));

/** @param {number[][]} units  Shares and effects of a function of them. */
function matters(units, of) {
  const values = units.map(of);
  return units[0].map((_, k) => mattersOf(values, (n) => units[n][k]));
}

test('quantiles of what is even, and between two values', () => {
  const sorted = Float64Array.from(points(4000, 1), ([unit]) => unit).sort();
  quantilesOf(sorted, [0.05, 0.5, 0.95]).forEach((found, k) => near(found, [-0.9, 0, 0.9][k], 2e-3));
  assert.deepEqual(quantilesOf([0, 1, 2, 4], [0, 0.5, 5 / 6, 1]), [0, 1.5, 3, 4]); // as NumPy has them
  assert.deepEqual(quantilesOf([7], [0.05, 0.95]), [7, 7]);
});

test('the share above a value counts what is larger, and not what is as large', () => {
  assert.equal(shareAbove([1, 2, 2, 3], 2), 0.25);
  assert.equal(shareAbove([1, 2, 2, 3], 0), 1);
  assert.equal(shareAbove([1, 2, 2, 3], 3), 0);
});

test('points of eight inputs are even, each alone and any two together', () => {
  const all = points(4000, 8);
  for (let k = 0; k < 8; k++) {
    near(all.reduce((sum, each) => sum + each[k], 0) / 4000, 0, 0.01);
    near(all.reduce((sum, each) => sum + each[k] ** 2, 0) / 4000, 1 / 3, 0.01);
    for (let n = 0; n < k; n++) near(all.reduce((sum, each) => sum + each[k] * each[n], 0) / 4000, 0, 0.01);
  }
});

test('shares of a sum are those of the squares of what each input does', () => {
  const found = matters(points(4000, 3), ([a, b, c]) => 5 + 3 * a - 2 * b + c);
  [9 / 14, 4 / 14, 1 / 14].forEach((share, k) => near(found[k].share, share, 0.01));
  [3, -2, 1].forEach((effect, k) => near(found[k].effect, effect, 0.02));
});

test('what acts only together with another input has no share alone, and a curved one has', () => {
  const found = matters(points(4000, 3), ([a, b, c]) => a * b + c * c);
  const [both, alone] = [1 / 9, 4 / 45]; // variances
  near(found[0].share, 0, 0.01);
  near(found[1].share, 0, 0.01);
  near(found[2].share, alone / (both + alone), 0.015);
  near(found[2].effect, 0, 0.02);
});

test('an input that does little has its share, in small samples too', () => {
  for (const [count, off] of [
    [200, 0.02],
    [1000, 0.006],
    [4000, 0.004],
  ]) {
    const found = matters(points(count, 4), ([a, b, c]) => 2.29 * a + 1.37 * b - 0.503 * c);
    const whole = 2.29 ** 2 + 1.37 ** 2 + 0.503 ** 2;
    near(found[2].share, 0.503 ** 2 / whole, off);
    near(found[3].share, 0, off);
  }
});

test('what never varies has no shares', () => {
  assert.deepEqual(
    matters(points(200, 2), () => 3),
    [
      { share: 0, effect: 0 },
      { share: 0, effect: 0 },
    ],
  );
});

test('bins count each kind, what is at the upper end too', () => {
  const bins = binsOf([0, 0.4, 0.6, 1], [1, 2, 2, 1], [0, 1], 2).map((bin) => Object.fromEntries(bin));
  assert.deepEqual(bins, [
    { 1: 1, 2: 1 },
    { 1: 1, 2: 1 },
  ]);
});
