// What a link hides, fixes and bounds: names and numbers that are possible, and a sentence for each that is not.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Held } from '../../app/static/wire/held.js';

const SPEC = {
  scene: { default: 'fixed-rod' },
  method: { default: 'modal', options: ['modal', 'rigid'] },
  mass_ratio: { default: 1, low: 0.001, high: 1000, whole: false },
  modes: { default: 5, low: 1, high: 200, whole: true },
  bodies: { default: '' },
};
const held = (search) => new Held(search, SPEC);

test('names and bounds are taken, and said again', () => {
  const found = held('?scene=fixed-rod&hide=method,bodies&fix=scene&bound=mass_ratio:0.1:2,modes:1:10');
  assert.deepEqual(found.refused, []);
  assert.deepEqual(found.said, [
    ['hide', 'method,bodies'],
    ['fix', 'scene'],
    ['bound', 'mass_ratio:0.1:2,modes:1:10'],
  ]);
  assert.deepEqual(
    ['method', 'scene', 'mass_ratio', 'modes'].map((name) => found.stays(name)),
    [true, true, false, false],
  );
  assert.deepEqual([found.within('mass_ratio', 5, 1), found.within('mass_ratio', 0.01, 1)], [2, 0.1]);
  assert.deepEqual([found.within('method', 'rigid', 'modal'), found.within('scene', 'x', 'y')], ['modal', 'y']);
  assert.equal(held('').within('mass_ratio', 5, 1), 5);
  assert.deepEqual(held('').said, []);
});

test('what is said of large and small numbers is taken again', () => {
  const spec = {
    hertz_stiffness: { default: 1e9, low: 1e6, high: 1e14, whole: false },
    gap: { default: 0, low: 0, high: 1 },
  };
  const { said } = new Held('?bound=hertz_stiffness:1e6:1e14,gap:1.23456789e-6:1e-3', spec);
  const again = new Held(`?${said.map((each) => each.join('=')).join('&')}`, spec);
  assert.deepEqual(again.refused, []);
  assert.deepEqual(
    [...again.bounds.values()],
    [
      [1e6, 1e14],
      [1.23456789e-6, 1e-3],
    ],
  );
});

test('values of bodies stay where they would move a choice that does not', () => {
  const stay = (search) => held(search).bodies;
  assert.deepEqual(['?fix=mass_ratio', '?bound=mass_ratio:0.1:2', '?hide=mass_ratio'].map(stay), [true, true, true]);
  assert.deepEqual(['', '?fix=method&hide=bodies&bound=modes:1:9'].map(stay), [false, false]);
});

test('what cannot be is refused with its key, what was given, and what is allowed', () => {
  const said = (search, acting = Object.keys(SPEC)) => held(search).refusals(acting);
  assert.deepEqual(said('?hide=methods'), [
    'hide: got methods; allowed in this scene: scene, method, mass_ratio, modes, bodies, closer.',
  ]);
  assert.deepEqual(said('?fix=bodies'), ['fix: got bodies; allowed in this scene: scene, method, mass_ratio, modes.']);
  assert.deepEqual(said('?bound=method:1:2'), ['bound: got method; allowed in this scene: mass_ratio, modes.']);
  assert.deepEqual(said('?hide=methods', ['scene', 'mass_ratio', 'bodies']), [
    'hide: got methods; allowed in this scene: scene, mass_ratio, bodies, closer.',
  ]);
  const number = 'allowed: mass_ratio:LOW:HIGH, with two numbers from 0.001 to 1000, the lower one first.';
  for (const bad of [
    'mass_ratio',
    'mass_ratio:1',
    'mass_ratio:2:1',
    'mass_ratio:0:1',
    'mass_ratio:1:2:3',
    'mass_ratio:a:2',
  ])
    assert.deepEqual(held(`?bound=${bad}`).refused, [`bound: got ${bad}; ${number}`]);
  const [whole] = held('?bound=modes:1.5:10').refused;
  assert.ok(whole.endsWith('with two whole numbers from 1 to 200, the lower one first.'));
  for (const bad of ['__proto__', 'constructor', 'x'.repeat(999)]) {
    const found = held(`?fix=${bad}`);
    assert.ok(found.fixed.size === 0 && found.refusals(Object.keys(SPEC))[0].length < 140);
  }
});

test('what is hidden and fixed at once is said, and hidden', () => {
  const found = held('?hide=method,modes&fix=modes,mass_ratio,method');
  assert.deepEqual(found.refusals([]), ['hide and fix: got method, modes in both; what is hidden is fixed, too.']);
  assert.deepEqual(found.said, [
    ['hide', 'method,modes'],
    ['fix', 'mass_ratio'],
  ]);
});

test('a scene that comes has its values brought within the bounds, once', () => {
  const found = held('?bound=mass_ratio:0.1:0.5');
  assert.deepEqual(found.beyond({ scene: 'a', mass_ratio: 1 }), [['mass_ratio', 0.5]]);
  assert.deepEqual(found.beyond({ scene: 'a', mass_ratio: 1 }), []);
  assert.deepEqual(found.beyond({ scene: 'b', mass_ratio: 0.2 }), []);
});

test('a lesson says itself what may be moved', () => {
  assert.deepEqual(held('?lesson=bounce-twice&hide=method').said, []);
});
