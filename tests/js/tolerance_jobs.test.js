// Impacts about a scene whose values are known to some percent, found by a source whose function is known.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { mattersOf, quantilesOf } from '../../app/static/whatif/spread.js';
import { PLACE, WIDTH } from '../../app/static/whatif/results.js';
import { ToleranceJobs, clips } from '../../app/static/whatif/tolerance_jobs.js';

const axis = (name, low, high) => ({ name, low, high, log: false, whole: false, factor: 1 });
const INPUTS = [
  { axis: axis('mass_ratio', 0.1, 100), value: 2, part: 0.1 },
  { axis: axis('speed', 0.1, 100), value: 5, part: 0.02 },
];
const ASKED = { key: 'a', inputs: INPUTS, chosen: { law: 'hertz' }, total: 4000 };

/** A force of 10 times the ratio and 20 times the speed; two contacts below a ratio of 1.9. */
function solved({ names, rows }, refuses = () => false) {
  const count = rows.length / names.length;
  const found = new Float64Array(count * WIDTH);
  for (let n = 0; n < count; n++) {
    const [ratio, speed] = rows.subarray(n * names.length, (n + 1) * names.length);
    found[n * WIDTH] = refuses(ratio, speed) ? 1 : 0;
    found[n * WIDTH + PLACE.contacts] = ratio < 1.9 ? 2 : 1;
    found[n * WIDTH + PLACE.peak_force] = 10 * ratio + 20 * speed;
  }
  return found;
}

/** All jobs until there is none. */
function run(jobs, refuses) {
  for (let job = jobs.next(32); job; job = jobs.next(32)) job.done(solved(job, refuses), 1);
  return jobs.shown;
}

const near = (found, expected, error) =>
  assert.ok(Math.abs(found - expected) <= error, `${found} is not ${expected} within ${error}`);

test('quantiles and shares of a sum of two even inputs', () => {
  const jobs = new ToleranceJobs(() => {});
  jobs.ask(ASKED);
  const samples = run(jobs);
  assert.ok(jobs.idle && samples.whole && samples.count === 4000);
  const { at, contacts, sorted, values } = samples.column('peak_force');
  // of two even ones of 118 to 122 each way 2 and 2: a triangle from 116 to 124
  const end = 4 - Math.sqrt(0.1 * 16);
  quantilesOf(sorted, [0.05, 0.5, 0.95]).forEach((found, k) => near(found, 120 + [-end, 0, end][k], 0.03));
  for (const input of [0, 1]) {
    const { effect, share } = mattersOf(values, (n) => samples.unit(at[n], input));
    near(share, 0.5, 0.01);
    near(effect, 2, 0.01);
  }
  near(contacts.filter((count) => count === 2).length / 4000, 0.25, 0.01);
});

test('what is refused is counted, and in none of the figures', () => {
  const jobs = new ToleranceJobs(() => {});
  jobs.ask(ASKED);
  const samples = run(jobs, (ratio) => ratio > 2.1);
  near(samples.refused / 4000, 0.25, 0.01);
  const { sorted } = samples.column('peak_force');
  assert.equal(sorted.length + samples.refused, 4000);
  assert.ok(sorted.at(-1) <= 21 + 20 * 5.1);
});

test('values stay within what they can be', () => {
  const [input] = INPUTS;
  const near2 = { ...input, axis: axis('mass_ratio', 1.9, 100) };
  assert.deepEqual([input, near2, { ...near2, part: 0.05 }].map(clips), [false, true, false]);
  const jobs = new ToleranceJobs(() => {});
  jobs.ask({ ...ASKED, inputs: [near2] });
  const ratios = [];
  for (let job = jobs.next(400); job; job = jobs.next(400)) {
    ratios.push(...job.rows);
    job.done(solved(job), 1);
  }
  assert.equal(Math.min(...ratios), 1.9);
  near(Math.max(...ratios), 2.2, 1e-3);
  near(ratios.filter((ratio) => ratio === 1.9).length / 4000, 0.25, 0.01);
});

test('a newer wish begins as soon as there are some of the old one, which stay shown until then', () => {
  const jobs = new ToleranceJobs(() => {});
  jobs.ask(ASKED);
  const first = jobs.next(150);
  jobs.ask({ ...ASKED, key: 'b' });
  jobs.ask({ ...ASKED, key: 'c', chosen: { law: 'rigid' } });
  const second = jobs.next(150);
  assert.equal(second.rows.length, 2 * 50);
  assert.equal(jobs.next(150), null);
  first.done(solved(first), 1);
  assert.ok(jobs.rough);
  second.done(solved(second), 1);
  assert.equal(jobs.shown.asked.key, 'a');
  const third = jobs.next(400);
  assert.deepEqual([third.chosen, third.rows.length], [{ law: 'rigid' }, 2 * 400]);
  third.done(solved(third), 1);
  assert.equal(jobs.shown.asked.key, 'c');
});

test('impacts whose worker has died are asked for again', () => {
  const jobs = new ToleranceJobs(() => {});
  jobs.ask({ ...ASKED, total: 100 });
  const lost = jobs.next(64);
  lost.done(null, 0);
  assert.deepEqual(jobs.next(64).rows, lost.rows);
  const never = new ToleranceJobs(() => {});
  never.ask({ ...ASKED, total: 100 });
  for (let job = never.next(64); job; job = never.next(64)) job.done(null, 0);
  assert.equal(never.shown.refused, 100);
});
