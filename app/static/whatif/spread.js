// What many impacts about a scene say: quantiles, shares, and how much of the variance goes with each input alone.

const STRIP = 60; // impacts in a strip of an input, about
const STRIPS = { least: 8, most: 16 };
const PRIMES = [2, 3, 5, 7, 11, 13, 17, 19];
const SAME = 1e-12; // of the mean: what varies by less is the same everywhere
const GOLDEN = 0.618; // of a prime: what its digits are mixed by

/** Inputs at most: more than so many impacts could distinguish, and a server takes no more. */
export const MOST_INPUTS = PRIMES.length;

/**
 * A point of Halton's, its digits mixed, as else those of large primes run beside each other.
 * @param {number} n  from 0 on
 * @param {number} inputs
 * @returns {number[]}  between 0 and 1
 */
export function haltonAt(n, inputs) {
  return PRIMES.slice(0, inputs).map((prime) => {
    const times = Math.max(1, Math.round(GOLDEN * prime));
    let [share, unit] = [0, 1];
    for (let rest = n + 1; rest; rest = Math.floor(rest / prime)) {
      unit /= prime;
      share += unit * (((rest % prime) * times) % prime);
    }
    return share;
  });
}

/**
 * Values below which these shares lie, on the straight line between two impacts.
 * @param {ArrayLike<number>} sorted
 * @param {number[]} shares
 */
export function quantilesOf(sorted, shares) {
  const last = sorted.length - 1;
  return shares.map((share) => {
    const place = share * last;
    const k = Math.min(Math.floor(place), Math.max(last - 1, 0));
    return last < 1 ? (sorted[0] ?? NaN) : sorted[k] + (place - k) * (sorted[k + 1] - sorted[k]);
  });
}

/**
 * Share of those above a value.
 * @param {ArrayLike<number>} sorted
 * @param {number} value
 */
export function shareAbove(sorted, value) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] > value) high = middle;
    else low = middle + 1;
  }
  return (sorted.length - low) / sorted.length;
}

/**
 * The share of the variance that goes with one input alone, by the means of strips of it; and what the result gains by
 * straight line from the middle of the input to its end. Inputs are even: in each strip the others are about all that
 * they can be, so that its mean hardly hangs on chance.
 * @param {ArrayLike<number>} values
 * @param {(n: number) => number} inputOf  −1 to 1, of a value
 */
export function mattersOf(values, inputOf) {
  const count = values.length;
  const strips = Math.max(STRIPS.least, Math.min(STRIPS.most, Math.floor(count / STRIP)));
  const sums = new Float64Array(strips);
  const counts = new Float64Array(strips);
  let mean = 0;
  let middle = 0;
  for (let n = 0; n < count; n++) {
    mean += values[n] / count;
    middle += inputOf(n) / count;
  }
  let [whole, slope, width] = [0, 0, 0];
  for (let n = 0; n < count; n++) {
    const [off, input] = [values[n] - mean, inputOf(n)];
    const strip = Math.min(strips - 1, Math.max(0, Math.floor(((input + 1) / 2) * strips)));
    sums[strip] += off;
    counts[strip] += 1;
    whole += off * off;
    slope += off * (input - middle);
    width += (input - middle) ** 2;
  }
  if (whole <= count * (SAME * mean) ** 2) return { share: 0, effect: 0 };
  let between = 0;
  for (let k = 0; k < strips; k++) if (counts[k]) between += sums[k] ** 2 / counts[k];
  return { share: Math.min(between / whole, 1), effect: width > 0 ? slope / width : 0 };
}

/**
 * How many lie in each of so many equal parts of a range, by kind.
 * @param {ArrayLike<number>} values
 * @param {ArrayLike<number>} kinds
 * @param {[low: number, high: number]} range
 * @param {number} parts
 * @returns {Map<number, number>[]}
 */
export function binsOf(values, kinds, [low, high], parts) {
  const bins = Array.from({ length: parts }, () => /** @type {Map<number, number>} */ (new Map()));
  for (let n = 0; n < values.length; n++) {
    const at = Math.floor(((values[n] - low) / (high - low)) * parts);
    const bin = bins[Math.min(Math.max(at, 0), parts - 1)];
    bin.set(kinds[n], (bin.get(kinds[n]) ?? 0) + 1);
  }
  return bins;
}
