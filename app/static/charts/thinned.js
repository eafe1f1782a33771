// Lines of thousands of samples, drawn by as few points as a picture can tell apart.

/**
 * Give the points of a line of which each pixel along it has the first, the last and the extremes between them.
 * @param {number} from  the first sample
 * @param {number} to  beyond the last one
 * @param {(k: number) => number} along  ascending [px]
 * @param {(k: number) => number} off  [px]
 * @param {(along: number, off: number) => void} give
 */
export function thinned(from, to, along, off, give) {
  let pixel = NaN;
  let [low, high, at, last] = [0, 0, 0, 0];
  let given = 0; // of this pixel
  const close = () => {
    const [least, most] = [Math.min(given, last), Math.max(given, last)];
    if (high > most) give(at, high);
    if (low < least) give(at, low);
    if (last !== given || low < least || high > most) give(at, last);
  };
  for (let k = from; k < to; k++) {
    const [place, value] = [along(k), off(k)];
    const here = Math.floor(place);
    if (here === pixel) {
      if (value < low) low = value;
      if (value > high) high = value;
    } else {
      if (k > from) close();
      pixel = here;
      low = high = given = value;
      give(place, value);
    }
    [at, last] = [place, value];
  }
  if (to > from) close();
}
