// Fields of an impact along an axis, rebuilt from the message. Time in round trips T, places in m from the struck end,
// displacement in v T, velocity in v, stress in v sqrt(E rho); compression positive.
import { between, evenly } from '../charts/scale.js';
import { given, arrayOf } from '../wire/message.js';
import { Mirrored, Wave } from './wave.js';

/** @import { Range, Samples } from '../charts/scale.js' */
/** @import { Steps } from './wave.js' */
/** @import { AxialFrame, Numbers, RodRecord } from '../messages.js' */

const POINTS = 240; // along the bodies, where no fronts are known
const NEXT = 1e-9; // of T, to both sides of a front
const JUMP = 1e-6; // the least that the message has twice

/** @typedef {'stress' | 'velocity' | 'displacement'} What */
/** @typedef {What | 'right' | 'left'} Part  the waves of stress that run either way, of which the stress is the sum */
/** @typedef {(column: number, values: Float64Array) => void} Visit */

/**
 * What colours are in units of [SI].
 * @param {{ stressUnit: number, speed: number }} frame
 * @param {What} what
 */
export const unitOf = (frame, what) => (what === 'stress' ? frame.stressUnit : frame.speed);

/** The field of one solution between two places; here of bodies that move as a whole, in which no wave runs. */
export class Field {
  from = 0;
  to = 0;
  coarse = false; // dear to compute: fewer points will do

  /**
   * @param {AxialFrame} frame
   * @param {'exact' | 'other'} solution
   */
  constructor(frame, solution) {
    this.frame = frame;
    this.solution = solution;
    const exact = solution === 'exact';
    this.ends = exact ? frame.exactEnd : given(frame.otherEnd, 'otherEnd');
    this.masses = exact ? frame.exactMass : given(frame.otherMass, 'otherMass');
  }
  /**
   * The end of the colours.
   * @param {What} _what
   */
  largest(_what) {
    return 1;
  }
  /**
   * The largest that is known anywhere, if some of it lies beyond the end of the colours.
   * @param {What} _what
   */
  peak(_what) {
    return 0;
  }
  /**
   * Values at places spread evenly from `from` to `to`.
   * @param {number} t
   * @param {What} what
   * @param {Float64Array} out
   */
  profile(t, what, out) {
    return out.fill(what === 'displacement' ? this.end(t) : 0);
  }
  /**
   * Values about an instant, averaged over a span of time where a front may cross it.
   * @param {number} t
   * @param {number} _span
   * @param {What} what
   * @param {Float64Array} out
   */
  mean(t, _span, what, out) {
    return this.profile(t, what, out);
  }
  /**
   * Visit the profiles of instants spread evenly over a stretch of time.
   * @param {Range} stretch
   * @param {What} what
   * @param {number} columns
   * @param {number} rows
   * @param {Visit} visit
   */
  image([start, end], what, columns, rows, visit) {
    const column = new Float64Array(rows);
    for (let c = 0; c < columns; c++)
      visit(c, this.profile(start + ((c + 0.5) / columns) * (end - start), what, column));
  }
  /**
   * Values over places [m] at one instant; where a place stands twice, a jump.
   * @param {number} t
   * @param {Part} what
   * @returns {Samples | null}
   */
  along(t, what) {
    return this.#apart(what, (part) => {
      const values = this.profile(t, part, new Float64Array(POINTS + 1));
      return evenly([this.from, this.to], POINTS, (_, k) => values[k]);
    });
  }
  /**
   * Values over a stretch of time at a place; nothing where they are not known.
   * @param {number} place  [m]
   * @param {Range} stretch
   * @param {Part} what
   * @returns {Samples | null}
   */
  over(place, stretch, what) {
    return this.#apart(what, (part) => this.history(place, stretch, part), place);
  }
  /**
   * @param {number} _place
   * @param {Range} _stretch
   * @param {What} _what
   * @returns {Samples | null}
   */
  history(_place, _stretch, _what) {
    return null;
  }
  /**
   * Read a quantity, or one of the two waves from stress s and velocity v: (s + rho c v) / 2 runs to the right,
   * (s - rho c v) / 2 to the left.
   * @param {Part} what
   * @param {(what: What) => Samples | null} read
   * @param {number} [place]  of all that is read
   * @returns {Samples | null}
   */
  #apart(what, read, place) {
    if (what !== 'right' && what !== 'left') return read(what);
    const [stress, velocity] = [read('stress'), read('velocity')];
    if (!stress || !velocity) return null;
    const way = what === 'right' ? 1 : -1;
    const y = Float64Array.from(Array.from(stress.x), (x, k) => {
      const { area, drift, impedance } = rodAt(this.frame.rods, place ?? x);
      return (stress.y[k] + (way * (velocity.y[k] - drift) * impedance) / area) / 2;
    });
    return { x: stress.x, y };
  }
  /**
   * Displacement of the struck end.
   * @param {number} t
   */
  end(t) {
    return between(this.frame.motionTime, this.ends, t);
  }
  /**
   * Where that is drawn.
   * @param {number} t
   */
  face(t) {
    return this.end(t);
  }
  /**
   * Displacement of the impactor.
   * @param {number} t
   */
  mass(t) {
    return between(this.frame.motionTime, this.masses, t);
  }
}

/**
 * The rod at a place.
 * @template {RodRecord} Found
 * @param {Found[]} rods
 * @param {number} place
 */
const rodAt = (rods, place) => rods.findLast(({ from }) => from <= place) ?? rods[0];

/** @typedef {RodRecord & { f: Wave, g: Wave | Mirrored }} Rod */

/** @param {Wave | Mirrored} wave */
const narrow = (wave) => Boolean((wave instanceof Mirrored ? wave.wave : wave).bold);

/** The field of any number of rods, from the waves that their ends send. */
export class WaveField extends Field {
  /** @type {Partial<Record<What, number>>} */ peaks = {};

  /** @param {AxialFrame} frame */
  constructor(frame) {
    super(frame, 'exact');
    const { rods, duration } = frame;
    const wave = (/** @type {string} */ name) =>
      new Wave(arrayOf(frame, `${name}Time`), arrayOf(frame, name), duration);
    this.from = rods[0].from;
    this.to = rods[rods.length - 1].to;
    this.rods = rods.map((rod, i) => {
      const f = wave(`f${i}`);
      return { ...rod, f, g: rod.mirror ? new Mirrored(f, rod.mirror, rod.transit) : wave(`g${i}`) };
    });
  }
  /**
   * The largest stress or velocity anywhere: waves add up where they meet.
   * @param {What} what
   */
  largest(what) {
    let most = 1e-12;
    const columns = 120;
    const profile = new Float64Array(this.rods.length === 1 && this.rods[0].mirror ? 0 : 121);
    for (const { f, mirror, area, impedance } of this.rods) {
      // at a wall the stress doubles, at a free end the velocity
      const doubled = mirror > 0 === (what === 'stress') ? 2 : 1;
      if (mirror) most = Math.max(most, (doubled * f.strongest) / (what === 'stress' ? area : impedance));
    }
    const seen = [];
    for (let c = 0; c < columns && profile.length; c++) {
      for (const v of this.profile(((c + 0.5) / columns) * this.frame.duration, what, profile))
        if (v !== 0) seen.push(Math.abs(v));
    }
    for (const value of this.rods.length > 1 ? [] : seen) most = Math.max(most, value); // all of it is on the scale
    if (seen.length && this.rods.length > 1) {
      // a thin specimen must not take all the colour: few values are beyond the scale
      seen.sort((a, b) => a - b);
      this.peaks[what] = seen[seen.length - 1];
      return Math.max(seen[Math.floor(0.985 * (seen.length - 1))], 0.15 * seen[seen.length - 1], 1e-12);
    }
    if (what === 'stress') for (const v of this.frame.exactForce) most = Math.max(most, v);
    return most;
  }
  /** @param {What} what */
  peak(what) {
    return this.peaks[what] ?? 0;
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Float64Array} out
   */
  profile(t, what, out) {
    return this.#sum(out, t, what, (wave, steps, factor) => {
      if (what === 'displacement') wave.addTotals(out, steps, factor);
      else wave.addValues(out, steps, factor);
    });
  }
  /**
   * @param {number} t
   * @param {number} span
   * @param {What} what
   * @param {Float64Array} out
   */
  mean(t, span, what, out) {
    if (this.rods.some(({ f, g }) => narrow(f) || narrow(g))) return this.profile(t, what, out); // or it fades
    return this.#sum(out, t, what, (wave, steps, factor) => wave.addMeans(out, steps, factor, span));
  }
  /**
   * Add the two waves of each rod up, at the places within it: they go on evenly, so that the instants do at which a
   * wave was sent that is there now.
   * @param {Float64Array} out  places spread evenly
   * @param {number} t
   * @param {What} what
   * @param {(wave: Wave | Mirrored, steps: Steps, factor: number) => void} add
   */
  #sum(out, t, what, add) {
    const apart = (this.to - this.from) / (out.length - 1);
    let first = 0;
    for (const [r, { area, drift, f, fall = 0, from, g, impedance, to, transit }] of this.rods.entries()) {
      const within = r === this.rods.length - 1 ? out.length : Math.floor((to - this.from) / apart) + 1;
      const last = Math.max(Math.min(within, out.length), first);
      const pace = transit / (to - from);
      const late = (this.from + first * apart - from) * pace;
      const step = apart * pace;
      const whole = what === 'velocity' ? drift + fall * t : (drift + 0.5 * fall * t) * t;
      out.fill(what === 'stress' ? 0 : whole, first, last);
      const factor = 1 / (what === 'stress' ? area : impedance);
      add(f, { first, last, start: t - late, step: -step }, factor);
      add(g, { first, last, start: t - transit + late, step }, what === 'stress' ? factor : -factor);
      first = last;
    }
    return out;
  }
  /**
   * With every front where it is.
   * @param {number} t
   * @param {Part} what
   */
  along(t, what) {
    /** @type {{ x: number[], y: number[] }} */
    const found = { x: [], y: [] };
    for (const rod of this.rods) {
      const { f, from, g, to, transit } = rod;
      const lates = f.corners([t - transit, t]).map((sent) => t - sent);
      for (const sent of g.corners([t - transit, t])) lates.push(sent - t + transit);
      const place = (/** @type {number} */ late) => from + (late / transit) * (to - from);
      stepped(found, lates, [0, transit], place, (late) => valueIn(rod, what, t, late));
    }
    return found;
  }
  /**
   * @param {number} place
   * @param {Range} stretch
   * @param {Part} what
   */
  over(place, [start, end], what) {
    const rod = rodAt(this.rods, place);
    const { f, from, g, to, transit } = rod;
    const late = ((place - from) / (to - from)) * transit;
    const later = (/** @type {Wave | Mirrored} */ wave, /** @type {number} */ by) =>
      wave.corners([start - by, end - by]).map((sent) => sent + by);
    /** @type {{ x: number[], y: number[] }} */
    const found = { x: [], y: [] };
    const instants = [...later(f, late), ...later(g, transit - late)];
    stepped(
      found,
      instants,
      [start, end],
      (t) => t,
      (t) => valueIn(rod, what, t, late),
    );
    return found;
  }
}

/**
 * A value in a rod, where the wave of its left end comes so late.
 * @param {Rod} rod
 * @param {Part} what
 * @param {number} t
 * @param {number} late
 */
function valueIn({ area, drift, f, fall = 0, g, impedance, transit }, what, t, late) {
  const [there, back] = [t - late, t - transit + late];
  if (what === 'displacement') return (drift + 0.5 * fall * t) * t + (f.total(there) - g.total(back)) / impedance;
  const right = what === 'left' ? 0 : f.sharp(there);
  const left = what === 'right' ? 0 : g.sharp(back);
  return what === 'velocity' ? drift + fall * t + (right - left) / impedance : (right + left) / area;
}

/**
 * Add the values at corners between two ends; where they jump, those on both sides.
 * @param {{ x: number[], y: number[] }} found
 * @param {number[]} corners
 * @param {Range} ends
 * @param {(at: number) => number} place
 * @param {(at: number) => number} value
 */
function stepped({ x, y }, corners, [first, last], place, value) {
  const inside = corners.filter((at) => at > first + 2 * NEXT && at < last - 2 * NEXT).sort((a, b) => a - b);
  const add = (/** @type {number} */ at, /** @type {number[]} */ ...values) => {
    y.push(...values);
    while (x.length < y.length) x.push(place(at));
  };
  add(first, value(first + NEXT));
  for (const at of inside) {
    const [before, after] = [value(at - NEXT), value(at + NEXT)];
    if (Math.abs(after - before) > JUMP) add(at, before, after);
    else add(at, after);
  }
  add(last, value(last - NEXT));
}

/** Rods as rigid lines, by a method that tells no places apart: a body that is held stays, whatever its face does. */
export class RigidField extends Field {
  /** @param {AxialFrame} frame */
  constructor(frame) {
    super(frame, 'other');
    this.from = frame.rods[0].from;
    this.to = frame.rods[frame.rods.length - 1].to;
  }
  /** @param {number} t */
  face(t) {
    return this.frame.target.held ? 0 : this.end(t);
  }
  /** It tells no places apart. */
  along() {
    return null;
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Float64Array} out
   */
  profile(t, what, out) {
    const meet = Math.round((-this.from / (this.to - this.from)) * out.length); // of two rods
    out.fill(0);
    return what === 'displacement' ? out.fill(this.mass(t), 0, meet).fill(this.face(t), meet) : out;
  }
}
