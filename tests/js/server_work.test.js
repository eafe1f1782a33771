// What the server finds of a map: how much there is, stopped and gone on with, and given up by who leaves.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CurveJobs } from '../../app/static/whatif/curve_jobs.js';
import { Lattice } from '../../app/static/whatif/lattice.js';
import { MapJobs } from '../../app/static/whatif/map_jobs.js';
import { Points } from '../../app/static/whatif/points.js';
import { ToleranceJobs } from '../../app/static/whatif/tolerance_jobs.js';
import { Window } from '../../app/static/whatif/window.js';
import { COLUMNS } from '../../app/static/wasm/columns.js';

globalThis.window = globalThis;
const axis = (name, low, high) => ({
  ...{ name, title: name, unit: '', factor: 1, low, high, log: true, whole: false, body: false, of: '' },
});
const RATIO = axis('mass_ratio', 1e-3, 1e3);
const SPEED = axis('speed', 0.01, 100);
const AXES = { x: RATIO, y: SPEED, x0: 1.5, x1: 4.5, y0: 0, y1: 4 };
const CHOSEN = { scene: 'four-bar', bodies: '', mass_ratio: 1, speed: 1 };
const FRAME = { chosen: CHOSEN };
const ROW = [0, 1, ...Array.from({ length: COLUMNS.length - 2 }, () => 1)];
const none = { next: () => null, idle: true };

/** A map whose impacts a server finds, which keeps what it is asked and answers when that is said. */
function mapOf() {
  const asked = [];
  const wishes = [];
  let hear;
  const model = {
    ...{ spec: { scene: {}, mass_ratio: { low: 1 }, speed: { low: 1 } }, whatif: '', on: (_, act) => (hear = act) },
    set whatif_points(text) {
      asked.push(text && JSON.parse(text));
    },
  };
  const page = { model, connection: { lost: false }, changes: { asked: false, latest: FRAME }, own: {} };
  const whatif = {
    ...{ borders: { near: none, across: none }, designs: none, gains: none, modes: { shown: null } },
    ...{ goal: { pulling: { next: () => wishes.shift() ?? null }, seek: none }, held: false, came: () => {} },
    ...{ chosen: CHOSEN, named: { x: 'mass_ratio', y: 'speed' }, x: RATIO, y: SPEED, value: () => 1 },
  };
  const jobs = new MapJobs(whatif);
  const points = new Points(
    page,
    () => jobs.next(),
    () => jobs.rest(),
  );
  whatif.points = points;
  points.sources = [points.served];
  assert.ok(points.about(CHOSEN, ['mass_ratio', 'speed']));
  const lattice = new Lattice(1);
  const draw = () => jobs.plan(new Window(lattice, AXES, [600, 400], 7));
  draw();
  /** All questions of the job that is under way. */
  const answer = () => {
    const { job } = points.served;
    while (points.served.job === job) {
      const { id, rows } = asked.at(-1);
      model.whatif = JSON.stringify({ id, chosen: { scene: 'four-bar' }, rows: rows.map(() => ROW) });
      hear();
    }
  };
  return { asked, wishes, jobs, points, lattice, draw, answer };
}
const wishOf = (ended) => ({
  ...{ chosen: CHOSEN, names: ['speed'], rows: Float64Array.of(7), wished: true, done: (found) => ended.push(found) },
});

test('coarse points come first, and how many of all are found is known', () => {
  const { answer, asked, draw, jobs, lattice, points } = mapOf();
  points.feed();
  assert.deepEqual(asked.at(-1).rows, [[1, 1]], 'the scene itself');
  answer();
  const { all, coarse } = jobs.progress;
  assert.ok(coarse && all > 30 && jobs.progress.found === 0);
  for (let n = 0; jobs.progress.coarse && n < 400; n++) {
    const { found } = jobs.progress;
    answer();
    draw();
    assert.ok(!jobs.progress.coarse || (jobs.progress.found > found && jobs.progress.all === all));
  }
  const fine = jobs.progress;
  assert.ok(!fine.coarse && fine.found === lattice.count && fine.all > fine.found, JSON.stringify(fine));
  points.leave();
});

test('what is stopped is asked no more but for what is wished, and goes on where it was', () => {
  const { answer, asked, draw, jobs, lattice, points, wishes } = mapOf();
  points.feed();
  answer();
  const under = asked.at(-1).rows;
  assert.ok(under.length > 1 && lattice.asked.size >= under.length);
  points.stop(true);
  assert.equal(asked.at(-1), '', 'its work ends at once');
  assert.deepEqual([lattice.asked.size, lattice.count, jobs.under], [0, 0, 0]);
  draw();
  const before = asked.length;
  points.feed();
  assert.ok(asked.length === before && points.served.idle && jobs.progress.found === 0);
  const ended = [];
  wishes.push(wishOf(ended));
  points.feed();
  assert.deepEqual(asked.at(-1).rows, [[7]]);
  answer();
  assert.ok(ended.length === 1 && ended[0] && points.served.idle);
  points.stop(false);
  assert.deepEqual(asked.at(-1).rows, under);
  wishes.push(wishOf(ended));
  answer();
  assert.deepEqual(asked.at(-1).rows, [[7]], 'before what is drawn');
  points.stop(true);
  assert.deepEqual(asked.at(-1).rows, [[7]], 'what is wished for is not given up');
  points.leave();
  assert.deepEqual([asked.at(-1), points.stopped], ['', false]);
  const last = asked.length;
  points.feed();
  assert.equal(asked.length, last, 'who has left asks nothing');
});

test('what the browser leaves to the server is stopped, too', () => {
  const { answer, asked, jobs, lattice, points } = mapOf();
  points.source = points.own = { feed: () => {}, leave: () => {} };
  points.sources = [points.own, points.served];
  const view = new Window(lattice, AXES, [600, 400], 7);
  const keys = [0, 8, 16].map((i) => view.key(i, 8));
  keys.forEach((key, k) => lattice.left.set(key, view.row(8 * k, 8)));
  points.feed();
  assert.deepEqual([asked.at(-1).rows.length, points.left, lattice.left.size], [3, 3, 0]);
  points.stop(true);
  assert.deepEqual([asked.at(-1), points.left, lattice.left.size], ['', 0, 3]);
  points.feed();
  assert.ok(points.served.idle);
  points.stop(false);
  answer();
  assert.deepEqual([points.handed, lattice.left.size, lattice.count, jobs.under], [3, 0, 3, 0]);
  points.leave();
});

test('what the browser could not do of a line waits while it is stopped, but not for another scene', () => {
  const { asked, jobs, lattice, points } = mapOf();
  Object.assign(points, { source: points.own, sources: [points.own, points.served] });
  Object.assign(points.own, { feed: () => {}, covers: () => true, scene: () => {} });
  points.own.next().done(Float64Array.from(ROW), 1); // the scene itself
  const edge = { low: 0, high: 1, from: 1, steps: 0 };
  Object.assign(jobs, { wanted: [], halves: [{ name: 'one', edge, at: 0.5, row: [1, 2] }] });
  lattice.edges.set('one', edge);
  const failed = Float64Array.from([1, ...ROW.slice(1)]);
  points.own.next().done(failed, 1);
  assert.deepEqual([asked.at(-1).rows, points.left, lattice.halving.size], [[[1, 2]], 1, 1]);
  points.stop(true);
  points.feed();
  assert.deepEqual([asked.at(-1), points.left, lattice.halving.size, edge.steps], ['', 1, 1, 0]);
  points.stop(false);
  assert.deepEqual(asked.at(-1).rows, [[1, 2]]);
  points.stop(true);
  points.page.changes.latest = { chosen: { ...CHOSEN, scene: 'piston' } };
  assert.ok(points.about({ ...CHOSEN, scene: 'piston' }, ['mass_ratio', 'speed']));
  assert.deepEqual([points.queue.length, lattice.halving.size], [0, 0], 'nobody waits for it any more');
  points.leave();
});

test('curves and tolerances say how much of them is found', () => {
  const curves = new CurveJobs(() => {});
  assert.equal(curves.progress, null);
  curves.ask({ key: 'a', axis: SPEED, from: 0, to: 4, fixed: [], chosen: CHOSEN });
  const foundOf = ({ names, rows }) =>
    Float64Array.from(Array.from({ length: rows.length / names.length }, () => ROW).flat());
  const first = curves.next(41);
  assert.deepEqual(curves.progress, { found: 0, all: 161, changes: 0, coarse: true });
  first.done(null); // stopped
  const again = curves.next(41);
  assert.deepEqual(again.rows, first.rows, 'it is asked again');
  again.done(foundOf(again));
  assert.deepEqual(curves.progress, { found: 41, all: 161, changes: 0, coarse: false });
  const tolerance = new ToleranceJobs(() => {});
  assert.equal(tolerance.progress, null);
  tolerance.ask({ key: 'a', inputs: [{ axis: SPEED, value: 1, part: 0.1 }], chosen: CHOSEN, total: 1000 });
  for (const many of [150, 100]) {
    const job = tolerance.next(many);
    job.done(foundOf(job));
  }
  assert.deepEqual(tolerance.progress, { found: 250, all: 1000, changes: 0, coarse: false });
});

test('while a scene changes under a hand, the server is not asked for what the browser has no room for', async () => {
  const { asked, jobs, points } = mapOf();
  const own = { feed: () => {}, leave: () => {} };
  Object.assign(points, { own, source: own, sources: [own, points.served] });
  const move = (held) => {
    const lattice = new Lattice(2);
    lattice.left.set(0, [2, 3]);
    jobs.whatif.held = held;
    jobs.plan(new Window(lattice, AXES, [600, 400], 7));
    points.feed();
  };
  for (let n = 0; n < 5; n++) move(true);
  assert.equal(asked.length, 0);
  await new Promise((rest) => globalThis.setTimeout(rest, 400));
  assert.deepEqual(asked.at(-1).rows, [[2, 3]], 'once it rests, though it still holds');
  points.leave();
});
