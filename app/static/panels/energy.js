// Energy over time: the share of every part, with a line that follows the clock.
import { Figure } from '../charts/figure.js';
import { make } from '../browser/dom.js';
import { shownIn } from '../clock/times.js';
import { openOf } from '../frame/energy.js';
import { family, text } from '../text/catalogue.js';
import { figures, percent } from '../text/format.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */

/**
 * @typedef {object} Shares
 * @property {Record<string, any>} chosen
 * @property {number[]} time
 * @property {string} unit  of time
 * @property {number} fed  what drives have brought in by the end [%]
 * @property {number | null} gap  the share that is unaccounted for, where shares would tell nothing
 * @property {{ key: string, values: number[] | null }[]} parts  [%]; null: not of this scene
 */

const ROWS = 21; // of the table
const TOP = 102; // %
const LEAST = 5e-5; // of the energy, that is worth a word
const FAINT = '#5b6c7d';
const PARTS = family('energy.part');
/** @param {string} unit */
const timeIn = (unit) => text('panel.time-in', { unit });

/**
 * With its times in the unit that suits them, and how many of that its own has.
 * @param {Shares} found
 */
function shownOf(found) {
  const [factor, unit] = shownIn(found.unit, found.time[found.time.length - 1]);
  return { ...found, factor, unit, time: found.time.map((t) => factor * t) };
}

/**
 * Where the energy is at the end.
 * @param {Shares} found
 */
function endOf({ fed, parts, time, unit }) {
  const last = time.length - 1;
  const shares = parts.flatMap(({ key, values }) => (values ? [{ key, share: values[last] / 100 }] : []));
  const there = shares.filter(({ key, share }) => key !== 'dissipated' && share >= LEAST);
  const lost = shares.find(({ key }) => key === 'dissipated')?.share ?? 0;
  return text('energy.said', {
    time: `${figures(time[last])} ${unit}`,
    parts: there.map(({ key, share }) => `${PARTS[key]} ${percent(share)}`),
    ...{ driven: fed > 0, fed: percent(0.01 * fed) },
    loses: lost >= LEAST,
    lost: percent(lost),
  });
}

/** @param {Shares} found */
const saidOf = (found) => (found.gap === null ? endOf(shownOf(found)) : openOf(found.gap));

class Energy extends Panel {
  /** @type {Shares | null} */ drawn = null;
  factor = 1; // of times, for the unit shown

  /** @param {Page} page */
  constructor(page) {
    super(page, 'energy', text('energy.button'), text('energy.title'), text('energy.heading'));
    this.said = make('p', { className: 'help', role: 'status', textContent: text('energy.idle') });
    const numbers = () => this.#numbers();
    const part = { name: 'energy', title: text('energy.heading'), about: text('energy.about'), headed: false, numbers };
    this.figure = new Figure('energy', [part]);
    this.root.append(this.said, this.figure.root);
  }
  get empty() {
    const { frame } = this.page;
    return 'moving' in frame && Boolean(frame.moving); // whose chart is at the stage
  }
  /**
   * @param {Shares | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    this.root.ariaBusy = String(!fresh);
    this.said.textContent = found ? saidOf(found) : text('energy.idle');
    this.figure.root.hidden = typeof found?.gap === 'number';
    if (!found || !this.figure || found === this.drawn) return;
    this.drawn = found;
    const { factor, parts, time, unit } = shownOf(found);
    this.factor = factor;
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
    const there = parts.filter(({ values }) => values).map(({ key }) => [PARTS[key], `@{${key}}{0.0} %`]);
    const rows = [[text('chart.time'), `@time{0.000} ${unit}`], ...there];
    const tooltips = rows.map(([name, value]) => `<div><span style="color: ${FAINT}">${name}</span> ${value}</div>`);
    this.figure.set('energy-hover', { tooltips: tooltips.join('') });
    this.figure.set('energy-across', { axis_label: timeIn(unit) });
    this.figure.fill('shares', { ...columns, whole: below });
    this.figure.range('energy-x', [0, time[time.length - 1]]);
    this.figure.range('energy-y', [0, TOP]);
    this.show(this.page.player.t);
  }
  #numbers() {
    const answer = /** @type {Shares | null} */ (this.answer);
    if (!answer) return [[]];
    const found = shownOf(answer);
    const shown = found.parts.flatMap(({ key, values }) => (values ? [{ name: PARTS[key], values }] : []));
    const last = found.time.length - 1;
    const rows = Array.from({ length: ROWS }, (_, k) => Math.round((k / (ROWS - 1)) * last));
    return [
      [timeIn(found.unit), ...shown.map(({ name }) => `${name}, %`)],
      ...rows.map((i) => [figures(found.time[i], 4), ...shown.map(({ values }) => figures(values[i], 3))]),
    ];
  }
  /** @param {number} t */
  show(t) {
    this.figure?.cursor('energy-cursor', t * this.factor);
  }
}

export const PANELS = { energy: Energy }; // by their names in the address
