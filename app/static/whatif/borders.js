// Where a contact is gained or lost, in numbers: the changes that are nearest to the scene along both axes, and the one
// whose line is under a pointer. Both are sought with the steps of the page's own answers, not with those of colours.
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { CurveJobs, askedOver, countOf } from './curve_jobs.js';
import { MANY, counted } from './lattice.js';
import { longOf, placeOf, roundAt, sureOf, writtenOn } from './places.js';
import { nameOf } from './sentence.js';

/** @import { Axis } from './axes.js' */
/** @import { Change } from './curve_jobs.js' */
/** @import { Spot } from './plane.js' */
/** @import { Torn } from './raster.js' */
/** @import { WhatIf } from './whatif.js' */
/** @import { Window } from './window.js' */

const NEAR = 6; // pixels from a line, where a pointer is at it
const ABOUT = 12; // pixels to both sides, where the change is sought
const PARTS = 8; // of these

/**
 * What a pointer is at: contacts before and after, along an axis; on the other one it is at a value.
 * @typedef {object} Pointed
 * @property {string} key
 * @property {Axis} axis
 * @property {Axis} other
 * @property {number} value
 * @property {number} place
 * @property {[before: number, after: number]} pair
 */

/** @param {Change} change  Contacts before and after it, as lines tell them apart. */
const pairOf = ({ after, before }) => [before, after].map((row) => counted(countOf(row)));

/** @param {Change} change */
const middleOf = ({ high, low }) => (low + high) / 2;

/** @param {number} count */
const shortOf = (count) => (count < MANY ? String(count) : `${MANY}+`);

export class Borders {
  root = make('p', { className: 'whatif-border' });
  /** @type {Pointed | null} */ pointed = null;
  keys = ['', '']; // of what is sought along both axes
  silent = false; // where students are to find it

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    this.searches = [0, 1].map(() => new CurveJobs(() => whatif.came())); // across and upwards
    this.near = new CurveJobs(() => this.say());
  }
  /** The scene may have moved: seek again, once it lies still. */
  follow() {
    const { whatif } = this;
    const { held, x, y } = whatif;
    if (this.silent) return;
    const both = [askedOver(whatif, x, y), askedOver(whatif, y, x)].map((asked) => ({ ...asked, most: MANY }));
    this.keys = both.map(({ key }) => key);
    if (!held) this.searches.forEach((search, k) => search.ask(both[k]));
    this.say();
  }
  /** The map is gone. */
  rest() {
    this.pointed = null;
    this.near.ask(null);
    for (const search of this.searches) search.ask(null);
    write(this.root, '');
  }
  /**
   * What is under a pointer: why nothing is there, or a change of contacts.
   * @param {Spot | null} at
   */
  look(at) {
    const { plane, view, words } = this.whatif;
    write(words, (at && view?.why(...plane.share(...at))) ?? '');
    if (this.silent) return;
    this.pointed = at && view ? this.#under(view, at) : null;
    const { pointed } = this;
    if (pointed && view) {
      const { axis, key, other, place, value } = pointed;
      const { x, x0, x1, y0, y1 } = view.axes;
      const about = ABOUT * (axis === x ? (x1 - x0) / view.size[0] : (y1 - y0) / view.size[1]);
      const [from, to] = [Math.max(place - about, 0), Math.min(place + about, longOf(axis))];
      const { chosen } = this.whatif;
      this.near.ask({ key, axis, from, to, fixed: [[other.name, value]], chosen, parts: PARTS, most: MANY });
      this.whatif.points.feed();
    }
    this.say();
  }
  /**
   * @param {Window} view
   * @param {Spot} at
   * @returns {Pointed | null}
   */
  #under(view, [px, py]) {
    const { plot, raster } = this.whatif.plane;
    const found = changeAt(view, raster.torn, [px - plot.x, py - plot.y]);
    if (!found) return null;
    const { x, x0, x1, y, y0, y1 } = view.axes;
    const places = [x0 + found.share[0] * (x1 - x0), y0 + found.share[1] * (y1 - y0)];
    const [axis, other] = found.way ? [y, x] : [x, y];
    const [place, beside] = found.way ? [places[1], places[0]] : places;
    const value = roundAt(other, beside);
    const key = JSON.stringify([this.keys, axis.name, value, found.pair]);
    return { key, axis, other, value, place, pair: found.pair };
  }
  get idle() {
    return this.searches.every(({ idle }) => idle);
  }
  /** @param {number} many  impacts */
  next(many) {
    return this.searches[0].next(many) ?? this.searches[1].next(many);
  }
  say() {
    write(this.root, this.pointed ? this.#pointedAt(this.pointed) : this.#nearest());
  }
  /** @param {Pointed} pointed */
  #pointedAt({ axis, key, other, pair, place, value }) {
    const { shown } = this.near;
    const all = shown?.whole && shown.asked.key === key ? (shown.changes ?? []) : [];
    const same = all.filter((each) => String(pairOf(each)) === String(pair));
    const change = same.sort((a, b) => Math.abs(middleOf(a) - place) - Math.abs(middleOf(b) - place)).at(0);
    const at = (/** @type {Axis} */ { unit }, /** @type {string} */ words) => `${words} ${unit}`.trim();
    const [before, after] = pair.map(shortOf);
    const where = change && [
      `${nameOf(axis)} ${at(axis, sureOf(axis, change.low, change.high))}`,
      `${nameOf(other)} ${at(other, writtenOn(other, value))}`,
    ];
    return text('whatif.border', { before, after, count: pair[1], where: where?.join(', ') ?? '…' });
  }
  /** The nearest changes along both axes. */
  #nearest() {
    const [x, y] = this.searches.map((search, k) => this.#along(search, this.keys[k]));
    if (!x || !y) return '';
    const found = [x, y].filter(({ sides }) => sides);
    if (!found.length) return text('whatif.no-border', { axes: [x, y].map(({ axis }) => axis).join(', ') });
    return found.map((each) => text('whatif.border-along', each)).join(' · ');
  }
  /**
   * The nearest change to each side of the scene, the nearer one first.
   * @param {CurveJobs} search
   * @param {string} key  of what is sought
   */
  #along({ shown }, key) {
    if (!shown?.whole || shown.asked.key !== key) return null;
    const { axis } = shown.asked;
    const here = placeOf(axis, this.whatif.value(axis));
    const far = (/** @type {Change} */ change) => Math.abs(middleOf(change) - here);
    const nearest = (shown.changes ?? []).toSorted((a, b) => far(a) - far(b));
    const below = (/** @type {Change} */ change) => middleOf(change) < here;
    const sides = nearest.filter((change) => nearest.find((each) => below(each) === below(change)) === change);
    const said = sides.map((change) => {
      const [before, after] = pairOf(change);
      const count = below(change) ? before : after;
      const many = text(count >= MANY ? 'whatif.many-contacts' : 'whatif.contacts', { count });
      const value = `${sureOf(axis, change.low, change.high)} ${axis.unit}`.trim();
      const where = text('whatif.border-where', { way: below(change) ? 'below' : 'above', value });
      return { words: count < 0 ? text('whatif.refused') : many, where };
    });
    const same = said.length === 2 && said[0].words === said[1].words;
    const [one, other] = said.map(({ where }) => where);
    if (same) said.splice(0, 2, { ...said[0], where: text('whatif.border-or', { one, other }) });
    return { axis: nameOf(axis), sides: said.map((each) => text('whatif.border-side', each)).join(', ') };
  }
}

/**
 * The line under a place of a map: where it is nearest, as shares of the map, along which axis contacts change there,
 * and from how many to how many.
 * @param {Window} view
 * @param {Map<number, Torn>} torn
 * @param {Spot} at  pixels from the corner of the plot
 * @returns {{ share: Spot, way: 0 | 1, pair: [before: number, after: number] } | null}
 */
export function changeAt(view, torn, [u, v]) {
  const { contacts, nx, size } = view;
  let [best, found] = [NEAR, /** @type {ReturnType<typeof changeAt>} */ (null)];
  for (const [k, { ends }] of torn) {
    const [i, j] = [k % nx, Math.floor(k / nx)];
    const spots = ends.map(([x, y]) => {
      const [X, Y] = view.spot(i + x, j + y);
      return /** @type {Spot} */ ([X * size[0], (1 - Y) * size[1]]);
    });
    const middle = /** @type {Spot} */ ([0, 1].map((n) => spots.reduce((sum, spot) => sum + spot[n] / ends.length, 0)));
    spots.forEach((spot, n) => {
      const [px, py] = closest(spot, middle, [u, v]);
      const far = Math.hypot(px - u, py - v);
      if (far >= best) return;
      const [x, y] = ends[n];
      const way = x === 0 || x === 1 ? 1 : 0;
      const first = way ? k + x : k + y * nx;
      best = far;
      found = {
        ...{ share: [px / size[0], 1 - py / size[1]], way },
        pair: [contacts[first], contacts[first + (way ? nx : 1)]],
      };
    });
  }
  return found;
}

/**
 * The point of a straight line that is closest to a place.
 * @param {Spot} from
 * @param {Spot} to
 * @param {Spot} place
 * @returns {Spot}
 */
function closest([ax, ay], [bx, by], [u, v]) {
  const [dx, dy] = [bx - ax, by - ay];
  const long = dx * dx + dy * dy;
  const share = long ? Math.min(Math.max(((u - ax) * dx + (v - ay) * dy) / long, 0), 1) : 0;
  return [ax + share * dx, ay + share * dy];
}
