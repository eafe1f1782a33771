// The table behind the map, and its state in words.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { rowsOfCurves, rowsOfMap, rowsOfTolerance } from '../../app/static/whatif/behind_rows.js';
import { Curve } from '../../app/static/whatif/curve_jobs.js';
import { Lattice } from '../../app/static/whatif/lattice.js';
import { endsIn, partsIn, reasonsIn } from '../../app/static/whatif/map_words.js';
import { PLACE, WIDTH } from '../../app/static/whatif/results.js';
import { Samples } from '../../app/static/whatif/tolerance_jobs.js';
import { haltonAt } from '../../app/static/whatif/spread.js';
import { Window } from '../../app/static/whatif/window.js';

const axis = (name, low, high, more = {}) => ({
  ...{ name, title: name, unit: '', factor: 1, low, high, log: low > 0 && high >= 10 * low, whole: false },
  ...{ body: false, of: '', ...more },
});
const RATIO = axis('ratio', 1e-3, 1e3);
const SPEED = axis('speed', 0.01, 100, { unit: 'm/s' });
const AXES = { x: RATIO, y: SPEED, x0: 1.5, x1: 4.5, y0: 0, y1: 4 };

/** Figures of one impact: a force of so many times the ratio and the speed, twice struck above a product of one. */
function figuresOf(ratio, speed) {
  const found = new Float64Array(WIDTH).fill(NaN);
  found[0] = speed > 50 ? 1 : 0;
  found[PLACE.contacts] = ratio * speed > 1 ? 2 : 1;
  found[PLACE.peak_force] = ratio * speed;
  return found;
}

/** A map of which this level and what is coarser is found. */
function mapOf(stride, axes = AXES, size = [600, 400]) {
  const view = new Window(new Lattice(1), axes, size, 7);
  for (let j = 0; j < view.ny; j += stride)
    for (let i = 0; i < view.nx; i += stride) {
      const key = view.key(i, j);
      const found = figuresOf(...view.row(i, j));
      view.lattice.keep(key, found, 0);
      if (found[0]) view.lattice.why.set(key, 'too fast');
    }
  view.look();
  view.fill('peak_force');
  return view;
}

test('a table has values, contacts and reasons at equal steps from below to above', () => {
  const { caption, columns, corner, groups, notes, rows, whole } = rowsOfMap(mapOf(4), 'peak_force');
  const cells = rows.map((row) => row.cells);
  assert.ok(whole && caption.includes('Peak force') && corner === 'speed');
  assert.deepEqual(columns, ['0.03162', '0.1', '0.3162', '1', '3.162', '10', '31.62']);
  assert.deepEqual(groups, [['ratio', 7]]);
  assert.deepEqual(
    rows.map(({ head }) => head),
    ['100 m/s', '10 m/s', '1 m/s', '0.1 m/s', '0.01 m/s'],
  );
  assert.deepEqual(cells[1][1], ['1 N', '1 contact']);
  assert.deepEqual(cells[1][5], ['100 N', '2 contacts']);
  assert.deepEqual([cells[0].every(([words]) => words.includes('(1)')), notes], [true, ['1: too fast']]);
  const counts = rowsOfMap(mapOf(4), 'contacts').rows[1].cells;
  assert.deepEqual([counts[1], counts[5]], [['1', ''], ['2', '']]); // prettier-ignore
});

test('what is not found yet is said, and whole numbers stand once each', () => {
  const { rows, whole } = rowsOfMap(mapOf(64), 'peak_force');
  assert.ok(!whole && rows.some(({ cells }) => cells.some(([words]) => words === 'not yet found')));
  const modes = axis('modes', 1, 4, { whole: true });
  const { columns } = rowsOfMap(mapOf(4, { ...AXES, x: modes, x0: 0, x1: 4 }), 'peak_force');
  assert.deepEqual(columns, [...new Set(columns)]);
  assert.ok(columns.length > 2 && columns.length < 5);
});

test('words say lowest, highest and where, contacts with their ranges, and reasons', () => {
  const view = mapOf(1);
  const ends = endsIn(view, 'peak_force');
  assert.match(ends, /Lowest: 316\sµN at ratio 0\.03162, speed 0\.01\sm\/s\./);
  const [one, two, refused, ...none] = partsIn(view);
  assert.match(one, /^1\scontact in \d+\s% of the map/);
  assert.match(two, /^2\scontacts in \d+\s% of the map/);
  assert.match(refused, /cannot be computed in \d+\s% of the map, speed from 5\d\.\d+\sm\/s to 100\sm\/s$/);
  assert.ok(!/ratio from/.test(refused) && !none.length);
  const shares = [one, two, refused].map((words) => Number(/(\d+)\s%/.exec(words)[1]));
  assert.ok(Math.abs(shares[0] + shares[1] + shares[2] - 100) <= 1, shares.join());
  assert.deepEqual(reasonsIn(view), ['too fast']);
  assert.match(endsIn(mapOf(1), 'contacts'), /Lowest: 1\s.*Highest: 2\s/);
  assert.equal(endsIn(mapOf(1), 'newton'), '', 'of what is never found nothing is said');
});

test('curves have all results over one choice', () => {
  const curve = new Curve({ key: '', axis: SPEED, from: 0, to: 4, fixed: [], chosen: {} });
  curve.places.forEach((_, k) => {
    curve.found.set(figuresOf(1, 0.01 * 10 ** (k / 40)), k * WIDTH);
    curve.known[k] = 1;
  });
  const { columns, rows, whole } = rowsOfCurves(curve, ['peak_force', 'newton']);
  assert.deepEqual([whole, columns, rows.length], [true, ['Contacts', 'Peak force', 'Restitution'], 21]);
  const first = [['1 contact', ''], ['10 mN', ''], ['–', '']]; // prettier-ignore
  assert.deepEqual(rows[0], { head: '0.01 m/s', cells: first });
  assert.deepEqual([rows[15].cells[0][0], rows[20].cells[1][0]], ['2 contacts', '–']);
  curve.known[8] = 0;
  const less = rowsOfCurves(curve, ['peak_force']);
  assert.deepEqual([less.whole, less.rows.length], [false, 20]);
});

test('tolerances have quantiles and shares of every result', () => {
  const inputs = [
    { axis: RATIO, value: 1, part: 0.3 },
    { axis: SPEED, value: 1, part: 0.001 },
  ];
  const samples = new Samples({ key: '', inputs, chosen: {}, total: 2000 });
  const units = Array.from({ length: 2000 }, (_, n) => haltonAt(n, 2).map((share) => 2 * share - 1));
  const found = units.flatMap(([a, b]) => [...figuresOf(1 + 0.3 * a, 1 + 0.001 * b)]);
  samples.add(units, Float64Array.from(found));
  const { columns, groups, notes, rows, whole } = rowsOfTolerance(samples, ['peak_force', 'newton']);
  assert.ok(whole && groups.reduce((sum, [, count]) => sum + count, 0) === columns.length);
  assert.deepEqual(columns.slice(3), ['ratio ±30 %', 'speed ±0.1 %']);
  assert.equal(rows.length, 1, 'what no impact has is left out');
  const [low, median, high, first, second] = rows[0].cells.map(([words]) => words);
  const near = (words, expected) => assert.ok(Math.abs(parseFloat(words) / expected - 1) < 0.02, words);
  near(low, /mN/.test(low) ? 730 : 0.73);
  near(
    median.replace(/(\d+) mN/, (_, mN) => String(mN / 1000)),
    1,
  );
  near(high, 1.27);
  assert.ok(/9\d\s%|100\s%/.test(first) && /^(<\s)?[01]\s%/.test(second), `${first} ${second}`);
  assert.match(notes.join(' '), /1\scontact, \d+\s%; 2\scontacts, \d+\s%\. 2,000\simpacts\./);
});
