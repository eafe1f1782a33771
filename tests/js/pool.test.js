// Workers that find figures of maps: who is given what, and when; they are stood in for.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { afterEach, test } from 'node:test';
import { setImmediate as turn } from 'node:timers/promises';
import { URL } from 'node:url';
import { Pool } from '../../app/static/whatif/pool.js';

const MODULE = readFileSync(new URL('../../app/static/wasm/kernels.wasm', import.meta.url));
const SCENE = { kind: 'axial', chosen: { speed: 1 } };
const FOUND = new Float64Array(11);

class Stand {
  static all = [];
  given = [];
  ended = false;
  constructor() {
    Stand.all.push(this);
  }
  postMessage(message) {
    this.given.push(message);
  }
  terminate() {
    this.ended = true;
  }
  say(data) {
    this.onmessage({ data });
  }
  get jobs() {
    return this.given.filter(({ kind }) => kind === 'points');
  }
  finish(spent = 5) {
    const job = this.jobs[(this.done = (this.done ?? 0) + 1) - 1].job;
    this.say({ job, found: FOUND, spent });
  }
}

/** Stands for a browser of so many processors. */
function browserOf(hardwareConcurrency) {
  Stand.all = [];
  globalThis.Worker = Stand;
  Object.defineProperty(globalThis, 'navigator', { value: { hardwareConcurrency }, configurable: true });
  globalThis.fetch = () => Promise.resolve({ ok: true, arrayBuffer: () => Promise.resolve(MODULE) });
}

/** One whose workers stand, and what has come of its jobs. */
async function poolOf(processors, jobs = Infinity) {
  browserOf(processors);
  const done = [];
  let made = 0;
  const pool = new Pool(() => {
    if (made === jobs) return null;
    const number = made++;
    return {
      chosen: {},
      names: ['speed'],
      rows: new Float64Array([number]),
      done: (found) => done.push([number, found]),
    };
  });
  pool.scene(SCENE);
  const prepared = pool.prepare();
  while (!Stand.all.length) await turn();
  for (const each of Stand.all) each.say({ ready: true });
  assert.equal(await prepared, true);
  return { done, pool };
}
const given = () => Stand.all.map(({ jobs }) => jobs.length);

afterEach(() => {
  delete globalThis.Worker;
});

test('one processor is left to the page, and no more than four are taken', async () => {
  for (const [processors, workers] of [
    [1, 1],
    [2, 1],
    [3, 2],
    [16, 4],
  ]) {
    await poolOf(processors);
    assert.equal(Stand.all.length, workers);
  }
});

test('every worker has the module and the scene before any points', async () => {
  await poolOf(3);
  for (const { given: messages } of Stand.all)
    assert.deepEqual(
      messages.map(({ kind }) => kind),
      ['module', 'scene', 'points'],
    );
});

test('the next job is asked for when a worker is free, small ones three deep', async () => {
  const { done, pool } = await poolOf(3);
  assert.deepEqual(given(), [1, 1]); // how long a job takes is not known yet
  Stand.all[0].finish(5);
  assert.deepEqual(given(), [4, 1]);
  Stand.all[1].finish(500);
  assert.deepEqual(given(), [4, 2]);
  assert.deepEqual(done, [
    [0, FOUND],
    [1, FOUND],
  ]);
  assert.equal(pool.idle, false);
});

test('nothing to do is no work, until there is some', async () => {
  const { pool } = await poolOf(2, 1);
  Stand.all[0].finish();
  assert.deepEqual([given(), pool.idle], [[1], true]);
  pool.next = () => ({ chosen: {}, rows: new Float64Array(1), done: () => {} });
  pool.feed();
  assert.deepEqual([given(), pool.idle], [[4], false]);
});

test('a worker that dies says so to its jobs and is replaced, once', async () => {
  const { done, pool } = await poolOf(2);
  Stand.all[0].onerror();
  assert.ok(Stand.all[0].ended);
  assert.deepEqual(done, [[0, null]]);
  assert.equal(Stand.all.length, 2);
  Stand.all[1].say({ ready: true });
  assert.deepEqual(
    Stand.all[1].given.map(({ kind }) => kind),
    ['module', 'scene', 'points'],
  );
  Stand.all[1].onerror();
  assert.deepEqual(done, [
    [0, null],
    [1, null],
  ]);
  assert.equal(Stand.all.length, 2);
  assert.ok(pool.idle);
});

test('there is none where no worker can have kernels, where there are no workers, or no module', async () => {
  browserOf(2);
  const refusing = new Pool(() => null).prepare();
  while (!Stand.all.length) await turn();
  Stand.all[0].say({ ready: false });
  Stand.all[1].say({ ready: false });
  assert.equal(await refusing, false);
  globalThis.fetch = () => Promise.resolve({ ok: false, status: 404 });
  assert.equal(await new Pool(() => null).prepare(), false);
  delete globalThis.Worker;
  assert.equal(await new Pool(() => null).prepare(), false);
});

test('who leaves ends all of them, and nothing is found of what they were at', async () => {
  const { done, pool } = await poolOf(3);
  const jobs = given().reduce((sum, count) => sum + count);
  pool.leave();
  assert.ok(Stand.all.every(({ ended }) => ended));
  assert.ok(jobs > 0 && done.length === jobs && done.every(([, found]) => found === null) && pool.idle);
});

test('who leaves while they are awaited has none, and may have some again', async () => {
  browserOf(2);
  const pool = new Pool(() => null);
  const first = pool.prepare();
  assert.equal(pool.prepare() && Stand.all.length, 0);
  pool.leave();
  assert.equal(await first, false);
  assert.equal(Stand.all.length, 0);
  const again = pool.prepare();
  while (!Stand.all.length) await turn();
  Stand.all[0].say({ ready: true });
  assert.equal(await again, true);
});
