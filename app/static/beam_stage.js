// The stage of a struck beam: the beam bending, and under it the engineer's diagrams of shear force and moment.
import { cleared, COLORS, css } from './plot.js';
import { between } from './beam_field.js';

const DIAGRAMS = [['shear', 'Shear force V', 'N'], ['moment', 'Bending moment M', 'N m']];
const UNITS = { moment: 'MPa', velocity: 'm/s', shear: 'N', deflection: 'mm' };

const FORMATS = {}; // made once for each number of digits: to make one takes longer than to use it
const formatOf = (digits) => (FORMATS[digits] ??= new Intl.NumberFormat('en', { maximumSignificantDigits: digits, useGrouping: false }));
export const figures = (value, digits = 3) => (Math.abs(value) < 1e-12 ? '0' : formatOf(digits).format(value).replace('-', '−'));
// A scale for numbers of this size: factor and prefix of the unit.
export const prefixed = (size) => (size >= 2e6 ? [1e-6, 'M'] : size >= 2e3 ? [1e-3, 'k'] : size < 0.5 && size > 0 ? [1e3, 'm'] : [1, '']);

export class BeamStage {
  constructor() {
    this.root = document.createElement('section');
    this.root.className = 'stage beam';
    this.canvas = document.createElement('canvas');
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'the beam bending under the blow, and the shear force and bending moment along it');
    this.root.append(this.canvas);
  }
  load(frame, field, what) {
    Object.assign(this, { frame, field, what });
    const lasting = frame.contacts.at(-1)?.[1] ?? frame.duration; // the impactor counts until it has gone
    let reach = field.largest.deflection;
    for (let k = 0; k < frame.time.length; k++) if (frame.time[k] <= lasting || lasting === 0) reach = Math.max(reach, Math.abs(frame.impactorPath[k]));
    const wanted = 0.13 * frame.beam.length / reach, power = 10 ** Math.floor(Math.log10(wanted));
    this.factor = power * [5, 2, 1].find((f) => f * power <= wanted);
    this.reach = reach;
    // of both signs alike, so that the zero line stays
    this.scales = { shear: field.usual.shear * 1.25, moment: field.largest.moment * 1.2 };
    this.stressUnit = frame.beam.halfDepth / frame.beam.secondMoment / 1e6;
  }
  draw(t) {
    const { canvas, frame, root } = this;
    if (!frame) return;
    const sheet = cleared(canvas, root);
    if (!sheet) return;
    const { c, width, height } = sheet;
    const narrow = width < 560, margin = narrow ? 30 : 64, top = 0.56 * height;
    Object.assign(this, { width, narrow, left: margin, long: width - 2 * margin, middle: 0.62 * top });
    this.scale = Math.min(this.factor * this.long / frame.beam.length, 0.36 * top / this.reach);
    this.thick = Math.min(Math.max(2 * frame.beam.halfDepth / frame.beam.length * this.long, 5), 0.1 * top);
    this.values = this.field.profile(t, this.what);
    this.moved = this.field.profile(t, 'deflection');
    this.grid(c, 0, height);
    this.impactor(c, t);
    this.beam(c);
    this.ghost(c, t);
    this.supports(c);
    this.touch(c, t);
    this.words(c, top);
    DIAGRAMS.forEach(([name, label, unit], k) => this.diagram(c, t, name, label, unit, top + k * (height - top) / 2, (height - top) / 2));
  }
  px(j) { return this.left + j / (this.field.places - 1) * this.long; }
  get struck() { return this.left + this.frame.beam.place / this.frame.beam.length * this.long; }
  line(c) {
    c.beginPath();
    for (let j = 0; j < this.field.places; j++) c.lineTo(this.px(j), this.middle + this.moved[j] * this.scale);
  }
  grid(c, top, bottom) { // the struck place, through all three pictures
    c.strokeStyle = COLORS.grid;
    c.lineWidth = 1;
    c.setLineDash([3, 4]);
    c.beginPath(); c.moveTo(this.struck, top + this.middle); c.lineTo(this.struck, bottom - 4); c.stroke();
    c.setLineDash([]);
  }
  // The outer fibres in the colours of their stress, which is opposite above and below.
  beam(c) {
    const { field, frame, thick, middle, scale, what } = this, half = thick / 2, largest = field.usual[what], last = field.places - 1;
    for (const [above, below, sign] of what === 'moment' ? [[-half, 0, -1], [0, half, 1]] : [[-half, half, 1]]) {
      const colours = c.createLinearGradient(this.left, 0, this.left + this.long, 0);
      for (let j = 0; j <= last; j++) colours.addColorStop(j / last, css(sign * this.values[j], largest));
      c.fillStyle = colours;
      c.beginPath();
      for (let j = 0; j <= last; j++) c.lineTo(this.px(j), middle + this.moved[j] * scale + above);
      for (let j = last; j >= 0; j--) c.lineTo(this.px(j), middle + this.moved[j] * scale + below);
      c.fill();
    }
    c.strokeStyle = '#4a5968';
    c.lineWidth = 1.1;
    for (const side of [-half, half]) {
      c.beginPath();
      for (let j = 0; j < field.places; j++) c.lineTo(this.px(j), middle + this.moved[j] * scale + side);
      c.stroke();
    }
    const ends = [0, field.places - 1].map((j) => [this.px(j), middle + this.moved[j] * scale]);
    for (const [x, y] of ends) { c.beginPath(); c.moveTo(x, y - half); c.lineTo(x, y + half); c.stroke(); }
    if (frame.beam.endMass) {
      const [x, y] = ends[1], size = Math.min(Math.max(3 * thick, 16), 34);
      c.fillStyle = '#3b4a59';
      c.beginPath(); c.roundRect(x - size * 0.2, y - size / 2, size, size, 4); c.fill();
    }
  }
  supports(c) {
    const { frame, thick, middle } = this, [first, second] = { cantilever: ['clamp'], 'pinned-pinned': ['pin', 'roller'], 'clamped-clamped': ['clamp', 'clamp'], 'free-free': [], 'pinned-free': ['pin'] }[frame.beam.support];
    const last = this.field.places - 1;
    if (first) this[first](c, this.px(0), middle, thick, -1);
    if (second) this[second](c, this.px(last), middle, thick, 1);
  }
  clamp(c, x, y, thick, way) {
    const tall = Math.max(1.3 * thick, 22);
    c.fillStyle = '#55636f';
    c.fillRect(way < 0 ? x - 5 : x, y - tall, 5, 2 * tall);
    c.strokeStyle = '#8a97a3';
    c.lineWidth = 1;
    c.beginPath();
    for (let s = -tall; s < tall; s += 8) { c.moveTo(x + 5 * way, y + s + 8); c.lineTo(x + 16 * way, y + s); }
    c.stroke();
  }
  pin(c, x, y, thick, way, rolls = false) {
    const top = y + thick / 2, base = top + 15;
    c.fillStyle = '#d4dce4';
    c.strokeStyle = '#55636f';
    c.lineWidth = 1.3;
    c.beginPath(); c.moveTo(x, top); c.lineTo(x - 9, base); c.lineTo(x + 9, base); c.closePath(); c.fill(); c.stroke();
    const floor = rolls ? base + 7 : base;
    if (rolls) for (const dx of [-5, 5]) { c.beginPath(); c.arc(x + dx, base + 3.5, 3, 0, 7); c.stroke(); }
    c.beginPath(); c.moveTo(x - 16, floor); c.lineTo(x + 16, floor);
    for (let s = -12; s <= 16; s += 7) { c.moveTo(x + s, floor); c.lineTo(x + s - 6, floor + 6); }
    c.stroke();
  }
  roller(c, x, y, thick, way) { this.pin(c, x, y, thick, way, true); }
  // The bending that the same deflection would have at rest, at the height of the quasi-static estimate.
  ghost(c, t) {
    const { frame } = this;
    if (!frame.staticShape || !frame.staticPath) return;
    const size = between(frame.staticTime, frame.staticPath, t) * this.scale;
    c.strokeStyle = COLORS.ghost;
    c.lineWidth = 1.4;
    c.setLineDash([5, 4]);
    c.beginPath();
    for (let j = 0; j < this.field.places; j++) c.lineTo(this.px(j), this.middle + frame.staticShape[j] * size);
    c.stroke();
    c.setLineDash([]);
  }
  get face() { return this.middle - this.thick / 2; }
  impactor(c, t) {
    const { frame } = this, { impactor } = frame, x = this.struck;
    const y = this.face + between(frame.time, frame.impactorPath, t) * this.scale;
    const size = Math.min(Math.max(44 * (impactor.mass / frame.beam.mass) ** (1 / 6), 18), 56);
    const fill = c.createLinearGradient(0, y - size, 0, y);
    fill.addColorStop(0, '#5d6c7b');
    fill.addColorStop(1, '#2b3846');
    c.fillStyle = fill;
    c.beginPath();
    if (impactor.kind === 'sphere') c.arc(x, y - size / 2, size / 2, 0, 7);
    else if (impactor.kind === 'rod') c.roundRect(x - size / 5, y - 1.9 * size, 0.4 * size, 1.9 * size, 2);
    else if (impactor.kind === 'beam') { c.roundRect(x - size / 2, y - size / 2, size, size / 2, 2); }
    else c.roundRect(x - size / 2, y - size, size, size, 5);
    c.fill();
    if (impactor.kind === 'beam') { c.fillStyle = COLORS.faint; c.font = '11px system-ui, sans-serif'; c.textAlign = 'center'; c.textBaseline = 'bottom'; c.fillText('beam, seen from its end', x, y - size / 2 - 3); }
    this.hit = [x, y, size];
  }
  touching(t) { return this.frame.contacts.some(([a, b]) => t >= a && t <= b); }
  touch(c, t) {
    if (!this.touching(t)) return;
    const [x, y, size] = this.hit;
    c.fillStyle = COLORS.cursor;
    c.fillRect(x - size / 2 - 5, y - 1.5, size + 10, 3);
  }
  words(c, top) {
    const { frame, narrow, width } = this, say = (text, x, y, align) => { c.textAlign = align; c.fillText(text, x, y); };
    c.fillStyle = COLORS.faint;
    c.font = '12px system-ui, sans-serif';
    c.textBaseline = 'alphabetic';
    const factor = this.scale * frame.beam.length / this.long;
    say(`movement drawn × ${figures(factor, 2)}`, 12, 18, 'left');
    if (frame.staticShape && frame.staticPath && !narrow) say('dashed: bent as at rest, by the quasi-static estimate', 12, top - 8, 'left');
    // away from the impactor, which flies back over the struck place
    const bar = 130, x = frame.beam.place > 0.6 * frame.beam.length ? (narrow ? this.left : 0.3 * width) : width - bar - 14, y = narrow && x < 0.5 * width ? 44 : 22, unit = this.what === 'moment' ? this.stressUnit : this.what === 'deflection' ? 1e3 : 1;
    const largest = this.field.usual[this.what] * unit, [factorOf, prefix] = this.what === 'shear' ? prefixed(largest) : [1, ''];
    const colours = c.createLinearGradient(x, 0, x + bar, 0);
    for (let k = 0; k <= 6; k++) colours.addColorStop(k / 6, css(k / 3 - 1, 1));
    c.fillStyle = colours;
    c.fillRect(x, y, bar, 6);
    c.fillStyle = COLORS.faint;
    c.font = '11px system-ui, sans-serif';
    const [low, high] = { moment: ['tension', 'compression'], velocity: ['back', 'forward'], shear: ['−', '+'], deflection: ['back', 'forward'] }[this.what];
    say(low, x, y - 4, 'left');
    say(high, x + bar, y - 4, 'right');
    say(`± ${figures(largest * factorOf)} ${prefix}${UNITS[this.what]}`, x + bar, y + 18, 'right');
  }
  // Value along the beam on a scale that stays the same over the whole blow.
  diagram(c, t, name, label, unit, top, height) {
    const values = name === this.what ? this.values : this.field.profile(t, name), most = this.scales[name], zero = top + 0.54 * height, reach = 0.32 * height / most;
    const [factor, prefix] = prefixed(most), at = (j) => zero - Math.min(Math.max(values[j] * reach, -0.42 * height), 0.42 * height);
    const last = this.field.places - 1;
    c.fillStyle = name === 'moment' ? 'rgba(222,105,62,.30)' : 'rgba(66,133,200,.30)';
    c.beginPath();
    c.moveTo(this.px(0), zero);
    for (let j = 0; j <= last; j++) c.lineTo(this.px(j), at(j));
    c.lineTo(this.px(last), zero);
    c.fill();
    c.strokeStyle = name === 'moment' ? '#b4481f' : COLORS.waves;
    c.lineWidth = 1.6;
    c.beginPath();
    for (let j = 0; j <= last; j++) c.lineTo(this.px(j), at(j));
    c.stroke();
    c.strokeStyle = '#b9c4cf';
    c.lineWidth = 1;
    c.beginPath();
    c.moveTo(this.left, zero); c.lineTo(this.left + this.long, zero);
    for (const side of [-1, 1]) { c.moveTo(this.left - 4, zero + side * most * reach); c.lineTo(this.left, zero + side * most * reach); }
    c.stroke();
    c.fillStyle = COLORS.faint;
    c.font = '11px system-ui, sans-serif';
    c.textBaseline = 'middle';
    c.textAlign = 'right';
    for (const side of this.narrow ? [] : [-1, 0, 1]) c.fillText(figures(-side * most * factor, 2), this.left - 8, zero + side * most * reach);
    c.textBaseline = 'top';
    c.textAlign = 'left';
    c.fillText(`${label}, ${prefix}${unit}${this.narrow ? ` (± ${figures(most * factor, 2)})` : ''}`, this.narrow ? 12 : this.left + 4, top + 3);
    let peak = 0;
    for (let j = 0; j <= last; j++) if (Math.abs(values[j]) > Math.abs(values[peak])) peak = j;
    c.textAlign = 'right';
    c.fillStyle = COLORS.cursor;
    c.fillText(`${figures(values[peak] * factor)} ${prefix}${unit} at ${figures(peak / last, 2)} L`, this.left + this.long, top + 3);
  }
}
