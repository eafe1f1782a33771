// What the opening draws of bodies in space below their stage: the clock of an impact without time is the impulse.
import { text } from '../text/catalogue.js';
import { figures, scaled } from '../text/format.js';
import { bodyOf, smoothOf } from './smooth.js';
import { cross, dot, triple } from './vectors.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Numbers, SpaceFrame } from '../messages.js' */
/** @import { Event } from '../frame/story.js' */
/** @import { Tracked } from '../opening/section.js' */
/** @import { Track } from '../opening/tracks.js' */

const ROOM = 1.1; // about the largest value
const IMPACT = 2; // on the clock, from 0 on; the movement before it and after it takes 1 each
export const CLOCK = { start: -1, length: 2 + IMPACT };
const LEAST = 1e-6; // of the largest spin, that is one
const BACK = 0.05; // of the largest velocity along the contact, that is more than nothing

/**
 * The clock of the movement, to which the impact is one instant.
 * @param {number} t
 */
export const movedAt = (t) => (t < 0 ? t : Math.max(t - IMPACT, 0));

/** How much of the normal impulse has been given. @param {number} t */
export const shareAt = (t) => Math.min(Math.max(t / IMPACT, 0), 1);

/** @type {Record<import('./smooth.js').Which, Series['style']>} */
const INK = { impactor: 'joint6', target: 'exact' }; // as the bodies are drawn

/**
 * The normal impulse in the end; of what does not meet nothing.
 * @param {SpaceFrame} frame
 */
const pressed = ({ impulse, slidePress }) => slidePress?.[slidePress.length - 1] ?? impulse;

/**
 * Whether the clock can run through the impact.
 * @param {SpaceFrame} frame
 */
export const meets = (frame) => pressed(frame) > 0;

/**
 * A history over the impulse as one over that clock.
 * @param {ArrayLike<number>} press
 * @param {Numbers | number[]} values
 * @param {Series['style']} style
 * @returns {Series}
 */
function over(press, values, style) {
  const most = press[press.length - 1];
  const x = [CLOCK.start, ...Array.from(press, (each) => (IMPACT * each) / most), CLOCK.start + CLOCK.length];
  return { x, y: [values[0], ...values, values[values.length - 1]], style, name: '' };
}

/**
 * @param {ArrayLike<number>[]} all
 * @returns {[low: number, high: number]}
 */
function rangeOf(...all) {
  const values = [0, ...all.flatMap((each) => Array.from(each))];
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const room = (ROOM - 1) * (high - low || 1);
  return [low < 0 ? low - room : 0, high > 0 ? high + room : 0];
}

/**
 * @param {SpaceFrame} frame
 * @returns {Tracked}
 */
export function tracksOf(frame) {
  const most = pressed(frame);
  const [per, sign] = scaled(most, 'N s');
  return {
    by: [text('opening.track.clock')],
    clock: [(per * most) / IMPACT, sign],
    drawn: null,
    tall: true,
    timed: [0, IMPACT],
    tracks: [...(rubbed(frame) ?? smooth(frame))].map((track) => ({ share: 1, ...track })),
  };
}

/** @typedef {Omit<Track, 'share'>} Plain */
/**
 * Without friction: how fast the bodies part, go and turn, and what energy they have.
 * @param {SpaceFrame} frame
 * @returns {Plain[]}
 */
function smooth(frame) {
  const { along, energy, parting, spins } = smoothOf(frame);
  const even = (/** @type {number} */ count) => Array.from({ length: count }, (_, k) => k / (count - 1));
  const curve = (/** @type {number[]} */ values, /** @type {Series['style']} */ style) =>
    over(even(values.length), values, style);
  const changes = (/** @type {import('./smooth.js').Change[]} */ all) => ({
    range: rangeOf(...all.map(({ values }) => values)),
    series: all.map(({ values, which }) => ({ ...curve(values, INK[which]), cursor: bodyOf(which) })),
  });
  return [
    { title: text('opening.track.parting'), unit: 'm/s', range: rangeOf(parting), series: [curve(parting, 'other')] },
    { title: text('opening.track.normal'), unit: 'm/s', ...changes(along) },
    ...(spins.length ? [{ title: text('opening.track.spin'), unit: 'rad/s', ...changes(spins) }] : []),
    { title: text('opening.track.energy'), unit: 'J', range: rangeOf(energy), series: [curve(energy, 'struck')] },
  ];
}

/**
 * With friction: how the contact slides as well; nothing without.
 * @param {SpaceFrame} frame
 * @returns {Plain[] | null}
 */
function rubbed(frame) {
  const { friction, slideAlong, slideAside, slideParting, slidePress, slidePush } = frame;
  if (!slidePress || !slideAlong || !slideAside || !slideParting || !slidePush) return null;
  const spins = spinsOf(frame);
  const speed = Array.from(slideAlong, (v, k) => Math.hypot(v, slideAside[k]));
  const most = Array.from(slidePress, (push) => friction * push);
  const curve = (/** @type {Numbers | number[]} */ values, /** @type {Series['style']} */ style) =>
    over(slidePress, values, style);
  return [
    {
      title: text('opening.track.parting'),
      unit: 'm/s',
      range: rangeOf(slideParting),
      series: [curve(slideParting, 'exact')],
    },
    { title: text('opening.track.slides'), unit: 'm/s', range: rangeOf(speed), series: [curve(speed, 'other')] },
    ...(spins.length
      ? [
          {
            ...{
              title: text('opening.track.spin'),
              unit: 'rad/s',
              range: rangeOf(...spins.map(({ values }) => values)),
            },
            series: spins.map(({ values, which }) => ({
              ...curve(values, INK[which]),
              cursor: spins.length > 1 ? bodyOf(which) : undefined,
            })),
          },
        ]
      : []),
    {
      ...{ title: text('opening.track.rubs'), unit: 'N s', range: rangeOf(slidePush, most) },
      series: [
        { ...curve(slidePush, 'struck'), cursor: text('opening.track.push') },
        { ...curve(most, 'prediction'), cursor: text('opening.track.cone') },
      ],
    },
  ];
}

/**
 * With friction: the spins of the bodies that turn, about the line towards who looks.
 * @param {SpaceFrame} frame
 * @returns {{ which: import('./smooth.js').Which, values: number[] }[]}
 */
function spinsOf({ across, slideSpins, up }) {
  if (!slideSpins) return [];
  const toward = cross(across, up);
  const both = /** @type {const} */ (['impactor', 'target']).map((which, k) => ({
    which,
    values: Array.from({ length: slideSpins.length / 6 }, (_, row) => dot(triple(slideSpins, 6 * row + 3 * k), toward)),
  }));
  const most = Math.max(...both.flatMap(({ values }) => values.map(Math.abs)));
  return both.filter(({ values }) => values.some((spin) => Math.abs(spin) > LEAST * most));
}

/**
 * What happens over the impulse.
 * @param {SpaceFrame} frame
 * @param {string} touch  what is said of it as a whole
 * @returns {Event[]}
 */
export function courseOf(frame, touch) {
  const { slideParting, slidePress, sliding } = frame;
  const most = pressed(frame);
  const named = (/** @type {number} */ t, /** @type {string} */ code) =>
    /** @type {Event} */ ([IMPACT * t, text(`space.event.${code}`), text(`space.named.${code}`)]);
  /** @type {Event[]} */
  const begins = [[0, touch, text('space.named.touches')]];
  const changes = sliding.slice(1).map(({ kind }, k) => named(sliding[k].until / most, kind));
  const share = slideParting && slidePress ? turned(slidePress, slideParting) / most : halfway(smoothOf(frame).parting);
  const deepest = share > 0 && share < 1 ? [named(share, 'deepest')] : [];
  return [...begins, ...[...changes, ...deepest].sort(([a], [b]) => a - b), named(1, 'leaves')];
}

/**
 * The impulse at which they approach no more.
 * @param {Numbers} press
 * @param {Numbers} parting
 */
const turned = (press, parting) =>
  press[
    Math.max(
      parting.findIndex((v) => v >= 0),
      0,
    )
  ];

/** @param {[before: number, after: number]} parting  that changes in proportion; the share of the impulse */
const halfway = ([before, after]) => before / (before - after);

/**
 * What friction does to it: it turns back, grips, or slides all the way.
 * @param {SpaceFrame} frame
 */
export function wayOf({ across, bodies: { impactor }, slidePress, sliding }) {
  if (!slidePress) return 'smooth';
  const [before, after] = [impactor.before, impactor.after].map(({ velocity }) =>
    velocity.reduce((sum, v, k) => sum + v * across[k], 0),
  );
  const most = Math.max(...[impactor.before, impactor.after].map(({ velocity }) => Math.hypot(...velocity)));
  if (Math.abs(before) > BACK * most && before * after < 0) return 'back';
  return sliding.some(({ kind }) => kind === 'stick') ? 'grips' : 'slides';
}

/**
 * How far the impulse is, on that clock.
 * @param {SpaceFrame} frame
 * @param {number} t
 */
export function impulseAt(frame, t) {
  const most = pressed(frame);
  const [per, sign] = scaled(most, 'N s'); // as the axis has it
  return `${figures(shareAt(t) * most * per)} ${sign}`;
}
