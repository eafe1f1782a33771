// Lines of thousands of samples, drawn by as few points as a picture can tell apart.

/** @import { Samples } from './scale.js' */
/** @typedef {[base: number, factor: number]} Scale  a sample is drawn at base + factor * sample [px] */

/**
 * Give the points of a line of which each pixel along it has the first, the last and the extremes between them.
 * @param {Samples} samples
 * @param {[from: number, to: number]} some  of them, the last one not among them
 * @param {Scale} along
 * @param {Scale} off
 * @param {(along: number, off: number) => void} give
 */
export function thinned({ x, y }, [from, to], [start, speed], [base, factor], give) {
  let pixel = NaN;
  let [low, high, first, last, at] = [0, 0, 0, 0, 0]; // of this pixel, and where its last sample is
  const close = () => {
    const rises = high > first && high > last;
    const falls = low < first && low < last;
    if (rises) give(at, high);
    if (falls) give(at, low);
    if (rises || falls || last !== first) give(at, last);
  };
  for (let k = from; k < to; k++) {
    const place = start + speed * x[k];
    const value = base + factor * y[k];
    const here = Math.floor(place);
    if (here === pixel) {
      if (value < low) low = value;
      else if (value > high) high = value;
    } else {
      if (k > from) close();
      pixel = here;
      low = value;
      high = value;
      first = value;
      give(place, value);
    }
    at = place;
    last = value;
  }
  if (to > from) close();
}
