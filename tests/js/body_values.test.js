// Values of bodies: what is typed, what is shown, and both in an address.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { entriesOf, inUnit, read, textOf, unitOf, written } from '../../app/static/shell/body_values.js';
import { keptOf, keptText } from '../../app/static/shell/kept.js';

const MM = unitOf('length', 0.3);

test('a number is in the unit of its field, or in the one behind it', () => {
  assert.equal(MM.sign, 'mm');
  const typed = { 600: 0.6, '0,6 m': 0.6, '60cm': 0.6, '600 mm': 0.6, '6e5 um': 0.6, '.1': 1e-4 };
  for (const [given, metres] of Object.entries(typed)) assert.equal(read(given, 'length', MM), metres, given);
  assert.equal(read('2.1e5 MPa', 'material.young', unitOf('material.young', 210e9)), 210e9);
  assert.equal(read('7.9 g/cm3', 'material.density', unitOf('material.density', 7900)), 7900);
  assert.equal(read('0.3', 'material.poisson', unitOf('material.poisson', 0.3)), 0.3);
});

test('what is no number of that unit is none', () => {
  for (const given of [
    '2 kg',
    'nan',
    '-',
    '',
    'abc',
    '1 000',
    '0x10',
    '1/3',
    '<b>1',
    '1e',
    'Infinity',
    '1 constructor',
  ])
    assert.ok(Number.isNaN(read(given, 'length', MM)), given);
  assert.ok(Number.isNaN(read('0.3 m', 'material.poisson', unitOf('material.poisson', 0.3))));
});

test('units suit the size, and what is shown is read again', () => {
  /** @type {[string, number, string][]} */
  const cases = [
    ['length', 0.3, '300 mm'],
    ['length', 2, '2 m'],
    ['mass', 0.5, '500 g'],
    ['mass', 2.133, '2.133 kg'],
    ['material.young', 210e9, '210 GPa'],
    ['material.yield', 400e6, '400 MPa'],
    ['section.area', 9e-4, '900 mm²'],
    ['round_trip', 1.1637e-4, '116 µs'],
    ['wave_speed', 5155.8, '5156 m/s'],
  ];
  for (const [quantity, value, shown] of cases) assert.equal(written(quantity, value), shown);
  for (const [quantity, value] of cases.slice(0, 6)) {
    const unit = unitOf(quantity, value);
    assert.equal(read(inUnit(value, unit), quantity, unit), value);
  }
});

test('kept bodies are in an address by keys of their own', () => {
  const bodies = 'target.length=0.6 target.rods.2.material=bronze';
  assert.equal(textOf(entriesOf(bodies)), bodies);
  assert.deepEqual(entriesOf(''), []);
  const own = { scene: 'a', bodies: '', modes: 50 };
  const frame = { own: { ...own, bodies }, acting: ['scene', 'bodies', 'modes'], chosen: { ...own, bodies, modes: 5 } };
  const runs = /** @type {any} */ ([{ letter: 'A', frame }]);
  const text = keptText(runs, /** @type {any} */ (frame));
  assert.equal(text, 'A,target.length:0.6,target.rods.2.material:bronze,modes:5');
  const spec = /** @type {any} */ ({ modes: { low: 1, high: 200, whole: true } });
  assert.deepEqual(keptOf(text, spec), [{ letter: 'A', settings: { modes: 5, bodies } }]);
  for (const bad of ['A,target.length', 'A,target.length:', 'A,target.length:1:2', 'A,target.length:<b>'])
    assert.equal(keptOf(bad, spec), null, bad);
});
