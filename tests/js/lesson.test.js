// Lessons: numbers and their mistakes, orders, ranges, lines drawn by keys and points, and times of events.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clearOf, Paper } from '../../app/static/lesson/drawing.js';
import { curveOf, eventsOf, lastContact, meets, timeOf } from '../../app/static/lesson/events.js';
import { rangeOf, wordsOfGoal } from '../../app/static/lesson/goal.js';
import { Drawn, pointsOf } from '../../app/static/lesson/line.js';
import { wordsOf } from '../../app/static/lesson/nodes.js';
import { isNear, judgeNumber, quantityWords, read } from '../../app/static/lesson/number.js';
import { mixed } from '../../app/static/lesson/order.js';

const UNITS = ['s', 'ms', 'µs'];
const ASKED = {
  ...{ answer: 116.4, unit: 'µs', tolerance: 2.328, units: UNITS, factors: [1, 1e-3, 1e-6] },
  mistakes: [
    { answer: 58.2, numbers: [], power_of_ten: false },
    { answer: null, numbers: [17187, 8593], power_of_ten: false },
    { answer: null, numbers: [], power_of_ten: true },
  ],
};
const FRAME = {
  ...{ trip: 1e-4, forceUnit: 1000, speed: 2, rods: [{ mirror: 1 }], exactTime: [0, 1], exactForce: [3, 1] },
  exact: {
    contacts: [
      [0, 1.7, 4, 8e4],
      [2, 2.2, 1, 5e4],
    ],
    ...{ final: -0.8, targetFinal: 0, peakForce: 8e4, restitution: { newton: 0.8 } },
  },
};

test('a number has a comma or a point, a power of ten, and its unit behind it or not', () => {
  assert.deepEqual(read(' 0,1164 ms', UNITS), { value: 0.1164, unit: 'ms' });
  assert.deepEqual(read('116.4', UNITS), { value: 116.4, unit: '' });
  assert.deepEqual(read('1.164e-4s', UNITS), { value: 1.164e-4, unit: 's' });
  assert.deepEqual(read('1,164·10^-4', UNITS), { value: 1.164e-4, unit: '' });
  assert.deepEqual(read('116 us', UNITS), { value: 116, unit: 'µs' });
  assert.deepEqual(read('−3', UNITS), { value: -3, unit: '' });
  assert.deepEqual(read('0.447 N s', ['N s', 'kg m/s']), { value: 0.447, unit: 'N s' });
  assert.deepEqual(read('37.5 %', ['%']), { value: 37.5, unit: '%' });
  for (const wrong of ['', 'long', '12 kg', '1 2 3 m', '.', ',', '1e', 'e5']) assert.equal(read(wrong, UNITS), null);
});

test('a ratio has no unit behind it', () => {
  assert.equal(quantityWords(0.7302, '1', 2), '0.73');
  assert.equal(quantityWords(12.5, 'N s'), '12.5 N s');
});

test('what a goal is about is said with its unit', () => {
  assert.equal(wordsOfGoal(FRAME, 'restitution'), '0.8');
  assert.equal(wordsOfGoal(FRAME, 'peak_force'), '80 kN');
  assert.equal(wordsOfGoal(FRAME, 'impactor_velocity'), '−1.6 m/s');
  assert.equal(wordsOfGoal(FRAME, 'contacts'), '2');
});

test('a number is right in any unit, or one of the usual mistakes', () => {
  const judge = (value, unit) => judgeNumber(ASKED, value, unit);
  assert.deepEqual(judge(116, 'µs'), { right: true, mistake: -1 });
  assert.deepEqual(judge(0.118, 'ms'), { right: true, mistake: -1 });
  assert.deepEqual(judge(1.164e-4, 's'), { right: true, mistake: -1 });
  assert.deepEqual(judge(119, 'µs'), { right: false, mistake: -1 });
  assert.deepEqual(judge(58, 'µs'), { right: false, mistake: 0 });
  assert.deepEqual(judge(0.058, 'ms'), { right: false, mistake: 0 });
  assert.deepEqual(judge(17187, 's'), { right: false, mistake: 1 });
  assert.deepEqual(judge(116.4, 'ms'), { right: false, mistake: 2 });
  assert.deepEqual(judge(0, 'µs'), { right: false, mistake: -1 });
});

test('what is off by as much as rounding is near, in any unit, but not its opposite', () => {
  for (const [value, unit] of [
    [119, 'µs'],
    [0.113, 'ms'],
    [1.19e-4, 's'],
  ])
    assert.ok(isNear(ASKED, value, unit));
  for (const [value, unit] of [
    [121, 'µs'],
    [-116, 'µs'],
    [119, 'ms'],
    [0, 's'],
  ])
    assert.ok(!isNear(ASKED, value, unit));
});

test('lines are mixed, each is there once, and never in their right order', () => {
  for (let count = 2; count <= 12; count++) {
    const order = mixed(count);
    assert.deepEqual(
      [...order].sort((a, b) => a - b),
      [...Array(count).keys()],
    );
    assert.ok(order.some((each, k) => each !== k));
    assert.deepEqual(mixed(count), order);
  }
});

test('a place is in a range, or nearest to one', () => {
  const found = [{ range: [1.02, 10] }, { range: [0.33, 0.57] }];
  assert.deepEqual(
    [2, 0.4, 0.6, 0.95, 0.1].map((place) => rangeOf(found, place)),
    [0, 1, 1, 0, 1],
  );
  assert.equal(rangeOf([{ range: null }], -3), 0);
});

test('events have their names, and goals are met or not', () => {
  const events = eventsOf(FRAME);
  assert.deepEqual([events.touch, events.part, events['touch-2'], events['part-2']], [0, 1.7, 2, 2.2]);
  assert.deepEqual([events.wall, events.back, events['back-2'], events.second], [0.5, 1, 2, 2]);
  assert.deepEqual([timeOf(1.5, events), timeOf('wall-2', events), timeOf('part-3', events)], [1.5, 1.5, NaN]);
  assert.equal(eventsOf({ ...FRAME, rods: [] }).back, undefined);
  const goal = (quantity, relation, value) => meets(FRAME, { quantity, relation, value });
  assert.ok(goal('contacts', '=', 2) && !goal('contacts', '=', 1) && goal('peak_force', '>', 7e4));
  assert.ok(goal('impactor_velocity', '<', -1.5) && goal('contact_time', '>', 1.8e-4) && goal('impulse', '<', 5.1));
  assert.ok(!goal('mass', '>', 0));
  assert.deepEqual(lastContact(FRAME), { start: 2, end: 2.2, peak: 5e4 });
  assert.deepEqual(curveOf(FRAME, 1e-3), { x: [0, 1], y: [3, 1] });
});

test('what stops goes neither way, whatever rounding says', () => {
  for (const final of [1e-16, -1e-16, 3e-7, 0]) {
    const frame = { ...FRAME, speed: 2, chosen: { speed: 2 }, exact: { ...FRAME.exact, final } };
    for (const relation of ['<', '>'])
      assert.ok(!meets(frame, { quantity: 'impactor_velocity', relation, value: 0 }), `${relation} ${final}`);
  }
  const slow = { ...FRAME, speed: 2, chosen: { speed: 2 }, exact: { ...FRAME.exact, final: 1e-3 } };
  assert.ok(meets(slow, { quantity: 'impactor_velocity', relation: '>', value: 0 }));
});

test('keys draw a line with a corner, lift the pen, and go back', () => {
  const chart = { until: 2, axis: [0, 120], given: [0, 36] };
  const drawn = new Drawn(chart);
  const keys = (...all) => all.forEach((key) => drawn.key(key, false));
  assert.ok(!drawn.begun);
  keys('ArrowRight', 'ArrowDown');
  assert.deepEqual([drawn.line[0], drawn.line[10], Math.round(drawn.line[5] * 10)], [36, 31, 335]);
  keys('Enter', 'ArrowUp', 'ArrowUp');
  assert.deepEqual([Math.round(drawn.line[9]), drawn.line[10]], [32, 41]); // a jump within a value
  keys('ArrowRight');
  assert.equal(drawn.line[20], 41);
  keys('Backspace');
  assert.ok(Number.isNaN(drawn.line[20]) && drawn.line[10] === 41);
  keys(' ', 'ArrowRight', ' ', 'ArrowRight');
  assert.ok(Number.isNaN(drawn.line[15]) && drawn.line[30] === 41);
  keys('End');
  assert.deepEqual([drawn.reach, drawn.line.at(-1)], [2, 41]);
  drawn.clear();
  assert.ok(!drawn.begun && drawn.line[0] === 36);
  drawn.undo();
  assert.equal(drawn.reach, 2);
  assert.ok(!drawn.key('q', false));
  assert.deepEqual(new Drawn(chart, JSON.parse(JSON.stringify(drawn.kept))).line, drawn.line);
});

test('points are typed, the same time twice is a jump, and small values are none', () => {
  const points = pointsOf('0 37\n0,99  8\n1; 80\n\nx\n1 2 3\n1.7 −1\n2.6 2');
  assert.deepEqual(points, [
    [0, 37],
    [0.99, 8],
    [1, 80],
    [1.7, -1],
    [2.6, 2],
  ]);
  const drawn = new Drawn({ until: 2.6, axis: [0, 120], given: null });
  drawn.type(points);
  assert.deepEqual([drawn.line[99], drawn.line[100], drawn.line[170], drawn.line[260]], [8, 80, 0, 0]);
  drawn.type([
    [0.5, 10],
    [0.5, 60],
  ]);
  assert.equal(drawn.line[50], 60);
});

test('sentences are words with their gaps filled', () => {
  const pieces = [
    { kind: 'text', text: 'at ' },
    { kind: 'strong', nodes: [{ kind: 'value', text: 'yours' }] },
  ];
  assert.equal(wordsOf(pieces, { yours: '1 T' }), 'at 1 T');
});

test('a label lies over no line where there is room', () => {
  const paper = new Paper(400, 300, { until: 2, axis: [0, 100] });
  const size = [80, 13];
  const over = ([x, y], lines) => lines.some(([a, b]) => a > x && a < x + 80 && b > y - 13 && b < y);
  const along = (y) => Array.from({ length: 341 }, (_, k) => [46 + k, y(k)]);
  const peak = [200, 60];
  assert.deepEqual(clearOf(paper, peak, size, []), [210, 64]);
  for (const y of [() => 60, (k) => 20 + k / 2, (k) => 200 - k / 2]) {
    const found = clearOf(paper, peak, size, along(y));
    assert.ok(!over(found, along(y)), String(found));
    assert.ok(found[0] >= paper.left && found[0] + 80 <= paper.left + paper.wide);
  }
  const edge = clearOf(paper, [384, 18], size, []); // at the right end and at the top
  assert.ok(edge[0] + 80 <= 386 && edge[1] - 13 >= paper.top);
});
