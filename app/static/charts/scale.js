// Axes and curves as numbers: ticks, ranges, values between samples. Nothing here draws.

/** @typedef {[low: number, high: number]} Range */
/** @typedef {{ x: ArrayLike<number>, y: ArrayLike<number> }} Samples  ascending in x; where x stands twice, a jump */

/**
 * @param {number} value
 * @param {Range} range
 */
export const within = (value, [low, high]) => Math.min(Math.max(value, low), high);

/**
 * Round numbers along a linear axis, and how many digits after the point tell them apart.
 * @param {number} low
 * @param {number} high
 * @param {number} about  how many are wanted
 * @returns {{ found: number[], digits: number }}
 */
export function ticks(low, high, about) {
  const rough = (high - low) / Math.max(about, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const steps = [1, 2, 5, 10].map((f) => f * power);
  const wanted = steps.find((each) => each >= rough * 0.999) ?? 10 * power;
  const count = (/** @type {number} */ each) => Math.floor(high / each + 1e-9) - Math.ceil(low / each - 1e-9) + 1;
  // One tick alone gives no scale; in so few places of a small chart two steps on there is room for two.
  const step = about >= 1.5 && count(wanted) < 2 ? (steps.findLast((each) => count(each) >= 2) ?? wanted) : wanted;
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++) found.push(k === 0 ? 0 : k * step);
  return { found, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

/**
 * The largest of 1, 2 and 5 times a power of ten that is no larger than this.
 * @param {number} value
 */
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * ([5, 2, 1].find((f) => f * power <= value) ?? 1);
}

/**
 * Exponents of the powers of ten along a logarithmic axis.
 * @param {Range} range
 * @param {number} most  that have room
 */
export function decades([low, high], most) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const every = Math.max(1, Math.ceil((last - first + 1) / most));
  const found = [];
  for (let power = first; power <= last; power += every) found.push(power);
  return found;
}

/**
 * Place of a value on a logarithmic axis, from 0 to 1.
 * @param {number} value
 * @param {Range} range
 */
export const logPlace = (value, [low, high]) => Math.log(value / low) / Math.log(high / low);

/**
 * The last sample at or before t; 0 if there is none.
 * @param {ArrayLike<number>} x  ascending
 * @param {number} t
 */
export function indexAt(x, t) {
  let low = 0;
  let high = x.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= t) low = middle;
    else high = middle;
  }
  return low;
}

/**
 * Value at t of a history; at a jump the value after it, beyond the ends the last one.
 * @param {ArrayLike<number>} x  ascending
 * @param {ArrayLike<number>} y
 * @param {number} t
 */
export function between(x, y, t) {
  const k = Math.min(indexAt(x, t), x.length - 2);
  if (k < 0) return x.length ? y[0] : NaN;
  const part = x[k + 1] > x[k] ? Math.min(Math.max((t - x[k]) / (x[k + 1] - x[k]), 0), 1) : 1;
  return y[k] + part * (y[k + 1] - y[k]);
}

/**
 * Instants spread evenly over [0, end].
 * @param {number} count
 * @param {number} end
 */
export const even = (count, end) => Float64Array.from({ length: count }, (_, k) => (k / (count - 1)) * end);

/**
 * Values at instants spread evenly over a stretch of time.
 * @param {Range} stretch
 * @param {number} count
 * @param {(t: number, k: number) => number} value  there, and at which of them
 * @returns {Samples}
 */
export function evenly([start, end], count, value) {
  const x = Float64Array.from({ length: count + 1 }, (_, k) => start + (k / count) * (end - start));
  return { x, y: x.map(value) };
}

/**
 * Curves of a solution at a place, on an axis of time that is that of another; none where it has nothing.
 * @template {Samples} Curve
 * @param {{ field: { from: number, to: number }, frame: { duration: number, trip: number } }} source
 * @param {number} place  [m]
 * @param {Range} view  of the axis
 * @param {number} trip  its unit [s]
 * @param {(stretch: Range) => Curve[]} read  over a stretch of the solution's own time
 * @returns {Curve[]}
 */
export function overTime({ field, frame }, place, view, trip, read) {
  const times = frame.trip / trip;
  const [start, end] = view.map((t) => within(t / times, [0, frame.duration]));
  if (end <= start || place < field.from || place > field.to) return [];
  const found = read([start, end]);
  return times === 1 ? found : found.map((each) => ({ ...each, x: Array.from(each.x, (t) => times * t) }));
}

/**
 * Samples of a history, if there is one.
 * @param {ArrayLike<number> | undefined} x
 * @param {ArrayLike<number> | undefined} y
 * @returns {Samples | null}
 */
export const pair = (x, y) => (x && y ? { x, y } : null);

/**
 * A history with finer samples of a stretch in place of its own there.
 * @param {Samples} whole
 * @param {Samples} fine
 * @returns {Samples}
 */
export function withFiner(whole, fine) {
  const [start, end] = [fine.x[0], fine.x[fine.x.length - 1]];
  const kept = (/** @type {(t: number) => boolean} */ outside) =>
    Array.from(whole.x, (t, k) => [t, whole.y[k]]).filter(([t]) => outside(t));
  const all = [...kept((t) => t < start), ...Array.from(fine.x, (t, k) => [t, fine.y[k]]), ...kept((t) => t > end)];
  return { x: all.map(([t]) => t), y: all.map(([, value]) => value) };
}

/**
 * A history that holds each of its values for one step.
 * @param {ArrayLike<number>} values
 * @param {number} step
 * @returns {{ x: Float64Array, y: Float64Array }}
 */
export function stairs(values, step) {
  const x = new Float64Array(2 * values.length);
  const y = new Float64Array(2 * values.length);
  for (let k = 0; k < x.length; k++) {
    x[k] = step * ((k + 1) >> 1);
    y[k] = values[k >> 1];
  }
  return { x, y };
}

/**
 * The mean of such a history over a window about the end of every step.
 * @param {ArrayLike<number>} values
 * @param {number} step
 * @param {number} window
 * @returns {{ x: Float64Array, y: Float64Array }}  one sample more than there are values
 */
export function averaged(values, step, window) {
  const n = values.length;
  const sums = new Float64Array(n + 1);
  for (let k = 0; k < n; k++) sums[k + 1] = sums[k] + values[k] * step;
  const [x, y] = [new Float64Array(n + 1), new Float64Array(n + 1)];
  for (let k = 0; k <= n; k++) {
    x[k] = k * step;
    for (let side = -1; n && side <= 1; side += 2) {
      const place = Math.min(Math.max((x[k] + (side * window) / 2) / step, 0), n);
      const i = Math.min(Math.floor(place), n - 1);
      y[k] += (side * (sums[i] + (place - i) * (sums[i + 1] - sums[i]))) / window;
    }
  }
  return { x, y };
}

/**
 * Lowest and highest value within a view, the values at its edges included; null if there is none.
 * @param {Samples & { path?: boolean }} samples  `path`: in any order of x
 * @param {Range} view
 * @returns {Range | null}
 */
export function extremes({ x, y, path }, view) {
  let low = Infinity;
  let high = -Infinity;
  if (!path && x.length && x[0] <= view[1] && x[x.length - 1] >= view[0]) {
    for (const edge of [Math.max(view[0], x[0]), Math.min(view[1], x[x.length - 1])]) {
      const value = between(x, y, edge);
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  const first = path ? 0 : indexAt(x, view[0]);
  for (let k = first; k < x.length; k++) {
    if (x[k] > view[1] && !path) break;
    if (x[k] < view[0] || x[k] > view[1]) continue;
    if (y[k] < low) low = y[k];
    if (y[k] > high) high = y[k];
  }
  return low <= high ? [low, high] : null;
}

/**
 * How far a series may widen the range of its chart: `Infinity` those that lead; so many times the range of what came
 * before it; 0 not at all. 'whole': leads, but only while nothing is zoomed.
 * @typedef {number | 'whole'} Reach
 */

/**
 * The range of y for what lies in view.
 * @param {(Samples & { path?: boolean, factor?: number, reach?: Reach, below?: number })[]} series  values are y times
 *   factor; `below`: how far one that does not lead may go below nought, of what is above
 * @param {Range} view
 * @param {object} how
 * @param {boolean} how.zoomed
 * @param {boolean | 'whole'} [how.zero]  nought belongs to the range: always, or while nothing is zoomed
 * @param {[below: number, above: number]} how.pad  as shares of the range
 * @returns {Range}
 */
export function rangeOf(series, view, { zoomed, zero = false, pad }) {
  const withZero = zero === true || (zero === 'whole' && !zoomed);
  let low = withZero ? 0 : Infinity;
  let high = withZero ? 0 : -Infinity;
  const reaches = series.map(({ reach = Infinity }) => (reach === 'whole' ? (zoomed ? 0 : Infinity) : reach));
  const order = [...series.keys()].sort((a, b) => Number(reaches[b] === Infinity) - Number(reaches[a] === Infinity));
  for (const k of order) {
    const seen = reaches[k] > 0 ? extremes(series[k], view) : null;
    if (!seen) continue;
    const [least, most] = seen.map((value) => value * (series[k].factor ?? 1)).sort((a, b) => a - b);
    const bounded = reaches[k] < Infinity && high > 0;
    const floor = reaches[k] * Math.min(low, 0) - (series[k].below ?? 0) * high;
    low = Math.min(low, bounded ? Math.max(least, floor) : least);
    high = Math.max(high, bounded ? Math.min(most, reaches[k] * high) : most);
  }
  if (!(high > low)) {
    const middle = Number.isFinite(low) ? low : 0;
    const reach = Math.abs(middle) || 1;
    [low, high] = withZero ? [0, reach] : [middle - reach, middle + reach];
  }
  return [low - pad[0] * (high - low), high + pad[1] * (high - low)];
}

/**
 * The ends of x and of y.
 * @param {ArrayLike<number>} places  x and y in turn
 */
export function boxOf(places) {
  const box = [Infinity, -Infinity, Infinity, -Infinity];
  for (let i = 0; i < places.length; i++) {
    const k = 2 * (i % 2);
    box[k] = Math.min(box[k], places[i]);
    box[k + 1] = Math.max(box[k + 1], places[i]);
  }
  return box;
}
