// Bending moments of a bar on a pivot or an axis, over time: there, where none may be, half way, and at the contact.
import { Chart } from '../charts/chart.js';
import { TRIPS } from '../clock/times.js';
import { text } from '../text/catalogue.js';
import { called } from '../text/words.js';

/** @import { Axis } from '../charts/axis.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { AxialFigures, AxialFrame, Numbers } from '../messages.js' */

const PLACES = /** @type {const} */ (['pivot', 'between', 'contact']);

/** @typedef {Partial<Record<typeof PLACES[number], Series['style']>>} Styles  of what is drawn */

export class Moments {
  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    const [title, about] = [text('axial.chart.moments'), text('axial.chart.moments-about')];
    this.chart = new Chart({ title, about, axis, xUnit: TRIPS, unit: 'N m', zero: true, go });
  }
  /** @param {AxialFrame} frame */
  load({ exact, exactMoments, momentTime: x, other, otherMoments, target }) {
    this.chart.root.hidden = !x;
    if (!x) return;
    /** @type {Series[]} */
    const series = [];
    const add = (/** @type {Numbers} */ moments, /** @type {AxialFigures} */ of, /** @type {Styles} */ styles) => {
      PLACES.forEach((where, k) => {
        const style = styles[where];
        if (!style) return;
        const name = text('axial.chart.moment', { where, turns: Boolean(target.rotation), method: called(of) });
        series.push({ x, y: moments.filter((_, i) => i % PLACES.length === k), name, style });
      });
    };
    const besides = otherMoments && other; // half way: of one solution, so that lines differ
    if (exactMoments) {
      add(exactMoments, exact, { pivot: 'exact', contact: 'struck', ...(!besides && { between: 'halfSpace' }) });
    }
    if (besides) add(otherMoments, other, { pivot: 'other', between: 'halfSpace', contact: 'dashedOther' });
    this.chart.show({ series, shades: exact.contacts });
  }
  draw() {
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}
