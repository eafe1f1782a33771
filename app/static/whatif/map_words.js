// The state of the map in words, for who does not see it: said anew once it rests, and the scene's value after a move
// by keys.
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { contactsIn, onAxis } from './behind_rows.js';
import { percentOf } from './histogram.js';
import { MISSING } from './lattice.js';
import { valueAt } from './places.js';
import { WIDTH, titleOf, valueOf, written } from './results.js';
import { nameOf } from './sentence.js';

/** @import { Axis } from './axes.js' */
/** @import { Result } from './results.js' */
/** @import { WhatIf } from './whatif.js' */
/** @import { Window } from './window.js' */

const REST = 400; // ms without another picture
const REASONS = 3; // that are said at most
let made = 0;

/** @param {[axis: Axis, value: number][]} values */
const placeIn = (values) => values.map(([axis, value]) => `${nameOf(axis)} ${onAxis(axis, value)}`).join(', ');

/**
 * Points that are seen.
 * @param {Window} view
 */
function* seenOf(view) {
  for (let j = 0; j < view.ny; j++) for (let i = 0; i < view.nx; i++) if (view.seen(i, j)) yield [i, j];
}

/**
 * Where the lowest and the highest value are, if any is.
 * @param {Window} view
 * @param {Result} result
 */
export function endsIn(view, result) {
  const { axes, index, lattice, nx } = view;
  let [low, high] = /** @type {({ value: number, i: number, j: number } | null)[]} */ ([null, null]);
  for (const [i, j] of seenOf(view)) {
    const point = index[j * nx + i];
    if (point === MISSING || lattice.data[point * WIDTH]) continue;
    const value = valueOf(result, lattice.data, point * WIDTH);
    if (!Number.isFinite(value)) continue;
    if (!low || value < low.value) low = { value, i, j };
    if (!high || value > high.value) high = { value, i, j };
  }
  if (!low || !high) return '';
  const [least, most] = [low, high].map(({ i, j, value }) => {
    const [x, y] = view.row(i, j);
    return { value: written(result, value), at: placeIn([[axes.x, x], [axes.y, y]]) }; // prettier-ignore
  });
  if (least.value === most.value) return text('whatif.map-same', { value: least.value });
  return text('whatif.map-ends', { low: least.value, lowAt: least.at, high: most.value, highAt: most.at });
}

/**
 * How many contacts there are in which part of the map, between which values; what is refused, and why.
 * @param {Window} view  filled
 */
export function partsIn(view) {
  const { axes, contacts, nx } = view;
  /** @type {Map<number, { points: number, x: number[], y: number[] }>} */
  const parts = new Map();
  let all = 0;
  for (const [i, j] of seenOf(view)) {
    const kind = contacts[j * nx + i];
    const part = parts.get(kind) ?? { points: 0, x: [i, i], y: [j, j] };
    parts.set(kind, part);
    part.points += 1;
    part.x = [Math.min(part.x[0], i), Math.max(part.x[1], i)];
    part.y = [Math.min(part.y[0], j), Math.max(part.y[1], j)];
    all += 1;
  }
  const sorted = [...parts].sort(([a], [b]) => (a > 0 && b > 0 ? a - b : b - a));
  const ends = [0, 1].map((way) => {
    const places = sorted.flatMap(([, part]) => (way ? part.y : part.x));
    return [Math.min(...places), Math.max(...places)].join();
  });
  return sorted.map(([kind, { points, x, y }]) => {
    const words = kind > 0 ? contactsIn(kind) : text(kind ? 'whatif.refused' : 'whatif.not-yet');
    const [from, to] = [view.row(x[0], y[0]), view.row(x[1], y[1])];
    const where = [axes.x, axes.y].flatMap((axis, way) => {
      if (ends[way] === (way ? y : x).join()) return []; // from end to end
      return [
        text('whatif.map-range', { axis: nameOf(axis), from: onAxis(axis, from[way]), to: onAxis(axis, to[way]) }),
      ];
    });
    return [text('whatif.map-part', { words, share: percentOf(points / all) }), ...where].join(', ');
  });
}

/**
 * Why some of it is refused.
 * @param {Window} view
 */
export function reasonsIn(view) {
  const { lattice } = view;
  const all = [...seenOf(view)].map(([i, j]) => lattice.why.get(view.key(i, j)) ?? '');
  return [...new Set(all)].filter(Boolean).slice(0, REASONS);
}

export class MapWords {
  said = make('p', { className: 'unseen', id: `whatif-map-said-${(made += 1)}` });
  moved = make('p', { className: 'unseen', role: 'status' });
  at = ''; // where the scene was
  /** @type {number | undefined} */ due;

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    const { over, root } = whatif.plane;
    root.append(this.said, this.moved);
    over.setAttribute('aria-describedby', this.said.id);
  }
  /** Another picture is there. */
  follow() {
    clearTimeout(this.due);
    this.due = window.setTimeout(() => this.#rest(), REST);
  }
  #rest() {
    const { held, open, plane, view, x, y } = this.whatif;
    if (!open || held || !view || !x || !y) return; // of another scene there may be none yet
    write(this.said, this.full);
    const { scene } = this;
    if (scene !== this.at && this.at && plane.over.matches(':focus')) write(this.moved, scene);
    this.at = scene;
  }
  /** The point of the scene. */
  get scene() {
    const { result, x, y } = this.whatif;
    const value = written(result, this.whatif.here(result));
    const count = this.whatif.here('contacts');
    const known = result !== 'contacts' && Number.isFinite(count) ? `, ${text('whatif.contacts', { count })}` : '';
    const at = placeIn([[x, this.whatif.value(x)], [y, this.whatif.value(y)]]); // prettier-ignore
    return `${at}: ${value}${known}`;
  }
  /** All of it. */
  get full() {
    const { result, view, x, y } = this.whatif;
    if (!view || !x || !y) return '';
    const range = (/** @type {Axis} */ axis) => {
      const [from, to] = this.whatif.range(axis).map((place) => onAxis(axis, valueAt(axis, place)));
      return text('whatif.map-range', { axis: nameOf(axis), from, to });
    };
    const ranges = [range(x), range(y)];
    const title = titleOf(result);
    const refused = reasonsIn(view);
    const why = refused.length ? text('whatif.map-why', { reasons: refused.join('; ') }) : '';
    return [
      text('whatif.map-said', { result: title, x: ranges[0], y: ranges[1], scene: this.scene }),
      endsIn(view, result),
      `${partsIn(view).join('; ')}.`,
      why,
    ]
      .filter(Boolean)
      .join(' ');
  }
}
