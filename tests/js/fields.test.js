// Fields rebuilt in the browser, against closed forms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { attachedModes } from '../../app/static/axial/attached_modes.js';
import { Field, RigidField, WaveField } from '../../app/static/axial/fields.js';
import { ModalField } from '../../app/static/axial/modal_field.js';
import { SampledField } from '../../app/static/axial/sampled_field.js';
import { fieldOf } from '../../app/static/beam/field_of.js';
import { between } from '../../app/static/charts/scale.js';

const near = (found, expected, error) =>
  assert.ok(Math.abs(found - expected) <= error, `${found} is not ${expected} within ${error}`);
const ROD = { from: 0, to: 2, transit: 0.5, impedance: 1, drift: 0, area: 1, joint: null };
const still = {
  motionTime: [0, 1, 2],
  exactMass: [0, 1, 0],
  exactEnd: [0, 0.5, 0],
  otherMass: [0, 1, 2],
  otherEnd: [0, 2, 4],
};

test('bodies without waves move as a whole', () => {
  const field = new Field({ duration: 2, ...still }, 'exact');
  assert.equal(field.mass(0.5), 0.5);
  assert.deepEqual([...field.profile(1, 'displacement', new Float64Array(3))], [0.5, 0.5, 0.5]);
  assert.deepEqual([...field.profile(1, 'stress', new Float64Array(3))], [0, 0, 0]);
});

test('a method that tells no places apart has rigid rods, and what is held stays', () => {
  const rods = [{ ...ROD, from: -1, to: 0 }, ROD];
  for (const held of [false, true]) {
    const field = new RigidField({ duration: 2, rods, target: { held }, ...still });
    const [mass, end] = [1, held ? 0 : 2];
    assert.deepEqual([...field.profile(1, 'displacement', new Float64Array(6))], [mass, mass, end, end, end, end]);
    assert.deepEqual([...field.profile(1, 'stress', new Float64Array(3))], [0, 0, 0]);
    assert.deepEqual([field.face(1), field.end(1)], [end, 2]); // what its method says of the face is in the charts
  }
});

test('a step of stress runs along a rod and is doubled at its fixed end', () => {
  const rods = [{ ...ROD, mirror: 1 }];
  const frame = { duration: 2, rods, f0Time: [0, 2], f0: [1, 1], exactForce: [1], ...still };
  const field = new WaveField(frame);
  const profile = (t, what) => [...field.profile(t, what, new Float64Array(5))];
  assert.deepEqual(profile(0.26, 'stress'), [1, 1, 1, 0, 0]);
  assert.deepEqual(profile(0.26, 'velocity'), [1, 1, 1, 0, 0]);
  assert.deepEqual(profile(0.76, 'stress'), [1, 1, 2, 2, 2]);
  assert.deepEqual(profile(0.76, 'velocity'), [1, 1, 0, 0, 0]);
  near(profile(0.4, 'displacement')[0], 0.4, 1e-12);
  assert.equal(field.largest('stress'), 2);
  assert.equal(field.largest('velocity'), 1);
});

test('at a free end the step comes back turned over', () => {
  const frame = { duration: 2, rods: [{ ...ROD, mirror: -1 }], f0Time: [0, 2], f0: [1, 1], exactForce: [1], ...still };
  const field = new WaveField(frame);
  assert.deepEqual([...field.profile(0.76, 'stress', new Float64Array(5))], [1, 1, 0, 0, 0]);
  assert.deepEqual([...field.profile(0.76, 'velocity', new Float64Array(5))], [1, 1, 2, 2, 2]);
});

test('sampled fields are straight in time and place', () => {
  const places = 4;
  const frame = { duration: 10, rods: [ROD], shapes: { fieldStress: [3, places] }, ...still };
  const table = Array.from({ length: 3 * places }, (_, p) => 5 * Math.floor(p / places) + (p % places));
  const field = new SampledField(
    { ...frame, fieldStress: table, fieldVelocity: table, fieldDisplacement: table },
    'other',
  );
  const out = field.profile(2.5, 'stress', new Float64Array(7));
  [...out].forEach((value, k) => near(value, 2.5 + k / 2, 1e-12));
});

test('modes of a rod under a constant force swing about their static deflection, whichever way time goes', () => {
  const [modes, step, steps] = [5, 0.001, 2000];
  const frame = {
    duration: 2,
    rods: [{ ...ROD, mirror: 1 }],
    modes,
    step,
    modalForce: Array(steps).fill(0.7),
    ...still,
  };
  const field = new ModalField(frame);
  const moved = (t) => field.profile(t, 'displacement', new Float64Array(3))[0];
  const expected = (t) => {
    let sum = 0;
    for (let i = 0; i < modes; i++) {
      const omega = 2 * Math.PI * (i + 0.5);
      sum += ((4 * 0.7) / omega ** 2) * (1 - Math.cos(omega * t));
    }
    return sum;
  };
  for (const t of [0.3, 1.9, 0.1, 1.2]) near(moved(t), expected(t), 1e-6);
  for (const t of [0.3, 1.9]) near(field.profile(t, 'stress', new Float64Array(3))[0], 0.7, 1e-6); // where it presses
});

test('a damped mode of a beam under a constant force settles as an oscillator does', () => {
  const [omega, damping, step, force] = [900, 0.05, 1e-5, 3];
  const table = (name) => ({ [`${name}Rows`]: [1, 2, 3], [`${name}Scale`]: [0.5] });
  const field = fieldOf({
    duration: 20e-3,
    places: 3,
    modalForce: Array(2000).fill(force),
    modalFrequencies: [omega],
    modalAtContact: [2],
    ...table('shape'),
    ...table('moment'),
    ...table('shear'),
    momentBeside: [0, 0, 1],
    shearBeside: [0, 0, 0],
    damping,
    step,
    smoothing: 0,
    rigidMass: null,
    drift: 0,
  });
  const shape = [0.5, 1, 1.5];
  for (const t of [4e-3, 15e-3, 1e-3]) {
    const damped = omega * Math.sqrt(1 - damping ** 2);
    const fade = Math.exp(-damping * omega * t);
    const swing = Math.cos(damped * t) + ((damping * omega) / damped) * Math.sin(damped * t);
    const q = ((2 * force) / omega ** 2) * (1 - fade * swing);
    const found = field.profile(t, 'deflection');
    shape.forEach((value, j) => near(found[j], value * q, 1e-10));
    near(field.profile(t, 'moment')[2], shape[2] * q + force, 1e-8);
  }
  const [span, parts] = [2e-3, 200];
  let sum = 0;
  for (let k = 0; k < parts; k++) sum += field.profile(4e-3 + (k / parts - 0.5) * span, 'moment')[1];
  near(field.mean(4e-3, span, 'moment', new Float64Array(3))[1], sum / parts, 1e-8); // of what swings in that time
  near(field.mean(4e-3, step, 'moment', new Float64Array(3))[1], field.profile(4e-3, 'moment')[1], 1e-12);
});

const STEP = { duration: 2, f0Time: [0, 2], f0: [1, 1], exactForce: [1], ...still };
const pairs = ({ x, y }) => Array.from(x, (each, k) => [each, y[k]]);
/** Pairs that are those expected, fronts to a part in 1e8. */
const nearly = (found, expected) => {
  assert.equal(found.length, expected.length, JSON.stringify(found));
  found.forEach((pair, k) => pair.forEach((value, i) => near(value, expected[k][i], 1e-8)));
};

test('a front is a vertical step over place and over time', () => {
  const field = new WaveField({ ...STEP, rods: [{ ...ROD, mirror: -1 }] });
  const front = [
    [0, 1],
    [1.2, 1],
    [1.2, 0],
    [2, 0],
  ];
  nearly(pairs(field.along(0.3, 'stress')), front);
  nearly(pairs(field.along(0.3, 'velocity')), front); // in units in which rho c is 1
  nearly(pairs(field.over(1.2, [0, 0.5], 'stress')), [
    [0, 0],
    [0.3, 0],
    [0.3, 1],
    [0.5, 1],
  ]);
  const moved = field.along(0.3, 'displacement');
  nearly(pairs(moved).slice(0, 2), [
    [0, 0.3],
    [1.2, 0],
  ]);
});

test('two waves apart add up to the stress and differ by the velocity, in every rod', () => {
  const second = { ...ROD, from: 2, to: 3, impedance: 0.5, area: 0.25, transit: 0.25, mirror: 0 };
  const waves = { f0Time: [0, 2], f0: [1, 1], g0Time: [0, 0.5, 0.5, 2], g0: [0, 0, -1 / 3, -1 / 3] };
  const on = { f1Time: [0, 0.5, 0.5, 2], f1: [0, 0, 2 / 3, 2 / 3], g1Time: [0, 2], g1: [0, 0] };
  const rods = [{ ...ROD, mirror: 0 }, second];
  const field = new WaveField({ duration: 2, rods, exactForce: [1], ...waves, ...on, ...still });
  const [stress, velocity, right, left] = ['stress', 'velocity', 'right', 'left'].map((w) => field.along(0.6, w));
  const at = ({ x, y }, place) => between(x, y, place);
  for (const place of [0.1, 1.3, 1.7, 2.2, 2.39, 2.41, 2.9]) {
    const { area, impedance } = rods[Number(place > 2)];
    near(at(right, place) + at(left, place), at(stress, place), 1e-8);
    near(((at(right, place) - at(left, place)) * area) / impedance, at(velocity, place), 1e-8);
  }
  near(at(right, 1.8), 1, 1e-12); // one third of the force has come back as tension, two thirds have gone on
  near(at(left, 1.8), -1 / 3, 1e-12);
  near(at(right, 2.1), 8 / 3, 1e-12);
  near(at(left, 2.1), 0, 1e-12);
});

test('fields that know no waves have them from stress and velocity, without the velocity the rod has anyway', () => {
  const rod = { ...ROD, impedance: 0.5, area: 0.25, drift: 0.1 };
  const frame = { duration: 10, rods: [rod], shapes: { fieldStress: [2, 3] }, ...still };
  const even = (value) => Array(6).fill(value);
  const tables = { fieldStress: even(4), fieldVelocity: even(1.1), fieldDisplacement: even(0) };
  const field = new SampledField({ ...frame, ...tables }, 'other');
  for (const found of [field.along(5, 'right'), field.over(1, [0, 10], 'right')]) near(found.y[1], 3, 1e-12);
  for (const found of [field.along(5, 'left'), field.over(1, [0, 10], 'left')]) near(found.y[1], 1, 1e-12);
});

test('histories at a place are those of the profiles there', () => {
  const sampled = { duration: 10, rods: [ROD], shapes: { fieldStress: [2, 3] }, ...still };
  const tables = { fieldStress: [0, 1, 2, 4, 5, 6], fieldVelocity: [0], fieldDisplacement: [0] };
  nearly(pairs(new SampledField({ ...sampled, ...tables }, 'other').over(1.5, [0, 10], 'stress')), [
    [0, 1.5],
    [10, 5.5],
  ]);
  assert.equal(new Field({ duration: 2, ...still }, 'exact').over(0, [0, 2], 'stress'), null);
  const own = { duration: 2, rods: [{ ...ROD, mirror: -1 }], modes: 4, step: 0.01, modalForce: Array(200).fill(0.7) };
  const field = new ModalField({ ...own, ...still });
  for (const what of ['stress', 'velocity', 'displacement']) {
    const { x, y } = field.over(1.5, [0, 2], what);
    for (const k of [40, 250]) near(y[k], field.profile(x[k], what, new Float64Array(5))[3], 1e-5);
  }
});

test('a frame fixed to the struck end has the frequencies, shapes and stresses of solvers.numerics.rods', () => {
  const { felt, omega, rows } = attachedModes(5);
  const turns = Array.from(omega, (w) => w / 2 / Math.PI);
  [1.00054354, 2.00471949, 3.01871995, 4.06079367, 5.9757652].forEach((value, i) => near(turns[i], value, 1e-8));
  [2.00331149, 2.01480741, 2.03851379, 2.06930394, 15.62947177].forEach((value, i) => near(felt[i], value, 1e-7));
  const { cosines, sines } = rows(Float64Array.of(0, 0.3, 1));
  [1, 0.59082234, -0.99749652, 1, -0.28952096, 1.01147898].forEach((value, k) => near(cosines[k], value, 1e-8));
  [0.126974283, 0.832600557, 0, 0.254409538, 1.00790516, 0].forEach((value, k) => near(sines[k], value, 1e-8));
});

test('one mode of a frame is as fast as its shape and its inertia about the mean make it', () => {
  const { felt, omega } = attachedModes(1);
  const inertia = 0.5 - (2 / Math.PI) ** 2;
  assert.ok(Math.abs(omega[0] / (Math.PI * Math.sqrt(0.5 / inertia)) - 1) < 1e-12);
  assert.ok(Math.abs((felt[0] * inertia) / (2 / Math.PI) ** 2 - 1) < 1e-12);
});
