// What the joints of a mechanism bear over time.
import { Chart } from '../charts/chart.js';
import { text } from '../text/catalogue.js';

/** @import { Axis } from '../charts/axis.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { BeamFrame } from '../shell/message.js' */

/** @type {Series['style'][]} */
const STYLES = ['exact', 'other', 'halfSpace', 'struck', 'record', 'prediction', 'limit'];

export class Reactions {
  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   * @param {string} [about]  what is to be seen
   */
  constructor(axis, go, about = text('beam.chart.reactions-about')) {
    const title = text('beam.chart.reactions');
    this.chart = new Chart({ title, about, axis, xUnit: 'ms', unit: 'N', zero: true, pad: [0.04, 0.12], go });
  }
  /** @param {BeamFrame} frame */
  load({ contacts, mechanism, reactionTime: x, reactions }) {
    const some = reactions?.some((force) => force !== 0); // else all is over at once
    this.chart.root.hidden = !some;
    if (!mechanism || !reactions || !x || !some) return;
    const count = mechanism.joints.length;
    /** @type {Series[]} */
    const series = mechanism.joints.slice(0, STYLES.length).map((joint, n) => ({
      x,
      y: Array.from(x, (_, k) => Math.hypot(reactions[3 * (k * count + n)], reactions[3 * (k * count + n) + 1])),
      name: joint.links.join(' – '),
      style: STYLES[n],
    }));
    this.chart.show({ series, shades: contacts });
  }
  draw() {
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}
