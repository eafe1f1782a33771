// The bar of colours beside a map, with the value of the scene and the one that is wanted.
import { scale } from '../charts/canvas.js';
import { paletteOf, stripOf } from './colours.js';
import { levelsOf } from './contours.js';
import { COLOR, disc, mark, pill, word } from './ink.js';
import { plain, shownOf, unitFor } from './results.js';

/** @import { Context } from './ink.js' */
/** @import { Domain, Over } from './plane.js' */
/** @import { Mapped } from './results.js' */

const [GAP, WIDE, WORDS] = [22, 12, 60]; // pixels from the plot, of the bar, of what stands beside it

/**
 * A round value of a scale, in its unit.
 * @param {Mapped} result
 * @param {number} level
 * @param {Domain} domain
 */
export function tickOf(result, level, domain) {
  const { log } = shownOf(result);
  const real = (/** @type {number} */ value) => (log ? 10 ** value : value);
  const [factor] = unitFor(result, domain);
  return plain(real(level) * factor);
}

export class Bar {
  x = 0;

  /**
   * @param {Context} c
   * @param {{ x: number, y: number, w: number, h: number }} plot
   * @param {Domain} domain
   * @param {Over} shown
   */
  draw(c, plot, domain, { result, value, wanted }) {
    const [low, high] = domain;
    const { log, whole } = shownOf(result);
    const x = plot.x + plot.w + GAP * scale;
    this.x = x;
    const at = (/** @type {number} */ level) => plot.y + plot.h - ((level - low) / (high - low)) * plot.h;
    const within = (/** @type {number} */ y) => Math.min(Math.max(y, plot.y), plot.y + plot.h);
    const place = (/** @type {number} */ each) => within(at(log ? Math.log10(each) : each));
    c.drawImage(stripOf(paletteOf(result)), x, plot.y, WIDE, plot.h);
    const counts = Array.from({ length: Math.round(high - low) }, (_, k) => Math.round(low + 0.5) + k);
    let last = Infinity;
    for (const level of whole ? counts : levelsOf(domain, Boolean(log))) {
      const y = at(level);
      if (last - y < 20 * scale || (wanted !== null && Math.abs(y - place(wanted)) < 19 * scale)) continue;
      word(c, tickOf(result, level, domain), x + WIDE + 8, y, { color: COLOR.soft, align: 'left' });
      last = y;
    }
    const [, unit] = unitFor(result, domain);
    word(c, unit, x + WIDE + 8, plot.y - 14 * scale, { color: COLOR.soft, align: 'left' });
    if (Number.isFinite(value)) {
      disc(c, x + WIDE / 2, place(value), 5.5, COLOR.accent);
      c.lineWidth = 2;
      c.strokeStyle = COLOR.ring;
      c.stroke();
    }
    if (wanted === null) return;
    c.strokeStyle = COLOR.accent;
    c.lineWidth = 3;
    mark(c, x - 3, place(wanted), WIDE + 6, 0);
    pill(c, tickOf(result, log ? Math.log10(wanted) : wanted, domain), x + WIDE + 5, place(wanted), 'left', Infinity);
  }
  /** @param {number} px  Whether this is on it, across. */
  holds(px) {
    return px > this.x - 10 && px < this.x + WIDE + WORDS;
  }
}
