// What a line that was drawn has of what happens, criterion by criterion. Only numbers: nothing here draws.

/**
 * @typedef {object} Criterion  times in T, values in the unit of the chart
 * @property {string} criterion
 * @property {number | [number, number]} at
 * @property {number} within
 * @property {number} slack
 * @property {number} by
 * @property {number} above
 */
/**
 * @typedef {object} Judgement
 * @property {string} outcome  which sentence is said
 * @property {number} yours  when it is in the line
 * @property {number} right  when it is
 * @property {[t: number, value: number]} ring  where in the line the sentence belongs
 * @property {[t: number, value: number]} to  where that is in truth
 * @property {[from: number, to: number]} span  of time that it is about
 */
/** @typedef {(t: number) => number} Truth */

export const BIN = 0.01; // T: a line has one value for each
export const NOTHING = 0.025; // of the height of the chart: what is drawn below is zero
const SHORT = 5; // values on either side of a jump, which is steep
const LONG = 15; // and of a hump, which is not
const STEEP = 0.6; // of the long rise, that a jump has at least in the short one
const SLIGHT = 0.4; // of its height, from which a rise is a small jump
const GAP = 10; // values without force, behind which they have parted
const BREAK = 3; // values without force between two contacts
const EXACTLY = 1e-9;

/** @param {number} until  [T] */
export const blank = (until) => Array.from({ length: Math.round(until / BIN) + 1 }, () => NaN);

/** @param {number} t */
const binOf = (t) => Math.round(t / BIN);

/**
 * A line without gaps: they are joined straight, and its ends go on as they are.
 * @param {number[]} line
 */
export function joined(line) {
  const found = line.slice();
  const known = [...found.keys()].filter((k) => !Number.isNaN(found[k]));
  if (!known.length) return found.fill(0);
  found.fill(found[known[0]], 0, known[0]);
  found.fill(found[known[known.length - 1]], known[known.length - 1]);
  for (let n = 1; n < known.length; n++) {
    const [a, b] = [known[n - 1], known[n]];
    for (let k = a + 1; k < b; k++) found[k] = found[a] + ((k - a) / (b - a)) * (found[b] - found[a]);
  }
  return found;
}

/**
 * A value between those of a boundary, at equal steps from 0 to 1.
 * @param {number[]} truth
 */
export const curveOver = (truth) => ({ x: truth.map((_, k) => k / (truth.length - 1)), y: truth });

/** A line, and what it is asked for. */
class Line {
  /**
   * @param {number[]} line
   * @param {number} zero  what is no more than nothing
   */
  constructor(line, zero) {
    this.y = joined(line);
    this.nothing = this.y.map((value) => value <= zero);
  }
  get last() {
    return this.y.length - 1;
  }
  /** @param {number} t */
  at(t) {
    return this.y[Math.min(Math.max(binOf(t), 0), this.last)];
  }
  /**
   * Values of a stretch of time.
   * @param {number} from
   * @param {number} to
   */
  between(from, to) {
    return this.y.slice(Math.max(binOf(from), 0), Math.max(binOf(to) + 1, 0));
  }
  /**
   * Whether there is no force from one bin until before another.
   * @param {number} from
   * @param {number} to
   */
  rests(from, to) {
    return this.nothing.slice(Math.max(from, 0), Math.max(to, 0)).every(Boolean);
  }
  /** When there is no force for a while, behind the first contact. */
  parts() {
    for (let k = GAP; k < this.y.length - GAP; k++) if (this.rests(k, k + GAP) && !this.rests(0, k)) return k * BIN;
    return null;
  }
  /**
   * By how much it grows around a bin.
   * @param {number} place
   * @param {number} reach
   */
  rise(place, reach) {
    return this.y[Math.min(place + reach, this.last)] - this.y[Math.max(place - reach, 0)];
  }
  /**
   * Steep rises, but for the beginning, and for those out of a pause.
   * @param {number} least
   */
  jumps(least) {
    const found = [];
    /** @type {number[]} */
    let run = [];
    for (let k = LONG; k <= this.last; k++) {
      const rise = this.rise(k, SHORT);
      if (rise >= Math.max(least, STEEP * this.rise(k, LONG)) && !this.rests(k - LONG, k - SHORT)) run.push(k);
      else if (run.length) {
        found.push(this.#jump(run));
        run = [];
      }
    }
    return run.length ? [...found, this.#jump(run)] : found;
  }
  /**
   * How high it is, and when half of it is reached.
   * @param {number[]} run  of bins
   */
  #jump(run) {
    const low = Math.max(run[0] - SHORT, 0);
    const part = this.y.slice(low, run[run.length - 1] + SHORT + 1);
    const height = Math.max(...run.map((k) => this.rise(k, SHORT)));
    const half = 0.5 * (Math.min(...part) + Math.max(...part));
    return { t: (low + part.findIndex((value) => value >= half)) * BIN, height };
  }
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @param {Truth} truth
 * @param {1 | -1} way
 * @returns {Judgement}
 */
function goes(line, { at, slack, within }, truth, way) {
  const [from, to] = /** @type {[number, number]} */ (at);
  const part = line.between(from + within, to - within).map((value) => -way * value); // close to its ends as it likes
  let low = Infinity;
  const turned = part.findIndex((value) => {
    low = Math.min(low, value);
    return value - low > slack;
  });
  const level = part.length > 0 && part[0] - part[part.length - 1] <= slack;
  const right = turned < 0 && !level;
  const t = turned < 0 ? 0.5 * (from + to) : from + within + turned * BIN;
  return {
    ...{ outcome: right ? 'yes' : 'no', yours: t, right: t, span: [from, to] },
    ...{ ring: [t, line.at(t)], to: [t, right ? line.at(t) : truth(t)] },
  };
}

/**
 * @param {number} yours
 * @param {number} right
 * @param {number} within
 */
const timed = (yours, right, within) =>
  Math.abs(yours - right) <= within + EXACTLY ? 'yes' : yours < right ? 'early' : 'late';

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @param {Truth} truth
 * @returns {Judgement}
 */
function jumps(line, { at, by, within }, truth) {
  const right = /** @type {number} */ (at);
  const all = line.jumps(SLIGHT * by);
  const high = all.filter(({ height }) => height >= by);
  const [nearest] = (high.length ? high : all).sort((a, b) => Math.abs(a.t - right) - Math.abs(b.t - right));
  const when = nearest && timed(nearest.t, right, within);
  const low = when === 'yes' ? 'small' : 'none';
  const outcome = !nearest ? 'none' : high.length ? when : low;
  const missing = outcome === 'none' || outcome === 'small';
  const yours = nearest && outcome !== 'none' ? nearest.t : right;
  const place = missing ? right + 4 * BIN : yours;
  const ring = /** @type {[number, number]} */ ([place, line.at(place)]);
  return {
    ...{ outcome, yours, right, ring, span: [right - within, right + within] },
    to: outcome === 'yes' ? ring : missing ? [place, truth(place)] : [right, ring[1]],
  };
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @returns {Judgement}
 */
function parts(line, { at, within }) {
  const right = /** @type {number} */ (at);
  const yours = line.parts();
  const span = /** @type {[number, number]} */ ([right - within, right + within]);
  if (yours === null)
    return { outcome: 'none', yours: right, right, span, ring: [right, line.at(right)], to: [right, 0] };
  const outcome = timed(yours, right, within);
  return { outcome, yours, right, span, ring: [yours, line.at(yours)], to: [outcome === 'yes' ? yours : right, 0] };
}

/**
 * A second hump, behind a pause.
 * @param {Line} line
 * @param {Criterion} asked
 * @param {Truth} truth
 * @returns {Judgement}
 */
function pushes(line, { above, at, within }, truth) {
  const [right, to] = /** @type {[number, number]} */ (at);
  const first = Math.max(binOf(right - within), 0);
  const part = line.between(right - within, to + within);
  const top = Math.max(...part);
  const place = first + part.indexOf(top);
  const begun = Math.max(line.nothing.indexOf(false), 0);
  let paused = false;
  for (let k = begun; k + BREAK <= place; k++) paused ||= line.rests(k, k + BREAK);
  const found = part.length > 0 && top >= above && paused;
  const t = found ? place * BIN : right + 2 * BIN;
  const ring = /** @type {[number, number]} */ ([t, line.at(t)]);
  return {
    outcome: found ? 'yes' : 'none',
    yours: t,
    right,
    span: [right, to],
    ring,
    to: found ? ring : [t, truth(t)],
  };
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @returns {Judgement}
 */
function ends(line, { at, slack, within }) {
  const right = /** @type {number} */ (at);
  const first = binOf(right + within);
  const over = line.y.findIndex((value, k) => k >= first && value > slack);
  const k = over < 0 ? Math.round(0.5 * (Math.min(first, line.last) + line.last)) : over;
  const ring = /** @type {[number, number]} */ ([k * BIN, line.y[k]]);
  return {
    ...{ outcome: over < 0 ? 'yes' : 'no', yours: k * BIN, right, ring, span: [first * BIN, line.last * BIN] },
    to: over < 0 ? ring : [k * BIN, 0],
  };
}

/**
 * Nowhere farther from the truth than it may be.
 * @param {Line} line
 * @param {Criterion} asked
 * @param {Truth} truth
 * @returns {Judgement}
 */
function near(line, { at, within }, truth) {
  const span = /** @type {[number, number]} */ (at);
  const first = Math.max(binOf(span[0]), 0);
  const off = line.between(...span).map((value, k) => value - truth((first + k) * BIN));
  const worst = off.reduce((most, value, k) => (Math.abs(value) > Math.abs(off[most]) ? k : most), 0);
  const t = (first + worst) * BIN;
  const outcome = Math.abs(off[worst]) <= within + EXACTLY ? 'yes' : off[worst] > 0 ? 'high' : 'low';
  return { outcome, yours: t, right: t, span, ring: [t, line.at(t)], to: [t, truth(t)] };
}

/** @type {Record<string, (line: Line, asked: Criterion, truth: Truth) => Judgement>} */
const CRITERIA = {
  near,
  falls: (line, asked, truth) => goes(line, asked, truth, -1),
  rises: (line, asked, truth) => goes(line, asked, truth, 1),
  jump: jumps,
  'zero-from': parts,
  push: pushes,
  'zero-beyond': ends,
};

/**
 * By the rules of app/lessons/judging.py.
 * @param {number[]} drawn  a value for each bin of time, NaN in gaps
 * @param {Criterion[]} criteria
 * @param {[low: number, high: number]} axis
 * @param {Truth} truth
 * @returns {Judgement[]}
 */
export function judged(drawn, criteria, axis, truth) {
  const line = new Line(drawn, NOTHING * (axis[1] - axis[0]));
  return criteria.map((each) => CRITERIA[each.criterion](line, each, truth));
}
