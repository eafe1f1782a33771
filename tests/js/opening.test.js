// The opening: what its rows and its question are made of.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WaveField } from '../../app/static/axial/fields.js';
import { palette, shade } from '../../app/static/charts/styles.js';
import { pushesOf } from '../../app/static/axial/story.js';
import { weave } from '../../app/static/opening/rows.js';

const ROD = { from: 0, to: 2, transit: 0.5, impedance: 1, drift: 0, area: 1, joint: null, mirror: 1 };
const STILL = { motionTime: [0, 2], exactMass: [0, 0], exactEnd: [0, 0], otherMass: [0, 0], otherEnd: [0, 0] };
const step = () =>
  new WaveField({ duration: 2, rods: [ROD], f0Time: [0, 2], f0: [1, 1], exactForce: [1], ...STILL }, 'exact');

/** A canvas that keeps what is put into it. */
const sheet = () => {
  const canvas = { width: 0, height: 0, picture: null };
  const context = {
    createImageData: (width, height) => ({ width, height, data: new Uint8ClampedArray(4 * width * height) }),
    putImageData: (picture) => (canvas.picture = picture),
  };
  return Object.assign(canvas, { getContext: () => context });
};

test('a push is counted at first touch, whenever the front is back, and whenever they meet again', () => {
  const pushes = (contacts, rigid = true) => pushesOf({ exact: { contacts }, rigid });
  assert.equal(pushes([[0, 1.534], [2.125, 2.163]]), 3); // prettier-ignore
  assert.equal(pushes([[0, 1]]), 1);
  assert.equal(pushes([[0, 4.2]]), 5);
  assert.equal(pushes([[0, 4.2]], false), 1);
});

test('a row averages what passes in its time', () => {
  const field = step();
  const mean = field.mean(0.25, 0.1, 'stress', new Float64Array(5));
  // the front is at 0.25 of a transit of 0.5, half way: there it has passed for half of the row's time
  for (const [k, value] of [1, 1, 0.5, 0, 0].entries()) assert.ok(Math.abs(mean[k] - value) < 2e-3, `${k}: ${mean[k]}`);
});

test('rows are woven between the moved ends of the body, and clear beside it', () => {
  const canvas = sheet();
  const shown = {
    drawn: { left: 10, right: 90, rest: 10 },
    duration: 2,
    field: step(),
    largest: 2,
    scale: 0,
    what: 'stress',
  };
  const ends = weave(canvas, shown, [0, 2], 100, 40);
  const color = (x, y) => [...canvas.picture.data.slice(4 * (100 * y + x), 4 * (100 * y + x) + 4)];
  const solid = (value) => [...palette.slice(shade(value, 2), shade(value, 2) + 3), 255];
  assert.deepEqual([canvas.width, canvas.height, ends.length], [100, 40, 40]);
  assert.deepEqual(color(5, 4), [0, 0, 0, 0]);
  assert.deepEqual(color(95, 4), [0, 0, 0, 0]);
  assert.deepEqual(color(12, 4), solid(1)); // at 0.225 of 2 the front has gone less than half way
  assert.deepEqual(color(80, 4), solid(0));
  assert.deepEqual(color(85, 12), solid(2)); // doubled at the wall, from where it comes back
  assert.ok(Math.abs(ends[5] - 1) < 1e-9);
});

test('rows end where the solution does', () => {
  const canvas = sheet();
  const shown = {
    drawn: { left: 0, right: 10, rest: 0 },
    duration: 1,
    field: step(),
    largest: 2,
    scale: 0,
    what: 'stress',
  };
  weave(canvas, shown, [0, 2], 10, 20);
  assert.equal(canvas.picture.data[4 * (10 * 9 + 5) + 3], 255);
  assert.equal(canvas.picture.data[4 * (10 * 11 + 5) + 3], 0);
});

test('rows of what is bent across are at the places that it knows, and tell of the struck one', () => {
  const mean = (t, span, what, out) => out.map((_, k) => (out[k] = k - 1 + t));
  const field = { coarse: false, places: 5, mean, profile: () => assert.fail('nothing of it is displaced') };
  const canvas = sheet();
  const shown = { drawn: { left: 10, right: 90, rest: 50 }, duration: 1, field, largest: 4, scale: 0, what: 'moment' };
  const ends = weave(canvas, shown, [0, 1], 100, 10);
  assert.equal(ends.length, 10);
  for (const [row, value] of ends.entries()) assert.ok(Math.abs(value - 1 - (row + 0.5) / 10) < 1e-12);
  assert.deepEqual(
    [9, 10, 89, 90].map((x) => canvas.picture.data[4 * x + 3]),
    [0, 255, 255, 0],
  );
});
