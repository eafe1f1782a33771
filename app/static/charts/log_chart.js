// Charts whose two axes are logarithmic, with their names.
import { decade } from '../text/format.js';
import { scale } from './canvas.js';
import { FONT, Plot } from './plot.js';
import { decades, logPlace } from './scale.js';
import { COLORS } from './styles.js';

const GRID = 'rgba(120,140,160,.22)';

export class LogChart extends Plot {
  margin = { left: 64 * scale, right: 12 * scale, top: 8, bottom: 40 * scale };
  gap = 0; // pixels beside the box for what has no place on a logarithmic axis

  /**
   * @param {string} title
   * @param {string} about
   * @param {[across: string, up: string]} named  the axes
   */
  constructor(title, about, named) {
    super(title, about);
    this.named = named;
  }

  /** @param {number} x */
  px(x) {
    const { x: left, w } = this.frame;
    return left + logPlace(x, this.x) * w;
  }

  /** @param {number} y */
  py(y) {
    return this.frame.y + (1 - logPlace(y, this.y)) * this.frame.h;
  }

  /**
   * Values under a pointer, and its place as shares of the box.
   * @param {{ clientX: number, clientY: number }} event
   * @returns {[x: number, y: number, across: number, up: number]}
   */
  under(event) {
    const [u, w] = this.place(event);
    const [low, high] = this.x;
    return [low * (high / low) ** u, this.y[0] * (this.y[1] / this.y[0]) ** w, u, w];
  }

  /** @param {CanvasRenderingContext2D} c */
  axes(c) {
    const { x: left, y: top, w, h } = this.frame;
    c.font = FONT;
    c.lineWidth = 1;
    c.fillStyle = COLORS.faint;
    c.strokeStyle = GRID;
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    c.beginPath();
    for (const power of decades(this.y, h / (26 * scale))) {
      const y = Math.round(this.py(10 ** power)) + 0.5;
      c.moveTo(left, y);
      c.lineTo(left + w, y);
      c.fillText(decade(power), left - this.gap - 6, y);
    }
    c.textAlign = 'center';
    c.textBaseline = 'top';
    for (const power of decades(this.x, w / (54 * scale))) {
      const x = Math.round(this.px(10 ** power)) + 0.5;
      c.moveTo(x, top);
      c.lineTo(x, top + h);
      c.fillText(decade(power), this.gap && x - left < this.gap ? x + 6 : x, top + h + 5);
    }
    c.stroke();
    c.strokeStyle = COLORS.edge;
    c.strokeRect(left + 0.5, top + 0.5, w - 1, h - 1);
    this.#names(c);
  }

  /** @param {CanvasRenderingContext2D} c */
  #names(c) {
    const { x, y, w, h } = this.frame;
    c.fillStyle = COLORS.ink;
    c.fillText(this.named[0], x + w / 2, y + h + 22 * scale);
    c.save();
    c.translate(11 * scale, y + h / 2);
    c.rotate(-Math.PI / 2);
    c.textBaseline = 'middle';
    c.fillText(this.named[1], 0, 0);
    c.restore();
  }
}
