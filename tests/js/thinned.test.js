// Lines of thousands of samples: of each pixel the first, the last and the extremes are drawn.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { thinned } from '../../app/static/charts/thinned.js';

/**
 * @param {number[]} x
 * @param {number[]} y
 */
function drawn(x, y) {
  /** @type {[number, number][]} */
  const found = [];
  thinned({ x, y }, [0, x.length], [0, 1], [0, 1], (along, off) => found.push([along, off]));
  return found;
}

test('what swings within a pixel keeps its extremes, by four points at most', () => {
  const x = Array.from({ length: 5000 }, (_, k) => k / 1000);
  const y = x.map((each) => 100 * Math.sin(40 * each) + each);
  const found = drawn(x, y);
  for (let pixel = 0; pixel < 5; pixel++) {
    const here = found.filter(([along]) => Math.floor(along) === pixel).map(([, off]) => off);
    const all = y.filter((_, k) => Math.floor(x[k]) === pixel);
    assert.ok(here.length <= 4);
    assert.equal(Math.min(...here), Math.min(...all));
    assert.equal(Math.max(...here), Math.max(...all));
  }
});

test('few samples are all drawn as they are, and a jump stays upright', () => {
  const line = /** @type {[number, number][]} */ ([
    [0, 1],
    [3.2, 5],
    [3.2, 9],
    [7, 2],
  ]);
  assert.deepEqual(
    drawn(
      line.map(([x]) => x),
      line.map(([, y]) => y),
    ),
    line,
  );
});

test('what rises goes from its first sample in a pixel to its last one', () => {
  const found = drawn([0, 0.2, 0.4, 0.6, 1.1], [0, 1, 2, 3, 4]);
  assert.deepEqual(found, [
    [0, 0],
    [0.6, 3],
    [1.1, 4],
  ]);
});

test('of nothing nothing is drawn', () => assert.deepEqual(drawn([], []), []));
