// A thin specimen between two bars, as a Hopkinson bar has it, and what gauges half way along these bars would tell.
import { text } from '../text/catalogue.js';

/** @import { Range } from '../charts/scale.js' */
/** @import { AxialFrame } from '../messages.js' */
/** @import { Trace } from '../opening/section.js' */
/** @import { Field } from './fields.js' */
/** @import { Stage } from './stage.js' */

const SHORT = 0.1; // of the bars beside it, that a specimen is long at most
const WIDE = 0.09; // of the picture, that the largest stress is drawn as
const SEAM = 0.13; // of the bodies, that a specimen is drawn wide

/**
 * Numbers of the bars before and after a specimen; nothing where there is none.
 * @param {AxialFrame} frame
 * @returns {[before: number, after: number] | null}
 */
export function barsOf({ rods }) {
  const long = rods.map(({ from, to }) => to - from);
  const at = rods.findIndex((_, k) => long[k] < SHORT * Math.min(long[k - 1] ?? 0, long[k + 1] ?? 0));
  return at < 0 ? null : [at - 1, at + 1];
}

/** @typedef {{ from: number, to: number, wide: number }} Seam  between two places [m], so wide [px] */
/**
 * Where a specimen is, which is too thin to be seen as it is.
 * @param {AxialFrame} frame
 * @param {number} length  of all that is drawn [px]
 * @returns {Seam | null}
 */
export function seamIn(frame, length) {
  const [before] = barsOf(frame) ?? [];
  if (before === undefined) return null;
  const { from, to } = frame.rods[before + 1];
  return { from, to, wide: SEAM * length };
}

/**
 * Where places are drawn: as far apart as they are, but for a seam.
 * @param {Range} places  the first and the last [m]
 * @param {Range} ends  where these are drawn [px]
 * @param {Seam | null} seam
 */
export function placing([from, to], [left, right], seam) {
  if (!seam) return (/** @type {number} */ x) => left + ((x - from) / (to - from)) * (right - left);
  const each = (right - left - seam.wide) / (to - from - (seam.to - seam.from));
  return (/** @type {number} */ x) => {
    if (x <= seam.from) return left + (x - from) * each;
    if (x >= seam.to) return right - (to - x) * each;
    return left + (seam.from - from) * each + ((x - seam.from) / (seam.to - seam.from)) * seam.wide;
  };
}

/**
 * The force through the specimen, to be drawn in its seam.
 * @param {AxialFrame} frame
 * @param {Field} field
 * @param {Stage} stage
 * @param {Range} stretch
 * @returns {import('../opening/seam.js').Filled | null}
 */
export function filledOf(frame, field, { largest, leads, place, what }, stretch) {
  const [before] = barsOf(frame) ?? [];
  if (before === undefined || !leads || what !== 'stress') return null;
  const { area, from, to } = frame.rods[before + 1];
  const stress = field.over((from + to) / 2, stretch, 'stress');
  if (!stress) return null;
  const unit = area * frame.forceUnit;
  const force = Float64Array.from(stress.y, (value) => value * unit);
  // coloured as the bar beside it, which feels the same force
  return {
    left: place(from),
    right: place(to),
    x: stress.x,
    force,
    largest: largest * frame.rods[before].area * frame.forceUnit,
  };
}

/**
 * @param {AxialFrame} frame
 * @param {Field} field
 * @param {Stage} stage
 * @param {Range} stretch
 * @returns {Trace[]}
 */
export function tracesOf(frame, field, { drawn: { left, right }, place: across }, stretch) {
  const bars = barsOf(frame);
  const seen = (bars ?? []).flatMap((number, k) => {
    const { from, to } = frame.rods[number];
    const place = (from + to) / 2;
    const stress = field.over(place, stretch, 'stress');
    return stress ? [{ place, stress, name: text('opening.gauge', { number: k + 1 }) }] : [];
  });
  const most = Math.max(...seen.flatMap(({ stress }) => Array.from(stress.y, Math.abs)));
  return seen.map(({ name, place, stress: { x, y } }) => ({
    ...{ name, x, at: across(place) },
    moved: Array.from(y, (value) => (value / most) * WIDE * (right - left)),
  }));
}
