// What the opening draws of a sliding contact below its stage: the clock of an impact without time is the impulse.
import { text } from '../text/catalogue.js';
import { engineering, scaled } from '../text/format.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Numbers, SpaceFrame } from '../messages.js' */
/** @import { Event } from '../shell/story.js' */
/** @import { Tracked } from '../opening/section.js' */
/** @import { Track } from '../opening/tracks.js' */

const ROOM = 1.1; // about the largest value
const IMPACT = 2; // on the clock, from 0 on; the movement before it and after it takes 1 each
export const CLOCK = { start: -1, length: 2 + IMPACT };
const NONE = new Float64Array(0);
const BACK = 0.05; // of the largest velocity along the contact, that is more than nothing

/**
 * The clock of the movement, to which the impact is one instant.
 * @param {number} t
 */
export const movedAt = (t) => (t < 0 ? t : Math.max(t - IMPACT, 0));

/**
 * A history over the impulse as one over that clock.
 * @param {Numbers} press
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
 * @returns {Tracked | null}
 */
export function tracksOf({ friction, slideAlong, slideAside, slideParting, slidePress, slidePush, slideSpin }) {
  if (!slidePress || !slideAlong || !slideAside || !slideParting || !slidePush || !slideSpin) return null;
  const speed = Array.from(slideAlong, (v, k) => Math.hypot(v, slideAside[k]));
  const most = Array.from(slidePress, (push) => friction * push);
  const [per, sign] = scaled(slidePress[slidePress.length - 1], 'N s');
  const curve = (/** @type {Numbers | number[]} */ values, /** @type {Series['style']} */ style) =>
    over(slidePress, values, style);
  /** @type {Track[]} */
  const tracks = [
    {
      title: text('opening.track.parting'),
      unit: 'm/s',
      range: rangeOf(slideParting),
      series: [curve(slideParting, 'exact')],
    },
    { title: text('opening.track.slides'), unit: 'm/s', range: rangeOf(speed), series: [curve(speed, 'other')] },
    {
      ...{ title: text('opening.track.rubs'), unit: 'N s', range: rangeOf(slidePush, most) },
      series: [
        { ...curve(slidePush, 'struck'), cursor: text('opening.track.push') },
        { ...curve(most, 'prediction'), cursor: text('opening.track.cone') },
      ],
    },
    {
      title: text('opening.track.spin'),
      unit: 'rad/s',
      range: rangeOf(slideSpin),
      series: [curve(slideSpin, 'halfSpace')],
    },
  ].map((track) => ({ share: 1, .../** @type {Omit<Track, 'share'>} */ (track) }));
  return {
    by: '',
    clock: [(per * slidePress[slidePress.length - 1]) / IMPACT, sign],
    drawn: null,
    timed: [0, IMPACT],
    tracks,
  };
}

/**
 * What happens over the impulse.
 * @param {SpaceFrame} frame
 * @param {string} touch  what is said of it as a whole
 * @returns {Event[]}
 */
export function courseOf({ slideParting = NONE, slidePress = NONE, sliding }, touch) {
  const most = slidePress[slidePress.length - 1];
  const named = (/** @type {number} */ t, /** @type {string} */ code) =>
    /** @type {Event} */ ([IMPACT * t, text(`space.event.${code}`), text(`space.named.${code}`)]);
  /** @type {Event[]} */
  const begins = [[0, touch, text('space.named.touches')]];
  const changes = sliding.slice(1).map(({ kind }, k) => named(sliding[k].until / most, kind));
  const turn = Array.from(slideParting).findIndex((v) => v >= 0);
  const deepest = turn > 0 ? [named(slidePress[turn] / most, 'deepest')] : [];
  return [...begins, ...[...changes, ...deepest].sort(([a], [b]) => a - b), named(1, 'leaves')];
}

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
export const impulseAt = ({ slidePress = NONE }, t) =>
  engineering(Math.min(Math.max(t / IMPACT, 0), 1) * (slidePress[slidePress.length - 1] ?? 0), 'N s', 3);
