// What draws like a canvas and writes SVG: that of Bokeh, which is on the page, with what our pictures use besides.
import { bokeh } from '../browser/bokeh.js';

const TURN = 2 * Math.PI;

/**
 * A font as that of Bokeh reads it, which knows weights of full hundreds.
 * @param {string} font
 */
const known = (font) => font.replace(/^\d+(?= )/, (weight) => String(100 * Math.round(Number(weight) / 100)));

/**
 * The path of a box with round corners.
 * @param {CanvasPath} c
 * @param {[left: number, right: number]} across
 * @param {[top: number, low: number]} down
 * @param {number} radius
 */
function rounded(c, [left, right], [top, low], radius) {
  c.moveTo(left + radius, top);
  c.arcTo(right, top, right, low, radius);
  c.arcTo(right, low, left, low, radius);
  c.arcTo(left, low, left, top, radius);
  c.arcTo(left, top, right, top, radius);
  c.closePath();
}

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
      this.font = known(this.font);
      super.fillText(words, x, y);
      if (this.measureText(words).width <= most) return;
      const last = [...this.get_svg().querySelectorAll('text')].at(-1);
      last?.setAttribute('textLength', String(most));
      last?.setAttribute('lengthAdjust', 'spacingAndGlyphs');
    }
    /**
     * @param {string} words
     * @param {number} x
     * @param {number} y
     */
    strokeText(words, x, y) {
      this.font = known(this.font);
      super.strokeText(words, x, y);
    }
    /**
     * @param {number} x
     * @param {number} y
     * @param {number} wide
     * @param {number} high
     * @param {number} radius
     */
    roundRect(x, y, wide, high, radius) {
      rounded(/** @type {any} */ (this), [x, x + wide], [y, y + high], Math.min(radius, wide / 2, high / 2));
    }
  }
  /** @type {any} */
  const c = new /** @type {any} */ (Context)({ width, height });
  c.get_svg().setAttribute('viewBox', `0 0 ${width} ${height}`);
  return c;
}
