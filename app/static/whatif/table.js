// What is seen as a table: every impact of it, a row each, in SI units and with as many digits as were found.
import { headed } from '../frame/share.js';
import { text } from '../text/catalogue.js';
import { BOUNDS } from './model_jobs.js';
import { valueAt } from './places.js';
import { NAMES, PLACE, WIDTH, shownOf } from './results.js';
import { drawnOf } from './tolerance_jobs.js';

/** @import { Axis } from './axes.js' */
/** @import { Curve } from './curve_jobs.js' */
/** @import { Result } from './results.js' */
/** @import { Called } from '../text/words.js' */
/** @import { Samples } from './tolerance_jobs.js' */
/** @import { Window } from './window.js' */

const DIGITS = 12;

/** @typedef {{ names: string[], rows: (number | string)[][] }} Table */

/** @param {Pick<Axis, 'name' | 'si'>} axis */
const headOf = ({ name, si }) => (si ? `${name}_${si}` : name);

/** @param {Result} name  Shares are of one, as the library has them. */
function headOfResult(name) {
  const { unit } = shownOf(name);
  if (unit === '%') return `${name}_share`;
  return unit ? `${name}_${unit}` : name;
}

const RESULTS = NAMES.map(headOfResult);
const WHY = 'refused'; // the last column: why there is nothing

/**
 * Results in a row of numbers, and why there are none.
 * @param {ArrayLike<number>} found
 * @param {number} at  where its row begins
 * @param {string} [why]
 */
function cellsOf(found, at, why) {
  const refused = found[at];
  const values = NAMES.map((name) => (refused ? NaN : found[at + PLACE[name]]));
  return [...values, refused ? (why ?? text('whatif.refused')) : ''];
}

/**
 * Impacts of the lattice that are in view.
 * @param {Window} view
 * @returns {Table}
 */
export function tableOfMap(view) {
  const { axes, index, lattice, nx, ny } = view;
  const rows = [];
  for (let j = 0; j < ny; j++)
    for (let i = 0; i < nx; i++) {
      const point = index[j * nx + i];
      if (point < 0 || !view.seen(i, j)) continue;
      rows.push([...view.row(i, j), ...cellsOf(lattice.data, point * WIDTH, lattice.why.get(view.key(i, j)))]);
    }
  return { names: [headOf(axes.x), headOf(axes.y), ...RESULTS, WHY], rows };
}

/**
 * Samples of a curve, and both sides of each change of contacts.
 * @param {Curve} curve
 * @returns {Table}
 */
export function tableOfCurves(curve) {
  const { asked, changes, known, places } = curve;
  const { axis } = asked;
  const samples = places.flatMap((place, k) => (known[k] ? [{ place, found: curve.row(k) }] : []));
  const sides = (changes ?? []).flatMap(({ after, before, high, low }) => [
    { place: low, found: before },
    { place: high, found: after },
  ]);
  const there = new Set(samples.map(({ place }) => place));
  const all = [...samples, ...sides.filter(({ place }) => !there.has(place))].sort((a, b) => a.place - b.place);
  return {
    names: [headOf(axis), ...RESULTS, WHY],
    rows: all.map(({ found, place }) => [valueAt(axis, place), ...cellsOf(found, 0)]),
  };
}

/**
 * Impacts within tolerances.
 * @param {Samples} samples
 * @returns {Table}
 */
export function tableOfTolerance(samples) {
  const { inputs } = samples.asked;
  const rows = Array.from({ length: samples.count }, (_, n) => [
    ...inputs.map((input, k) => drawnOf(input, samples.unit(n, k))),
    ...cellsOf(samples.found, n * WIDTH),
  ]);
  return { names: [...inputs.map(({ axis }) => headOf(axis)), ...RESULTS, WHY], rows };
}

/**
 * Points of which it is known which model is enough, by bound of the error.
 * @param {Window} view
 * @param {Called[]} models  from the smallest up
 * @returns {Table}
 */
export function tableOfModels(view, models) {
  const { axes, index, lattice, nx, ny } = view;
  const name = (/** @type {number} */ place) => {
    const model = models[place - 1];
    return model.modes ? `${model.name}-${model.modes}` : model.name;
  };
  const rows = [];
  for (let j = 0; j < ny; j++)
    for (let i = 0; i < nx; i++) {
      const at = index[j * nx + i] * WIDTH;
      if (at < 0 || !view.seen(i, j)) continue;
      const refused = lattice.data[at] ? (lattice.why.get(view.key(i, j)) ?? text('whatif.refused')) : '';
      rows.push([...view.row(i, j), ...BOUNDS.map((_, k) => (refused ? '' : name(lattice.data[at + 1 + k]))), refused]);
    }
  return { names: [headOf(axes.x), headOf(axes.y), ...BOUNDS.map((bound) => `model_within_${bound}`), WHY], rows };
}

/** @param {number | string} cell */
function written(cell) {
  if (typeof cell === 'string') return /[",\r\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell;
  return Number.isFinite(cell) ? String(Number(cell.toPrecision(DIGITS))) : '';
}

/**
 * As comma-separated values, below the scene and the link; without results that no row has.
 * @param {Table} table
 * @param {string} scene  in TOML, or nothing
 * @param {string} link
 * @param {number} tolerance  of a step through a contact law; 0: none that matters
 */
export function csvOf({ names, rows }, scene, link, tolerance) {
  const kept = names.map((_, k) => k).filter((k) => rows.some((row) => written(row[k]) !== ''));
  const columns = kept.includes(names.length - 1) ? kept : [...kept, names.length - 1];
  const said = `${scene.trim()}\n[saved]${tolerance ? `\ntolerance = ${tolerance}` : ''}`;
  const lines = rows.map((row) => columns.map((k) => written(row[k])).join(','));
  return [...headed(said, link), columns.map((k) => names[k]).join(','), ...lines, ''].join('\n');
}
