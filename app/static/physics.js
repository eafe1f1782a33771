// The message of app/frames.py, and the fields rebuilt from it. Time in round trips T, place as a fraction of the
// length from the struck end, displacement in v T, velocity in v, stress in v sqrt(E rho); compression positive.

export function decode(buffer) {
  const bytes = new Uint8Array(buffer);
  const length = new DataView(bytes.buffer, bytes.byteOffset, 4).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const data = {};
  let offset = 4 + length;
  for (const [name, size, unit] of header.arrays) { // with a unit: whole numbers of two bytes
    const width = unit ? 2 : 4, part = bytes.slice(offset, offset + width * size).buffer;
    data[name] = unit ? new Float64Array(new Int16Array(part)) : new Float32Array(part);
    if (unit) for (let k = 0; k < size; k++) data[name][k] *= unit;
    offset += 4 * Math.ceil(width * size / 4);
  }
  return { ...header, ...data };
}

// Value at t of samples spread evenly over [0, duration].
export function at(samples, t, duration) {
  const place = Math.min(Math.max(t / duration, 0), 1) * (samples.length - 1);
  const i = Math.min(Math.floor(place), samples.length - 2);
  return samples[i] + (place - i) * (samples[i + 1] - samples[i]);
}

const CELLS = 8192;

// One wave that a rod end sends, on even cells: value, and integral from the beginning.
class Wave {
  constructor(time, value, duration) {
    this.duration = duration;
    this.perTrip = CELLS / duration;
    this.value = new Float64Array(CELLS + 1);
    this.sum = new Float64Array(CELLS + 1);
    const sums = new Float64Array(time.length);
    for (let j = 1; j < time.length; j++) sums[j] = sums[j - 1] + 0.5 * (value[j] + value[j - 1]) * (time[j] - time[j - 1]);
    for (let k = 0, j = 0; k <= CELLS; k++) {
      const t = (k + 0.5) / this.perTrip; // cell middles: jumps stay within one cell
      const u = k / this.perTrip;
      while (j < time.length - 2 && time[j + 1] <= t) j++;
      const part = time[j + 1] > time[j] ? Math.min((t - time[j]) / (time[j + 1] - time[j]), 1) : 1;
      this.value[k] = value[j] + part * (value[j + 1] - value[j]);
      let i = j;
      while (i > 0 && time[i] > u) i--;
      const step = Math.max(u - time[i], 0), width = time[i + 1] - time[i], slope = width > 0 ? (value[i + 1] - value[i]) / width : 0;
      this.sum[k] = sums[i] + Math.min(step, width) * (value[i] + 0.5 * slope * Math.min(step, width));
    }
    this.strongest = 0;
    for (const v of value) this.strongest = Math.max(this.strongest, Math.abs(v));
    this.embolden();
  }
  // Pulses narrower than a pixel are drawn a pixel wide: of every pixel's worth of time, the strongest value.
  embolden() {
    const pixel = Math.max(0.0045, this.duration / 480), count = Math.min(Math.ceil(this.duration / pixel), CELLS), each = (CELLS + 1) / count;
    let whole = 0, seen = 0;
    const bold = new Float64Array(count + 1);
    for (let k = 0; k <= CELLS; k++) {
      const cell = Math.min(Math.floor(k / each), count), v = this.value[k];
      if (Math.abs(v) > Math.abs(bold[cell])) bold[cell] = v;
      whole = Math.max(whole, Math.abs(v));
    }
    for (let k = 0; k < count; k += 2) seen = Math.max(seen, Math.abs(this.value[Math.floor((k + 0.9) * each)]));
    if (seen > 0.6 * whole) return;
    this.bold = bold;
    this.boldPerTrip = count / this.duration;
  }
  at(t) {
    if (this.bold) return t < 0 ? 0 : this.bold[Math.min(Math.floor(t * this.boldPerTrip), this.bold.length - 1)];
    return t < 0 ? 0 : this.value[Math.min(Math.floor(t * this.perTrip), CELLS)];
  }
  total(t) {
    if (t <= 0) return 0;
    const place = Math.min(t * this.perTrip, CELLS - 1e-9), i = Math.floor(place);
    return this.sum[i] + (place - i) * (this.sum[i + 1] - this.sum[i]);
  }
}

// The same wave a transit time later, as it was or turned over: what the far end of a uniform rod sends back.
class Mirrored {
  constructor(wave, sign, transit) { Object.assign(this, { wave, sign, transit, strongest: wave.strongest }); }
  at(t) { return this.sign * this.wave.at(t - this.transit); }
  total(t) { return this.sign * this.wave.total(t - this.transit); }
}

// The field of any number of rods, from the waves that their ends send. Places run from `from` to `to` over all rods.
export class WaveField {
  constructor(frame) {
    this.frame = frame;
    const { rods, duration } = frame;
    this.from = rods[0].from;
    this.to = rods.at(-1).to;
    this.rods = rods.map((rod, i) => {
      const f = new Wave(frame[`f${i}Time`], frame[`f${i}`], duration);
      const g = rod.mirror ? new Mirrored(f, rod.mirror, rod.transit) : new Wave(frame[`g${i}Time`], frame[`g${i}`], duration);
      return { ...rod, f, g };
    });
  }
  // The largest stress or velocity anywhere: waves add up where they meet.
  largest(what) {
    let most = 1e-12;
    const columns = 120, profile = new Float64Array(this.rods.length === 1 && this.rods[0].mirror ? 0 : 121);
    for (const { f, mirror, area, impedance } of this.rods) {
      const doubled = mirror > 0 === (what === 'stress') ? 2 : 1; // at a wall the stress doubles, at a free end the velocity
      if (mirror) most = Math.max(most, doubled * f.strongest / (what === 'stress' ? area : impedance));
    }
    const seen = [];
    for (let c = 0; c < columns && profile.length; c++) {
      for (const v of this.profile((c + 0.5) / columns * this.frame.duration, what, profile)) if (v !== 0) seen.push(Math.abs(v));
    }
    if (seen.length) { // a thin specimen must not take all the colour: few values are beyond the scale
      seen.sort((a, b) => a - b);
      return Math.max(seen[Math.floor(0.985 * (seen.length - 1))], 0.15 * seen.at(-1), 1e-12);
    }
    if (what === 'stress') for (const v of this.frame.exactForce) most = Math.max(most, v);
    return most;
  }
  profile(t, what, out) {
    const n = out.length - 1, { rods, from, to } = this;
    for (let i = 0, r = 0; i <= n; i++) {
      const x = from + (to - from) * i / n;
      while (r < rods.length - 1 && x > rods[r].to) r++;
      const { f, g, transit, impedance, drift, area, from: left, to: right } = rods[r], s = (x - left) / (right - left) * transit;
      if (what === 'stress') out[i] = (f.at(t - s) + g.at(t - transit + s)) / area;
      else if (what === 'velocity') out[i] = drift + (f.at(t - s) - g.at(t - transit + s)) / impedance;
      else out[i] = drift * t + (f.total(t - s) - g.total(t - transit + s)) / impedance;
    }
    return out;
  }
  image(what, columns, rows, visit) {
    const column = new Float64Array(rows);
    for (let c = 0; c < columns; c++) visit(c, this.profile((c + 0.5) / columns * this.frame.duration, what, column));
  }
  end(t) { return at(this.frame.exactEnd, t, this.frame.duration); }
  mass(t) { return at(this.frame.exactMass, t, this.frame.duration); }
}

// No rod at all: bodies that move as a whole.
export class CompactField {
  constructor(frame, which = 'exact') { Object.assign(this, { frame, which, from: 0, to: 0 }); }
  largest() { return 1; }
  profile(t, what, out) { return out.fill(what === 'displacement' ? this.end(t) : 0); }
  image(what, columns, rows, visit) { const column = new Float64Array(rows); for (let c = 0; c < columns; c++) visit(c, column); }
  end(t) { return at(this.frame[`${this.which}End`], t, this.frame.duration); }
  mass(t) { return at(this.frame[`${this.which}Mass`], t, this.frame.duration); }
}

// Fields sampled by the server, for methods whose fields cannot be rebuilt here.
export class SampledField extends CompactField {
  constructor(frame) {
    super(frame, 'other');
    this.from = frame.rods[0]?.from ?? 0;
    this.to = frame.rods.at(-1)?.to ?? 0;
    this.instants = 110;
    this.places = frame.fieldStress.length / this.instants;
    this.sampled = true;
  }
  profile(t, what, out) {
    const { frame, instants, places } = this, n = out.length - 1;
    const field = frame[{ stress: 'fieldStress', velocity: 'fieldVelocity', displacement: 'fieldDisplacement' }[what]];
    const row = Math.min(Math.max(t / frame.duration, 0), 1) * (instants - 1), i = Math.min(Math.floor(row), instants - 2), a = row - i;
    for (let k = 0; k <= n; k++) {
      const place = k / n * (places - 1), j = Math.min(Math.floor(place), places - 2), b = place - j, p = i * places + j;
      out[k] = (1 - a) * ((1 - b) * field[p] + b * field[p + 1]) + a * ((1 - b) * field[p + places] + b * field[p + places + 1]);
    }
    return out;
  }
  image(what, columns, rows, visit) {
    const column = new Float64Array(rows);
    for (let c = 0; c < columns; c++) visit(c, this.profile((c + 0.5) / columns * this.frame.duration, what, column));
  }
}

const SAVED_NUMBERS = 400_000;

// The modal field: the browser carries the same oscillators through the same forces as the server did.
export class ModalField {
  constructor(frame) {
    this.frame = frame;
    this.from = frame.rods[0].from;
    this.to = frame.rods[0].to;
    const fixed = frame.rods[0].mirror > 0;
    this.free = !fixed;
    const n = frame.modes, h = frame.step;
    this.steps = frame.modalForce.length;
    this.stride = Math.max(1, Math.ceil(this.steps * n / SAVED_NUMBERS));
    this.omega = Float64Array.from({ length: n }, (_, i) => 2 * Math.PI * (fixed ? i + 0.5 : i + 1));
    this.cosine = this.omega.map((w) => Math.cos(w * h));
    this.sine = this.omega.map((w) => Math.sin(w * h));
    this.kickQ = this.omega.map((w) => 8 / (w * w) * Math.sin(w * h / 2) ** 2);
    this.kickW = this.omega.map((w) => 4 / (w * w) * Math.sin(w * h));
    this.q = new Float64Array(n);
    this.w = new Float64Array(n);
    this.saved = [];
    this.shapes = new Map();
    this.at = 0;
    this.rigid = [0, 0];
  }
  step() {
    const { q, w, cosine, sine, kickQ, kickW } = this, force = this.frame.modalForce[this.at], h = this.frame.step;
    for (let i = 0; i < q.length; i++) {
      const a = q[i], b = w[i];
      q[i] = cosine[i] * a + sine[i] * b + kickQ[i] * force;
      w[i] = cosine[i] * b - sine[i] * a + kickW[i] * force;
    }
    if (this.free) { // the free rod as a whole: x'' = 2 F
      this.rigid[0] += h * (this.rigid[1] + h * force);
      this.rigid[1] += 2 * h * force;
    }
    this.at++;
  }
  // Bring the oscillators to the instant next to t.
  seek(t) {
    const target = Math.min(Math.max(Math.round(t / this.frame.step), 0), this.steps);
    const row = Math.floor(target / this.stride);
    if (target < this.at || row * this.stride > this.at + this.stride) {
      const from = Math.min(row, this.saved.length - 1);
      if (from < 0) { this.q.fill(0); this.w.fill(0); this.rigid = [0, 0]; this.at = 0; }
      else { const s = this.saved[from]; this.q.set(s.q); this.w.set(s.w); this.rigid = [...s.rigid]; this.at = from * this.stride; }
    }
    for (;;) {
      if (this.at % this.stride === 0 && this.at / this.stride === this.saved.length)
        this.saved.push({ q: Float32Array.from(this.q), w: Float32Array.from(this.w), rigid: [...this.rigid] });
      if (this.at >= target) break;
      this.step();
    }
  }
  table(points) { // cosines and sines of every mode at every place
    if (!this.shapes.has(points)) {
      const n = this.omega.length, cosines = new Float64Array(n * points), sines = new Float64Array(n * points);
      for (let i = 0; i < n; i++) for (let j = 0; j < points; j++) {
        const angle = this.omega[i] * j / (points - 1) / 2;
        cosines[i * points + j] = Math.cos(angle);
        sines[i * points + j] = Math.sin(angle);
      }
      this.shapes.set(points, { cosines, sines });
    }
    return this.shapes.get(points);
  }
  profile(t, what, out) {
    this.seek(t);
    const points = out.length, { cosines, sines } = this.table(points);
    out.fill(what === 'stress' ? 0 : what === 'velocity' ? this.rigid[1] : this.rigid[0]);
    for (let i = 0; i < this.omega.length; i++) {
      const shape = what === 'stress' ? sines : cosines;
      const amplitude = what === 'stress' ? this.q[i] * this.omega[i] : what === 'velocity' ? this.w[i] * this.omega[i] : this.q[i];
      for (let j = 0, k = i * points; j < points; j++, k++) out[j] += amplitude * shape[k];
    }
    return out;
  }
  image(what, columns, rows, visit) {
    const column = new Float64Array(rows);
    for (let c = 0; c < columns; c++) visit(c, this.profile((c + 0.5) / columns * this.frame.duration, what, column));
  }
  end(t) { return at(this.frame.otherEnd, t, this.frame.duration); }
  mass(t) { return at(this.frame.otherMass, t, this.frame.duration); }
}

// Modal force, raw and averaged over the shortest kept period.
export function modalForces(frame) {
  const raw = frame.modalForce, h = frame.step, n = raw.length;
  const impulse = new Float64Array(n + 1);
  for (let k = 0; k < n; k++) impulse[k + 1] = impulse[k] + raw[k] * h;
  const window = frame.other.diagnostics.resolved_time / frame.trip;
  const value = (t) => {
    const place = Math.min(Math.max(t / h, 0), n), i = Math.min(Math.floor(place), n - 1);
    return impulse[i] + (place - i) * (impulse[i + 1] - impulse[i]);
  };
  const resolved = new Float64Array(n + 1);
  for (let k = 0; k <= n; k++) resolved[k] = (value(k * h + window / 2) - value(k * h - window / 2)) / window;
  return { raw, resolved };
}
