// Fields of a struck beam, from the message of app/beam_frame.py: SI units, except that time is in milliseconds.
// Deflection is positive the way the impactor goes; M = EI y'', V = dM/dx.

export const QUANTITIES = ['moment', 'velocity', 'shear', 'deflection'];
const COLUMNS = 240, SAVED_NUMBERS = 20_000, SPARSE = 7;
const SURVEYED = 96, EVERY = 2; // instants of the first look, and every how many-th place of each

// Value at t of a history on ascending times; where a time stands twice, the value after the jump.
export function between(time, value, t) {
  let low = 0, high = time.length - 1;
  while (high - low > 1) { const m = (low + high) >> 1; if (time[m] <= t) low = m; else high = m; }
  const part = time[high] > time[low] ? Math.min(Math.max((t - time[low]) / (time[high] - time[low]), 0), 1) : 1;
  return value[low] + part * (value[high] - value[low]);
}

// Room for numbers that each field of its size uses anew; only one field is shown at a time.
const rooms = {};
function scratch(name, size, Type = Float32Array) {
  if (rooms[name]?.length !== size) rooms[name] = new Type(size);
  return rooms[name].fill(0);
}

class Field {
  // A first look over the whole blow: the largest value of everything, and where the colours end.
  survey() {
    const { places, frame } = this, row = scratch('row', places), across = Math.ceil(places / EVERY);
    const seen = Object.fromEntries(QUANTITIES.map((what) => [what, scratch(`surveyed ${what}`, SURVEYED * across)]));
    for (let c = 0; c < SURVEYED; c++) {
      const t = (c + 0.5) / SURVEYED * frame.duration;
      for (const what of QUANTITIES) {
        this.profile(t, what, row, c % EVERY, EVERY); // by turns other places, so that none is left out
        for (let j = c % EVERY, k = c * across; j < places; j += EVERY, k++) seen[what][k] = row[j];
      }
    }
    this.largest = {};
    this.usual = {};
    for (const what of QUANTITIES) {
      let most = 1e-30;
      for (const value of seen[what]) most = Math.max(most, Math.abs(value));
      this.largest[what] = most;
      this.usual[what] = this.usualOf(seen[what], most);
    }
  }
  // The end of the colours of a picture: few values lie beyond.
  usualOf(values, most) {
    const sizes = new Float32Array(Math.ceil(values.length / SPARSE));
    for (let k = 0; k < sizes.length; k++) sizes[k] = Math.abs(values[k * SPARSE]);
    sizes.sort();
    return Math.max(sizes[Math.floor(0.99 * (sizes.length - 1))], 0.2 * most, 1e-30);
  }
  // The picture (column of time, place) of one quantity over a stretch of time.
  picture([start, end], what) {
    this.columns = COLUMNS;
    const asked = `${start} ${end} ${what}`;
    if (asked === this.asked) return this.drawn;
    this.asked = asked;
    this.drawn = scratch('picture', COLUMNS * this.places);
    for (let c = 0; c < COLUMNS; c++) this.profile(start + (c + 0.5) / COLUMNS * (end - start), what, this.drawn.subarray(c * this.places, (c + 1) * this.places));
    return this.drawn;
  }
}

// The modal field: the browser carries the same oscillators through the same forces as the server did.
export class BeamField extends Field {
  constructor(frame) {
    super();
    this.frame = frame;
    this.places = frame.places;
    const { modalFrequencies: omega, modalAtContact: push, damping, step: h } = frame, n = omega.length;
    const list = (value) => { const found = new Float64Array(n); for (let i = 0; i < n; i++) found[i] = value(i); return found; };
    // over a step the force is constant: each oscillator turns, and fades, about push F / omega^2
    const damped = list((i) => omega[i] * Math.sqrt(1 - damping ** 2)), fade = list((i) => Math.exp(-damping * omega[i] * h));
    const cosine = list((i) => fade[i] * Math.cos(damped[i] * h));
    this.fromRate = list((i) => fade[i] * Math.sin(damped[i] * h) / damped[i]);
    this.stay = list((i) => cosine[i] + damping * omega[i] * this.fromRate[i]);
    this.keep = list((i) => cosine[i] - damping * omega[i] * this.fromRate[i]);
    this.pull = list((i) => omega[i] ** 2 * this.fromRate[i]);
    this.middle = list((i) => push[i] / omega[i] ** 2);
    this.q = new Float64Array(n);
    this.v = new Float64Array(n);
    this.steps = frame.modalForce.length;
    this.stride = Math.max(1, Math.ceil(this.steps * n / SAVED_NUMBERS));
    this.saved = 0; // rows of displacements, rates and the two of the whole, one every `stride` steps
    this.rows = scratch('rows', (Math.floor(this.steps / this.stride) + 1) * (2 * n + 2), Float64Array);
    this.begin();
    this.tables = { deflection: this.table('shape'), moment: this.table('moment'), shear: this.table('shear') };
    this.tables.velocity = this.tables.deflection;
    this.beside = { moment: frame.momentBeside, shear: frame.shearBeside };
    this.impulses = new Float64Array(this.steps + 1);
    for (let k = 0; k < this.steps; k++) this.impulses[k + 1] = this.impulses[k] + h * frame.modalForce[k];
    this.survey();
  }
  // A table (mode, place), sent as whole numbers with a scale for each mode.
  table(name) {
    const rows = this.frame[`${name}Rows`], scale = this.frame[`${name}Scale`];
    const found = scratch(`table ${name}`, rows.length, Float64Array);
    for (let i = 0, k = 0; i < scale.length; i++) for (let j = 0; j < this.places; j++, k++) found[k] = rows[k] * scale[i];
    return found;
  }
  begin() {
    this.q.fill(0);
    this.v.fill(0);
    this.rigid = [0, this.frame.drift];
    this.at = 0;
  }
  step() {
    const { q, v, stay, keep, pull, fromRate, middle, frame } = this, force = frame.modalForce[this.at], h = frame.step, { rigidMass } = frame;
    for (let i = 0; i < q.length; i++) {
      const a = q[i] - middle[i] * force, b = v[i];
      q[i] = middle[i] * force + stay[i] * a + fromRate[i] * b;
      v[i] = keep[i] * b - pull[i] * a;
    }
    if (rigidMass) {
      const gained = h * force / rigidMass;
      this.rigid[0] += h * (this.rigid[1] + 0.5 * gained);
      this.rigid[1] += gained;
    }
    this.at++;
  }
  // Bring the oscillators to the instant next to t.
  seek(t) {
    const target = Math.min(Math.max(Math.round(t / 1e3 / this.frame.step), 0), this.steps), row = Math.floor(target / this.stride);
    if (target < this.at || row * this.stride > this.at + this.stride) {
      const from = Math.min(row, this.saved - 1);
      if (from < 0) this.begin();
      else this.restore(from);
    }
    for (;;) {
      if (this.at === this.saved * this.stride) this.save();
      if (this.at >= target) break;
      this.step();
    }
  }
  save() {
    const { q, v, rigid, rows } = this, n = q.length, start = this.saved * (2 * n + 2);
    rows.set(q, start);
    rows.set(v, start + n);
    [rows[start + 2 * n], rows[start + 2 * n + 1]] = rigid;
    this.saved++;
  }
  restore(row) {
    const { q, v, rows } = this, n = q.length, start = row * (2 * n + 2);
    q.set(rows.subarray(start, start + n));
    v.set(rows.subarray(start + n, start + 2 * n));
    this.rigid = [rows[start + 2 * n], rows[start + 2 * n + 1]];
    this.at = row * this.stride;
  }
  // The force about the instant reached, which the modes left out follow as if it were steady.
  force() {
    const { impulses, steps, frame } = this, reach = Math.max(frame.smoothing / (2 * frame.step), 1);
    const start = Math.max(this.at - reach, 0), end = Math.min(this.at + reach, steps);
    const upTo = (place) => { const k = Math.min(Math.floor(place), steps - 1); return impulses[k] + (place - k) * (impulses[k + 1] - impulses[k]); };
    return (upTo(end) - upTo(start)) / ((end - start) * frame.step);
  }
  // Values along the beam at one instant: at all places, or at every `every`-th from `first`.
  profile(t, what, out = new Float64Array(this.places), first = 0, every = 1) {
    this.seek(t);
    const { places, frame } = this, table = this.tables[what], amounts = what === 'velocity' ? this.v : this.q, n = amounts.length;
    const whole = what === 'velocity' ? this.rigid[1] : what === 'deflection' ? this.rigid[0] : 0;
    for (let j = first; j < places; j += every) out[j] = whole ? whole * frame.rigidShape[j] : 0;
    for (let i = 0; i < n; i += 2) { // two modes at a time: half as many readings and writings of the sum
      const one = amounts[i], two = i + 1 < n ? amounts[i + 1] : 0, a = i * places, b = i + 1 < n ? a + places : a;
      for (let j = first; j < places; j += every) out[j] += one * table[a + j] + two * table[b + j];
    }
    const beside = this.beside[what], force = beside ? this.force() : 0;
    if (force) for (let j = first; j < places; j += every) out[j] += force * beside[j];
    return out;
  }
}

// Fields sampled by the server, for methods whose fields cannot be rebuilt here; closer together at first.
export class SampledBeamField extends Field {
  constructor(frame) {
    super();
    this.frame = frame;
    this.places = frame.places;
    this.instants = frame.fieldTime.length;
    this.tables = { deflection: frame.fieldDeflection, velocity: frame.fieldVelocity, moment: frame.fieldMoment, shear: frame.fieldShear };
    this.survey();
  }
  profile(t, what, out = new Float64Array(this.places), first = 0, every = 1) {
    const { places, instants } = this, time = this.frame.fieldTime, table = this.tables[what];
    let low = 0, high = instants - 1;
    while (high - low > 1) { const m = (low + high) >> 1; if (time[m] <= t) low = m; else high = m; }
    const part = Math.min(Math.max((t - time[low]) / (time[high] - time[low]), 0), 1);
    for (let j = first; j < places; j += every) out[j] = table ? (1 - part) * table[low * places + j] + part * table[high * places + j] : 0;
    return out;
  }
}

export const fieldOf = (frame) => (frame.modalForce ? new BeamField(frame) : new SampledBeamField(frame));
