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
const WINDOW = 10; // values over which a jump rises at most
const STEEP = 0.6; // of a rise, that a jump has in so short a time
const BUMP = 0.25; // of a jump, that can be seen
const REST = 15; // values without force, behind which a rise is a push of its own
const APART = 10; // values without force, by which they have parted
const GAP = 5; // between two pushes
const EDGE = [0.05, 0.08, 0.2]; // T at the ends of a fall: how it begins, and where a jump may be drawn too early
const LEAST = 0.01; // of the highest value, that is more than nothing
const FALL = 0.04; // of it, by which a line falls

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

/** A line, and what it is asked for. */
class Line {
  /** @param {number[]} line */
  constructor(line) {
    this.y = joined(line);
    this.high = Math.max(...this.y.map(Math.abs), 1e-30);
    this.zero = LEAST * this.high;
  }
  get last() {
    return this.y.length - 1;
  }
  /** @param {number} t */
  bin(t) {
    return Math.min(Math.max(binOf(t), 0), this.last);
  }
  /** @param {number} t */
  at(t) {
    return this.y[this.bin(t)];
  }
  /**
   * Whether there is nothing for so many values from one on.
   * @param {number} from
   * @param {number} count
   */
  rests(from, count) {
    const end = Math.min(from + count, this.y.length);
    for (let k = Math.max(from, 0); k < end; k++) if (this.y[k] > this.zero) return false;
    return true;
  }
  /** @returns {[first: number, last: number][]} stretches with a force */
  pushes() {
    /** @type {[number, number][]} */
    const found = [];
    for (let k = 0; k <= this.last; k++) {
      if (this.y[k] <= this.zero) continue;
      const before = found[found.length - 1];
      if (before && k - before[1] <= GAP) before[1] = k;
      else found.push([k, k]);
    }
    return found;
  }
  /** When they part for the first time; nothing where they do not. */
  parts() {
    const first = this.y.findIndex((value) => value > this.zero);
    for (let k = first + 1; first >= 0 && k <= this.last - GAP; k++) if (this.rests(k, APART)) return k * BIN;
    return null;
  }
  /**
   * Steep rises, but for those from rest.
   * @param {number} least
   */
  rises(least) {
    const { last, y } = this;
    const rise = (/** @type {number} */ k) => y[Math.min(k + WINDOW, last)] - y[k];
    const found = [];
    for (let k = 1; k < last; k++) {
      if (rise(k) < least || this.#fromRest(k)) continue;
      let best = k;
      let end = k;
      while (end < last && rise(end) >= least) {
        if (rise(end) > rise(best)) best = end;
        end += 1;
      }
      found.push({ size: rise(best), t: this.#half(best), whole: this.#whole(best) });
      k = end + 1;
    }
    return found;
  }
  /**
   * Whether a rise begins where there was no force for some time, or ever.
   * @param {number} from
   */
  #fromRest(from) {
    const foot = this.#foot(from);
    return this.y[foot] <= this.zero && (this.rests(foot - REST, REST + 1) || this.rests(0, foot + 1));
  }
  /** @param {number} from */
  #foot(from) {
    let low = from;
    while (low > 0 && this.y[low - 1] < this.y[low]) low--;
    return low;
  }
  /**
   * Where half of a rise is reached.
   * @param {number} from
   */
  #half(from) {
    const { last, y } = this;
    const half = 0.5 * (y[from] + y[Math.min(from + WINDOW, last)]);
    let k = from;
    while (k < last - 1 && y[k + 1] < half) k++;
    return (k + (y[k + 1] > y[k] ? (half - y[k]) / (y[k + 1] - y[k]) : 0)) * BIN;
  }
  /**
   * All of a rise, also what is not in so short a time.
   * @param {number} from
   */
  #whole(from) {
    const { last, y } = this;
    let high = Math.min(from + WINDOW, last);
    while (high < last && y[high + 1] > y[high]) high++;
    return y[high] - y[this.#foot(from)];
  }
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @param {Truth} truth
 * @param {1 | -1} way
 * @returns {Judgement}
 */
function goes(line, asked, truth, way) {
  const [from, to] = /** @type {[number, number]} */ (asked.at);
  const first = line.bin(from + EDGE[0]);
  let end = line.bin(to - EDGE[1]);
  const value = (/** @type {number} */ k) => -way * line.y[k];
  for (let k = end; k >= Math.max(line.bin(to - EDGE[2]), first); k--) if (value(k) < value(end)) end = k;
  let low = value(first);
  let turned = -1;
  for (let k = first; k <= end && turned < 0; k++) {
    low = Math.min(low, value(k));
    if (value(k) > low + asked.slack) turned = k;
  }
  const falls = value(first) - value(end) > FALL * line.high;
  const t = turned < 0 ? 0.5 * (from + to) : turned * BIN;
  const right = turned < 0 && falls;
  return {
    ...{ outcome: right ? 'yes' : 'no', yours: t, right: t, span: [from, to] },
    ...{ ring: [t, line.at(t)], to: [t, right ? line.at(t) : truth(t)] },
  };
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @param {Truth} truth
 * @returns {Judgement}
 */
function jumps(line, asked, truth) {
  const right = /** @type {number} */ (asked.at);
  const near = (/** @type {{ t: number }} */ a, /** @type {{ t: number }} */ b) =>
    Math.abs(a.t - right) - Math.abs(b.t - right);
  const steep = line
    .rises(BUMP * asked.by)
    .filter(({ size, whole }) => size >= STEEP * whole)
    .sort(near);
  const jump = steep.find(({ size }) => size >= asked.by);
  const bump = steep.find(({ t }) => Math.abs(t - right) <= 2 * asked.within);
  const off = jump && Math.abs(jump.t - right) > asked.within + 0.5 * BIN;
  const small = bump && (!jump || off) && bump.size < asked.by;
  const outcome = small ? 'small' : !jump ? 'none' : !off ? 'yes' : jump.t < right ? 'early' : 'late';
  const yours = (small ? bump : jump)?.t ?? right;
  const after = right + 4 * BIN;
  const missing = small || !jump;
  const ring = /** @type {[number, number]} */ (missing ? [after, line.at(after)] : [yours, line.at(yours)]);
  return {
    ...{ outcome, yours, right, ring, span: [right - asked.within, right + asked.within] },
    to: outcome === 'yes' ? ring : missing ? [after, truth(after)] : [right, ring[1]],
  };
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @returns {Judgement}
 */
function parts(line, asked) {
  const right = /** @type {number} */ (asked.at);
  const yours = line.parts();
  const span = /** @type {[number, number]} */ ([right - asked.within, right + asked.within]);
  if (yours === null)
    return { outcome: 'none', yours: right, right, span, ring: [right, line.at(right)], to: [right, 0] };
  const outcome = Math.abs(yours - right) <= asked.within + 0.5 * BIN ? 'yes' : yours < right ? 'early' : 'late';
  return { outcome, yours, right, span, ring: [yours, 0], to: [outcome === 'yes' ? yours : right, 0] };
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @param {Truth} truth
 * @returns {Judgement}
 */
function pushes(line, asked, truth) {
  const [right, to] = /** @type {[number, number]} */ (asked.at);
  const top = ([a, b] = [0, 0]) => Math.max(...line.y.slice(a, b + 1));
  const found = line
    .pushes()
    .slice(1)
    .find((each) => Math.abs(each[0] * BIN - right) <= asked.within + 0.5 * BIN && top(each) > asked.above);
  const span = /** @type {[number, number]} */ ([right, to]);
  const t = found ? line.y.indexOf(top(found), found[0]) * BIN : right + 2 * BIN;
  const ring = /** @type {[number, number]} */ ([t, line.at(t)]);
  const yours = found ? found[0] * BIN : right;
  return { outcome: found ? 'yes' : 'none', yours, right, span, ring, to: found ? ring : [t, truth(t)] };
}

/**
 * @param {Line} line
 * @param {Criterion} asked
 * @returns {Judgement}
 */
function ends(line, asked) {
  const right = /** @type {number} */ (asked.at);
  const first = line.bin(right + asked.within);
  const over = line.y.findIndex((value, k) => k >= first && value > asked.slack);
  const k = over < 0 ? Math.round(0.5 * (first + line.last)) : over;
  const ring = /** @type {[number, number]} */ ([k * BIN, line.y[k]]);
  return {
    ...{ outcome: over < 0 ? 'yes' : 'no', yours: k * BIN, right, ring, span: [first * BIN, line.last * BIN] },
    to: over < 0 ? ring : [k * BIN, 0],
  };
}

/** @type {Record<string, (line: Line, asked: Criterion, truth: Truth) => Judgement>} */
const CRITERIA = {
  falls: (line, asked, truth) => goes(line, asked, truth, -1),
  rises: (line, asked, truth) => goes(line, asked, truth, 1),
  jump: jumps,
  'zero-from': parts,
  push: pushes,
  'zero-beyond': ends,
};

/**
 * @param {number[]} drawn  a value for each bin of time, NaN in gaps
 * @param {Criterion[]} criteria
 * @param {Truth} truth
 * @returns {Judgement[]}
 */
export function judged(drawn, criteria, truth) {
  const line = new Line(drawn);
  return criteria.map((each) => CRITERIA[each.criterion](line, each, truth));
}
