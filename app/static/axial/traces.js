// A thin specimen between two bars, as a Hopkinson bar has it, and what gauges half way along these bars would tell.
import { text } from '../text/catalogue.js';

/** @import { Range } from '../charts/scale.js' */
/** @import { AxialFrame } from '../messages.js' */
/** @import { Trace } from '../opening/section.js' */
/** @import { Field } from './fields.js' */
/** @import { Stage } from './stage.js' */

const SHORT = 0.1; // of the bars beside it, that a specimen is long at most
const WIDE = 0.09; // of the picture, that the largest stress is drawn as

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

/**
 * @param {AxialFrame} frame
 * @param {Field} field
 * @param {Stage} stage
 * @param {Range} stretch
 * @returns {Trace[]}
 */
export function tracesOf(frame, field, { drawn: { left, right } }, stretch) {
  const bars = barsOf(frame);
  const seen = (bars ?? []).flatMap((number, k) => {
    const { from, to } = frame.rods[number];
    const place = (from + to) / 2;
    const stress = field.stressAt(place, stretch);
    return stress ? [{ place, stress, name: text('opening.gauge', { number: k + 1 }) }] : [];
  });
  const most = Math.max(...seen.flatMap(({ stress }) => Array.from(stress.y, Math.abs)));
  const each = (right - left) / (field.to - field.from);
  return seen.map(({ name, place, stress: { x, y } }) => ({
    ...{ name, x, at: left + (place - field.from) * each },
    moved: Array.from(y, (value) => (value / most) * WIDE * (right - left)),
  }));
}
