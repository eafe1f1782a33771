// What is seen as rows and columns of words, few enough to be read: of a map, of curves, of tolerances.
import { text } from '../text/catalogue.js';
import { grouped } from '../text/format.js';
import { percentOf } from './histogram.js';
import { MANY, MISSING } from './lattice.js';
import { valueAt, writtenOn } from './places.js';
import { PLACE, WIDTH, shownOf, titleOf, valueOf, written } from './results.js';
import { nameOf } from './sentence.js';
import { mattersOf, quantilesOf } from './spread.js';
import { NEVER_SPARED } from './window.js';

/** @import { Axis } from './axes.js' */
/** @import { Curve } from './curve_jobs.js' */
/** @import { Result } from './results.js' */
/** @import { Samples } from './tolerance_jobs.js' */
/** @import { Window } from './window.js' */

const MOST = { across: 9, upwards: 7 }; // values of an axis
const EVERY = 8; // samples of a curve, of which one is read
const SHARES = [0.05, 0.5, 0.95];

/** @typedef {[value: string, below: string]} Cell */
/**
 * @typedef {object} Rows
 * @property {string} caption
 * @property {[name: string, columns: number][]} groups  heads of columns that go together
 * @property {string} corner  the head of the heads of rows
 * @property {string[]} columns
 * @property {{ head: string, cells: Cell[] }[]} rows
 * @property {string[]} notes  below it
 * @property {boolean} whole  whether nothing is still to be found
 */

/**
 * @param {Axis} axis
 * @param {number} value
 */
export const onAxis = (axis, value) => `${writtenOn(axis, value)} ${axis.unit}`.trim();

/** @param {number} count  Contacts, as a map tells them apart. */
export const contactsIn = (count) =>
  count < MANY ? text('whatif.contacts', { count }) : text('whatif.many-contacts', { count: MANY });

/**
 * Points of a map that is whole, along one axis, by equal steps, each with a value of its own.
 * @param {Window} view
 * @param {0 | 1} way  0: across, 1: upwards
 * @param {number} most
 */
function alongOf(view, way, most) {
  const at = (/** @type {number} */ k) => /** @type {[number, number]} */ (way ? [0, k] : [k, 0]);
  const value = (/** @type {number} */ k) => view.row(...at(k))[way];
  const all = Array.from({ length: way ? view.ny : view.nx }, (_, k) => k);
  for (let step = NEVER_SPARED; ; step *= 2) {
    const seen = all.filter((k) => {
      const place = view.spot(...at(k))[way];
      return (k + view.first[way]) % step === 0 && place > -1e-9 && place < 1 + 1e-9;
    });
    const some = seen.filter((k, n) => !n || value(k) !== value(seen[n - 1])); // whole numbers may be the same
    if (some.length <= most) return some;
  }
}

/**
 * A result at points of the map, with the number of contacts; what is refused, with the number of its reason.
 * @param {Window} view
 * @param {Result} result
 * @returns {Rows}
 */
export function rowsOfMap(view, result) {
  const { x, y } = view.axes;
  const caption = text('whatif.sentence', { of: titleOf(result), x: nameOf(x), y: nameOf(y) });
  return rowsOf(view, caption, (at) => {
    const contacts = view.lattice.data[at + PLACE.contacts];
    return [written(result, valueOf(result, view.lattice.data, at)), result === 'contacts' ? '' : contactsIn(contacts)];
  });
}

/**
 * What is found at points of a map, few enough to be read.
 * @param {Window} view
 * @param {string} caption
 * @param {(at: number) => Cell} said  of a point, by where its numbers begin
 * @returns {Rows}
 */
export function rowsOf(view, caption, said) {
  const { axes, index, lattice, nx } = view;
  const { x, y } = axes;
  const across = alongOf(view, 0, MOST.across);
  const upwards = alongOf(view, 1, MOST.upwards).reverse(); // as on the map
  /** @type {string[]} */
  const why = [];
  let whole = true;
  const cellOf = (/** @type {number} */ i, /** @type {number} */ j) => {
    const point = index[j * nx + i];
    if (point === MISSING) whole = false;
    if (point === MISSING) return /** @type {Cell} */ ([text('whatif.not-yet'), '']);
    const at = point * WIDTH;
    if (!lattice.data[at]) return said(at);
    const reason = lattice.why.get(view.key(i, j)) ?? text('whatif.refused');
    if (!why.includes(reason)) why.push(reason);
    return /** @type {Cell} */ ([text('whatif.refused-by', { number: why.indexOf(reason) + 1 }), '']);
  };
  const rows = upwards.map((j) => ({
    head: onAxis(y, view.row(0, j)[1]),
    cells: across.map((i) => cellOf(i, j)),
  }));
  return {
    caption,
    groups: [[nameOf(x), across.length]],
    corner: nameOf(y),
    columns: across.map((i) => onAxis(x, view.row(i, 0)[0])),
    ...{ rows, whole, notes: why.map((reason, k) => `${k + 1}: ${reason}`) },
  };
}

/**
 * All results along a curve.
 * @param {Curve} curve
 * @param {Result[]} results
 * @returns {Rows}
 */
export function rowsOfCurves(curve, results) {
  const { axis } = curve.asked;
  const samples = [...curve.places.keys()].filter((k) => k % EVERY === 0 && curve.known[k]);
  const rows = samples.map((k) => {
    const row = curve.row(k);
    const refused = row[0] > 0;
    const contacts = refused ? text('whatif.refused') : text('whatif.contacts', { count: row[PLACE.contacts] });
    const values = results.map((name) => written(name, refused ? NaN : valueOf(name, row)));
    return {
      head: onAxis(axis, valueAt(axis, curve.places[k])),
      cells: [contacts, ...values].map((words) => /** @type {Cell} */ ([words, ''])),
    };
  });
  return {
    caption: text('whatif.sentence-curves', { x: nameOf(axis) }),
    ...{ groups: [], corner: nameOf(axis), columns: [titleOf('contacts'), ...results.map(titleOf)] },
    ...{ rows, notes: [], whole: curve.known.every(Boolean) },
  };
}

/**
 * Of each result what it is below how often, and how much of its spread goes with each input.
 * @param {Samples} samples
 * @param {Result[]} results
 * @returns {Rows}
 */
export function rowsOfTolerance(samples, results) {
  const { inputs } = samples.asked;
  const rows = results.flatMap((result) => {
    const { at, sorted, values } = samples.column(result);
    if (!sorted.length) return [];
    const quantiles = quantilesOf(sorted, SHARES).map((value) => written(result, value));
    const shares = inputs.map((_, k) => {
      if (shownOf(result).whole && sorted[0] === sorted[sorted.length - 1]) return '–';
      return `${percentOf(mattersOf(values, (n) => samples.unit(at[n], k)).share)} %`;
    });
    return [
      { head: titleOf(result), cells: [...quantiles, ...shares].map((words) => /** @type {Cell} */ ([words, ''])) },
    ];
  });
  return {
    caption: text('whatif.table-tolerance'),
    groups: [
      [text('whatif.of-impacts'), SHARES.length],
      [text('whatif.spread-by'), inputs.length],
    ],
    corner: text('whatif.of'),
    columns: [
      ...[text('whatif.below'), text('whatif.median'), text('whatif.beyond')],
      ...inputs.map(({ axis, part }) => `${nameOf(axis)} ±${Number((100 * part).toPrecision(3))} %`),
    ],
    ...{ rows, notes: notesOf(samples), whole: samples.whole },
  };
}

/** @param {Samples} samples  How often there are how many contacts, and what is refused. */
function notesOf(samples) {
  const { contacts } = samples.column('contacts');
  const shares = [...new Set(contacts)]
    .sort((a, b) => a - b)
    .map((count) => {
      const share = contacts.filter((each) => each === count).length / contacts.length;
      return text('whatif.contacts-share', { count, share: percentOf(share) });
    });
  const refused = samples.refused ? text('whatif.refusals', { count: samples.refused }) : '';
  const impacts = text('whatif.impacts', { count: grouped(samples.count) });
  return [`${shares.join('; ')}.`, `${impacts} ${refused}`.trim()];
}
