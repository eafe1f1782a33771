// What the opening draws of bodies without rods below their stage: force or impulse, indentation, movement, and of a
// pendulum that bends its bar, laid flat.
import { times } from '../clock/times.js';
import { between } from '../charts/scale.js';
import { text } from '../text/catalogue.js';
import { engineering } from '../text/format.js';
import { byOf, called, errorsOf } from '../text/words.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { AxialFrame } from '../messages.js' */
/** @import { Tracked } from '../opening/section.js' */
/** @import { Track } from '../opening/tracks.js' */
/** @import { Field } from './fields.js' */

const ROOM = 1.1; // about the largest value
const LEAST = 1e-12; // that is more than nothing
const SLIGHT = 1e-6; // of the deepest indentation, that is no dent

/**
 * @param {ArrayLike<number>} values
 * @returns {[low: number, high: number]}
 */
const spanOf = (values) => Array.from(values).reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [0, 0]);

/**
 * The bar of a pendulum that bends, laid flat: its bending moment from the pivot to its end.
 * @param {AxialFrame} frame
 * @param {'exact' | 'other'} solution
 * @returns {Track[]}
 */
export function barOf(frame, solution) {
  const name = solution === 'exact' ? 'exactBend' : 'otherBend';
  const { duration, impactor, shapes } = frame;
  const bend = frame[name];
  if (!bend) return [];
  const [instants, places] = shapes[name];
  const mean = (/** @type {number} */ t, /** @type {number} */ _span, /** @type {any} */ _, /** @type {any} */ out) => {
    const when = Math.min(Math.max(t / duration, 0), 1) * (instants - 1);
    const row = Math.min(Math.floor(when), instants - 2);
    const [from, part] = [row * places, when - row];
    for (let k = 0; k < places; k++) out[k] = (1 - part) * bend[from + k] + part * bend[from + places + k];
    return out;
  };
  const [low, high] = spanOf(bend);
  const { length = 1, place = length } = impactor;
  return [
    {
      ...{ title: text('opening.track.bar'), share: 1, range: [0, length], unit: 'm', marks: [place / length] },
      ends: [text('opening.track.pivot'), text('opening.track.tip')],
      rows: {
        field: { coarse: false, places, mean, profile: () => undefined },
        ...{ what: 'moment', largest: 0.85 * Math.max(-low, high), duration },
      },
    },
  ];
}

/**
 * @param {Field} field
 * @param {Float64Array} x
 * @param {number} factor
 * @returns {Series}
 */
const struck = (field, x, factor) => ({
  ...{ x, y: field.ends, factor, style: 'other', name: '' },
  cursor: text('opening.track.struck'),
});

/**
 * How deep they are pressed in; what flow has left of it stays once they have parted.
 * @param {AxialFrame} frame
 * @param {Field} field  that is drawn
 * @returns {Track[]}
 */
export function indentationOf({ exact, motionTime: x, speed, trip }, field) {
  const factor = speed * trip;
  const near = field.masses.map((moved, k) => Math.max(moved - field.ends[k], 0));
  const [, deepest] = spanOf(near);
  if (deepest <= LEAST) return [];
  const dent = (exact.residualIndentation ?? 0) / factor;
  const stays = dent > SLIGHT * deepest;
  const dentAt = (/** @type {number} */ t) => {
    const past = exact.contacts.findLast(([, end]) => end <= t);
    if (!past) return 0;
    return past === exact.contacts.at(-1) ? dent : Math.min(between(x, near, past[1]), dent); // by then
  };
  const y = stays ? near.map((value, k) => Math.max(value, dentAt(x[k]))) : near;
  const words = text('opening.track.dent', { depth: engineering(dent * factor, 'm', 3) });
  return [
    {
      ...{ title: text('opening.track.pressed'), share: 0.8, range: [0, ROOM * deepest * factor], unit: 'm' },
      series: [{ x, y, factor, style: 'struck', name: '' }],
      said: stays ? [{ t: exact.contacts.at(-1)?.[1] ?? 0, value: dent * factor, words }] : [],
    },
  ];
}

/**
 * @param {AxialFrame} frame
 * @param {Field} field  that is drawn
 * @param {Series[]} forces
 * @returns {Tracked}
 */
export function tracksOf(frame, field, forces) {
  const { exact, motionTime: x, speed, trip } = frame;
  const factor = speed * trip;
  const [force] = forces;
  /** @type {Track[]} */
  const tracks = [];
  if (!exact.peakForce || !force?.x.length) {
    const most = Math.max(...exact.contacts.map(([, , impulse]) => impulse));
    const bars = exact.contacts.map(([t, , value]) => ({ t, value, words: engineering(value, 'N s', 3) }));
    tracks.push({ title: text('opening.track.impulses'), share: 1, range: [1.6 * most, 0], unit: 'N s', bars });
  } else {
    const [, most] = spanOf(force.y);
    const range = /** @type {[number, number]} */ ([ROOM * most * (force.factor ?? 1), 0]);
    tracks.push({ title: text('opening.track.force'), share: 1.2, range, unit: 'N', force: true, series: forces });
  }
  tracks.push(...barOf(frame, field.solution));
  tracks.push(...indentationOf(frame, field));
  const [low, high] = spanOf([...field.masses, ...field.ends]);
  const room = (ROOM - 1) * (high - low);
  tracks.push({
    ...{ title: text('opening.track.moved'), share: 1, unit: 'm' },
    range: [(low - room) * factor, (high + room) * factor],
    series: [
      { x, y: field.masses, factor, style: 'exact', name: '', cursor: text('opening.track.strikes') },
      ...(frame.target.held ? [] : [struck(field, x, factor)]),
    ],
  });
  return {
    by: byOf(called(exact), errorsOf(exact)),
    clock: times.shown,
    drawn: null,
    tracks,
  };
}
