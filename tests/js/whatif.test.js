// What can be varied on the map, and points of it that the server finds, one question after the other.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { axesOf } from '../../app/static/whatif/axes.js';
import { COLUMNS } from '../../app/static/wasm/columns.js';
import { Served } from '../../app/static/whatif/server.js';

globalThis.window = globalThis;
const SPEC = {
  scene: { default: 'fixed-rod' },
  bodies: { default: '' },
  mass_ratio: { default: 1, low: 1e-3, high: 1e3, whole: false },
  speed: { default: 1, low: 0.01, high: 100, whole: false },
  place: { default: 1, low: 0, high: 1, whole: false },
  modes: { default: 50, low: 1, high: 200, whole: true },
  law: { default: 'rigid', options: ['rigid', 'hertz'] },
};
const value = (quantity, own, low, high, now = own) => ({ quantity, own, value: now, low, high });
const PARTS = [
  { key: 'impactor', name: '', kind: 'mass', strikes: true, derived: [], values: [value('mass', 2, 1e-9, 1e9)] },
  {
    ...{ key: 'target', name: '', kind: 'rod', strikes: false, derived: [] },
    values: [
      { quantity: 'material', own: 'steel', value: 'steel', low: null, high: null },
      value('length', 0.25, 1e-5, 1e4, 2),
      value('material.poisson', 0.3, -0.99, 0.499),
      value('material.yield', null, 1e3, 1e12),
    ],
  },
];
const FRAME = {
  acting: ['scene', 'bodies', 'law', 'speed', 'place', 'modes', 'mass_ratio'],
  parts: PARTS,
  chosen: { scene: 'fixed-rod', bodies: '', mass_ratio: 1, speed: 1, place: 1, modes: 50, law: 'rigid' },
};

test('axes are numbers that act, and numbers of bodies around those of the scene', () => {
  const axes = axesOf(FRAME, { spec: SPEC });
  assert.deepEqual(
    axes.map(({ name }) => name),
    ['speed', 'place', 'modes', 'mass_ratio', 'target.length', 'target.material.poisson'],
  );
  const by = Object.fromEntries(axes.map((axis) => [axis.name, axis]));
  assert.deepEqual(
    [by.speed.low, by.speed.high, by.speed.log, by.speed.unit, by.speed.body],
    [0.01, 100, true, 'm/s', false],
  );
  assert.deepEqual([by.place.log, by.modes.whole, by.modes.log], [false, true, true]);
  const { factor, high, low, title, unit } = by['target.length'];
  assert.deepEqual([low, high, unit, factor, title], [0.0625, 2, 'mm', 1e-3, 'Length']);
  assert.deepEqual([by['target.material.poisson'].low, by['target.material.poisson'].log], [-0.99, false]);
  assert.ok(by['target.length'].of && by['target.length'].body);
});

test('the mass is an axis of its own where no slider sets it, and what a link holds is none', () => {
  const alone = axesOf({ ...FRAME, acting: ['speed'] }, { spec: SPEC }).map(({ name }) => name);
  assert.deepEqual(alone.slice(0, 2), ['speed', 'impactor.mass']);
  const held = {
    ...{ bodies: true, bounds: new Map([['place', [0.2, 0.8]]]) },
    stays: (name) => name === 'speed',
  };
  const left = axesOf(FRAME, { spec: SPEC }, held);
  assert.deepEqual(
    left.map(({ name, low }) => [name, low]),
    [
      ['place', 0.2],
      ['modes', 1],
      ['mass_ratio', 1e-3],
    ],
  );
});

/** A page whose server keeps what it is asked, and what it answers is said. */
function pageOf() {
  const asked = [];
  let hear;
  const model = {
    ...{ spec: SPEC, whatif: '', on: (_, act) => (hear = act) },
    set whatif_points(text) {
      asked.push(text && JSON.parse(text));
    },
  };
  const answer = (given, question = asked.at(-1)) => {
    model.whatif = JSON.stringify({ id: question.id, chosen: { scene: 'fixed-rod' }, ...given });
    hear();
  };
  return { page: { model, connection: { lost: false } }, asked, answer };
}
const row = (first) => [0, first, ...Array.from({ length: COLUMNS.length - 2 }, () => null)];

/** Points of a job, and what came of it. */
function jobOf(values, names = ['mass_ratio']) {
  const job = { chosen: { ...FRAME.chosen, speed: 3 }, names, rows: Float64Array.from(values), ended: [] };
  job.done = (...found) => job.ended.push(found);
  return job;
}

test('what is left of a job is asked again, then the newest wish', () => {
  const { page, asked, answer } = pageOf();
  const jobs = [jobOf([1, 2, 3]), jobOf([7])];
  const [first, second] = jobs;
  const served = new Served(page, () => jobs.shift() ?? null);
  assert.ok(served.covers(FRAME, ['mass_ratio', 'target.length']) && !served.covers(FRAME, ['law']));
  served.scene(FRAME);
  served.feed();
  served.feed();
  assert.equal(asked.length, 1);
  assert.deepEqual([asked[0].names, asked[0].rows, asked[0].set.speed], [['mass_ratio'], [[1], [2], [3]], 3]);
  assert.ok(!('scene' in asked[0].set) && !('mass_ratio' in asked[0].set) && asked[0].set.law === 'rigid');
  answer({ rows: [row(4)] });
  assert.deepEqual([asked[1].rows, first.ended], [[[2], [3]], []]);
  answer({ rows: [row(0)] }, asked[0]); // which is answered already
  assert.equal(asked.length, 2);
  const why = { 1: { code: 'refused.points', values: { names: 8, rows: 256 } } };
  answer({ rows: [row(5), [1, ...row(0).slice(1)]], why });
  const [[found, spent, reasons]] = first.ended;
  assert.deepEqual([found[1], found[COLUMNS.length + 1], found[2 * COLUMNS.length]], [4, 5, 1]);
  assert.ok(Number.isNaN(found[2]) && spent >= 0 && reasons.size === 1 && reasons.get(2).includes('256'));
  assert.deepEqual(asked[2].rows, [[7]]);
  answer({ error: why[1] });
  assert.deepEqual([second.ended[0][0][0], second.ended[0][2].size, served.idle], [1, 1, true]);
});

test('many points are asked in parts of bounded length', () => {
  const { page, asked, answer } = pageOf();
  const values = Array.from({ length: 1000 }, (_, k) => 1 + k / 3);
  const job = jobOf(values, ['mass_ratio', 'speed']);
  const served = new Served(page, () => job);
  served.scene(FRAME);
  served.feed();
  assert.equal(asked[0].rows.length, 256);
  assert.ok(JSON.stringify(asked[0]).length < 16_000);
  answer({ rows: [row(1), row(1)] });
  assert.equal(asked[1].rows.length, 8); // the last took long
  served.leave();
  assert.deepEqual([asked[2], job.ended[0][0], served.idle], ['', null, true]);
});

test('a lost server and another scene end a job', (t) => {
  t.mock.timers.enable({ apis: ['setInterval'] });
  const { page, asked, answer } = pageOf();
  let job = jobOf([1, 2]);
  const served = new Served(page, () => job);
  const begin = () => {
    job = jobOf([1, 2]);
    served.scene(FRAME);
    served.feed();
    return job;
  };
  const given = begin();
  page.connection.lost = true;
  t.mock.timers.tick(300);
  assert.deepEqual([given.ended[0][0], served.idle, asked.length], [null, true, 1]);
  served.feed();
  assert.equal(asked.length, 1); // while there is none nothing is asked
  page.connection.lost = false;
  const other = begin();
  answer({ chosen: { scene: 'free-rod' }, rows: [row(1)] });
  assert.equal(other.ended[0][0], null);
  const same = begin();
  served.scene({ ...FRAME });
  assert.equal(same.ended.length, 0);
  served.scene({ ...FRAME, chosen: { ...FRAME.chosen, scene: 'free-rod' } });
  assert.equal(same.ended[0][0], null);
});
