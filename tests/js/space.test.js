import assert from 'node:assert/strict';
import { test } from 'node:test';

import { arrow, label, unlabelled } from '../../app/static/space/arrows.js';
import { leanOf, longestSide, LOOKS, turnedBy } from '../../app/static/space/hands.js';
import { coneOf, coneSeen, givenAt, movingAt } from '../../app/static/space/impulse.js';
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

/** A ball that strikes a floor, seen from the side; it slides up to half of the normal impulse, and then sticks. */
const RUBS = {
  ...{ friction: 0.5, normal: [0, -1, 0], push: [1, -4, 0], impulse: Math.hypot(1, 4) },
  slidePress: Float64Array.of(0, 2, 4),
  slideImpulse: Float64Array.of(0, 0, 0, 1, -2, 0, 1, -4, 0),
  bodies: { impactor: { shape: 'ball' }, target: { shape: 'stop' } },
};
const seenFrom = (frame, across, up) => ({
  ...{ frame, long: 100, up, toward: cross(across, up) },
  flat: (v) => [dot(v, across), dot(v, up)],
});

test('the impulse grows along the cone of friction while it slides, and inside it while it sticks', () => {
  const slope = (share) => -givenAt(RUBS, share)[0] / givenAt(RUBS, share)[1];
  for (const share of [0.1, 0.3, 0.5]) near([slope(share)], [RUBS.friction]);
  near(givenAt(RUBS, 0.75), [1, -3, 0]);
  near(givenAt(RUBS, 1), RUBS.push);
  near(givenAt({ push: [0, 0, 2] }, 0.25), [0, 0, 0.5]); // without friction in proportion
  near([coneOf({ friction: 1 })], [45]);
});

test('bodies go and turn by what of the impulse they have been given', () => {
  const ball = { before: { velocity: [2, 1, 0], spin: [0, 0, 4] }, after: { velocity: [0, 9, 0], spin: [0, 0, 0] } };
  const bodies = { ...RUBS.bodies, impactor: { shape: 'ball', mass: 0.5, ...ball } };
  const slideSpins = Float64Array.from([4, 1, 0].flatMap((spin) => [0, 0, spin, 0, 0, 0]));
  const at = (share, more = { slideSpins }) => movingAt({ ...RUBS, bodies, ...more }, 'impactor', share);
  assert.deepEqual([at(0), at(1)], [ball.before, ball.after]);
  near([...at(0.25).velocity, ...at(0.25).spin], [1, 3, 0, 0, 0, 2.5]); // half of what it has been given at 0.5
  near(at(0.75, { slidePress: undefined }).spin, [0, 0, 1]); // without friction in proportion
});

test('a cone is a triangle from the side, a circle from its end, and nothing without friction', () => {
  const side = coneSeen(seenFrom(RUBS, [1, 0, 0], [0, 1, 0]));
  const [tip, first] = side.outline;
  const last = side.outline.at(-1);
  near(tip, [0, 0]);
  assert.ok(first[1] > 80); // it opens towards the ball, which is above
  near([Math.abs(first[0]) / first[1], last[0] + first[0], last[1] - first[1]], [0.5, 0, 0]);
  const end = coneSeen(seenFrom(RUBS, [1, 0, 0], [0, 0, 1]));
  assert.equal(end.outline, end.end);
  for (const [x, y] of end.end) near([Math.hypot(x, y)], [Math.abs(first[0])]);
  const aslant = coneSeen(seenFrom(RUBS, [1, 0, 0], [0, 0.8, 0.6]));
  const widest = Math.max(...aslant.outline.slice(1).map(([x, y]) => Math.abs(x / y)));
  for (const [x, y] of aslant.end) assert.ok(Math.abs(x) <= widest * Math.abs(y) + 1e-9); // its sides enclose it
  assert.equal(coneSeen(seenFrom({ ...RUBS, friction: 0 }, [1, 0, 0], [0, 1, 0])), null);
});

test('words stay within the sides of the picture', () => {
  const seen = [];
  const c = {
    measureText: () => ({
      actualBoundingBoxLeft: c.textAlign === 'right' ? 150 : 0,
      actualBoundingBoxRight: c.textAlign === 'left' ? 150 : 0,
    }),
    strokeText: () => {},
    fillText: (_, x) => seen.push(x),
    save: () => {},
    restore: () => {},
  };
  unlabelled(c, [], [], 200);
  label(c, 'cone of friction', [100, 30], [-1, 0]); // written to the left, from its right end
  label(c, 'cone of friction', [100, 90], [1, 0]);
  assert.deepEqual(seen, [156, 44]); // and off the edge
});

test('an arrow has a pale edge, by which it is seen on a dark body', () => {
  const drawn = [];
  const idle = ['beginPath', 'moveTo', 'lineTo', 'closePath', 'fill'].map((name) => [name, () => {}]);
  const c = { ...Object.fromEntries(idle), strokeStyle: '#33475b' };
  arrow(
    {
      ...c,
      stroke() {
        drawn.push([this.strokeStyle, this.lineWidth]);
      },
    },
    [0, 0],
    [30, 0],
    2,
  );
  const [[edge, wide], line] = drawn;
  assert.deepEqual([edge, line], ['#ffffff', ['#33475b', 2]]);
  assert.ok(wide >= 4);
});
