// What things are called, and sentences made of the catalogue.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { described, numeral, said, text } from '../../app/static/text/catalogue.js';
import { unbroken } from '../../app/static/text/format.js';
import { noteOf } from '../../app/static/frame/story.js';
import { byOf, called, errorsOf, LABELS } from '../../app/static/text/words.js';

test('a method with its resolution', () => {
  assert.equal(described('modal modes=50'), '50 modes');
  assert.equal(described('fe-nodal elements=12 scheme=central-difference'), '12 finite elements, central differences');
  assert.equal(described('waves tolerance=1e-05'), 'exact waves, tolerance 10⁻⁵');
  assert.equal(described('quasi-static model=local'), 'quasi-static contact');
  assert.equal(described('quasi-static model=structural'), 'quasi-static structure');
  assert.equal(called({ name: 'quasi-static', model: 'local' }), 'quasi-static contact');
  assert.equal(described('rigid model=poisson'), 'rigid bodies, poisson');
  assert.equal(described('balance restitution=0 modes=50'), 'impulse–momentum balance, 50 modes, restitution 0');
  assert.equal(called({ name: 'modal', modes: 1 }), '1 mode');
  assert.equal(called({ name: 'fe-modal', modes: 1 }), 'FE modal superposition, 1 mode');
  assert.equal(called({ name: 'fe-nodal', elements: 4 }), '4 finite elements');
  assert.equal(called({ name: 'rigid' }), 'rigid bodies');
});

test('of which solution a picture is, and how wrong that may be', () => {
  const solution = (/** @type {number | null} */ estimated_error, /** @type {any[]} */ ...notes) =>
    byOf('modes', errorsOf({ diagnostics: { estimated_error }, notes })).map((each) => each.replaceAll('\u00a0', ' '));
  const ripples = (/** @type {number} */ share) => ({ code: 'law-ripples', severity: 'warning', values: { share } });
  assert.deepEqual(solution(null), ['solved by modes']);
  assert.deepEqual(solution(0.0152), ['solved by modes', 'error of rebound 1.5 %']);
  assert.deepEqual(solution(1e-9, ripples(87)).slice(1), ['error of rebound < 10⁻⁵ %', 'of peak force 87 %']);
});

test('a note names things as the controls do', () => {
  const values = { slenderness: 3.3333, theory: 'euler-bernoulli', least: 10 };
  const note = { code: 'beam-not-slender', severity: 'warning', values };
  assert.equal(
    said(note),
    'The beam is 3.33 times as long as deep, and Euler-Bernoulli theory is meant for 10 times and more: ' +
      'use Theory: Timoshenko.',
  );
});

test('of more modes than the page has it says so', () => {
  const advice = (/** @type {number} */ needed) =>
    said({
      code: 'front-unresolved',
      severity: 'warning',
      values: { lasts: 1e-6, kind: 'modes', period: 2e-6, needed },
    });
  assert.match(
    advice(10102),
    /blurred; 10102 modes, more than the 200 that the page has, would show them, or use exact waves/,
  );
  assert.match(advice(150), /blurred; 150 modes would show them/);
});

test('plural forms and choices', () => {
  const of = (/** @type {number} */ others) =>
    text('near-grazing', { change: 1.234, heavier: true, others, contacts: 2 }).split('.').slice(0, 2).join('.');
  assert.equal(of(1), 'Near grazing: with the mass 1.2\u00a0% heavier there would be one contact instead of 2');
  assert.equal(of(3), 'Near grazing: with the mass 1.2\u00a0% heavier there would be 3 contacts instead of 2');
});

test('formats of Python', () => {
  const cases = [
    [1234.5, '.3g', '1.23·10³'],
    [0.00012346, '.3g', '0.000123'],
    [1.2e-5, '.3g', '1.2·10⁻⁵'],
    [-2, '+.4g', '−2'],
    [2, '+.4g', '+2'],
    [0.126, '.1%', '12.6%'],
    [3.14159, '.2f', '3.14'],
    [1e-12, '.0e', '10⁻¹²'],
    [400000, 'g', '400000'],
  ];
  for (const [value, format, shown] of cases) assert.equal(numeral(Number(value), String(format)), shown);
});

test('a text or a value that is not there is an error', () => {
  assert.throws(() => text('no-such-code'), /no text for no-such-code/);
  assert.throws(() => text('contact-missed', {}), /no value for start/);
});

test('a scene that sets keys without a control says which', () => {
  /** @type {any} */
  const plain = {
    kind: 'axial',
    title: 'Rod: two contacts',
    acting: [],
    chosen: { bodies: '' },
    own: { bodies: '' },
    parts: [],
    unshown: [],
  };
  const keys = noteOf({ ...plain, note: '', unshown: ['method.status'] }, '');
  assert.match(keys, /method\.status.*impact solve --set KEY=VALUE/);
  assert.equal(noteOf({ ...plain, note: 'of a rod' }, 'Thesis.'), 'Thesis. of a rod');
  const changed = { ...plain, note: 'of a rod', chosen: { bodies: 'target.length=0.5 impactor.material=bronze' } };
  const what = 'Length 500\u00a0mm (body 2), Material Bronze (body 1)';
  assert.equal(noteOf(changed, 'Thesis.'), `Changed from the scene “Rod”: ${what}.`); // nothing that held for that
  const faster = { ...plain, note: 'of a rod', acting: ['speed', 'modes'], chosen: { bodies: '', speed: 2, modes: 5 } };
  const found = noteOf({ ...faster, own: { bodies: '', speed: 1, modes: 50 } }, 'Thesis.');
  assert.equal(found, 'Changed from the scene “Rod”: 2\u00a0m/s.');
});

test('a unit stays with its number', () => {
  assert.match(text('space.touch', { impulse: '1.2' }), /is 1\.2\u00a0N\u00a0s\.$/);
  assert.equal(
    unbroken('of 3 N m s in 10⁻⁵ % of 2 T, 5 modes'),
    'of 3\u00a0N\u00a0m\u00a0s in 10⁻⁵\u00a0% of 2\u00a0T, 5 modes',
  );
});

test('every choice has a title', () => {
  for (const [name, { title }] of Object.entries(LABELS)) assert.ok(title, name);
});
