// What is taken along of the map: its link, its table, its command.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { apart, commandOf, figureOf, pythonOf, variedOf, withinOf } from '../../app/static/whatif/code_lines.js';
import { Curve } from '../../app/static/whatif/curve_jobs.js';
import { Ranges } from '../../app/static/whatif/ranges.js';
import { PLACE, WIDTH } from '../../app/static/whatif/results.js';
import { csvOf, tableOfCurves } from '../../app/static/whatif/table.js';
import { follow, saidOf } from '../../app/static/whatif/view_link.js';

const axis = (name, low, high, log = true) => ({ name, si: '', low, high, log, whole: false, factor: 1, title: name });
const AXES = [axis('mass_ratio', 1e-3, 1e3), axis('speed', 0.01, 100), axis('place', 0, 1, false)];

/** A map whose scene has the value 1 for all. */
function mapOf() {
  const whatif = {
    ...{ result: 'peak_force', named: { x: 'mass_ratio', y: 'speed' }, wanted: {}, ranges: new Ranges() },
    axis: (name) => AXES.find((each) => each.name === name),
    value: () => 1,
    range: (each) => whatif.ranges.of(each, 1),
    modes: { mode: 'map', said: '', tolerance: { parts: new Map() } },
  };
  whatif.goal = {
    ...{ gives: '', usual: 'place', holds: false, keep: (holds) => (whatif.goal.holds = holds) },
    get wanted() {
      return whatif.wanted[whatif.result] ?? null;
    },
  };
  return whatif;
}

test('a link says what is not as usual, and brings it back', () => {
  const map = mapOf();
  assert.equal(saidOf(map), 'peak_force,mass_ratio,speed');
  map.wanted.peak_force = 4e4;
  assert.equal(saidOf(map), 'peak_force,mass_ratio,speed,40000');
  map.ranges.set(AXES[0], [2, 4]);
  Object.assign(map.goal, { gives: 'speed', holds: true });
  map.modes.mode = 'tolerance';
  map.modes.tolerance.parts.set('speed', 0.05);
  const said = saidOf(map);
  assert.equal(said, 'peak_force,mass_ratio,speed,40000,x:0.1:10,gives:speed,hold,tolerance:speed:0.05');
  const again = mapOf();
  again.modes.mode = 'tolerance';
  follow(again, said);
  assert.equal(saidOf(again), said);
  const places = again.ranges.of(AXES[0], 1).map((place) => place.toFixed(9));
  assert.deepEqual(places, ['2.000000000', '4.000000000']);
});

test('old links open, and what is no value or of a later version is passed over', () => {
  const usual = saidOf(mapOf());
  for (const said of [
    'peak_force,mass_ratio,speed',
    'peak_force,mass_ratio,speed,',
    'nothing,here,there,NaN,x:1:2',
    'peak_force,mass_ratio,speed,,x:5:1,x:a:b,x:1,y:NaN:2,gives:nobody,hold,tolerance:speed:7,tolerance:speed,more:1:2',
    ',,,,,,,::::',
  ]) {
    const map = mapOf();
    follow(map, said);
    assert.equal(saidOf(map), usual, said);
  }
  const map = mapOf();
  follow(map, 'newton,speed,mass_ratio,0.5,y:1e-9:1e9');
  assert.deepEqual([map.result, map.named, map.wanted], ['newton', { x: 'speed', y: 'mass_ratio' }, { newton: 0.5 }]);
  assert.deepEqual(map.ranges.of(AXES[0], 1), [0, 6], 'no farther than the axis');
});

test('values of a key are a range where they are one, and a list where they are none', () => {
  assert.deepEqual(variedOf({ 'impactor.mass': [8, 4, 2, 1] }), ['impactor.mass', '1..8:4:log']);
  assert.deepEqual(variedOf({ 'target.at': [0, 0.25, 0.5] }), ['target.at', '0..0.5:3:linear']);
  assert.deepEqual(variedOf({ 'target.at': [null, 0.25, 0.5] }), ['target.at', '0.25,0.5']);
  assert.deepEqual(variedOf({ 'method.modes': [1, 2, 2, 7] }), ['method.modes', '1,2,7']);
  assert.deepEqual(variedOf({ a: [1, 2, null], b: [3, 5, 6] }), ['a,b', '(1,3),(2,5)']);
  assert.equal(variedOf({}), null);
});

test('keys that go with both axes cannot be varied apart', () => {
  const keys = { m: [1, 2, 3, 1, 1, 3], v: [5, 5, 5, 6, 7, 7] };
  assert.deepEqual(apart(keys, 3), [{ m: [1, 2, 3] }, { v: [6, 7] }]);
  assert.equal(apart({ m: [1, 2, 3, 1, 2, 3] }, 3), null);
  assert.equal(apart({ m: [1, 2, 3, 1, 1, 4] }, 3), null, 'another value in the corner');
});

test('a tolerance is the stretch between both ends of one key', () => {
  assert.deepEqual(withinOf({ 'impactor.mass': [2.2, 1.8] }), ['impactor.mass', '1.8..2.2']);
  assert.equal(withinOf({ a: [1, 2], b: [1, 2] }), null);
  assert.equal(withinOf({}), null);
  assert.equal(withinOf({ a: [null, 2] }), null);
});

test('command and Python say the same', () => {
  const varied = [
    ['impactor.mass', '1..8:4:log'],
    ['a,b', '(1,2),(3,4)'],
  ];
  assert.equal(
    commandOf('study', 'fixed-rod.toml', varied, [figureOf('vibration')]),
    'impact study fixed-rod.toml --vary impactor.mass=1..8:4:log --vary "a,b=(1,2),(3,4)" --figure vibration_share ' +
      '--out fixed-rod.nc\nimpact report fixed-rod.nc',
  );
  assert.match(
    pythonOf('study', 'a.toml', varied, ['newton']),
    /"a,b": "\(1,2\),\(3,4\)",\n.*\n {4}figures=\["newton"\],\n\)\nsolvers\.report\(data\)\.save\("a\.html"\)$/,
  );
  assert.equal(
    commandOf('uncertain', 'a.toml', [['target.at', '0.4..0.6']], [figureOf('peak_force')]),
    'impact uncertain a.toml --tolerance target.at=0.4..0.6 --figure peak_force',
  );
  assert.match(pythonOf('uncertain', 'a.toml', varied, ['newton']), /print\(found\)$/);
});

test('a table has a row for each impact, why there is none, and both sides of a change', () => {
  const curve = new Curve({ key: '', axis: AXES[2], from: 0, to: 4, fixed: [], chosen: {} });
  for (const k of [0, 160]) curve.known[k] = 1;
  curve.found.set([1], 0);
  curve.found[160 * WIDTH + PLACE.peak_force] = 7;
  curve.found[160 * WIDTH + PLACE.contacts] = 1;
  const side = (peak) => Float64Array.from({ length: WIDTH }, (_, k) => (k === PLACE.peak_force ? peak : k ? NaN : 0));
  curve.changes = [{ low: 2, high: 2.5, before: side(3), after: side(5), asked: false }];
  const table = tableOfCurves(curve);
  assert.deepEqual(
    table.rows.map(([place]) => place),
    [0, 0.5, 0.625, 1],
  );
  const lines = csvOf(table, 'title = "A, rod"\n', 'http://here/', 1e-5).split('\n');
  assert.deepEqual(lines.slice(0, 4), [
    '# title = "A, rod"',
    '# [saved]',
    '# tolerance = 0.00001',
    '# link = "http://here/"',
  ]);
  const [head, refused, before, , after] = lines.slice(4);
  assert.match(head, /^place,peak_force_N,impactor_velocity_m\/s,vibration_share,contacts,.*,refused$/);
  assert.match(refused, /^0,,.*,cannot be computed$/);
  assert.match(before, /^0\.5,3,/);
  assert.match(after, /^1,7,.*,$/);
});
