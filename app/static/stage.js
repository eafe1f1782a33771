// The stage: the bodies themselves, movement exaggerated by a stated factor.
import { cleared, COLORS, css } from './plot.js';

const SLICES = 241;

export class Stage {
  constructor() {
    this.root = document.createElement('section');
    this.root.className = 'stage';
    this.canvas = document.createElement('canvas');
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'the rod and the mass, coloured by stress or velocity');
    this.root.append(this.canvas);
    this.values = new Float64Array(SLICES);
    this.moved = new Float64Array(SLICES);
  }
  load(frame, field, what, largest) {
    Object.assign(this, { frame, field, what, largest });
    // the largest movement of the blow fills a tenth of the picture; the factor is rounded to 1, 2 or 5
    let reach = 1e-12;
    for (let k = 0; k <= 200; k++) {
      const t = k / 200 * frame.duration;
      reach = Math.max(reach, Math.abs(field.mass(t)), Math.abs(field.end(t)));
    }
    this.span = field.to - field.from || reach * frame.speed * frame.trip * 4; // length drawn [m]
    const real = reach * frame.speed * frame.trip / this.span; // as a fraction of what is drawn
    const wanted = 0.16 / real, power = 10 ** Math.floor(Math.log10(wanted));
    this.factor = power * [5, 2, 1].find((f) => f * power <= wanted);
    this.stretch = this.factor * frame.speed * frame.trip / this.span;
  }
  draw(t) {
    const { canvas, frame } = this;
    if (!frame) return;
    const sheet = cleared(canvas, this.root);
    if (!sheet) return;
    const { c, width, height } = sheet;
    const narrow = width < 560, { rods, target } = frame, rodStrikes = frame.impactor.kind === 'rod';
    const left = rodStrikes ? 40 : (narrow ? 0.25 : 0.21) * width, right = target.held ? width - 30 : width * (rodStrikes ? 0.86 : 0.82);
    const length = right - left, middle = height * 0.47, thick = Math.min(height * 0.3, 56);
    const scale = this.stretch * length;
    let start = left;
    if (rods.length) {
      this.field.profile(t, this.what, this.values);
      this.field.profile(t, 'displacement', this.moved);
      start = this.rods(c, left, length, middle, thick, scale);
      if (target.support === 'fixed') this.wall(c, right, middle, thick);
      if (target.support === 'anechoic') this.onward(c, right, middle, thick);
      if (target.endMass) this.endMass(c, right + this.moved[SLICES - 1] * scale, middle, thick);
    } else {
      start = 0.45 * width;
      this.compact(c, start, middle, thick, scale, t, width);
    }
    if (frame.impactor.kind === 'pulse') this.push(c, start, middle, thick, t);
    else if (!rodStrikes) this.mass(c, start, middle, scale, t, height, width);
    else this.touch(c, left + length * -this.field.from / this.span, middle, thick, scale, t);
    if (rods.length === 1 && rods[0].mirror) this.front(c, t, left, length, middle - thick / 2, thick);
    c.fillStyle = COLORS.faint;
    c.font = '12px system-ui, sans-serif';
    c.textBaseline = 'alphabetic';
    c.textAlign = 'left';
    c.fillText(`movement drawn × ${this.factor >= 1 ? this.factor.toLocaleString('en') : this.factor.toPrecision(1)}`, 12, height - 10);
    if (rods.length) this.scaleBar(c, width, height);
  }
  // Every rod slice by slice, its height by the side of its section; returns where the struck face is at rest.
  rods(c, left, length, middle, thick, scale) {
    const { frame, field } = this, widest = Math.max(...frame.rods.map((rod) => rod.area));
    const place = (x) => left + (x - field.from) / this.span * length;
    frame.rods.forEach((rod, number) => {
      const tall = thick * Math.max(Math.sqrt(rod.area / widest), 0.18), top = middle - tall / 2;
      // a hair inside, as at a joint that has opened the field jumps
      const inside = (rod.to - rod.from) * 1e-6, slot = (x) => (x - field.from) / this.span * (SLICES - 1);
      const first = Math.ceil(slot(rod.from + inside)), last = Math.max(Math.floor(slot(rod.to - inside)), first);
      const ends = [place(rod.from) + this.moved[first] * scale, place(rod.to) + this.moved[last] * scale];
      for (let i = first; i <= last; i++) {
        const x = (k) => (k <= first ? ends[0] : k >= last ? ends[1] : left + k / (SLICES - 1) * length + this.moved[k] * scale);
        if (i === last && i > first) continue;
        c.fillStyle = css(first === last ? this.values[first] : 0.5 * (this.values[i] + this.values[i + 1]), this.largest);
        c.fillRect(x(i), top, first === last ? ends[1] - ends[0] : x(i + 1) - x(i) + 0.7, tall);
      }
      c.strokeStyle = '#4a5968';
      c.lineWidth = 1.2;
      c.strokeRect(ends[0], top, ends[1] - ends[0], tall);
      c.strokeStyle = 'rgba(28,39,51,.28)'; // rings painted on the rods, evenly spaced before the blow
      c.beginPath();
      for (let k = 1; k < 24; k++) {
        const i = Math.round(k * (SLICES - 1) / (frame.rods.length > 1 ? 24 : 12));
        if (i <= first || i >= last) continue;
        const x = left + i / (SLICES - 1) * length + this.moved[i] * scale;
        c.moveTo(x, top); c.lineTo(x, top + tall);
      }
      c.stroke();
      if (number && rod.joint === 'bonded') { c.fillStyle = '#4a5968'; c.fillRect(ends[0] - 1, top - 3, 2, tall + 6); }
    });
    return place(0);
  }
  onward(c, x, middle, thick) { // a rod without end
    c.fillStyle = COLORS.faint;
    c.font = '18px system-ui, sans-serif';
    c.textAlign = 'left';
    c.textBaseline = 'middle';
    c.fillText('⋯ ∞', x - 2, middle + thick * 0.02);
  }
  endMass(c, x, middle, thick) {
    c.fillStyle = '#3b4a59';
    c.beginPath(); c.roundRect(x, middle - thick * 0.7, thick * 0.8, thick * 1.4, 5); c.fill();
  }
  // The prescribed force, as an arrow on the end while it acts.
  push(c, x, middle, thick, t) {
    if (!this.touching(t)) return;
    const at = x;
    c.strokeStyle = c.fillStyle = COLORS.cursor;
    c.lineWidth = 4;
    c.beginPath(); c.moveTo(at - 70, middle); c.lineTo(at - 14, middle); c.stroke();
    c.beginPath(); c.moveTo(at - 2, middle); c.lineTo(at - 18, middle - 9); c.lineTo(at - 18, middle + 9); c.fill();
    c.font = '12px system-ui, sans-serif';
    c.textAlign = 'center';
    c.fillText('force', at - 44, middle - thick * 0.3);
  }
  // A struck body in which no wave runs.
  compact(c, x, middle, thick, scale, t, width) {
    const { target } = this.frame, face = x + this.field.end(t) * scale, size = thick * 1.2;
    if (target.kind === 'stop') { this.wall(c, face, middle, thick); return; }
    c.fillStyle = '#8fb4d6';
    c.strokeStyle = '#4a5968';
    if (target.kind === 'half-space') {
      c.fillRect(face, middle - thick * 1.3, width - face, thick * 2.6);
      c.beginPath(); c.moveTo(face, middle - thick * 1.3); c.lineTo(face, middle + thick * 1.3); c.stroke();
      return;
    }
    c.beginPath(); c.roundRect(face, middle - size / 2, size, size, 5); c.fill(); c.stroke();
    if (target.kind === 'spring-mass') {
      const from = face + size, to = width - 30, turns = 14;
      c.beginPath(); c.moveTo(from, middle);
      for (let k = 1; k < turns; k++) c.lineTo(from + k / turns * (to - from), middle + (k % 2 ? -9 : 9));
      c.lineTo(to, middle); c.stroke();
      this.wall(c, to, middle, thick);
    }
  }
  touching(t) {
    const { frame, field } = this;
    return frame[field.omega || field.which === 'other' ? 'other' : 'exact'].contacts.some(([a, b]) => t >= a && t <= b);
  }
  // Where two rods press on each other.
  touch(c, x, middle, thick, scale, t) {
    if (!this.touching(t)) return;
    const at = x + this.field.end(t) * scale;
    c.fillStyle = COLORS.cursor;
    c.fillRect(at - 1.5, middle - thick / 2 - 8, 3, thick + 16);
  }
  wall(c, x, middle, thick) {
    const tall = thick * 0.95;
    c.fillStyle = '#55636f';
    c.fillRect(x, middle - tall, 5, 2 * tall);
    c.strokeStyle = '#8a97a3';
    c.beginPath();
    for (let y = middle - tall; y < middle + tall; y += 8) { c.moveTo(x + 5, y + 8); c.lineTo(x + 16, y); }
    c.stroke();
  }
  mass(c, left, middle, scale, t, height, width) {
    const { frame, field } = this;
    const size = Math.min(Math.max(52 * (frame.impactor.mass / frame.target.mass) ** (1 / 6), 22), 0.16 * width, height * 0.62);
    const shape = (face) => {
      c.beginPath();
      if (frame.impactor.kind === 'sphere') c.arc(face - size / 2, middle, size / 2, 0, 7);
      else c.roundRect(face - size, middle - size / 2, size, size, 5);
    };
    c.setLineDash([5, 4]);
    c.strokeStyle = COLORS.ghost;
    c.lineWidth = 1.5;
    shape(left + frame.ghost.impactor * t * scale);
    c.stroke();
    c.setLineDash([]);
    const face = left + field.mass(t) * scale;
    const fill = c.createLinearGradient(0, middle - size / 2, 0, middle + size / 2);
    fill.addColorStop(0, '#5d6c7b');
    fill.addColorStop(1, '#2b3846');
    shape(face);
    c.fillStyle = fill;
    c.fill();
    if (this.touching(t)) { c.fillStyle = COLORS.cursor; c.fillRect(face - 1.5, middle - size / 2 - 5, 3, size + 10); }
  }
  // Where the front that set out at first touch is now, and which way it runs.
  front(c, t, left, length, top, thick) {
    const trip = t - Math.floor(t), outward = trip < 0.5, place = outward ? 2 * trip : 2 - 2 * trip;
    const i = Math.round(place * (SLICES - 1)), x = left + place * length + this.moved[i] * this.stretch * length, y = top - 9, way = outward ? 1 : -1;
    c.fillStyle = COLORS.cursor;
    c.beginPath();
    c.moveTo(x, y + 6); c.lineTo(x - 5, y - 3); c.lineTo(x + 5, y - 3);
    c.fill();
    c.strokeStyle = COLORS.cursor;
    c.lineWidth = 1.6;
    c.beginPath();
    c.moveTo(x, y - 7); c.lineTo(x + 22 * way, y - 7); c.lineTo(x + 16 * way, y - 11); c.moveTo(x + 22 * way, y - 7); c.lineTo(x + 16 * way, y - 3);
    c.stroke();
    c.font = '11px system-ui, sans-serif';
    c.textAlign = outward ? 'right' : 'left';
    c.fillText(this.frame.chosen.law === 'rigid' ? 'front' : 'wave', x - 8 * way, y - 4);
  }
  scaleBar(c, width, height) {
    const bar = Math.min(150, width * 0.3), x = width - bar - 16, y = height - 22;
    const unit = this.what === 'stress' ? this.frame.stressUnit / 1e6 : this.frame.speed;
    const largest = this.largest * unit, show = (v) => (Math.abs(v) >= 10 ? v.toFixed(0) : v.toPrecision(2)).replace('-', '−');
    for (let k = 0; k < bar; k++) {
      c.fillStyle = css((k / bar * 2 - 1), 1);
      c.fillRect(x + k, y, 1.2, 7);
    }
    c.fillStyle = COLORS.faint;
    c.font = '11px system-ui, sans-serif';
    c.textAlign = 'left';
    const names = this.what === 'stress' ? ['tension', 'compression', 'MPa'] : ['back', 'forward', 'm/s'];
    c.fillText(`${show(-largest)} ${names[0]}`, x, y - 4);
    c.textAlign = 'right';
    c.fillText(`${names[1]} ${show(largest)} ${names[2]}`, x + bar, y + 18);
  }
}
