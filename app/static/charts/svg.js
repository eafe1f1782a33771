// What draws like a canvas and writes SVG: that of Bokeh, which is on the page, with what our pictures use besides.
import { bokeh } from '../browser/bokeh.js';

const TURN = 2 * Math.PI;

/** @typedef {CanvasRenderingContext2D & { get_serialized_svg: () => string }} SvgContext */

/**
 * @param {number} width
 * @param {number} height
 * @returns {SvgContext}
 */
export function svgContext(width, height) {
  const { SVGRenderingContext2D } = bokeh().require('core/util/svg');
  class Context extends SVGRenderingContext2D {
    clientWidth = width; // it is its own canvas

    /**
     * A full circle has no end that falls on its beginning.
     * @param {number} x
     * @param {number} y
     * @param {number} radius
     * @param {number} from
     * @param {number} to
     * @param {boolean} [back]
     */
    arc(x, y, radius, from, to, back = false) {
      if (Math.abs(to - from) < TURN) super.arc(x, y, radius, from, to, back);
      else super.arc(x, y, radius, 0, TURN);
    }
    /**
     * Narrower where it has no more room.
     * @param {string} words
     * @param {number} x
     * @param {number} y
     * @param {number} [most]
     */
    fillText(words, x, y, most = Infinity) {
      super.fillText(words, x, y);
      if (this.measureText(words).width <= most) return;
      const last = [...this.get_svg().querySelectorAll('text')].at(-1);
      last?.setAttribute('textLength', String(most));
      last?.setAttribute('lengthAdjust', 'spacingAndGlyphs');
    }
    /**
     * @param {number} x
     * @param {number} y
     * @param {number} wide
     * @param {number} high
     * @param {number} radius
     */
    roundRect(x, y, wide, high, radius) {
      const [right, low] = [x + wide, y + high];
      const round = Math.min(radius, wide / 2, high / 2);
      this.moveTo(x + round, y);
      this.arcTo(right, y, right, low, round);
      this.arcTo(right, low, x, low, round);
      this.arcTo(x, low, x, y, round);
      this.arcTo(x, y, right, y, round);
      this.closePath();
    }
  }
  /** @type {any} */
  const c = new /** @type {any} */ (Context)({ width, height });
  c.get_svg().setAttribute('viewBox', `0 0 ${width} ${height}`);
  return c;
}
