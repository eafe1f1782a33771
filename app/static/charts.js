// The three views that share the axis of time: x-t diagram, contact force, displacements.
import { Chart, COLORS, palette, shade } from './plot.js';
import { at, modalForces } from './physics.js';

const COLUMNS = 480, ROWS = 121, MODAL_COLUMNS = 200, MODAL_ROWS = 61; // fewer for modes, which cost a sum each
const LINES = [['exact waves', 'line waves'], ['modes', 'line modal']];
const figures = (value) => (value === 0 ? '0' : Number(value.toPrecision(3)).toLocaleString('en', { maximumSignificantDigits: 3, useGrouping: false }).replace('-', '−'));

function shadeContacts(c, chart, frame) {
  c.fillStyle = COLORS.contact;
  for (const [start, end] of frame.waves.contacts) {
    c.fillRect(chart.px(start), chart.box.y, Math.max(chart.px(end) - chart.px(start), 1), chart.box.h);
  }
}

export class SpaceTime {
  constructor() {
    this.chart = new Chart('Where the waves are', 'place along the rod ↓, time → in T', 'x-t diagram: stress or velocity along the rod against time');
    this.chart.label = (v) => (v === 0 ? 'struck' : v === 1 ? 'far end' : v.toFixed(1));
    this.image = document.createElement('canvas');
    this.chart.y = [1, 0]; // the struck end on top
  }
  // Rebuild the picture; returns the largest value, which is the end of the colour scale.
  load(field, what, largest) {
    const columns = field.omega ? MODAL_COLUMNS : COLUMNS, rows = field.omega ? MODAL_ROWS : ROWS;
    if (this.image.width !== columns) Object.assign(this.image, { width: columns, height: rows });
    const context = this.image.getContext('2d'), picture = context.createImageData(columns, rows), pixels = picture.data;
    field.image(what, columns, rows, (column, values) => {
      for (let row = 0; row < rows; row++) {
        const k = shade(values[row], largest), p = 4 * (row * columns + column);
        pixels[p] = palette[k]; pixels[p + 1] = palette[k + 1]; pixels[p + 2] = palette[k + 2]; pixels[p + 3] = 255;
      }
    });
    context.putImageData(picture, 0, 0);
  }
  draw(frame, view) {
    const { chart } = this;
    chart.x = view;
    if (!chart.fit()) return;
    const c = chart.begin(chart.below), { box } = chart;
    const { width, height } = this.image, part = (view[1] - view[0]) / frame.duration;
    c.imageSmoothingEnabled = part < 1 / 3 || width < COLUMNS;
    c.drawImage(this.image, view[0] / frame.duration * width, 0, part * width, height, box.x, box.y, box.w, box.h);
    chart.axes(c, { gridX: false });
    const { contacts } = frame[frame.chosen.method === 'modal' ? 'modal' : 'waves'];
    for (const [start, end] of contacts) { // contact, as a bar on the struck end
      const a = Math.max(chart.px(start), box.x), b = Math.min(chart.px(end), box.x + box.w);
      if (b > a) { c.fillStyle = COLORS.ink; c.fillRect(a, box.y, Math.max(b - a, 2), 4); }
    }
    chart.key([['bar on top: in contact', 'line ink']]);
  }
}

export class Force {
  constructor() {
    this.chart = new Chart('Contact force', 'kN', 'contact force against time, exact waves and modes');
  }
  load(frame) {
    this.frame = frame;
    this.time = frame.waveTime;
    this.exact = frame.waveForce;
    Object.assign(this, modalForces(frame));
    this.scale = frame.forceUnit / 1e3;
  }
  draw(frame, view) {
    const { chart, scale } = this;
    chart.x = view;
    let high = 0;
    for (let k = 0; k < this.time.length; k++) if (this.time[k] >= view[0] && this.time[k] <= view[1]) high = Math.max(high, this.exact[k]);
    for (let k = 0; k < this.resolved.length; k++) {
      const t = k * frame.step;
      if (t >= view[0] && t <= view[1]) high = Math.max(high, this.resolved[k]);
    }
    chart.y = [-0.04 * (high || 1) * scale, 1.25 * (high || 1) * scale];
    const unit = chart.y[1] < 0.5 ? [1e3, 'N'] : chart.y[1] > 2e3 ? [1e-3, 'MN'] : [1, 'kN'];
    this.unit = unit;
    chart.unit.textContent = unit[1];
    chart.y = chart.y.map((v) => v * unit[0]);
    const s = scale * unit[0];
    if (!chart.fit()) return;
    const c = chart.begin(chart.below);
    chart.axes(c);
    chart.clip(c);
    shadeContacts(c, chart, frame);
    const h = frame.step, steps = this.raw.length;
    chart.line(c, 2 * steps, (k) => h * ((k + 1) >> 1), (k) => this.raw[k >> 1] * s, COLORS.raw, 1);
    chart.line(c, this.resolved.length, (k) => k * h, (k) => this.resolved[k] * s, COLORS.modal, 1.5);
    chart.line(c, this.time.length, (k) => this.time[k], (k) => this.exact[k] * s, COLORS.waves, 2);
    c.restore();
    const { raw_contacts: touches } = frame.modal.diagnostics;
    const chatter = touches > frame.modal.contacts.length ? `raw (${touches} touches)` : 'raw';
    chart.key([...LINES, [chatter, 'line raw']]);
  }
  at(t) {
    let low = 0, high = this.time.length - 1;
    while (high - low > 1) { const m = (low + high) >> 1; if (this.time[m] <= t) low = m; else high = m; }
    const part = this.time[high] > this.time[low] ? Math.min((t - this.time[low]) / (this.time[high] - this.time[low]), 1) : 1;
    return this.exact[low] + part * (this.exact[high] - this.exact[low]);
  }
  cursor(t) {
    const { chart, scale } = this;
    if (!chart.box) return;
    const c = chart.cursor(t), s = scale * this.unit[0], exact = this.at(t) * s;
    const modal = this.resolved[Math.min(Math.round(t / this.frame.step), this.resolved.length - 1)] * s;
    chart.dot(c, t, modal, COLORS.modal);
    chart.dot(c, t, exact, COLORS.waves);
    chart.value.textContent = `waves ${figures(exact)}   modes ${figures(modal)} ${this.unit[1]}`;
  }
}

export class Displacements {
  constructor() {
    this.chart = new Chart('Mass and struck end', 'µm', 'displacement of the mass and of the struck end against time');
  }
  load(frame, fields) {
    this.frame = frame;
    this.fields = fields;
    this.scale = frame.speed * frame.trip * 1e6;
  }
  draw(frame, view) {
    const { chart, scale, fields } = this, [waves] = fields, points = 500;
    chart.x = view;
    const t = (k) => view[0] + (view[1] - view[0]) * k / (points - 1);
    let low = 0, high = 0;
    for (let k = 0; k < points; k++) for (const y of [waves.mass(t(k)), waves.end(t(k)), this.ghost(t(k))]) {
      low = Math.min(low, y); high = Math.max(high, y);
    }
    if (view[0] > 0) { // zoomed: what the eye wants is the two bodies, not the origin
      low = Infinity; high = -Infinity;
      for (let k = 0; k < points; k++) for (const y of [waves.mass(t(k)), waves.end(t(k))]) { low = Math.min(low, y); high = Math.max(high, y); }
    }
    const pad = 0.08 * (high - low || 1);
    const unit = Math.max(Math.abs(low), Math.abs(high)) * scale > 3e3 ? [1e-3, 'mm'] : Math.max(Math.abs(low), Math.abs(high)) * scale < 0.3 ? [1e3, 'nm'] : [1, 'µm'];
    this.unit = unit;
    chart.unit.textContent = `${unit[1]}, time → in T`;
    const s = scale * unit[0];
    chart.y = [(low - pad) * s, (high + pad) * s];
    if (!chart.fit()) return;
    const c = chart.begin(chart.below);
    chart.axes(c);
    chart.clip(c);
    shadeContacts(c, chart, frame);
    chart.line(c, 2, (k) => t(k * (points - 1)), (k) => this.ghost(t(k * (points - 1))) * s, COLORS.ghost, 1.6, [6, 4]);
    if (!frame.fixed) chart.line(c, 2, (k) => t(k * (points - 1)), (k) => frame.ghost.target * t(k * (points - 1)) * s, COLORS.ghost, 1.6, [2, 3]);
    chart.line(c, points, t, (k) => at(frame.modalEnd, t(k), frame.duration) * s, COLORS.modal, 1, [3, 2]);
    chart.line(c, points, t, (k) => at(frame.modalMass, t(k), frame.duration) * s, COLORS.modal, 1);
    chart.line(c, points, t, (k) => waves.end(t(k)) * s, '#4f9bd8', 1.8);
    chart.line(c, points, t, (k) => waves.mass(t(k)) * s, COLORS.waves, 2);
    c.restore();
    const ghosts = frame.fixed ? [['ghost', 'line ghost']] : [['ghost mass', 'line ghost'], ['ghost rod', 'line dots']];
    chart.key([['mass', 'line waves'], ['end', 'line end'], ['modes', 'line modal'], ...ghosts]);
  }
  ghost(t) { return this.frame.ghost.impactor * t; }
  cursor(t) {
    const { chart, scale } = this;
    if (!chart.box) return;
    const c = chart.cursor(t), s = scale * this.unit[0], [waves] = this.fields;
    chart.dot(c, t, waves.end(t) * s, '#4f9bd8');
    chart.dot(c, t, waves.mass(t) * s, COLORS.waves);
    chart.value.textContent = `mass ${figures(waves.mass(t) * s)}   end ${figures(waves.end(t) * s)} ${this.unit[1]}`;
  }
}
