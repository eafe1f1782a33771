// The stage: the bodies themselves, movement exaggerated by a stated factor.
import { COLORS, css } from './plot.js';

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
    const real = reach * frame.speed * frame.trip / frame.length; // as a fraction of the length
    const wanted = 0.16 / real, power = 10 ** Math.floor(Math.log10(wanted));
    this.factor = power * [5, 2, 1].find((f) => f * power <= wanted);
    this.stretch = this.factor * frame.speed * frame.trip / frame.length;
  }
  draw(t) {
    const { canvas, frame } = this;
    if (!frame) return;
    const width = this.root.clientWidth, height = this.root.clientHeight, ratio = window.devicePixelRatio || 1;
    if (!width || !height) return;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const c = canvas.getContext('2d');
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    const narrow = width < 560, left = (narrow ? 0.25 : 0.21) * width, right = frame.fixed ? width - 30 : width * 0.82;
    const length = right - left, middle = height * 0.47, thick = Math.min(height * 0.3, 56), top = middle - thick / 2;
    const scale = this.stretch * length, field = this.field;
    field.profile(t, this.what, this.values);
    field.profile(t, 'displacement', this.moved);
    // the rod, slice by slice
    for (let i = 0; i < SLICES - 1; i++) {
      const a = left + i / (SLICES - 1) * length + this.moved[i] * scale;
      const b = left + (i + 1) / (SLICES - 1) * length + this.moved[i + 1] * scale;
      c.fillStyle = css(0.5 * (this.values[i] + this.values[i + 1]), this.largest);
      c.fillRect(a, top, b - a + 0.7, thick);
    }
    const start = left + this.moved[0] * scale, end = right + this.moved[SLICES - 1] * scale;
    c.strokeStyle = '#4a5968';
    c.lineWidth = 1.2;
    c.strokeRect(start, top, end - start, thick);
    // rings painted on the rod, evenly spaced before the blow
    c.strokeStyle = 'rgba(28,39,51,.28)';
    c.beginPath();
    for (let k = 1; k < 12; k++) {
      const i = k * (SLICES - 1) / 12, x = left + k / 12 * length + this.moved[i] * scale;
      c.moveTo(x, top); c.lineTo(x, top + thick);
    }
    c.stroke();
    if (frame.fixed) this.wall(c, right, middle, thick);
    this.mass(c, left, middle, scale, t, height, width);
    this.front(c, t, left, length, top, thick);
    c.fillStyle = COLORS.faint;
    c.font = '12px system-ui, sans-serif';
    c.textBaseline = 'alphabetic';
    c.textAlign = 'left';
    c.fillText(`movement drawn × ${this.factor >= 1 ? this.factor.toLocaleString('en') : this.factor.toPrecision(1)}`, 12, height - 10);
    this.scaleBar(c, width, height);
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
    const size = Math.min(Math.max(52 * (frame.impactorMass / frame.targetMass) ** (1 / 6), 22), 0.16 * width, height * 0.62);
    const shape = (face) => {
      c.beginPath();
      if (frame.sphere) c.arc(face - size / 2, middle, size / 2, 0, 7);
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
    const touching = frame[field.omega ? 'modal' : 'waves'].contacts.some(([a, b]) => t >= a && t <= b);
    if (touching) { c.fillStyle = COLORS.cursor; c.fillRect(face - 1.5, middle - size / 2 - 5, 3, size + 10); }
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
