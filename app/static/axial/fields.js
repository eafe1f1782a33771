// Fields of an impact along an axis, rebuilt from the message. Time in round trips T, places in m from the struck end,
// displacement in v T, velocity in v, stress in v sqrt(E rho); compression positive.
import { between } from '../charts/scale.js';
import { given, arrayOf } from '../shell/message.js';
import { Mirrored, Wave } from './wave.js';

/** @import { Range, Samples } from '../charts/scale.js' */
/** @import { AxialFrame, Numbers, RodRecord } from '../messages.js' */

const SAMPLES = 2000; // of a stress over time, by waves

/** @typedef {'stress' | 'velocity' | 'displacement'} What */
/** @typedef {(column: number, values: Float64Array) => void} Visit */

/**
 * Values at instants spread evenly over a stretch of time.
 * @param {Range} stretch
 * @param {number} count
 * @param {(t: number) => number} value
 * @returns {Samples}
 */
export function evenly([start, end], count, value) {
  const x = Float64Array.from({ length: count + 1 }, (_, k) => start + (k / count) * (end - start));
  return { x, y: x.map(value) };
}

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
   * The stress at a place over a stretch of time; nothing where it is not known.
   * @param {number} _place  [m]
   * @param {Range} _stretch
   * @returns {Samples | null}
   */
  stressAt(_place, _stretch) {
    return null;
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

/** @typedef {RodRecord & { f: Wave, g: Wave | Mirrored }} Rod */

/** @param {Wave | Mirrored} wave */
const narrow = (wave) => Boolean((wave instanceof Mirrored ? wave.wave : wave).bold);

/** The field of any number of rods, from the waves that their ends send. */
export class WaveField extends Field {
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
    if (seen.length) {
      // a thin specimen must not take all the colour: few values are beyond the scale
      seen.sort((a, b) => a - b);
      return Math.max(seen[Math.floor(0.985 * (seen.length - 1))], 0.15 * seen[seen.length - 1], 1e-12);
    }
    if (what === 'stress') for (const v of this.frame.exactForce) most = Math.max(most, v);
    return most;
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Float64Array} out
   */
  profile(t, what, out) {
    if (what === 'stress')
      return this.#along(out, ({ area, f, g, transit }, s) => (f.at(t - s) + g.at(t - transit + s)) / area);
    if (what === 'velocity')
      return this.#along(
        out,
        ({ drift, f, g, impedance, transit }, s) => drift + (f.at(t - s) - g.at(t - transit + s)) / impedance,
      );
    return this.#along(
      out,
      ({ drift, f, g, impedance, transit }, s) => drift * t + (f.total(t - s) - g.total(t - transit + s)) / impedance,
    );
  }
  /**
   * @param {number} t
   * @param {number} span
   * @param {What} what
   * @param {Float64Array} out
   */
  mean(t, span, what, out) {
    if (this.rods.some(({ f, g }) => narrow(f) || narrow(g))) return this.profile(t, what, out); // or it fades
    const [a, b] = [t - span / 2, t + span / 2];
    const of = (/** @type {Wave | Mirrored} */ wave, /** @type {number} */ late) =>
      (wave.total(b - late) - wave.total(a - late)) / span;
    return this.#along(out, ({ area, drift, f, g, impedance, transit }, s) =>
      what === 'stress' ? (of(f, s) + of(g, transit - s)) / area : drift + (of(f, s) - of(g, transit - s)) / impedance,
    );
  }
  /**
   * @param {Float64Array} out  places spread evenly
   * @param {(rod: Rod, late: number) => number} value  where the wave of the left end comes so late
   */
  #along(out, value) {
    const n = out.length - 1;
    const { rods, from, to } = this;
    for (let i = 0, r = 0; i <= n; i++) {
      const x = from + ((to - from) * i) / n;
      while (r < rods.length - 1 && x > rods[r].to) r++;
      const { transit, from: left, to: right } = rods[r];
      out[i] = value(rods[r], ((x - left) / (right - left)) * transit);
    }
    return out;
  }
  /**
   * @param {number} place
   * @param {Range} stretch
   */
  stressAt(place, stretch) {
    const rod = this.rods.findLast(({ from }) => from <= place) ?? this.rods[0];
    const { f, g, transit, area, from, to } = rod;
    const s = ((place - from) / (to - from)) * transit;
    return evenly(stretch, SAMPLES, (t) => (f.exactly(t - s) + g.exactly(t - transit + s)) / area);
  }
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

/** Fields sampled by the server, for methods whose fields cannot be rebuilt here. */
export class SampledField extends Field {
  coarse = true;

  /**
   * @param {AxialFrame} frame
   * @param {'exact' | 'other'} solution
   */
  constructor(frame, solution) {
    super(frame, solution);
    const exact = solution === 'exact';
    this.from = frame.rods[0]?.from ?? 0;
    this.to = frame.rods.at(-1)?.to ?? 0;
    this.tables = {
      stress: given(exact ? frame.exactStress : frame.fieldStress, 'stress'),
      velocity: given(exact ? frame.exactVelocity : frame.fieldVelocity, 'velocity'),
      displacement: given(exact ? frame.exactDisplacement : frame.fieldDisplacement, 'displacement'),
    };
    const [instants, places] = frame.shapes[exact ? 'exactStress' : 'fieldStress'];
    this.instants = instants;
    this.places = places;
  }
  /**
   * The largest anywhere.
   * @param {What} what
   */
  largest(what) {
    return this.tables[what].reduce((/** @type {number} */ most, value) => Math.max(most, Math.abs(value)), 1e-12);
  }
  /**
   * @param {number} t
   * @param {What} what
   * @param {Float64Array} out
   */
  profile(t, what, out) {
    const { frame, instants, places } = this;
    const n = out.length - 1;
    const field = this.tables[what];
    const row = Math.min(Math.max(t / frame.duration, 0), 1) * (instants - 1);
    const i = Math.min(Math.floor(row), instants - 2);
    const a = row - i;
    for (let k = 0; k <= n; k++) {
      const place = (k / n) * (places - 1);
      const j = Math.min(Math.floor(place), places - 2);
      const b = place - j;
      const p = i * places + j;
      out[k] =
        (1 - a) * ((1 - b) * field[p] + b * field[p + 1]) +
        a * ((1 - b) * field[p + places] + b * field[p + places + 1]);
    }
    return out;
  }
  /** @param {number} place */
  stressAt(place) {
    const along = (this.to > this.from ? (place - this.from) / (this.to - this.from) : 0) * (this.places - 1);
    const j = Math.min(Math.max(Math.floor(along), 0), this.places - 2);
    const row = (/** @type {number} */ i) => i * this.places + j;
    const { stress } = this.tables;
    const last = this.instants - 1;
    return evenly([0, this.frame.duration], last, (t) => {
      const p = row(Math.round((t / this.frame.duration) * last));
      return stress[p] + (along - j) * (stress[p + 1] - stress[p]);
    });
  }
}
