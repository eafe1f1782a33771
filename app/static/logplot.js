// Charts whose two axes are logarithmic, with their names.
import { Chart, COLORS, ticks } from './plot.js';

const DIGITS = '⁰¹²³⁴⁵⁶⁷⁸⁹';
export const raised = (power) => `${power < 0 ? '⁻' : ''}${[...String(Math.abs(power))].map((d) => DIGITS[d]).join('')}`;
export const decade = (power) => (power >= -3 && power <= 3 ? String(Number((10 ** power).toPrecision(1))) : `10${raised(power)}`);
// A share as a percentage, 10^-2 as "1 %".
export const percentDecade = (power) => `${decade(power + 2)} %`;

export class LogChart extends Chart {
  constructor(title, about, named) {
    super(title, '', about);
    Object.assign(this, { named, across: decade, upward: decade });
    this.margin = { left: 64, right: 12, top: 8, bottom: 40 };
  }
  // `linear`: across; upward it is always logarithmic.
  px(x) {
    const [low, high] = this.x;
    return this.box.x + (this.linear ? (x - low) / (high - low) : Math.log(x / low) / Math.log(high / low)) * this.box.w;
  }
  py(y) { return this.box.y + this.box.h - Math.log(y / this.y[0]) / Math.log(this.y[1] / this.y[0]) * this.box.h; }
  // Values under a pointer.
  under(event) {
    const from = this.area.getBoundingClientRect(), share = (value, start, size) => (value - start) / size;
    const u = share(event.clientX - from.left, this.box.x, this.box.w), w = 1 - share(event.clientY - from.top, this.box.y, this.box.h);
    const [low, high] = this.x;
    return [this.linear ? low + (high - low) * u : low * (high / low) ** u, this.y[0] * (this.y[1] / this.y[0]) ** w, u, w];
  }
  axes(c) {
    const { box } = this, decades = ([low, high], most) => {
      const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9), every = Math.max(1, Math.ceil((last - first + 1) / most)), found = [];
      for (let power = first; power <= last; power += every) found.push(power);
      return found;
    };
    c.font = '11px system-ui, sans-serif';
    c.lineWidth = 1;
    c.fillStyle = COLORS.faint;
    c.strokeStyle = 'rgba(120,140,160,.22)';
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const power of decades(this.y, box.h / 26)) {
      const y = Math.round(this.py(10 ** power)) + 0.5;
      c.beginPath(); c.moveTo(box.x, y); c.lineTo(box.x + box.w, y); c.stroke();
      c.fillText(this.upward(power), box.x - (this.gap ?? 0) - 6, y);
    }
    c.textAlign = 'center';
    c.textBaseline = 'top';
    if (this.linear) {
      const { found, digits } = ticks(...this.x, box.w / 54);
      for (const value of found) {
        const x = Math.round(this.px(value)) + 0.5;
        c.beginPath(); c.moveTo(x, box.y); c.lineTo(x, box.y + box.h); c.stroke();
        c.fillText(value.toFixed(digits), x, box.y + box.h + 5);
      }
    } else for (const power of decades(this.x, box.w / 54)) {
      const x = Math.round(this.px(10 ** power)) + 0.5;
      c.beginPath(); c.moveTo(x, box.y); c.lineTo(x, box.y + box.h); c.stroke();
      c.fillText(this.across(power), this.gap && power === decades(this.x, box.w / 54)[0] ? x + 6 : x, box.y + box.h + 5);
    }
    c.strokeStyle = '#b9c4cf';
    c.strokeRect(box.x + 0.5, box.y + 0.5, box.w - 1, box.h - 1);
    c.fillStyle = COLORS.ink;
    c.fillText(this.named[0], box.x + box.w / 2, box.y + box.h + 22);
    c.save();
    c.translate(11, box.y + box.h / 2);
    c.rotate(-Math.PI / 2);
    c.textBaseline = 'middle';
    c.fillText(this.named[1], 0, 0);
    c.restore();
  }
}
