import assert from 'node:assert/strict';
import { test } from 'node:test';

import { leanOf, longestSide, LOOKS, turnedBy } from '../../app/static/space/hands.js';
import { cross, dot } from '../../app/static/space/vectors.js';

const near = (found, expected) =>
  expected.forEach((value, k) => assert.ok(Math.abs(found[k] - value) < 1e-12, `${found} is not ${expected}`));

test('the picture is turned, and its directions stay at right angles', () => {
  const [x, y, z] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (const [about, above] of [LOOKS.side, LOOKS.oblique, LOOKS.end, [-2, 1.4]]) {
    const [across, up] = turnedBy(x, y, [about, above]);
    near([dot(across, across), dot(up, up), dot(across, up)], [1, 1, 0]);
    near(cross(across, up), [Math.sin(about) * Math.cos(above), Math.sin(above), Math.cos(about) * Math.cos(above)]);
  }
  near(turnedBy(x, y, LOOKS.side)[0], x);
  near(turnedBy(x, y, LOOKS.end)[0], [0, 0, -1]);
  near(cross(...turnedBy(x, y, LOOKS.end)), x);
  near(
    turnedBy(x, y, [0, Math.PI / 2])[1],
    z.map((v) => -v),
  );
});

test('how far a normal leans, and where to', () => {
  const frame = [
    [0, 0, -1],
    [1, 0, 0],
    [0, -1, 0],
  ];
  near(leanOf([0, 0, -3], frame), [0, 0]);
  near(leanOf([0.01, 0, -1], frame), [0, 0]); // a hand that lets it snap back
  near(leanOf([1, 0, -1], frame), [45, 0]);
  near(leanOf([0, -2, 0], frame), [90, 90]);
  near(leanOf([-1, 0, -Math.sqrt(3)], frame).map(Math.abs), [30, 180]);
});

test('the longest side points along a positive axis; balls and points have none', () => {
  const box = {
    shape: 'box',
    sides: [1, 3, 2],
    axes: [
      [1, 0, 0],
      [0, -0.8, 0.6],
      [0, 0.6, 0.8],
    ],
  };
  const [axis, length] = longestSide({ impactor: { shape: 'point' }, target: box });
  near([...axis, length], [0, 0.8, -0.6, 3]);
  assert.equal(longestSide({ impactor: box, target: { shape: 'stop' } })[1], 3);
  assert.equal(longestSide({ impactor: box, target: { shape: 'ball', radius: 1 } }), null);
});
