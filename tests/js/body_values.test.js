// Values of bodies: what is typed, what is shown, and both in an address.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { entriesOf, inUnit, read, textOf, unitOf, written } from '../../app/static/wire/body_values.js';
import { text } from '../../app/static/text/catalogue.js';
import { ambiguous, signsOf, typed } from '../../app/static/text/units.js';
import { keptOf, keptText } from '../../app/static/frame/kept.js';

const MM = unitOf('length', 0.3);

test('a number is in the unit of its field, or in the one behind it', () => {
  assert.equal(MM.sign, 'mm');
  const lengths = {
    600: 0.6,
    '0,6 m': 0.6,
    '60cm': 0.6,
    '600 mm': 0.6,
    '6e5 um': 0.6,
    '.1': 1e-4,
    '1/3 m': 1 / 3,
    '12 in': 0.3048,
    '1/2"': 0.0127,
    '3 feet': 0.9144,
  };
  for (const [given, metres] of Object.entries(lengths))
    assert.equal(read(given, 'length', MM), Number(metres.toPrecision(12)), given);
  assert.equal(read('2 lb', 'mass', unitOf('mass', 0.5)), 0.90718474);
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
    '1/0',
    '1/3/4',
    '<b>1',
    '1e',
    'Infinity',
    '1 constructor',
  ])
    assert.ok(Number.isNaN(read(given, 'length', MM)), given);
  assert.ok(Number.isNaN(read('0.3 m', 'material.poisson', unitOf('material.poisson', 0.3))));
});

test('fractions, and units of what is set by a slider', () => {
  /** @type {[given: string, si: string, factor: number, value: number][]} */
  const cases = [
    ['1/3', '', 1, 0.333333333333],
    ['1 / 4', 'm/s', 1, 0.25],
    ['100 km/h', 'm/s', 1, 27.7777777778],
    ['−30 °', '°', 1, -30],
    ['2 kN', 'N', 1, 2000],
    ['3e9 N/m¹·⁵', 'N/m¹·⁵', 1, 3e9],
    ['5', '1', 0.01, 0.05],
    ['5 %', '1', 0.01, 0.05],
    ['250 us', 's', 1e-3, 250e-6],
    ['1 g', 'm/s²', 1, 9.80665],
  ];
  for (const [given, si, factor, value] of cases) assert.equal(typed(given, si, factor), value, given);
  for (const given of ['2 kg', '1 toString', '1/0', 'e', '1 1'])
    for (const si of ['m/s', '', 'N/m¹·⁵']) assert.ok(Number.isNaN(typed(given, si)), given);
  const said = { control: 'Speed', value: '“2 kg”', whole: false, low: 0.01, high: 100, unit: 'm/s' };
  assert.match(
    text('refused.typed', { ...said, units: signsOf('m/s') }),
    /1\/3, from 0\.01 to 100\sm\/s, .*km\/h, mph/,
  );
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
  const saved = keptText(runs, /** @type {any} */ (frame));
  assert.equal(saved, 'A,target.length:0.6,target.rods.2.material:bronze,modes:5');
  const spec = /** @type {any} */ ({ modes: { low: 1, high: 200, whole: true } });
  assert.deepEqual(keptOf(saved, spec), [{ letter: 'A', settings: { modes: 5, bodies } }]);
  for (const bad of ['A,target.length', 'A,target.length:', 'A,target.length:1:2', 'A,target.length:<b>'])
    assert.equal(keptOf(bad, spec), null, bad);
});

test('a comma that may stand for thousands is refused, others are decimal', () => {
  for (const given of ['1,000', '12,500 mm', '-1,000', '1,000,000', '1/1,000', '1,000.5'])
    assert.ok(Number.isNaN(typed(given, 'm')), given);
  for (const given of ['1,000', '1/1,000']) assert.ok(ambiguous(given), given);
  /** @type {[given: string, value: number][]} */
  const clear = [
    ['0,125', 0.125],
    ['1,5', 1.5],
    ['1,25', 1.25],
    ['1234,567', 1234.567],
    ['1,0000', 1],
    ['1.000', 1],
  ];
  for (const [given, value] of clear) assert.equal(typed(given, 'm'), value, given);
});
