// Designs beside the map: what they hold, how they are compared, and what lies between two of them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compares } from '../../app/static/compare/kinds.js';
import { differsBeyond, comparedIn } from '../../app/static/whatif/designs.js';
import { inputsOf, tableOf } from '../../app/static/whatif/inputs.js';
import { Letters } from '../../app/static/whatif/letters.js';
import { between, changesOf, shareAlong } from '../../app/static/whatif/morph.js';
import { COLUMNS, listed } from '../../app/static/wasm/columns.js';

compares({ axial: { law: ({ exponent }) => ({ exponent }) } });

const axis = (name, low, high, more = {}) => ({
  ...{ name, title: name, unit: '', factor: 1, low, high, log: true, whole: false, body: false, of: '' },
  ...more,
});
const AXES = [
  axis('mass_ratio', 1e-3, 1e3),
  axis('place', 0, 1, { log: false }),
  axis('modes', 1, 200, { whole: true }),
  axis('target.length', 0.1, 10, { body: true }),
];
const HEAD = `title = "A rod, \\"steel\\" [1]"
source = ""
[impactor]
kind = "mass"
mass = 2.1329999999999996
material = { young = 210000000000.0, density = 7900.0, poisson = 0.3 }
[target]
links = [{ name = "crank, [short]", from = [0.0, -0.3], mass = 1e-05 }, { name = "bar", modes = 12, open = true }]
normal = []
[contact]
law = "hertz"
stiffness = 10000000000.0
[saved]
methods = { waves = { name = "waves", tolerance = 1e-09 } }`;

/** @returns {any}  as much of an answer as is looked at */
const frameOf = (changed = {}, length = 2) => ({
  kind: 'axial',
  exponent: 1.5,
  head: HEAD,
  acting: ['scene', 'bodies', 'mass_ratio', 'place', 'modes', 'law'],
  chosen: { scene: 'fixed-rod', bodies: '', mass_ratio: 1, place: 1, modes: 50, law: 'hertz', ...changed },
  parts: [{ key: 'target', values: [{ quantity: 'length', value: length }] }],
});
const found = (row) => listed({ contacts: 1, ...row });

test('what a scene file holds is read by its keys, parts of lists by their numbers', () => {
  assert.deepEqual(Object.fromEntries(inputsOf(HEAD)), {
    'impactor.kind': 'mass',
    'impactor.mass': 2.1329999999999996,
    'impactor.material.young': 2.1e11,
    'impactor.material.density': 7900,
    'impactor.material.poisson': 0.3,
    'target.links.0.name': 'crank, [short]',
    'target.links.0.from': '0 -0.3',
    'target.links.0.mass': 1e-5,
    'target.links.1.name': 'bar',
    'target.links.1.modes': 12,
    'target.links.1.open': true,
    'target.normal': '',
    'contact.law': 'hertz',
    'contact.stiffness': 1e10,
  });
});

test('a table has units in its head, a row for each design, and nothing where there is no figure', () => {
  const own = frameOf();
  const soft = { ...frameOf(), exponent: 1, head: '[contact]\nlaw = "linear"\nstiffness = 5.0\ndamping = 0.5' };
  const one = { name: 'A', frame: own, found: found({ peak_force: 15785.4874032183 }) };
  const rows = (designs) => tableOf(designs, 'a,b').split('\n');
  const [link, head, first, last] = rows([one]);
  assert.deepEqual([link, last], ['# link = "a,b"', '']);
  const names = head.split(',');
  assert.deepEqual(names.slice(0, 4), ['design', 'scene', 'impactor.kind', 'impactor.mass [kg]']);
  for (const name of ['target.links.0.mass [kg]', 'contact.stiffness [N/m^1.5]', 'peak_force [N]', 'vibration'])
    assert.ok(names.includes(name), name);
  assert.ok(first.startsWith('A,fixed-rod,mass,2.1329999999999996,210000000000,'));
  assert.ok(first.includes('"crank, [short]"') && first.includes(',15785.4874032183,') && first.endsWith(','));
  const [, both, , other] = rows([one, { name: 'B', frame: soft, found: found({}) }]);
  assert.ok(both.includes('contact.stiffness [N/m^n]') && both.includes('contact.damping'));
  assert.ok(other.startsWith('B,fixed-rod,,,') && other.includes(',linear,5,0.5,1,'));
  assert.equal(both.split(',').length, other.split(',').length);
  assert.equal(both.split(',').length, 2 + 15 + COLUMNS.length - 1);
});

test('numbers have values between them along each axis, and what is no number has none', () => {
  const from = frameOf({ place: 0.2, modes: 10 });
  const to = frameOf({ mass_ratio: 100, place: 0.6, modes: 40, bodies: 'target.length=8' }, 8);
  const { changes, others } = changesOf(AXES, from, to);
  assert.deepEqual([changes.map((each) => each.axis.name), others], [AXES.map(({ name }) => name), []]);
  const middle = between(changes, from, to, 0.5);
  assert.ok(Math.abs(middle.mass_ratio - 10) < 1e-9 && Math.abs(middle.place - 0.4) < 1e-9);
  assert.equal(middle.modes, 20);
  assert.ok(Math.abs(Number(middle.bodies.split('=')[1]) - 4) < 1e-9 && middle.bodies.startsWith('target.length='));
  assert.equal(between(changes, from, to, 0), from.chosen);
  assert.equal(between(changes, from, to, 1), to.chosen);
  assert.ok(Math.abs(shareAlong(changes, frameOf({ mass_ratio: 10 })) - 0.5) < 1e-9);
  assert.equal(shareAlong(changes, frameOf({ mass_ratio: 1000 })), 1);
  const rigid = changesOf(AXES, from, frameOf({ law: 'rigid' }));
  assert.deepEqual(rigid.others, ['Contact law']);
  const bronze = changesOf(AXES, from, frameOf({ place: 0.2, modes: 10, bodies: 'target.material=bronze' }));
  assert.deepEqual([bronze.changes, bronze.others], [[], ['Material']]);
});

test('a design is on the map where nothing but its axes differs', () => {
  const now = frameOf();
  const [ratio, , , length] = AXES;
  assert.ok(!differsBeyond(now, frameOf({ mass_ratio: 3, bodies: 'target.length=8' }), [ratio, length]));
  assert.ok(differsBeyond(now, frameOf({ mass_ratio: 3, bodies: 'target.length=8' }), [ratio]));
  assert.ok(differsBeyond(now, frameOf({ law: 'rigid' }), [ratio, length]));
});

test('the result and the contacts are compared, else what differs most', () => {
  const spoken = (now, kept, result = 'peak_force') =>
    comparedIn(found(now), found(kept), result).replaceAll('\u00a0', ' ');
  assert.equal(
    spoken({ peak_force: 11200, contacts: 2 }, { peak_force: 1e4 }),
    'peak force 11.2 kN instead of 10 kN: 12 % more; contacts 2 instead of 1',
  );
  assert.equal(
    spoken({ peak_force: 1e4, peak_stress: 3e8 }, { peak_force: 1e4, peak_stress: 1e8 }),
    'peak stress 300 MPa instead of 100 MPa: 3 times as much',
  );
  assert.match(spoken({ peak_force: 10001 }, { peak_force: 1e4 }), /^No figure differs by half a percent/);
  assert.equal(spoken({ newton: NaN }, { newton: 0.5, contacts: 3 }, 'newton'), 'contacts 1 instead of 3');
});

test('letters stand where they are, at the edge where they are out of view, and the last is on top', () => {
  const drawn = new Proxy({}, { get: () => () => ({ width: 8 }), set: () => true });
  const letters = new Letters();
  const kept = [
    { letter: 'A', at: [0.5, 0.5], hollow: true },
    { letter: 'B', at: [0.5, 0.5], hollow: false },
    { letter: 'C', at: [9, 0.25], hollow: false },
  ];
  const spotOf = ([x, y]) => [100 + 200 * x, 50 + 100 * y];
  letters.draw(drawn, { x: 100, y: 50, w: 200, h: 100 }, kept, [[0, 0], [1, 1]], spotOf); // prettier-ignore
  assert.equal(letters.under(203, 98), 'B');
  const [, , [name, [x, y]]] = letters.spots;
  assert.deepEqual([name, y], ['C', 75]);
  assert.ok(x > 260 && x < 300);
  assert.equal(letters.under(120, 60), null);
});
