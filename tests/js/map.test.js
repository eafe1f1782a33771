// The map without a browser: places along its axes, its lattice, where contacts change, and a value that is wanted.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changeAt } from '../../app/static/whatif/borders.js';
import { Lattice, MANY, counted, halve } from '../../app/static/whatif/lattice.js';
import {
  longOf,
  marksOf,
  placeOf,
  roundAt,
  sureOf,
  usualRange,
  valueAt,
  writtenOn,
} from '../../app/static/whatif/places.js';
import { PLACE, WIDTH } from '../../app/static/whatif/results.js';
import { Seek, nearestTo } from '../../app/static/whatif/seek.js';
import { contoursOf, levelsOf } from '../../app/static/whatif/contours.js';
import { Window } from '../../app/static/whatif/window.js';

const axis = (name, low, high, more = {}) => ({
  ...{ name, title: name, unit: '', factor: 1, low, high, log: low > 0 && high >= 10 * low, whole: false },
  ...{ body: false, of: '', ...more },
});
const RATIO = axis('mass_ratio', 1e-3, 1e3);
const SPEED = axis('speed', 0.01, 100);
const SHARE = axis('place', -1, 1);

/** Figures of an impact by these. */
function figures(rows, of) {
  const found = new Float64Array(rows.length * WIDTH).fill(NaN);
  rows.forEach((row, k) => {
    const all = of(...row);
    found[k * WIDTH] = all ? 0 : 1;
    for (const [name, value] of Object.entries(all ?? {})) found[k * WIDTH + PLACE[name]] = value;
  });
  return found;
}
const rowsOf = ({ names, rows }) =>
  Array.from({ length: rows.length / names.length }, (_, k) => [
    ...rows.subarray(k * names.length, (k + 1) * names.length),
  ]);

test('places and values are each other, and the ends are exact', () => {
  for (const each of [RATIO, SPEED, SHARE, axis('x', 0.25, 4.1), axis('y', 3, 4)]) {
    for (const share of [0, 0.1, 0.37, 0.5, 0.99, 1]) {
      const place = share * longOf(each);
      assert.ok(Math.abs(placeOf(each, valueAt(each, place)) - place) < 1e-9);
    }
    assert.deepEqual([valueAt(each, 0), valueAt(each, longOf(each))], [each.low, each.high]);
    assert.equal(valueAt(each, -1), each.low);
  }
  assert.equal(longOf(RATIO), 6);
  assert.equal(roundAt(RATIO, placeOf(RATIO, 0.123456)), 0.1235);
  const [from, to] = usualRange(RATIO, 900);
  assert.ok(to === longOf(RATIO) && Math.abs(to - from - 3) < 1e-9);
  assert.deepEqual(usualRange(SHARE, 0), [0, 4]);
  assert.equal(valueAt(axis('modes', 1, 200, { whole: true }), 0.3) % 1, 0);
});

test('marks stand at round values within the axis', () => {
  for (const [each, room] of [
    [RATIO, 800],
    [RATIO, 200],
    [SHARE, 300],
    [axis('z', 0.2, 0.9), 700],
  ]) {
    // prettier-ignore
    const marks = marksOf(each, [0, longOf(each)], room);
    assert.ok(marks.filter(({ named }) => named).length >= 2, each.name);
    for (const { place, value } of marks) {
      assert.ok(Math.abs(placeOf(each, value) - place) < 1e-9 && place > -1e-9 && place < longOf(each) + 1e-9);
      assert.ok(Math.abs(value - Number(value.toPrecision(2))) < 1e-9 * Math.abs(value) + 1e-12);
    }
  }
  const metres = { ...axis('length', 0.06, 0.6), factor: 1e-3 };
  assert.ok(marksOf(metres, [0, longOf(metres)], 500).some(({ value }) => Math.abs(value - 0.2) < 1e-12));
});

test('a value of an axis is rounded once', () => {
  const stiffness = axis('linear_stiffness', 1e3, 1e12);
  assert.equal(writtenOn({ ...stiffness, factor: 1 }, 792465.251), '7.92·10⁵'); // 7925 first would make 7.93 of it
  assert.equal(writtenOn({ ...stiffness, factor: 1e-3 }, 0.0908665), '90.87');
});

/** All that a window needs, found: how many impacts that took. */
function complete(lattice, axes, size, of, whole = false) {
  for (let total = 0; ; ) {
    const view = new Window(lattice, axes, size, 7);
    const [first = view.mend()] = view.plan([0.5, 0.5], whole); // what comes first, as it is asked
    const wanted = [...first];
    const edges = wanted.length ? [] : view.halves();
    if (!wanted.length && !edges.length) return { total, view };
    total += wanted.length + edges.length;
    wanted.forEach(([i, j]) => lattice.keep(view.key(i, j), figures([view.row(i, j)], of), 0));
    for (const { at, edge, row } of edges) halve(edge, at, counted(figures([row], of)[PLACE.contacts]));
    if (edges.length) lattice.version += 1;
  }
}
const AXES = { x: RATIO, y: SPEED, x0: 1.5, x1: 4.5, y0: 0, y1: 4 };

test('a map finds what it needs once, spares what is straight, and halves where contacts change', () => {
  const of = (ratio, speed) => ({
    ...{ contacts: ratio * speed > 1 ? 2 : 1, peak_force: ratio * speed, impactor_velocity: -0.2 * Math.log10(speed) },
  });
  const lattice = new Lattice(1);
  const { total, view } = complete(lattice, AXES, [600, 400], of);
  assert.ok(lattice.count < 0.6 * view.nx * view.ny && total > 100, `${lattice.count} of ${view.nx * view.ny}`);
  view.fill('peak_force');
  let [off, edges] = [0, 0];
  for (let j = 0; j < view.ny; j++)
    for (let i = 0; i < view.nx; i++) {
      if (!view.seen(i, j)) continue;
      const [ratio, speed] = view.row(i, j);
      off = Math.max(off, Math.abs(view.values[j * view.nx + i] - Math.log10(ratio * speed)));
      for (const way of [0, 1]) {
        const [a, b] = [j * view.nx + i, way ? (j + 1) * view.nx + i : j * view.nx + i + 1];
        if (!view.seen(i + 1 - way, j + way) || view.contacts[a] === view.contacts[b]) continue;
        const { at, found } = view.change(i, j, way);
        const [p, q] = way ? view.row(i, j + at) : view.row(i + at, j);
        edges += 1;
        assert.ok(found && Math.abs(Math.log10(p * q)) < 4 * 1e-3, `${p} ${q}`);
      }
    }
  assert.ok(edges > 20 && off < 1e-2, `${edges} ${off}`);
  const again = complete(lattice, AXES, [600, 400], of);
  assert.equal(again.total, 0, 'all is known');
  const near = complete(lattice, { ...AXES, x0: 2, x1: 4 }, [600, 400], of);
  assert.ok(near.total < total, 'a closer look uses what is known');
});

test('what is refused is told apart, and nothing is asked beyond the ends of an axis', () => {
  const asked = [];
  const of = (share, speed) => {
    asked.push([share, speed]);
    return speed > 10 ? null : { contacts: 1, peak_force: 1 };
  };
  const lattice = new Lattice(1);
  const { view } = complete(lattice, { x: SHARE, y: SPEED, x0: 0, x1: 4, y0: 0, y1: 4 }, [300, 300], of);
  assert.ok(asked.every(([share, speed]) => share >= -1 && share <= 1 && speed >= 0.01 && speed <= 100));
  view.fill('peak_force');
  for (let k = 0; k < view.nx * view.ny; k++) {
    const speed = view.row(k % view.nx, Math.floor(k / view.nx))[1];
    if (view.index[k] >= 0) assert.equal(view.contacts[k], speed > 10 ? -1 : 1);
  }
});

test('as many contacts as are chaos are one kind', () => {
  assert.deepEqual([1, 5, 6, 150].map(counted), [1, 5, MANY, MANY]);
});

test('contours stand where the value is, and levels are round', () => {
  const [w, h, step] = [80, 60, 2];
  const values = Float32Array.from({ length: w * h }, (_, k) => ((k % w) + 0.5) * step);
  const raster = { contacts: new Int16Array(w * h).fill(1), sheet: { width: w, height: h }, step, values };
  const lines = contoursOf(raster, [40, 100], [0, 160]);
  for (const [level, line] of lines) {
    assert.ok(line.length > 20);
    for (let k = 0; k < line.length; k += 2) assert.ok(Math.abs(line[k] - level) < 1e-3);
  }
  assert.deepEqual(levelsOf([0, 100], false), [20, 40, 60, 80]);
  assert.ok(levelsOf([0, 2], true).some((level) => Math.abs(level - Math.log10(20)) < 1e-12));
});

/** What a search finds of a function. */
function sought(of, wanted, more = {}) {
  let found = null;
  let impacts = 0;
  const seek = new Seek((each) => (found = each));
  seek.ask({ axis: RATIO, result: 'peak_force', wanted, chosen: {}, fixed: [], ...more });
  for (let job = seek.next(); job; job = seek.next()) {
    const rows = rowsOf(job);
    impacts += rows.length;
    job.done(figures(rows, of), 1);
  }
  return { ...found, impacts, idle: seek.idle };
}

test('every value that gives what is wanted is found, and a leap is none', () => {
  const wavy = (ratio) => ({ contacts: 1, peak_force: 2 + Math.sin(2 * Math.log(ratio)) });
  const { idle, impacts, roots } = sought(wavy, 2.5);
  assert.ok(idle && impacts < 600);
  const right = [];
  for (let k = -10; k < 10; k++)
    right.push(Math.exp((Math.PI / 6 + 2 * Math.PI * k) / 2), Math.exp(((5 * Math.PI) / 6 + 2 * Math.PI * k) / 2));
  const inside = right.filter((each) => each > 1e-3 && each < 1e3).sort((a, b) => a - b);
  assert.equal(roots.length, inside.length);
  roots.forEach((place, k) => assert.ok(Math.abs(valueAt(RATIO, place) / inside[k] - 1) < 1e-5));
  const leap = (ratio) => ({ contacts: ratio > 1.3 ? 2 : 1, peak_force: ratio > 1.3 ? 3 : 1 });
  const { leaps, roots: none } = sought(leap, 2);
  assert.deepEqual([none.length, leaps.length], [0, 1]);
  assert.ok(Math.abs(valueAt(RATIO, leaps[0]) / 1.3 - 1) < 1e-6);
  assert.equal(nearestTo({ roots: [] }, 1), null);
  assert.equal(nearestTo({ roots: [1, 2.2, 5] }, 2), 2.2);
});

test('where nothing can be found a search ends, and the newest wish is what is done', () => {
  const { roots, values } = sought(() => null, 1);
  assert.ok(roots.length === 0 && values.every(Number.isNaN));
  const done = [];
  const seek = new Seek(({ asked }) => done.push(asked.wanted));
  const asked = (wanted) => ({ axis: SPEED, result: 'peak_force', wanted, chosen: {}, fixed: [['mass_ratio', 2]] });
  const flat = (ratio, speed) => ({ contacts: 1, peak_force: ratio * speed });
  seek.ask(asked(1));
  const first = seek.next();
  assert.equal(seek.next(), null, 'one job at a time');
  assert.deepEqual(first.names, ['mass_ratio', 'speed']);
  seek.ask(asked(2));
  seek.ask(asked(3));
  first.done(figures(rowsOf(first), flat), 1);
  for (let job = seek.next(); job; job = seek.next()) job.done(figures(rowsOf(job), flat), 1);
  assert.deepEqual(done, [1, 3]);
  seek.ask(asked(4));
  const lost = seek.next();
  seek.ask(null);
  lost.done(figures(rowsOf(lost), flat), 1);
  assert.ok(seek.idle && done.length === 2, 'nobody wants it any more');
});

test('a value between two places has no more digits than are sure', () => {
  const wide = { low: 0.01, high: 100, log: true, whole: false, factor: 1 };
  const at = (value) => placeOf(wide, value);
  assert.equal(sureOf(wide, at(1.01065), at(1.01075)), '1.011');
  assert.equal(sureOf(wide, at(1.0104), at(1.0106)), '1.01');
  assert.equal(sureOf(wide, at(0.94), at(1.06)), '0.94–1.06');
  assert.equal(sureOf({ ...wide, factor: 1e-3 }, at(0.0250001), at(0.0250002)), '25');
});

test('a place near a line is told which contacts change there, and along which axis', () => {
  const view = { nx: 3, contacts: [1, 2, 2, 1, 1, 2, 1, 1, 1], size: [200, 200], spot: (i, j) => [i / 2, j / 2] };
  const torn = new Map([
    [0, { found: true, ends: [[0.5, 0], [1, 0.5]] }], // prettier-ignore
    [1, { found: true, ends: [[0, 0.5], [0.5, 1]] }], // prettier-ignore
  ]);
  assert.equal(changeAt(view, torn, [150, 60]), null);
  const below = changeAt(view, torn, [55, 197]);
  assert.deepEqual([below.way, below.pair], [0, [1, 2]]);
  assert.ok(Math.hypot(below.share[0] * 200 - 54, (1 - below.share[1]) * 200 - 196) < 1.5);
  const beside = changeAt(view, torn, [98, 149]);
  assert.deepEqual([beside.way, beside.pair], [1, [2, 1]]);
});
