// Draws like a canvas and writes SVG: what charts use of a canvas, and no more.

/** @param {number} value */
const short = (value) => String(Number(value.toFixed(2)));
/** @param {unknown} text */
const escaped = (text) => String(text).replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

/** @param {Record<string, string | number>} attributes */
const written = (attributes) =>
  Object.entries(attributes)
    .map(([name, value]) => ` ${name}="${escaped(typeof value === 'number' ? short(value) : value)}"`)
    .join('');

const ANCHORS = { left: 'start', center: 'middle', right: 'end' };
const RISES = { alphabetic: 0, middle: 0.36, top: 0.9, bottom: -0.2 }; // of the height of the letters

export class SvgContext {
  fillStyle = '#000';
  strokeStyle = '#000';
  lineWidth = 1;
  lineJoin = 'miter';
  font = '10px sans-serif';
  /** @type {keyof typeof ANCHORS} */ textAlign = 'left';
  /** @type {keyof typeof RISES} */ textBaseline = 'alphabetic';
  imageSmoothingEnabled = true;
  /** @type {string[]} */ #parts = [];
  /** @type {number[]} */ #dash = [];
  /** @type {number[]} */ #open = []; // groups that each save() has to close
  #path = '';
  #clips = 0;

  /**
   * @param {number} width
   * @param {number} height
   */
  constructor(width, height) {
    this.size = { width, height };
  }

  save() {
    this.#open.push(0);
  }

  restore() {
    this.#parts.push('</g>'.repeat(this.#open.pop() ?? 0));
  }

  /** @param {Record<string, string>} attributes */
  #group(attributes) {
    this.#parts.push(`<g${written(attributes)}>`);
    if (this.#open.length) this.#open[this.#open.length - 1] += 1;
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  translate(x, y) {
    this.#group({ transform: `translate(${short(x)} ${short(y)})` });
  }

  clip() {
    const id = `clip${++this.#clips}`;
    this.#parts.push(`<clipPath id="${id}"><path d="${this.#path}"/></clipPath>`);
    this.#group({ 'clip-path': `url(#${id})` });
  }

  beginPath() {
    this.#path = '';
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  moveTo(x, y) {
    this.#path += `M${short(x)} ${short(y)}`;
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  lineTo(x, y) {
    this.#path += `${this.#path ? 'L' : 'M'}${short(x)} ${short(y)}`;
  }

  /**
   * A full circle: charts draw no other arcs.
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   */
  arc(x, y, radius) {
    const turn = `a${short(radius)} ${short(radius)} 0 1 0 `;
    this.#path += `M${short(x - radius)} ${short(y)}${turn}${short(2 * radius)} 0${turn}${short(-2 * radius)} 0`;
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} w
   * @param {number} h
   */
  rect(x, y, w, h) {
    this.#path += `M${short(x)} ${short(y)}h${short(w)}v${short(h)}h${short(-w)}z`;
  }

  /** @param {number[]} dash */
  setLineDash(dash) {
    this.#dash = dash;
  }

  stroke() {
    if (!this.#path) return;
    /** @type {Record<string, string>} */
    const dash = this.#dash.length ? { 'stroke-dasharray': this.#dash.join(' ') } : {};
    const join = { 'stroke-width': this.lineWidth, 'stroke-linejoin': this.lineJoin, ...dash };
    this.#parts.push(`<path${written({ d: this.#path, fill: 'none', stroke: this.strokeStyle, ...join })}/>`);
  }

  fill() {
    if (this.#path) this.#parts.push(`<path${written({ d: this.#path, fill: this.fillStyle })}/>`);
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} width
   * @param {number} height
   */
  fillRect(x, y, width, height) {
    this.#parts.push(`<rect${written({ x, y, width, height, fill: this.fillStyle })}/>`);
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} w
   * @param {number} h
   */
  strokeRect(x, y, w, h) {
    this.beginPath();
    this.rect(x, y, w, h);
    this.stroke();
  }

  /**
   * @param {string} text
   * @param {number} x
   * @param {number} y
   */
  fillText(text, x, y) {
    const [, weight = 'normal', size, family] = this.font.match(/^(?:(bold) )?([\d.]+)px (.*)$/) ?? [
      '',
      '',
      '10',
      'sans-serif',
    ];
    const place = { x, y: y + RISES[this.textBaseline] * Number(size), 'text-anchor': ANCHORS[this.textAlign] };
    const type = { 'font-size': size, 'font-family': family, 'font-weight': weight, fill: this.fillStyle };
    this.#parts.push(`<text${written({ ...place, ...type })}>${escaped(text)}</text>`);
  }

  /**
   * Part of a canvas.
   * @param {HTMLCanvasElement} image
   * @param {[sx: number, sy: number, sw: number, sh: number, x: number, y: number, w: number, h: number]} places
   */
  drawImage(image, ...[sx, sy, sw, sh, x, y, width, height]) {
    const part = Object.assign(document.createElement('canvas'), { width: Math.ceil(sw), height: Math.ceil(sh) });
    part.getContext('2d')?.drawImage(image, sx, sy, sw, sh, 0, 0, part.width, part.height);
    const place = written({ x, y, width, height, preserveAspectRatio: 'none', href: part.toDataURL() });
    this.#parts.push(`<image${place}/>`);
  }

  toString() {
    const { width, height } = this.size;
    const size = written({ width, height, viewBox: `0 0 ${width} ${height}` });
    return `<svg xmlns="http://www.w3.org/2000/svg"${size}>${this.#parts.join('')}</svg>`;
  }
}
