// The three views that share the axis of time: x-t diagram, contact force, displacements.
import { Chart, COLORS, palette, shade } from './plot.js';
import { at, modalForces } from './physics.js';

const COLUMNS = 480, ROWS = 121, MODAL_COLUMNS = 200, MODAL_ROWS = 61; // fewer for modes, which cost a sum each
const NAMES = { waves: 'exact waves', modal: 'modes', rigid: 'rigid bodies', 'quasi-static': 'quasi-static', 'fe-nodal': 'finite elements', 'fe-modal': 'modes of elements', balance: 'balances', 'mode-switch': 'switched modes', 'floating-frame': 'floating frame' };
export const naming = (name) => NAMES[name] ?? name;
// Whether the pictures show the other method.
export const drawnFromOther = (frame) => Boolean(frame.other && frame.chosen.method === frame.other.name && frame.other.name !== frame.exact.name);
// Value at t of a history given by times and values; at a jump the value after it.
function between(time, value, t) {
  let low = 0, high = time.length - 1;
  while (high - low > 1) { const m = (low + high) >> 1; if (time[m] <= t) low = m; else high = m; }
  const part = time[high] > time[low] ? Math.min(Math.max((t - time[low]) / (time[high] - time[low]), 0), 1) : 1;
  return value[low] + part * (value[high] - value[low]);
}
const figures = (value) => (Math.abs(value) < 1e-9 ? '0' : Number(value.toPrecision(3)).toLocaleString('en', { maximumSignificantDigits: 3, useGrouping: false }).replace('-', '−'));

function shadeContacts(c, chart, frame) {
  c.fillStyle = COLORS.contact;
  for (const [start, end] of frame.exact.contacts) {
    c.fillRect(chart.px(start), chart.box.y, Math.max(chart.px(end) - chart.px(start), 1), chart.box.h);
  }
}

export class SpaceTime {
  constructor() {
    this.chart = new Chart('Where the waves are', 'place along the rod ↓, time → in T', 'x-t diagram: stress or velocity along the rod against time');
    this.image = document.createElement('canvas');
    this.chart.y = [1, 0]; // the struck end on top
  }
  // Places as fractions of the struck body; a rod that strikes lies on the other side of zero.
  label(field) {
    const { frame } = field, reach = field.to || 1;
    this.span = [field.from / reach, 1];
    const several = frame.rods.length > 1;
    this.chart.unit.textContent = several ? 'place along the rods ↓ in m, time → in T' : 'place along the rod ↓, time → in T';
    this.chart.label = several ? (v, digits) => (v * reach).toFixed(Math.max(digits, 1)) : (v) => (v === 0 ? 'struck' : v === 1 ? 'far end' : v.toFixed(1));
    this.chart.y = [this.span[1], this.span[0]];
    this.joints = frame.rods.slice(1).map((rod) => rod.from / reach);
  }
  // Rebuild the picture; returns the largest value, which is the end of the colour scale.
  load(field, what, largest) {
    this.label(field);
    const few = field.omega || field.sampled, columns = few ? MODAL_COLUMNS : COLUMNS, rows = few ? MODAL_ROWS : ROWS;
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
    c.strokeStyle = 'rgba(28,39,51,.45)';
    c.lineWidth = 1;
    for (const place of this.joints) {
      c.setLineDash([4, 4]);
      c.beginPath(); c.moveTo(box.x, chart.py(place)); c.lineTo(box.x + box.w, chart.py(place)); c.stroke();
    }
    c.setLineDash([]);
    const { contacts } = frame[drawnFromOther(frame) ? 'other' : 'exact'], face = chart.py(0);
    for (const [start, end] of contacts) { // contact, as a bar on the struck end
      const a = Math.max(chart.px(start), box.x), b = Math.min(chart.px(end), box.x + box.w);
      if (b > a) { c.fillStyle = COLORS.ink; c.fillRect(a, Math.max(face - 2, box.y), Math.max(b - a, 2), 4); }
    }
    chart.key([['bar: in contact', 'line ink']]);
  }
}

export class Force {
  constructor() {
    this.chart = new Chart('Contact force', 'kN', 'contact force against time, exact and by the other method');
  }
  load(frame) {
    this.frame = frame;
    this.time = frame.exactTime;
    this.exact = frame.exactForce;
    this.raw = null;
    if (frame.modalForce) {
      const { raw, resolved } = modalForces(frame);
      this.raw = raw;
      this.other = resolved;
      this.otherTime = Float64Array.from(resolved, (_, k) => k * frame.step);
    } else {
      this.other = frame.otherForce;
      this.otherTime = frame.otherTime;
    }
    this.scale = frame.forceUnit / 1e3;
  }
  draw(frame, view) {
    const { chart, scale, other, otherTime } = this;
    chart.x = view;
    let high = 0;
    for (let k = 0; k < this.time.length; k++) if (this.time[k] >= view[0] && this.time[k] <= view[1]) high = Math.max(high, this.exact[k]);
    const exactHigh = high;
    for (let k = 0; k < (other?.length ?? 0); k++) if (otherTime[k] >= view[0] && otherTime[k] <= view[1]) high = Math.max(high, other[k]);
    if (!frame.modalForce && exactHigh > 0) high = Math.min(high, 2.5 * exactHigh); // trains of impulses have no height
    for (let k = 0; k < (frame.balanceForce?.length ?? 0); k++) if (frame.balanceTime[k] >= view[0] && frame.balanceTime[k] <= view[1]) high = Math.max(high, frame.balanceForce[k]);
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
    const h = frame.step;
    if (this.raw) chart.line(c, 2 * this.raw.length, (k) => h * ((k + 1) >> 1), (k) => this.raw[k >> 1] * s, COLORS.raw, 1);
    if (other) chart.line(c, other.length, (k) => otherTime[k], (k) => other[k] * s, COLORS.modal, 1.5);
    chart.line(c, this.time.length, (k) => this.time[k], (k) => this.exact[k] * s, COLORS.waves, 2);
    for (let k = 0; k < (frame.balanceForce?.length ?? 0); k++) chart.circle(c, frame.balanceTime[k], frame.balanceForce[k] * s, COLORS.modal);
    if (frame.record) chart.line(c, frame.record.time.length, (k) => frame.record.time[k], (k) => frame.record.force[k] * s, COLORS.record, 1.4);
    c.restore();
    const entries = [[naming(frame.exact.name), 'line waves']];
    if (frame.other) entries.push([naming(frame.other.name), 'line modal']);
    if (frame.balanceForce) entries.push(['impulse over step', 'ring']);
    if (this.raw) {
      const { raw_contacts: touches } = frame.other.diagnostics;
      entries.push([touches > frame.other.contacts.length ? `raw (${touches} touches)` : 'raw', 'line raw']);
    }
    if (frame.record) entries.push(['measured', 'line record']);
    chart.key(entries);
  }
  at(t) { return between(this.time, this.exact, t); }
  otherAt(t) { return between(this.otherTime, this.other, t); }
  cursor(t) {
    const { chart, scale } = this;
    if (!chart.box) return;
    const c = chart.cursor(t), s = scale * this.unit[0], exact = this.at(t) * s;
    const other = this.other ? between(this.otherTime, this.other, t) * s : NaN;
    chart.dot(c, t, other, COLORS.modal);
    chart.dot(c, t, exact, COLORS.waves);
    const second = this.other ? `   ${naming(this.frame.other.name)} ${figures(other)}` : '';
    chart.value.textContent = `${naming(this.frame.exact.name)} ${figures(exact)}${second} ${this.unit[1]}`;
  }
}

// Force against indentation: the law's own curve, and the path of this blow.
export class Cycle {
  constructor() {
    this.chart = new Chart('Contact law', 'kN over µm', 'force against indentation: the law and this blow');
    this.chart.root.classList.add('cycle');
  }
  draw(frame) {
    const { chart } = this, { cycleDepth: depth, cycleLoading: loading, cycleUnloading: unloading, blowDepth, blowForce } = frame;
    chart.root.hidden = !depth;
    if (!depth) return;
    const most = (values) => values.reduce((a, b) => Math.max(a, b), 0);
    const deep = Math.max(most(depth), most(blowDepth)), strong = Math.max(most(loading), most(blowForce), 1e-300);
    const across = deep > 3e-3 ? [1e3, 'mm'] : deep < 3e-7 ? [1e9, 'nm'] : [1e6, 'µm'], up = strong < 500 ? [1, 'N'] : strong > 2e6 ? [1e-6, 'MN'] : [1e-3, 'kN'];
    this.unit = [across, up];
    chart.unit.textContent = `${up[1]} over ${across[1]}`;
    chart.x = [0, 1.04 * deep * across[0]];
    chart.y = [0, 1.08 * strong * up[0]];
    if (!chart.fit()) return;
    const c = chart.begin(chart.below);
    chart.axes(c);
    chart.clip(c);
    const n = depth.length, x = (k) => depth[k] * across[0];
    chart.line(c, n, x, (k) => loading[k] * up[0], COLORS.ghost, 1.6, [6, 4]);
    chart.line(c, n, x, (k) => unloading[k] * up[0], COLORS.ghost, 1.6, [2, 3]);
    c.strokeStyle = COLORS.waves;
    c.lineWidth = 2;
    c.beginPath();
    blowDepth.forEach((a, k) => c[k ? 'lineTo' : 'moveTo'](chart.px(a * across[0]), chart.py(blowForce[k] * up[0])));
    c.stroke();
    c.restore();
    const slow = loading.some((f, k) => Math.abs(f - unloading[k]) > 1e-6 * strong);
    chart.key([['this blow', 'line waves'], [slow ? 'loading slowly' : 'the law, slowly', 'line ghost'], ...(slow ? [['and back', 'line dots']] : [])]);
  }
  // This blow at one instant: depth [m] and force [N].
  mark(depth, force) {
    const { chart } = this;
    if (!chart.box) return;
    const c = chart.begin(chart.above), [across, up] = this.unit;
    if (depth > 0) chart.dot(c, depth * across[0], force * up[0], COLORS.cursor);
    chart.value.textContent = `${figures(Math.max(depth, 0) * across[0])} ${across[1]}   ${figures(force * up[0])} ${up[1]}`;
  }
}

export class Displacements {
  constructor() {
    this.chart = new Chart('Impactor and struck face', 'µm', 'displacement of the mass and of the struck end against time');
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
    if (frame.ghost) chart.line(c, 2, (k) => t(k * (points - 1)), (k) => this.ghost(t(k * (points - 1))) * s, COLORS.ghost, 1.6, [6, 4]);
    if (frame.ghost && !frame.target.held) chart.line(c, 2, (k) => t(k * (points - 1)), (k) => frame.ghost.target * t(k * (points - 1)) * s, COLORS.ghost, 1.6, [2, 3]);
    if (frame.other) {
      chart.line(c, points, t, (k) => at(frame.otherEnd, t(k), frame.duration) * s, COLORS.modal, 1, [3, 2]);
      chart.line(c, points, t, (k) => at(frame.otherMass, t(k), frame.duration) * s, COLORS.modal, 1);
    }
    chart.line(c, points, t, (k) => waves.end(t(k)) * s, '#4f9bd8', 1.8);
    chart.line(c, points, t, (k) => waves.mass(t(k)) * s, COLORS.waves, 2);
    c.restore();
    const ghosts = !frame.ghost ? [] : frame.target.held ? [['ghost', 'line ghost']] : [['ghost', 'line ghost'], ['ghost of target', 'line dots']];
    chart.key([['impactor', 'line waves'], ['face', 'line end'], ...(frame.other ? [[naming(frame.other.name), 'line modal']] : []), ...ghosts]);
  }
  ghost(t) { return (this.frame.ghost?.impactor ?? 0) * t; }
  cursor(t) {
    const { chart, scale } = this;
    if (!chart.box) return;
    const c = chart.cursor(t), s = scale * this.unit[0], [waves] = this.fields;
    chart.dot(c, t, waves.end(t) * s, '#4f9bd8');
    chart.dot(c, t, waves.mass(t) * s, COLORS.waves);
    chart.value.textContent = `mass ${figures(waves.mass(t) * s)}   end ${figures(waves.end(t) * s)} ${this.unit[1]}`;
  }
}
