// Samples of results over one choice, and every place where the number of contacts changes, against a closed form.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CurveJobs } from '../../app/static/whatif/curve_jobs.js';
import { PLACE, WIDTH } from '../../app/static/whatif/results.js';

const AXIS = { name: 'mass_ratio', low: 0.01, high: 100, log: true, whole: false, factor: 1 }; // of four decades
const ASKED = { key: 'a', axis: AXIS, from: 1, to: 3, fixed: [['speed', 2]], chosen: { law: 'rigid' } };

/** Contacts and force of an impact; nothing beyond 30. */
function solved(rows, contactsOf) {
  const found = new Float64Array((rows.length / 2) * WIDTH).fill(NaN);
  for (let k = 0; k < rows.length / 2; k++) {
    const [ratio, speed] = [rows[2 * k], rows[2 * k + 1]];
    const count = contactsOf(ratio);
    found[k * WIDTH] = count < 0 ? 1 : 0;
    if (count < 0) continue;
    found[k * WIDTH + PLACE.contacts] = count;
    found[k * WIDTH + PLACE.peak_force] = speed * (count === 2 ? 10 + ratio : ratio);
  }
  return found;
}

const steps = (ratio) => (ratio > 30 ? -1 : ratio < 0.4237 ? 3 : ratio < 2.5 ? 2 : 1);

/** All jobs until there is none, with so many impacts each. */
function run(jobs, contactsOf, many = 16, each = () => {}) {
  let impacts = 0;
  for (let job = jobs.next(many); job; job = jobs.next(many)) {
    impacts += job.rows.length / 2;
    job.done(solved(job.rows, contactsOf), 1);
    each();
  }
  return impacts;
}

const valueOf = (place) => 0.01 * 10 ** place;
const near = (found, expected, error) =>
  assert.ok(Math.abs(found - expected) <= error, `${found} is not ${expected} within ${error}`);

test('every change of contacts is found to a millionth of the axis', () => {
  const jobs = new CurveJobs(() => {});
  jobs.ask(ASKED);
  const impacts = run(jobs, steps);
  const { changes, whole } = jobs.shown;
  assert.ok(whole && jobs.idle);
  assert.equal(changes.length, 2);
  for (const [k, value] of [0.4237, 2.5].entries()) {
    near(changes[k].low, Math.log10(value / 0.01), 4e-6);
    assert.ok(valueOf(changes[k].low) <= value && value <= valueOf(changes[k].high));
  }
  assert.ok(impacts < 161 + 2 * 16, `${impacts}`);
});

test('two changes between two samples are both found', () => {
  const jobs = new CurveJobs(() => {});
  jobs.ask(ASKED);
  run(jobs, (ratio) => (ratio < 1 ? 3 : ratio < 1.011 ? 2 : 1));
  const found = jobs.shown.changes.map(({ high, low }) => valueOf((low + high) / 2));
  near(found[0], 1, 1e-5);
  near(found[1], 1.011, 1e-5);
  assert.deepEqual(
    jobs.shown.bands().map(({ count }) => count),
    [3, 2, 1],
  );
});

test('a curve is broken where it leaps, with its values on both sides', () => {
  const jobs = new CurveJobs(() => {});
  jobs.ask({ ...ASKED, to: 4 });
  run(jobs, steps);
  const pieces = jobs.shown.pieces('peak_force');
  assert.equal(pieces.length, 3);
  const [[, before], [, after]] = [pieces[0].at(-1), pieces[1][0]];
  near(before, 2 * 0.4237, 1e-4);
  near(after, 2 * 10.4237, 1e-4);
  near(pieces[2].at(-1)[0], Math.log10(3000), 4e-6); // as far as it can be computed
  const bands = jobs.shown.bands();
  assert.deepEqual([bands[0].from, bands[3].to, ...bands.map(({ count }) => count)], [1, 4, 3, 2, 1, -1]);
});

test('coarse samples come first, and the newest wish follows as soon as they are there', () => {
  const jobs = new CurveJobs(() => {});
  jobs.ask(ASKED);
  const first = jobs.next(400);
  assert.equal(first.rows.length, 2 * 41);
  assert.deepEqual([first.names, first.rows[1]], [['mass_ratio', 'speed'], 2]);
  jobs.ask({ ...ASKED, key: 'b' });
  jobs.ask({ ...ASKED, key: 'c', chosen: { law: 'hertz' } });
  assert.equal(jobs.next(400), null);
  first.done(solved(first.rows, steps), 1);
  assert.equal(jobs.shown.asked.key, 'a');
  assert.deepEqual(
    jobs.shown.bands().map(({ count }) => count),
    [3, 2, 1],
  ); // roughly
  const next = jobs.next(400);
  assert.deepEqual([next.chosen, next.rows.length], [{ law: 'hertz' }, 2 * 41]);
  next.done(solved(next.rows, steps), 1);
  assert.equal(jobs.shown.asked.key, 'c');
  jobs.ask({ ...ASKED, key: 'c' }); // the same: nothing begins anew
  assert.equal(jobs.next(400).rows.length, 2 * 120);
});

test('answers to what nobody wants any more change nothing', () => {
  const jobs = new CurveJobs(() => {});
  jobs.ask(ASKED);
  const late = jobs.next(400);
  jobs.ask(null);
  late.done(solved(late.rows, steps), 1);
  assert.equal(jobs.shown, null);
});

test('samples whose worker has died are asked for again', () => {
  const jobs = new CurveJobs(() => {});
  jobs.ask(ASKED);
  jobs.next(400).done(null, 0);
  const again = jobs.next(400);
  assert.equal(again.rows.length, 2 * 41);
  again.done(solved(again.rows, steps), 1);
  run(jobs, steps);
  assert.equal(jobs.shown.changes.length, 2);
});
