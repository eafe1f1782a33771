// What supports exert, as their chart reads it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { WaveField } from '../../app/static/axial/fields.js';
import { wallOf } from '../../app/static/axial/wall.js';
import { supportsOf } from '../../app/static/beam/supports.js';
import { overTime } from '../../app/static/charts/scale.js';

const ROD = { from: 0, to: 2, transit: 0.5, impedance: 1, drift: 0, area: 1, joint: null, mirror: 1 };

test('a wall bears twice the force of the wave that meets it, 2 rho c v A, from when it is there', () => {
  const [speed, impedance] = [1.5, 40e3]; // of a steel rod: rho c A
  const target = { support: 'fixed' };
  const still = { motionTime: [0, 1], exactMass: [0, 1], exactEnd: [0, 1], exactForce: [1] };
  const frame = { duration: 1, trip: 1e-4, rods: [ROD], target, forceUnit: impedance * speed, ...still };
  const field = new WaveField({ ...frame, f0Time: [0, 1], f0: [1, 1] });
  const [{ force, place }] = wallOf(frame);
  const [part, factor] = force;
  const read = (view, trip) =>
    overTime({ field, frame }, place, view, trip, (stretch) => [{ ...field.over(place, stretch, part), factor }]);
  const [{ x, y }] = read([0, 2], frame.trip);
  const borne = Array.from(y, (value) => value * factor);
  const doubled = 2 * impedance * speed;
  assert.deepEqual(Array.from(new Set(x)), [0, 0.5, 1]); // a jump as steep as the front; nothing after what was solved
  assert.deepEqual([...borne.slice(0, 2), ...borne.slice(-2)], [0, 0, doubled, doubled]);
  assert.deepEqual(Array.from(new Set(read([0, 2], 2 * frame.trip)[0].x)), [0, 0.25, 0.5]); // on another impact's axis
  assert.deepEqual(read([1, 2], frame.trip), []);
});

test('nothing holds a free rod, one without end, or one that turns', () => {
  const frame = { forceUnit: 1, rods: [ROD] };
  for (const target of [{ support: 'free' }, { support: 'anechoic' }, { support: 'fixed', rotation: {} }])
    assert.deepEqual(wallOf({ ...frame, target }), []);
  assert.deepEqual(wallOf({ ...frame, rods: [], target: { support: 'fixed' } }), []);
});

test('supports of a beam push back with minus the shear force at its first end, with it at its last', () => {
  const of = (support) =>
    supportsOf({ beam: { length: 0.3, support } }).map((each) => [each.place, ...each.force, Boolean(each.moment)]);
  assert.deepEqual(of('cantilever'), [[0, 'shear', -1, true]]);
  assert.deepEqual(of('clamped-clamped'), [
    [0, 'shear', -1, true],
    [0.3, 'shear', 1, true],
  ]);
  assert.deepEqual(of('pinned-pinned'), [
    [0, 'shear', -1, false],
    [0.3, 'shear', 1, false],
  ]);
  assert.deepEqual(of('free-free'), []);
});
