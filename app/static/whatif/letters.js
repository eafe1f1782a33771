// Letters of designs on the map: where the values of both axes lie; hollow where other choices differ, at the edge with
// an arrow where that is out of view.
import { COLOR, disc, word } from './ink.js';

/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {[x: number, y: number]} Spot  pixels, or places on both axes */
/** @typedef {{ letter: string, at: Spot, hollow: boolean }} Kept */
/** @typedef {{ x: number, y: number, w: number, h: number }} Plot */

const RADIUS = 10; // pixels
const REACH = 13;
const ARROW = { from: 12, to: 17, half: 5 };

/**
 * A letter.
 * @param {Context} c
 * @param {Spot} spot
 * @param {string} letter
 * @param {boolean} hollow
 */
export function drawLetter(c, [x, y], letter, hollow) {
  disc(c, x, y, RADIUS + 1.5, hollow ? COLOR.kept : COLOR.edge);
  disc(c, x, y, hollow ? RADIUS - 0.5 : RADIUS, hollow ? '#fff' : COLOR.kept);
  word(c, letter, x, y + 0.5, { color: hollow ? COLOR.kept : '#fff', weight: '700 ' });
}

export class Letters {
  /** @type {[letter: string, spot: Spot][]} */ spots = []; // where they are drawn

  /**
   * @param {Context} c
   * @param {Plot} plot
   * @param {Kept[]} kept
   * @param {[from: Spot, to: Spot] | null} way  along which two of them morph
   * @param {(at: Spot) => Spot} spotOf  of places
   */
  draw(c, { h, w, x, y }, kept, way, spotOf) {
    if (way) {
      c.save();
      c.beginPath();
      c.rect(x, y, w, h);
      c.clip();
      c.beginPath();
      for (const end of way) c.lineTo(...spotOf(end));
      c.lineWidth = 1.75;
      c.setLineDash([2, 5]);
      c.lineCap = 'round';
      c.strokeStyle = COLOR.kept;
      c.stroke();
      c.restore();
    }
    this.spots = kept.map(({ at, hollow, letter }) => {
      const [px, py] = spotOf(at);
      /** @type {Spot} */
      const spot = [Math.min(Math.max(px, x), x + w), Math.min(Math.max(py, y), y + h)];
      const off = Math.hypot(px - spot[0], py - spot[1]);
      if (off > 1) {
        const inside = ARROW.to + 2;
        spot[0] = Math.min(Math.max(px, x + inside), x + w - inside);
        spot[1] = Math.min(Math.max(py, y + inside), y + h - inside);
        pointTo(c, spot, Math.atan2(py - spot[1], px - spot[0]));
      }
      drawLetter(c, spot, letter, hollow);
      return [letter, spot];
    });
  }
  /**
   * The letter there, the last drawn first.
   * @param {number} px
   * @param {number} py
   */
  under(px, py) {
    return this.spots.findLast(([, [x, y]]) => Math.hypot(px - x, py - y) < REACH)?.[0] ?? null;
  }
}

/**
 * @param {Context} c
 * @param {Spot} spot
 * @param {number} angle
 */
function pointTo(c, [x, y], angle) {
  c.save();
  c.translate(x, y);
  c.rotate(angle);
  c.beginPath();
  c.moveTo(ARROW.to, 0);
  c.lineTo(ARROW.from, ARROW.half);
  c.lineTo(ARROW.from, -ARROW.half);
  c.fillStyle = COLOR.kept;
  c.fill();
  c.restore();
}
