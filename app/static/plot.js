// Small plotting kit on two canvases: what changes with a solve below, what moves with time above.

export const COLORS = {
  ink: '#1c2733', faint: '#66788a', grid: '#e3e9ef', panel: '#ffffff',
  waves: '#0b4f8a', modal: '#d9730d', raw: 'rgba(217,115,13,.30)', ghost: '#8b95a1', cursor: '#c81e4a', contact: 'rgba(11,79,138,.09)', record: '#2e7d4f',
};

// Diverging colours: tension blue, rest almost white, compression red.
const STOPS = [[12, 58, 120], [66, 133, 200], [186, 215, 236], [246, 247, 248], [250, 205, 176], [222, 105, 62], [138, 24, 30]];
const PALETTE = new Uint8ClampedArray(3 * 257);
for (let i = 0; i <= 256; i++) {
  const place = i / 256 * (STOPS.length - 1), k = Math.min(Math.floor(place), STOPS.length - 2);
  for (let c = 0; c < 3; c++) PALETTE[3 * i + c] = STOPS[k][c] + (place - k) * (STOPS[k + 1][c] - STOPS[k][c]);
}
export function shade(value, largest) {
  return 3 * Math.round(128 + 128 * Math.min(Math.max(value / largest, -1), 1));
}
export const palette = PALETTE;
export const css = (value, largest) => {
  const k = shade(value, largest);
  return `rgb(${PALETTE[k]},${PALETTE[k + 1]},${PALETTE[k + 2]})`;
};

export function ticks(low, high, about) {
  const rough = (high - low) / Math.max(about, 1), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((f) => f * power >= rough * 0.999);
  const found = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + step * 1e-9; v += step) found.push(Math.abs(v) < step * 1e-9 ? 0 : v);
  return { found, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

// Width and height of an element, read anew only once it has changed: to read them the browser must lay out the page.
const sizes = new WeakMap();
const resized = new ResizeObserver((entries) => { for (const { target } of entries) sizes.set(target, null); });
export function sizeOf(root) {
  if (!sizes.has(root)) resized.observe(root);
  const known = sizes.get(root);
  if (known) return known;
  const size = [root.clientWidth, root.clientHeight];
  sizes.set(root, size[0] && size[1] ? size : null);
  return size;
}

// A canvas as large as its element, wiped: what to draw with, and the size in pixels of the page; null while hidden.
export function cleared(canvas, root) {
  const [width, height] = sizeOf(root), ratio = window.devicePixelRatio || 1;
  if (!width || !height) return null;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const c = canvas.getContext('2d');
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, width, height);
  return { c, width, height };
}

const element = (tag, name) => Object.assign(document.createElement(tag), { className: name });

export class Chart {
  constructor(title, unit, about) {
    this.root = element('section', 'chart');
    this.head = element('header', 'chart-head');
    const heading = element('h2', '');
    heading.textContent = title;
    this.unit = element('span', 'unit');
    this.unit.textContent = unit;
    this.legend = element('span', 'legend');
    this.value = element('output', 'readout');
    this.head.append(heading, this.unit, this.legend, this.value);
    this.area = element('div', 'chart-area');
    this.below = element('canvas', '');
    this.above = element('canvas', 'above');
    this.below.setAttribute('role', 'img');
    this.below.setAttribute('aria-label', about);
    this.area.append(this.below, this.above);
    this.root.append(this.head, this.area);
    this.margin = { left: 46, right: 10, top: 6, bottom: 20 };
    this.x = [0, 1];
    this.y = [0, 1];
  }
  // Returns false while the chart has no size.
  fit() {
    const [width, height] = sizeOf(this.area), ratio = window.devicePixelRatio || 1;
    if (!width || !height) return false;
    for (const canvas of [this.below, this.above]) {
      if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
        canvas.width = Math.round(width * ratio);
        canvas.height = Math.round(height * ratio);
      }
    }
    this.ratio = ratio;
    this.width = width;
    this.height = height;
    this.box = { x: this.margin.left, y: this.margin.top, w: width - this.margin.left - this.margin.right, h: height - this.margin.top - this.margin.bottom };
    return true;
  }
  px(x) { return this.box.x + (x - this.x[0]) / (this.x[1] - this.x[0]) * this.box.w; }
  py(y) { return this.box.y + (this.y[1] - y) / (this.y[1] - this.y[0]) * this.box.h; }
  time(clientX) {
    const place = (clientX - this.area.getBoundingClientRect().left - this.box.x) / this.box.w;
    return this.x[0] + Math.min(Math.max(place, 0), 1) * (this.x[1] - this.x[0]);
  }
  begin(layer) {
    const context = layer.getContext('2d');
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    return context;
  }
  axes(c, { gridX = true, labelX = true } = {}) {
    const { box } = this;
    c.font = '11px system-ui, sans-serif';
    c.lineWidth = 1;
    c.fillStyle = COLORS.faint;
    c.strokeStyle = COLORS.grid;
    const vertical = ticks(this.y[0], this.y[1], box.h / 34);
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const v of vertical.found) {
      const y = Math.round(this.py(v)) + 0.5;
      c.beginPath(); c.moveTo(box.x, y); c.lineTo(box.x + box.w, y); c.stroke();
      c.fillText(this.label ? this.label(v, vertical.digits) : v.toFixed(vertical.digits), box.x - 6, y);
    }
    const across = ticks(this.x[0], this.x[1], box.w / 70);
    c.textAlign = 'center';
    c.textBaseline = 'top';
    for (const v of across.found) {
      const x = Math.round(this.px(v)) + 0.5;
      if (gridX) { c.beginPath(); c.moveTo(x, box.y); c.lineTo(x, box.y + box.h); c.stroke(); }
      if (labelX) c.fillText(v.toFixed(across.digits), Math.min(x, this.width - 14), box.y + box.h + 5);
    }
    c.strokeStyle = '#b9c4cf';
    c.strokeRect(box.x + 0.5, box.y + 0.5, box.w - 1, box.h - 1);
  }
  clip(c) {
    c.save();
    c.beginPath();
    c.rect(this.box.x, this.box.y, this.box.w, this.box.h);
    c.clip();
  }
  // A line through (x(k), y(k)); keeps the extremes of each pixel column, so that thousands of points cost little.
  line(c, count, x, y, color, width = 1.6, dash = []) {
    const { box } = this, across = box.w / (this.x[1] - this.x[0]), up = box.h / (this.y[1] - this.y[0]);
    c.strokeStyle = color;
    c.lineWidth = width;
    c.lineJoin = 'round';
    c.setLineDash(dash);
    c.beginPath();
    let column = NaN, low = 0, high = 0, last = 0, started = false;
    for (let k = 0; k < count; k++) {
      const t = x(k);
      if (k + 1 < count && x(k + 1) < this.x[0]) continue;
      const px = box.x + (t - this.x[0]) * across, py = box.y + (this.y[1] - y(k)) * up, here = Math.round(px * 2);
      if (here !== column) {
        if (started && low !== high) { c.lineTo(column / 2, low); c.lineTo(column / 2, high); c.lineTo(column / 2, last); }
        if (started) c.lineTo(px, py); else c.moveTo(px, py);
        started = true;
        column = here; low = high = py;
      } else { low = Math.min(low, py); high = Math.max(high, py); }
      last = py;
      if (t > this.x[1]) break;
    }
    if (started && low !== high) { c.lineTo(column / 2, low); c.lineTo(column / 2, high); c.lineTo(column / 2, last); }
    c.stroke();
    c.setLineDash([]);
  }
  cursor(t) {
    const c = this.begin(this.above), x = this.px(t);
    if (t < this.x[0] || t > this.x[1]) return c;
    c.strokeStyle = COLORS.cursor;
    c.lineWidth = 1.4;
    c.beginPath(); c.moveTo(x, this.box.y); c.lineTo(x, this.box.y + this.box.h); c.stroke();
    return c;
  }
  dot(c, t, y, color) {
    if (t < this.x[0] || t > this.x[1] || !Number.isFinite(y)) return;
    c.fillStyle = color;
    c.strokeStyle = '#fff';
    c.lineWidth = 1.5;
    c.beginPath(); c.arc(this.px(t), this.py(y), 4, 0, 7); c.fill(); c.stroke();
  }
  circle(c, t, y, color) {
    if (t < this.x[0] || t > this.x[1]) return;
    c.strokeStyle = color;
    c.lineWidth = 1.2;
    c.beginPath(); c.arc(this.px(t), this.py(y), 3, 0, 7); c.stroke();
  }
  key(entries) {
    const said = entries.join('|');
    if (said === this.said) return;
    this.said = said;
    this.legend.replaceChildren(...entries.map(([text, style]) => {
      const item = element('span', 'key'), mark = element('i', style);
      item.append(mark, text);
      return item;
    }));
  }
}
