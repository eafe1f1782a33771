// Where the energy of a mechanism that moves on is, part by part over time.
import { Chart } from '../charts/chart.js';
import { given } from '../wire/message.js';
import { SECONDS } from '../clock/times.js';
import { family, text } from '../text/catalogue.js';

/** @import { Axis } from '../charts/axis.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { MechanismFrame } from '../messages.js' */

/** @type {Record<string, Series['style']>} */
const LOOKS = {
  ...{
    impactor: 'exact',
    links: 'other',
    weight: 'struck',
    springs: 'record',
    local: 'dashedOther',
    drives: 'halfSpace',
  },
  ...{ dissipated: 'limit', sum: 'prediction' },
};

export class Energies {
  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    const [title, about] = [text('motion.chart.energy'), text('motion.chart.energy-about')];
    this.chart = new Chart({ title, about, axis, xUnit: SECONDS, unit: 'J', pad: [0.06, 0.1], go });
  }
  /** @param {MechanismFrame} frame */
  load({ contacts, energies, energyTime: x, moving }) {
    this.chart.root.hidden = !moving;
    if (!moving || !x) return;
    const all = given(energies, 'energies');
    const count = moving.energies.length;
    const parts = moving.energies.map((name, k) => ({ name, y: all.filter((_, i) => i % count === k) }));
    const sum = x.map((_, k) => parts.reduce((total, { y }) => total + y[k], 0));
    const names = family('motion.energy');
    const series = [...parts, { name: 'sum', y: sum }].map(({ name, y }) => ({
      ...{ x, y, name: names[name], style: LOOKS[name] },
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
