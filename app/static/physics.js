// The message of app/frames.py, and the fields rebuilt from it. Time in round trips T, place as a fraction of the
// length from the struck end, displacement in v T, velocity in v, stress in v sqrt(E rho); compression positive.

export function decode(buffer) {
  const bytes = new Uint8Array(buffer);
  const length = new DataView(bytes.buffer, bytes.byteOffset, 4).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const data = {};
  let offset = 4 + length;
  for (const [name, size] of header.arrays) {
    data[name] = new Float32Array(bytes.slice(offset, offset + 4 * size).buffer);
    offset += 4 * size;
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

// The exact field: one wave out, the same wave back one round trip later.
export class WaveField {
  constructor(frame) {
    this.frame = frame;
    this.reflection = frame.fixed ? 1 : -1;
    const { waveTime: time, wave, waveTotal, duration } = frame;
    this.perTrip = CELLS / duration;
    this.wave = new Float64Array(CELLS + 1);
    this.total = new Float64Array(CELLS + 1);
    for (let k = 0, j = 0; k <= CELLS; k++) {
      const t = (k + 0.5) / this.perTrip; // cell middles: jumps stay within one cell
      const u = k / this.perTrip;
      while (j < time.length - 2 && time[j + 1] <= t) j++;
      const part = time[j + 1] > time[j] ? Math.min((t - time[j]) / (time[j + 1] - time[j]), 1) : 1;
      this.wave[k] = wave[j] + part * (wave[j + 1] - wave[j]);
      let i = j;
      while (i > 0 && time[i] > u) i--;
      const share = time[i + 1] > time[i] ? Math.min((u - time[i]) / (time[i + 1] - time[i]), 1) : 1;
      this.total[k] = waveTotal[i] + share * (waveTotal[i + 1] - waveTotal[i]);
    }
    this.embolden();
  }
  // The largest stress or velocity anywhere: both double where the wave turns back.
  largest(what) {
    const { wave, waveForce, fixed } = this.frame;
    let sent = 0, force = 0;
    for (const v of wave) sent = Math.max(sent, Math.abs(v));
    for (const v of waveForce) force = Math.max(force, v);
    if (what === 'stress') return Math.max(fixed ? 2 * sent : sent, force, 1e-12);
    return Math.max(fixed ? sent : 2 * sent, 1e-12);
  }
  // Pulses narrower than a pixel are drawn a pixel wide: of every pixel's worth of time, the strongest value.
  embolden() {
    const pixel = Math.max(0.0045, this.frame.duration / 480), count = Math.min(Math.ceil(this.frame.duration / pixel), CELLS), each = (CELLS + 1) / count;
    let whole = 0, seen = 0;
    const bold = new Float64Array(count + 1);
    for (let k = 0; k <= CELLS; k++) {
      const cell = Math.min(Math.floor(k / each), count), v = this.wave[k];
      if (Math.abs(v) > Math.abs(bold[cell])) bold[cell] = v;
      whole = Math.max(whole, Math.abs(v));
    }
    for (let k = 0; k < count; k += 2) seen = Math.max(seen, Math.abs(this.wave[Math.floor((k + 0.9) * each)]));
    if (seen > 0.6 * whole) return;
    this.bold = bold;
    this.boldPerTrip = count / this.frame.duration;
  }
  sent(t) {
    if (this.bold) return t < 0 ? 0 : this.bold[Math.min(Math.floor(t * this.boldPerTrip), this.bold.length - 1)];
    return t < 0 ? 0 : this.wave[Math.min(Math.floor(t * this.perTrip), CELLS)];
  }
  sentTotal(t) {
    if (t <= 0) return 0;
    const place = Math.min(t * this.perTrip, CELLS - 1e-9), i = Math.floor(place);
    return this.total[i] + (place - i) * (this.total[i + 1] - this.total[i]);
  }
  profile(t, what, out) {
    const n = out.length - 1, r = this.reflection;
    for (let i = 0; i <= n; i++) {
      const lag = i / n / 2;
      if (what === 'stress') out[i] = this.sent(t - lag) + r * this.sent(t + lag - 1);
      else if (what === 'velocity') out[i] = this.sent(t - lag) - r * this.sent(t + lag - 1);
      else out[i] = this.sentTotal(t - lag) - r * this.sentTotal(t + lag - 1);
    }
    return out;
  }
  image(what, columns, rows, visit) {
    const column = new Float64Array(rows);
    for (let c = 0; c < columns; c++) visit(c, this.profile((c + 0.5) / columns * this.frame.duration, what, column));
  }
  end(t) { return this.sentTotal(t) - this.reflection * this.sentTotal(t - 1); }
  mass(t) { return at(this.frame.waveMass, t, this.frame.duration); }
}

const SAVED_NUMBERS = 400_000;

// The modal field: the browser carries the same oscillators through the same forces as the server did.
export class ModalField {
  constructor(frame) {
    this.frame = frame;
    const n = frame.modes, h = frame.step;
    this.steps = frame.modalForce.length;
    this.stride = Math.max(1, Math.ceil(this.steps * n / SAVED_NUMBERS));
    this.omega = Float64Array.from({ length: n }, (_, i) => 2 * Math.PI * (frame.fixed ? i + 0.5 : i + 1));
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
    if (!this.frame.fixed) { // the free rod as a whole: x'' = 2 F
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
  end(t) { return at(this.frame.modalEnd, t, this.frame.duration); }
  mass(t) { return at(this.frame.modalMass, t, this.frame.duration); }
}

// Modal force, raw and averaged over the shortest kept period.
export function modalForces(frame) {
  const raw = frame.modalForce, h = frame.step, n = raw.length;
  const impulse = new Float64Array(n + 1);
  for (let k = 0; k < n; k++) impulse[k + 1] = impulse[k] + raw[k] * h;
  const window = frame.modal.diagnostics.resolved_time / frame.trip;
  const value = (t) => {
    const place = Math.min(Math.max(t / h, 0), n), i = Math.min(Math.floor(place), n - 1);
    return impulse[i] + (place - i) * (impulse[i + 1] - impulse[i]);
  };
  const resolved = new Float64Array(n + 1);
  for (let k = 0; k <= n; k++) resolved[k] = (value(k * h + window / 2) - value(k * h - window / 2)) / window;
  return { raw, resolved };
}
