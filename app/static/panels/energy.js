// Energy over time: the share of every part, with a line that follows the clock.
import { Figure } from '../charts/figure.js';
import { make } from '../shell/dom.js';
import { figures } from '../text/format.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */

/**
 * @typedef {object} Shares
 * @property {Record<string, any>} chosen
 * @property {number[]} time
 * @property {string} unit  of time
 * @property {{ key: string, name: string, values: number[] | null }[]} parts  [%]; null: not of this scene
 */

const ROWS = 21; // of the table
const TOP = 102; // %
const FAINT = '#5b6c7d';

export class Energy extends Panel {
  /** @type {Shares | null} */ drawn = null;

  /** @param {Page} page */
  constructor(page) {
    const title = 'how much of the first energy each part has, and when';
    super(page, 'energy', 'Energy over time', title, 'Where the energy is');
    this.said = make('p', { className: 'help', role: 'status', textContent: 'Adding up the energy of every part …' });
    const about = 'shares of the energy of every part against time, one upon the other';
    const numbers = () => this.#numbers();
    this.figure = new Figure('energy', [{ name: 'energy', title: 'Where the energy is', about, numbers }]);
    this.root.append(this.said, this.figure.root);
  }
  get away() {
    return this.page.frame.kind === 'bodies';
  }
  /**
   * @param {Shares | null} found
   * @param {boolean} fresh
   */
  told(found, fresh) {
    this.root.ariaBusy = String(!fresh);
    this.said.hidden = Boolean(found);
    if (!found || !this.figure || found === this.drawn) return;
    this.drawn = found;
    const { parts, time, unit } = found;
    /** @type {Record<string, number[]>} */
    const columns = { time };
    let below = time.map(() => 0);
    parts.forEach(({ key, values }, k) => {
      const own = values ?? time.map(() => 0);
      const above = below.map((sum, i) => sum + own[i]);
      Object.assign(columns, { [key]: own, [`${key}-low`]: below, [`${key}-high`]: above });
      this.figure?.set(key, { visible: values !== null });
      this.figure?.set(`energy-key-${k}`, { visible: values !== null });
      below = above;
    });
    const there = parts.filter(({ values }) => values).map(({ key, name }) => [name, `@{${key}}{0.0} %`]);
    const rows = [['time', `@time{0.000} ${unit}`], ...there];
    const tooltips = rows.map(([name, value]) => `<div><span style="color: ${FAINT}">${name}</span> ${value}</div>`);
    this.figure.set('energy-hover', { tooltips: tooltips.join('') });
    this.figure.set('energy-across', { axis_label: `time, ${unit}` });
    this.figure.fill('shares', { ...columns, whole: below });
    this.figure.range('energy-x', [0, time[time.length - 1]]);
    this.figure.range('energy-y', [0, TOP]);
    this.show(this.page.player.t);
  }
  #numbers() {
    const found = /** @type {Shares | null} */ (this.answer);
    if (!found) return [[]];
    const shown = found.parts.flatMap(({ name, values }) => (values ? [{ name, values }] : []));
    const last = found.time.length - 1;
    const rows = Array.from({ length: ROWS }, (_, k) => Math.round((k / (ROWS - 1)) * last));
    return [
      [`time, ${found.unit}`, ...shown.map(({ name }) => `${name}, %`)],
      ...rows.map((i) => [figures(found.time[i], 4), ...shown.map(({ values }) => figures(values[i], 3))]),
    ];
  }
  /** @param {number} t */
  show(t) {
    this.figure?.cursor('energy-cursor', t);
  }
}
