// The opening: what its rows and its question are made of.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WaveField } from '../../app/static/axial/fields.js';
import { filledOf, placing, seamIn } from '../../app/static/axial/traces.js';
import { pushesOf } from '../../app/static/axial/question.js';
import { palette, shade } from '../../app/static/charts/styles.js';
import { impactsOf, nearest } from '../../app/static/fall/lens.js';
import { indentationOf } from '../../app/static/axial/tracks.js';
import { fallOf } from '../../app/static/fall/fall.js';
import { eventsOf as fallEvents } from '../../app/static/fall/view.js';
import { spread, windowOf } from '../../app/static/opening/happens.js';
import { withBesides } from '../../app/static/opening/besides.js';
import { weave } from '../../app/static/opening/rows.js';
import { placed } from '../../app/static/opening/tracks.js';
import { courseOf, meets, movedAt, tracksOf as slideTracks } from '../../app/static/space/tracks.js';

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

test('bodies apart are woven as wide as they are, with the push that goes through each', () => {
  const canvas = sheet();
  const field = { coarse: false, pieces: (t) => [[10 + 20 * t, 30 + 20 * t, 0, 4], [50, 70, 4, 0]] }; // prettier-ignore
  const drawn = { left: 10, right: 70, rest: 30 };
  weave(canvas, { drawn, duration: 1, field, largest: 4, scale: 0, what: 'push' }, [0, 1], 100, 10);
  const alpha = (x, y) => canvas.picture.data[4 * (100 * y + x) + 3];
  const red = (x, y) => canvas.picture.data[4 * (100 * y + x)];
  const edges = (y) => Array.from({ length: 99 }, (_, x) => x).filter((x) => alpha(x, y) !== alpha(x + 1, y));
  assert.deepEqual(edges(0), [10, 30, 49, 69]); // at t = 0.05 the first has come a pixel
  assert.deepEqual(
    edges(9),
    [28, 48, 49, 69].filter((x, k, all) => all.indexOf(x) === k),
  );
  assert.equal(red(28, 0), palette[shade(4 * 0.875, 4)]); // 17.5 of 20 pixels along it
  assert.ok(red(13, 0) > red(28, 0) && red(52, 0) < red(66, 0)); // darker, the harder it is pressed
});

test('tracks share the room by what they take, and the last ones give way where there is little', () => {
  const tracks = [1, 2, 1].map((share) => ({ title: '', share, range: [0, 1] }));
  const all = placed(tracks, 0, 860, { top: 0, tall: 10 });
  const wide = all.map(({ place: { left, right } }) => right - left);
  assert.equal(wide.length, 3);
  assert.ok(Math.abs(wide[1] - 2 * wide[0]) < 1e-9 && Math.abs(all[2].place.right - 860) < 1e-9);
  assert.equal(placed(tracks, 0, 220, { top: 0, tall: 10 }).length, 2);
  assert.equal(placed(tracks, 0, 60, { top: 0, tall: 10 }).length, 1);
});

const FALL = { height: 1, gravity: 9.81, rest: 1.355 };
const bounced = (rows, fall = FALL) => ({
  fall,
  bounces: Float64Array.from(rows.flat()),
  fallTime: [0, 1.3],
  fallHeight: [1, 0],
});

test('a dropped body is let go, bounces, and lies still after all of its bounces', () => {
  const rows = [[0.452, 0.2, 0.25, 0.5], [0.904, 0.1, 0.0625, 0.5]]; // prettier-ignore
  const events = fallEvents(fallOf(bounced(rows)));
  assert.deepEqual(
    events.map(([t]) => t),
    [0, 0.452, 0.904, 1.355],
  );
  assert.match(events[1][1], /4\.43\sm\/s\..*50\.0\s%.*25\.0\s%/);
  assert.match(events[2][1], /2\.21\sm\/s/); // it has fallen from a quarter
  assert.equal(fallEvents(fallOf(bounced(rows, { ...FALL, rest: null }))).length, 3);
  assert.equal(fallOf({}), null);
});

const COURSE = {
  friction: 0.5,
  sliding: [
    { kind: 'slip', until: 1 },
    { kind: 'stick', until: 4 },
  ],
  slidePress: Float64Array.of(0, 1, 2, 4),
  slideParting: Float64Array.of(-3, -1.5, 0, 3),
  slideAlong: Float64Array.of(3, 0, 0, 0),
  slideAside: Float64Array.of(4, 0, 0, 0),
  slidePush: Float64Array.of(0, 0.5, 0.5, 0.5),
  ...{ across: [1, 0, 0], up: [0, 1, 0] },
  slideSpins: Float64Array.from([9, 5, 5, 5].flatMap((spin) => [0, 1, spin, 0, 0, 0])),
};

test('the clock of an impact without time is its impulse', () => {
  const { series } = slideTracks(COURSE).tracks[1];
  assert.deepEqual(Array.from(series[0].x), [-1, 0, 0.5, 1, 2, 3]);
  assert.deepEqual(Array.from(series[0].y), [5, 5, 0, 0, 0, 0]); // its size: 3 along, 4 aside
  const spin = slideTracks(COURSE).tracks[2].series; // of the one that turns
  assert.deepEqual([spin.length, Array.from(spin[0].y)], [1, [9, 9, 5, 5, 5, 5]]);
  assert.deepEqual([-0.5, 0, 1.2, 2, 2.5].map(movedAt), [-0.5, 0, 0, 0, 0.5]);
  const events = courseOf(COURSE, 'They touch.');
  assert.deepEqual(
    events.map(([t]) => t),
    [0, 0.5, 1, 2],
  );
  assert.match(events[1][1], /grips/);
});

/** A ball of 0.5 kg strikes a rod of 2 kg and 1.2 m, 0.2 m from its middle, at 3 m/s: it is felt as 1.5 kg there. */
const SMOOTH = {
  ...{ friction: 0, impulse: 1.8, push: [-1.8, 0, 0], sliding: [], figures: [['energy-before', 2.25, 'J']] },
  impactorPath: Float64Array.of(1, 0, 0, 0, 0, 0, 0.2, 0, 0),
  targetPath: Float64Array.of(0, -0.2, 0, 0, -0.2, 0, -0.3, -0.2, 0),
  bodies: {
    impactor: {
      shape: 'point',
      before: { velocity: [-3, 0, 0], spin: [0, 0, 0] },
      after: { velocity: [0.6, 0, 0], spin: [0, 0, 0] },
    },
    target: {
      shape: 'box',
      before: { velocity: [0, 0, 0], spin: [0, 0, 0] },
      after: { velocity: [-0.9, 0, 0], spin: [0, 0, 1.5] },
    },
  },
};

test('without friction velocities change in proportion to the impulse; the energy is least between', () => {
  const found = slideTracks(SMOOTH);
  const [parting, along, spin, energy] = found.tracks.map(({ series }) => series);
  const near = (values, expected) =>
    expected.forEach((value, k) => assert.ok(Math.abs(values[k] - value) < 1e-12, `${[...values]}`));
  near(parting[0].y, [-3, -3, 1.8, 1.8]); // restitution 0.6
  near(along[0].y, [3, 3, -0.6, -0.6]);
  near(along[1].y, [0, 0, 0.9, 0.9]);
  assert.equal(spin.length, 1); // the ball does not turn
  near(spin[0].y, [0, 0, 1.5, 1.5]);
  const joules = [...energy[0].y];
  near([joules[0], joules.at(-1)], [2.25, 1.17]);
  assert.ok(Math.abs(Math.min(...joules) - (2.25 - 0.5 * 0.375 * 9)) < 1e-3); // both go as one
  assert.deepEqual(found.timed, [0, 2]);
  near(
    courseOf(SMOOTH, 'They touch.').map(([t]) => t),
    [0, 1.25, 2],
  );
  assert.ok(meets(SMOOTH) && !meets({ ...SMOOTH, impulse: 0 }));
});

test('names stand at their time, apart, and those at the end move up', () => {
  assert.deepEqual(spread([10, 100, 190], 10, 200), [10, 100, 190]);
  assert.deepEqual(spread([10, 12, 14], 10, 200), [10, 34, 58]);
  assert.deepEqual(spread([10, 150, 196, 197], 10, 200), [10, 150, 176, 200]);
  assert.deepEqual(spread([-5, 300], 10, 200), [10, 200]);
});

test('of many names those are seen that have room, and the others are counted', () => {
  assert.deepEqual(windowOf(14, 14, 3), [0, 14]);
  assert.deepEqual(windowOf(14, 10, 0), [0, 9]); // and a line: 5 more
  assert.deepEqual(windowOf(14, 10, 3), [3, 11]); // between two lines
  assert.deepEqual(windowOf(14, 10, 9), [5, 14]); // 5 earlier
  for (let first = 0; first < 14; first++) {
    const [from, to] = windowOf(14, 10, first);
    assert.equal(to - from + Number(from > 0) + Number(to < 14), 10);
  }
});

test('every impact is seen closer with its own force and the flight before it, the nearest is shown', () => {
  const bounces = [{ t: 0.4 }, { t: 1.2 }, { t: 1.6 }];
  const frame = {
    touches: Float64Array.of(0.01, 30, 0.02, 20, 0.03, 10),
    touchForce: Float64Array.of(0, 29, 0, 0, 20, 0, 0, 10, 0),
  };
  const found = impactsOf(frame, bounces);
  assert.deepEqual(
    found.map(({ end, most, y }) => [end, most, ...y]),
    [
      [0.01, 30, 0, 29, 0],
      [0.02, 20, 0, 20, 0],
      [0.03, 10, 0, 10, 0],
    ],
  );
  for (const [k, flown] of [0.4, 0.79, 0.38].entries()) assert.ok(Math.abs(found[k].flown - flown) < 1e-12);
  assert.deepEqual(
    [-1, 0.5, 0.79, 0.81, 1.3, 9].map((t) => nearest(found, t)),
    [0, 0, 0, 1, 1, 2],
  );
  assert.deepEqual(impactsOf({}, bounces), []); // without duration
});

const BAR = { transit: 0.5, impedance: 1, drift: 0, area: 1, joint: null, mirror: 0 };
const BARS = [
  { ...BAR, from: 0, to: 1 },
  { ...BAR, from: 1, to: 1.01, area: 0.25 },
  { ...BAR, from: 1.01, to: 2.01 },
];

test('a thin specimen between bars is drawn wide, and all else as far apart as it is', () => {
  const seam = seamIn({ rods: BARS }, 1000);
  const place = placing([0, 2.01], [100, 1100], seam);
  const found = [0, 0.5, 1, 1.005, 1.01, 1.51, 2.01].map(place);
  const expected = [100, 317.5, 535, 600, 665, 882.5, 1100];
  for (const [k, x] of found.entries()) assert.ok(Math.abs(x - expected[k]) < 1e-9, `${k}: ${x}`);
  assert.equal(seamIn({ rods: [BARS[0], { ...BARS[1], to: 1.5 }, BARS[2]] }, 1000), null); // no thin one
  const even = placing([0, 2], [100, 1100], null);
  assert.deepEqual([0, 1, 2].map(even), [100, 600, 1100]);
});

test('what fills the seam is the force through the specimen, coloured as the bars that feel it', () => {
  const field = { over: (place) => (place > 1 && place < 1.01 ? { x: [0, 1], y: [0, 8] } : assert.fail()) };
  const stage = { largest: 3, leads: true, place: (x) => 100 * x, what: 'stress' };
  const found = filledOf({ rods: BARS, forceUnit: 10 }, field, stage, [0, 1]);
  assert.deepEqual([...found.force], [0, 20]);
  assert.deepEqual([found.left, found.right, found.largest], [100, 101, 30]);
  assert.equal(filledOf({ rods: BARS, forceUnit: 10 }, field, { ...stage, what: 'velocity' }, [0, 1]), null);
});

test('rows of what is not drawn evenly lie where it is', () => {
  const canvas = sheet();
  const at = (share) => (share < 0.5 ? 10 + 40 * share : 50 + 40 * share);
  const shown = { drawn: { left: 10, right: 90, rest: 10, at }, duration: 2, field: step(), largest: 2, scale: 0 };
  weave(canvas, { ...shown, what: 'stress' }, [0, 2], 100, 40);
  const color = (x, y) => [...canvas.picture.data.slice(4 * (100 * y + x), 4 * (100 * y + x) + 3)];
  const solid = (value) => [...palette.slice(shade(value, 2), shade(value, 2) + 3)];
  assert.deepEqual(color(28, 8), solid(1)); // at 0.425 of 2 the front has gone 0.85 of the length, to 84
  assert.deepEqual(color(80, 8), solid(1));
  assert.deepEqual(color(88, 8), solid(0));
});

test('a lesson has the first force alone, and what it wants beside it on one scale', () => {
  const curve = (peak, cursor) => ({ x: [0, 1], y: [0, peak], factor: 2, style: 'exact', cursor });
  const [own, other, third] = [curve(1, 'own'), curve(5, 'other'), { ...curve(3, 'third'), factor: 1 }];
  const rows = withBesides({ drawn: {}, forces: [own, other] }, [third], 'mine');
  assert.deepEqual(
    rows.forces.map(({ cursor }) => cursor),
    ['mine', 'third'],
  );
  const push = { title: 'force', force: true, range: [2.2, 0], series: [own, other] };
  const gap = { title: 'gap', range: [0, 1], series: [own] };
  const { tracks } = withBesides({ drawn: null, tracks: [push, gap] }, [third], '');
  assert.deepEqual([tracks[0].series, tracks[1]], [[own, third], gap]);
  assert.ok(Math.abs(tracks[0].range[0] - 3.3) < 1e-9);
  assert.deepEqual(withBesides({ drawn: null, tracks: [push] }, [], '').tracks[0].range, [2.2, 0]);
});

test('the force of before keeps its seconds where T has become longer', () => {
  const now = { x: [0, 1], y: [0, 1], style: 'exact' };
  const before = { x: [0, 1], y: [0, 3], trip: 1e-4, style: 'prediction' };
  const xs = (frame) => withBesides({ drawn: {}, forces: [now] }, [before], '', frame).forces[1].x;
  assert.deepEqual(xs({ trip: 1e-4 }), [0, 1]);
  assert.deepEqual(xs({ trip: 2e-4 }), [0, 0.5]);
  assert.deepEqual(xs({}), [0, 1]); // a clock of seconds
});

test('a dent stays once they have parted, and is deeper after a second contact', () => {
  const motionTime = [0, 1, 2, 3, 4, 5, 6];
  const field = { masses: [0, 3, 1, -1, 2, 1.5, -3], ends: [0, 0, 0, 0, -2, 0, 0] };
  const contacts = [
    [0, 2, 1, 1],
    [3.5, 5, 1, 1],
  ];
  const frame = { exact: { contacts, residualIndentation: 3e-6 }, motionTime, speed: 2, trip: 1e-6 };
  const [{ said, series }] = indentationOf(frame, field);
  assert.deepEqual(series[0].y, [0, 3, 1, 1, 4, 1.5, 1.5]);
  assert.deepEqual([said.length, said[0].t, said[0].value], [1, 5, 3e-6]);
  const elastic = { ...frame, exact: { contacts, residualIndentation: 0 } };
  const [{ said: nothing, series: near }] = indentationOf(elastic, field);
  assert.deepEqual([near[0].y, nothing], [[0, 3, 1, 0, 4, 1.5, 0], []]);
});
