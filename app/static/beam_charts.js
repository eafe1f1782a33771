// The views of a struck beam that share the axis of time: x-t diagram, contact force, motions. Times in milliseconds.
import { Chart, COLORS, palette, shade } from './plot.js';
import { naming } from './charts.js';
import { between } from './beam_field.js';
import { figures, prefixed } from './beam_stage.js';

const ENDS = { cantilever: ['clamp', 'tip'], 'pinned-pinned': ['pin', 'roller'], 'clamped-clamped': ['clamp', 'clamp'], 'free-free': ['free', 'free'], 'pinned-free': ['pin', 'free'] };
const HALF_SPACE = '#7a5ea8', STRUCK = '#4f9bd8', BAND = 'rgba(122,94,168,.14)', WIDE = 'rgba(122,94,168,.09)', RAW = 'rgba(11,79,138,.28)';

// A method with its resolution, as a reader calls it.
export const called = (solution) => {
  const { name, modes, elements } = solution, what = { modal: 'modes', 'mode-switch': 'switched modes', 'fe-modal': 'modes of elements', 'fe-nodal': 'elements' }[name];
  const count = name === 'fe-nodal' ? elements : modes;
  return what && count ? `${count} ${count === 1 ? what.replace(/s( of elements)?$/, '$1') : what}` : naming(name);
};

function shadeContacts(c, chart, contacts) {
  c.fillStyle = COLORS.contact;
  for (const [start, end] of contacts) {
    if (end < chart.x[0] || start > chart.x[1]) continue;
    c.fillRect(chart.px(start), chart.box.y, Math.max(chart.px(end) - chart.px(start), 1), chart.box.h);
  }
}

export class BeamSpaceTime {
  constructor() {
    this.chart = new Chart('How bending runs along the beam', 'place ↓, time → in ms', 'x-t diagram: the beam against time, in colours');
    this.chart.y = [1, 0];
    this.image = document.createElement('canvas');
  }
  load(frame, field, what) {
    Object.assign(this, { frame, field, what });
    const [first, last] = ENDS[frame.beam.support];
    this.chart.label = (v) => (v === 0 ? first : v === 1 ? last : v.toFixed(1));
  }
  draw(view) {
    const { chart, field, frame, what } = this;
    chart.x = view;
    if (!chart.fit()) return;
    this.paint(field.picture(view, what));
    const c = chart.begin(chart.below), { box } = chart;
    c.imageSmoothingEnabled = true;
    c.drawImage(this.image, box.x, box.y, box.w, box.h);
    chart.axes(c, { gridX: false });
    chart.clip(c);
    const place = frame.beam.place / frame.beam.length, limit = frame.beam.speedLimit / frame.beam.length / 1e3;
    c.strokeStyle = 'rgba(28,39,51,.65)';
    c.lineWidth = 1.2;
    c.setLineDash([5, 4]);
    c.beginPath(); // nothing in the material runs faster
    for (const way of [-1, 1]) { c.moveTo(chart.px(0), chart.py(place)); c.lineTo(chart.px(1 / limit), chart.py(place + way)); }
    c.stroke();
    c.setLineDash([]);
    c.restore();
    for (const [start, end] of frame.contacts) {
      const a = Math.max(chart.px(start), box.x), b = Math.min(chart.px(end), box.x + box.w);
      if (b >= a) { c.fillStyle = COLORS.ink; c.fillRect(a, Math.min(Math.max(chart.py(place) - 2, box.y), box.y + box.h - 4), Math.max(b - a, 1), 4); }
    }
    chart.key([[`red: ${what} ${what === 'moment' || what === 'shear' ? 'positive' : 'forward'}`, 'red'], ['contact', 'line ink'], ['fastest possible, √(E/ρ)', 'line dashes']]);
  }
  paint(picture) {
    const { field, image } = this, { columns, places } = field, largest = field.usualOf(picture, 0);
    if (image.width !== columns || image.height !== places) {
      Object.assign(image, { width: columns, height: places });
      this.context = image.getContext('2d');
      this.data = this.context.createImageData(columns, places);
      this.data.data.fill(255);
    }
    const pixels = this.data.data;
    for (let row = 0, p = 0; row < places; row++) for (let column = 0; column < columns; column++, p += 4) {
      const k = shade(picture[column * places + row], largest);
      pixels[p] = palette[k]; pixels[p + 1] = palette[k + 1]; pixels[p + 2] = palette[k + 2];
    }
    this.context.putImageData(this.data, 0, 0);
  }
  cursor(t) { if (this.chart.box) this.chart.cursor(t); }
}

export class BeamForce {
  constructor(toggled) {
    this.chart = new Chart('Contact force', 'N', 'contact force against time, with every contact shaded');
    this.half = Object.assign(document.createElement('button'), { type: 'button', className: 'whole small', textContent: 'On a half-space' });
    this.half.title = 'the same impactor, by the same contact law, on a body of this material too large to bend';
    this.shown = true;
    this.half.onclick = () => { this.shown = !this.shown; toggled(); };
    this.chart.head.insertBefore(this.half, this.chart.value);
  }
  load(frame) {
    this.frame = frame;
    const { modalForce, step } = frame;
    // what modes say is one force for each step
    if (modalForce) {
      this.time = new Float64Array(2 * modalForce.length);
      this.force = new Float64Array(2 * modalForce.length);
      for (let k = 0; k < this.time.length; k++) { this.time[k] = 1e3 * step * ((k + 1) >> 1); this.force[k] = modalForce[k >> 1]; }
    } else Object.assign(this, { time: frame.mainTime, force: frame.mainForce });
    this.raw = null;
    const window = frame.law.name === 'rigid' && modalForce ? frame.main.diagnostics.resolved_time : 0;
    if (window) { // chatter at the shortest kept period says nothing
      this.raw = [this.time, this.force];
      this.resolve(modalForce, step, window);
    }
    this.half.hidden = !frame.halfForce;
  }
  // The mean force over the shortest kept period, the finest that the modes can tell.
  resolve(raw, h, window) {
    const n = raw.length, impulse = new Float64Array(n + 1);
    for (let k = 0; k < n; k++) impulse[k + 1] = impulse[k] + raw[k] * h;
    const sum = (t) => { const place = Math.min(Math.max(t / h, 0), n), i = Math.min(Math.floor(place), n - 1); return impulse[i] + (place - i) * (impulse[i + 1] - impulse[i]); };
    this.time = new Float64Array(n + 1);
    this.force = new Float64Array(n + 1);
    for (let k = 0; k <= n; k++) {
      this.time[k] = 1e3 * h * k;
      this.force[k] = (sum(k * h + window / 2) - sum(k * h - window / 2)) / window;
    }
  }
  get curves() {
    const { frame } = this, found = [];
    if (this.raw) found.push([...this.raw, RAW, 1]);
    if (this.shown && frame.halfForce) found.push([frame.halfTime, frame.halfForce, HALF_SPACE, 1.3]);
    if (frame.reference) found.push([frame.referenceTime, frame.referenceForce, COLORS.modal, 1.1]);
    return [...found, [this.time, this.force, COLORS.waves, 1.6]];
  }
  draw(view, band) {
    const { chart, frame } = this;
    chart.x = view;
    this.half.setAttribute('aria-pressed', String(this.shown));
    let high = 0;
    for (const [time, force, color] of this.curves.reverse()) {
      let most = 0;
      for (let k = 0; k < time.length; k++) if (time[k] >= view[0] && time[k] <= view[1]) most = Math.max(most, force[k]);
      high = color !== COLORS.waves && high > 0 ? Math.max(high, Math.min(most, 2 * high)) : Math.max(high, most); // others may leave the picture
    }
    const [factor, prefix] = prefixed(high);
    this.unit = [factor, `${prefix}N`];
    chart.unit.textContent = `${prefix}N, time → in ms`;
    chart.y = [-0.04 * (high || 1) * factor, 1.12 * (high || 1) * factor];
    if (!chart.fit()) return;
    const c = chart.begin(chart.below);
    chart.axes(c);
    chart.clip(c);
    shadeContacts(c, chart, frame.contacts);
    if (band) drawBand(c, chart, band.time, band.force, factor);
    for (const [time, force, color, width] of this.curves) chart.line(c, time.length, (k) => time[k], (k) => force[k] * factor, color, width);
    c.restore();
    const entries = [[called(frame.main), 'line waves']];
    if (this.raw) entries.push(['raw', 'line raw-main']);
    if (frame.reference) entries.push([`${called(frame.reference)}, to compare`, 'line modal']);
    if (this.shown && frame.halfForce) entries.push([`on a body too large to bend, up to ${figures(Math.max(...frame.halfForce) * factor, 2)} ${prefix}N`, 'line half-space']);
    if (band) entries.push(['spread', 'chip spread']);
    chart.key(entries);
  }
  cursor(t) {
    const { chart, unit } = this;
    if (!chart.box) return;
    const c = chart.cursor(t), now = between(this.time, this.force, t) * unit[0];
    chart.dot(c, t, now, COLORS.waves);
    chart.value.textContent = `${figures(now)} ${unit[1]}`;
  }
  at(t) { return between(this.time, this.force, t); }
}

// 5 to 95 % of an ensemble over the range of all of it.
export function drawBand(c, chart, time, { low, high, lowest, highest }, factor) {
  for (const [a, b, color] of [[lowest, highest, WIDE], [low, high, BAND]]) {
    c.fillStyle = color;
    c.beginPath();
    for (let k = 0; k < time.length; k++) c.lineTo(chart.px(time[k]), chart.py(a[k] * factor));
    for (let k = time.length - 1; k >= 0; k--) c.lineTo(chart.px(time[k]), chart.py(b[k] * factor));
    c.fill();
  }
}

const KINDS = { displacement: ['Path', 1e6, 'µm'], velocity: ['Rate', 1, 'm/s'] };

// Impactor and struck place: where they are, or how fast they go.
export class BeamMotion {
  constructor(changed) {
    this.chart = new Chart('Impactor and struck place', 'µm', 'displacement or velocity of the impactor and of the struck place against time');
    this.kind = 'displacement';
    this.switch = Object.assign(document.createElement('div'), { className: 'segments small' });
    for (const kind of Object.keys(KINDS)) {
      const button = Object.assign(document.createElement('button'), { type: 'button', textContent: kind, onclick: () => { this.kind = kind; changed(); } });
      this.switch.append(button);
    }
    this.chart.head.insertBefore(this.switch, this.chart.value);
  }
  load(frame) { this.frame = frame; }
  get curves() {
    const { frame, kind } = this, [suffix] = KINDS[kind], found = [];
    if (kind === 'displacement' && frame.staticPath) found.push([frame.staticTime, frame.staticPath, COLORS.ghost, 1.3, [6, 4]]);
    if (kind === 'displacement' && frame.reference) found.push([frame.time, frame.referenceStruckPath, COLORS.modal, 1, [3, 2]], [frame.time, frame.referenceImpactorPath, COLORS.modal, 1, []]);
    return [...found, [frame.time, frame[`struck${suffix}`], STRUCK, 1.7, []], [frame.time, frame[`impactor${suffix}`], COLORS.waves, 1.8, []]];
  }
  draw(view, band) {
    const { chart, frame, kind } = this, [, base, name] = KINDS[kind];
    for (const button of this.switch.children) button.setAttribute('aria-pressed', String(button.textContent === kind));
    chart.x = view;
    let low = Infinity, high = -Infinity;
    for (const [time, values] of this.curves.slice(-2)) for (let k = 0; k < time.length; k++) if (time[k] >= view[0] && time[k] <= view[1]) { low = Math.min(low, values[k]); high = Math.max(high, values[k]); }
    if (!(high > low)) [low, high] = [-1, 1];
    const size = Math.max(Math.abs(low), Math.abs(high)) * base, [factor, unit] = kind === 'velocity' ? [1, name] : size > 3e3 ? [1e3, 'mm'] : [1e6, 'µm'];
    this.unit = [factor, unit];
    chart.unit.textContent = `${unit}, time → in ms`;
    const pad = 0.08 * (high - low);
    chart.y = [(low - pad) * factor, (high + pad) * factor];
    if (!chart.fit()) return;
    const c = chart.begin(chart.below);
    chart.axes(c);
    chart.clip(c);
    shadeContacts(c, chart, frame.contacts);
    if (band && kind === 'displacement') drawBand(c, chart, band.time, band.displacement, factor);
    for (const [time, values, color, width, dash] of this.curves) chart.line(c, time.length, (k) => time[k], (k) => values[k] * factor, color, width, dash);
    c.restore();
    const entries = [['impactor', 'line waves'], ['struck place', 'line end']];
    if (kind === 'displacement' && frame.reference) entries.push([`${called(frame.reference)}, to compare`, 'line modal']);
    if (kind === 'displacement' && frame.staticPath) entries.push(['quasi-static', 'line ghost']);
    chart.key(entries);
  }
  cursor(t) {
    const { chart, unit, frame } = this;
    if (!chart.box) return;
    const c = chart.cursor(t), [suffix] = KINDS[this.kind];
    const [impactor, struck] = ['impactor', 'struck'].map((name) => between(frame.time, frame[name + suffix], t) * unit[0]);
    chart.dot(c, t, struck, STRUCK);
    chart.dot(c, t, impactor, COLORS.waves);
    chart.value.textContent = `impactor ${figures(impactor)}   struck ${figures(struck)} ${unit[1]}`;
  }
}

// Frequency over wavenumber by the theory in use, the kept modes on it, and the fastest wave of the material.
export class Dispersion {
  constructor() {
    this.chart = new Chart('Dispersion', 'kHz over 1/m', 'frequency against wavenumber, with the kept modes as dots');
    this.chart.root.classList.add('square');
  }
  draw(frame) {
    const { chart } = this, { wavenumbers: k, lower, upper, modeWavenumbers, modeFrequencies, beam } = frame, hertz = 0.5 / Math.PI;
    const most = lower.at(-1) * hertz, [factor, prefix] = prefixed(most), unit = `${prefix}Hz`;
    chart.unit.textContent = `${unit} over wavenumber in 1/m`;
    chart.x = [0, k.at(-1)];
    chart.y = [0, most * factor];
    if (!chart.fit()) return;
    const c = chart.begin(chart.below), s = hertz * factor;
    chart.axes(c);
    chart.clip(c);
    c.strokeStyle = COLORS.ink;
    c.lineWidth = 1.2;
    c.setLineDash([5, 4]);
    c.beginPath(); c.moveTo(chart.px(0), chart.py(0)); c.lineTo(chart.px(k.at(-1)), chart.py(beam.speedLimit * k.at(-1) * s)); c.stroke();
    c.setLineDash([]);
    if (upper) chart.line(c, k.length, (i) => k[i], (i) => upper[i] * s, STRUCK, 1.4);
    chart.line(c, k.length, (i) => k[i], (i) => lower[i] * s, COLORS.waves, 1.8);
    let beyond = 0;
    modeWavenumbers.forEach((x, i) => {
      const fast = modeFrequencies[i] > beam.speedLimit * x;
      beyond += fast;
      c.fillStyle = fast ? COLORS.cursor : COLORS.waves;
      c.beginPath(); c.arc(chart.px(x), chart.py(modeFrequencies[i] * s), 3, 0, 7); c.fill();
    });
    c.restore();
    const theory = beam.theory === 'timoshenko' ? 'Timoshenko' : 'Euler–Bernoulli';
    chart.key([[theory, 'line waves'], ...(upper ? [['shear branch', 'line end']] : []), ['√(E/ρ)', 'line dashes']]);
    chart.value.textContent = beyond ? `${beyond} of ${modeWavenumbers.length} modes too fast` : `${modeWavenumbers.length} mode${modeWavenumbers.length === 1 ? '' : 's'}, none too fast`;
  }
}
