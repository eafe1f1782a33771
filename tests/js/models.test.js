// Which model is enough: what is kept of a point by bound, its link, its table, its command.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { planOf } from '../../app/static/whatif/code_lines.js';
import { BOUNDS, ModelJobs, ModelLattice } from '../../app/static/whatif/model_jobs.js';
import { WIDTH } from '../../app/static/whatif/results.js';
import { tableOfModels } from '../../app/static/whatif/table.js';
import { Window } from '../../app/static/whatif/window.js';

const axis = (name) => ({ name, si: '', low: 0, high: 1, log: false, whole: false, factor: 1, title: name });
const AXES = { x: axis('one'), y: axis('other'), x0: 0, x1: 4, y0: 0, y1: 4 }; // all of both, in places
const ASKED = { chosen: { law: 'hertz' }, names: ['one', 'other'], values: [0.2, 0.3], figure: 'peak_force' };
const MODELS = [{ name: 'rigid-impulse' }, { name: 'modal', modes: 1 }, { name: 'modal', modes: 5 }, { name: 'waves' }];

/** By bound, of a point: the harder the larger its first axis, and the smaller the bound. */
const placesOf = (x) => BOUNDS.map((_, k) => (x < 0.25 + 0.1 * k ? 2 : 3));

/** Find all that is asked for, each job at once; what is seen then. */
function answer(jobs, lattice, size) {
  for (let count = 0; count < 500; count++) {
    const view = new Window(lattice, AXES, size, 20);
    view.fill('model');
    jobs.ask({ ...ASKED, lattice }, view, [0.2, 0.3]);
    if (!work(jobs)) return view;
  }
  throw new Error('it does not end');
}

/** Answer what is asked now; whether anything was. */
function work(jobs) {
  let any = false;
  for (let job = jobs.next(); job; job = jobs.next()) {
    any = true;
    assert.deepEqual(job.models, { figure: 'peak_force', bounds: BOUNDS });
    const found = new Float64Array((job.rows.length / 2) * WIDTH);
    for (let k = 0; k < job.rows.length / 2; k++) {
      const [x, y] = job.rows.subarray(2 * k, 2 * k + 2);
      if (y > 0.9) found[k * WIDTH] = 1;
      else found.set([0, ...placesOf(x)], k * WIDTH);
    }
    job.named?.(MODELS);
    job.done(found, 1, new Map());
  }
  return any;
}

test('the smallest model is kept for all bounds, and looked at for one', () => {
  const lattice = new ModelLattice(0);
  const jobs = new ModelJobs(() => {});
  assert.ok(jobs.rough);
  const view = answer(jobs, lattice, [400, 400]);
  assert.ok(!jobs.rough);
  assert.deepEqual(jobs.own.places, placesOf(0.2));
  const at = (x) => view.near(x, 0.3);
  assert.deepEqual([at(0.1), at(0.9)], [2, 3]);
  assert.equal(view.contacts[view.nx * (view.ny - 1)], -1); // refused, at the top
  const before = lattice.count;
  lattice.look(3);
  const later = new Window(lattice, AXES, [400, 400], 20);
  later.fill('model');
  assert.deepEqual(
    [0.1, 0.4, 0.7].map((x) => later.near(x, 0.3)),
    [2, 2, 3],
  ); // of what is known: nothing is asked anew
  assert.equal(lattice.count, before);
  assert.equal(lattice.edges.size, 0);
});

test('its table says the model within each bound', () => {
  const lattice = new ModelLattice(0);
  const jobs = new ModelJobs(() => {});
  const view = answer(jobs, lattice, [400, 400]);
  const { names, rows } = tableOfModels(view, MODELS);
  assert.deepEqual(names.slice(2, 6), [
    'model_within_0.1',
    'model_within_0.05',
    'model_within_0.01',
    'model_within_0.001',
  ]);
  for (const [x, y, ...cells] of rows) {
    const models = placesOf(x).map((place) => ['', 'rigid-impulse', 'modal-1', 'modal-5', 'waves'][place]);
    assert.deepEqual(cells.slice(0, 4), y > 0.9 ? ['', '', '', ''] : models);
    assert.equal(cells[4] !== '', y > 0.9);
  }
  assert.ok(rows.length > 50);
});

test('command and Python ask the library for the same figure and bound', () => {
  const { command, python } = planOf('rod.toml', 'peak_force', 0.01);
  assert.equal(command, 'impact plan rod.toml --question peak-force --tolerance 0.01 --solve');
  assert.match(python, /solvers\.plan\(solvers\.load\("rod\.toml"\), "peak-force", 0\.01, solve=True\)/);
  assert.equal(planOf('rod.toml', 'vibration', 0.01), null);
});
