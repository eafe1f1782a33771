// How far to trust an impact on a beam: the same impact many times with tiny changes; its band goes behind the curves.
import { Figure } from '../charts/figure.js';
import { headOf, make, rowOf, scrolled } from '../browser/dom.js';
import { unitOfTime } from '../clock/times.js';
import { family, named, said, text } from '../text/catalogue.js';
import { duration, engineering, figures, prefixed, scaled } from '../text/format.js';

/** @import { Band } from '../beam/charts.js' */
/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Spread  of one figure over all runs
 * @property {string} quantity
 * @property {string} unit
 * @property {string} verdict
 * @property {number | null} unperturbed
 * @property {number | null} lowest
 * @property {number | null} highest
 * @property {number} half_range  as a share
 * @property {number} sensitivity  what a change of 1 % does [%]
 */
/**
 * @typedef {object} Words
 * @property {Note} [error]  why there is no answer
 * @property {Record<string, any>} chosen
 */
/** @typedef {Record<typeof EDGES[number], number[]>} Edges  of what 90 % of the runs do, and of what all do */
/** @typedef {{ velocity: Edges }} Moving */
/** @typedef {Words & Band & Moving & { summary: Note, runs: number, notes: Note[], spread: Spread[] }} Ensemble */

const COLUMNS = ['this-impact', 'lowest', 'highest', 'half-range', 'sensitivity'];

const EDGES = /** @type {const} */ (['lowest', 'low', 'high', 'highest']);
/** @type {[name: 'force' | 'displacement' | 'velocity', unit: string][]} */
const BANDS = [
  ['force', 'N'],
  ['displacement', 'm'],
  ['velocity', 'm/s'],
];
const ROWS = 21; // of the table of a band

/**
 * A figure in the units of the page.
 * @param {number | null} value
 * @param {string} unit
 */
export function shown(value, unit) {
  if (value === null) return '–';
  if (unit === 's') return duration(value);
  if (unit === 'm') return `${figures(value * 1e6, 4)} µm`;
  if (unit === 'N' || unit === 'Pa') {
    const [factor, prefix] = prefixed(Math.abs(value));
    return `${figures(value * factor, 4)} ${prefix}${unit}`;
  }
  return `${figures(value, 4)}${unit ? ` ${unit}` : ''}`;
}

/**
 * What is asked of the slow pool and drawn when it comes: opened by a button, stale while the choices have changed.
 * @template {Words} Found
 */
export class Study {
  /** @type {Figure | null} */ figure = null; // that is shown while it is open
  came = ''; // the answer that the figure shows
  changed = false; // since then
  /** @type {string[]} */ forKinds = []; // of scene, as Python says

  /**
   * @param {Page} page
   * @param {string} name  of the two properties of the model, and of its texts
   */
  constructor(page, name) {
    this.page = page;
    this.name = name;
    this.texts = family(name);
    this.button = make('button', { type: 'button', textContent: this.texts.button });
    this.said = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods' });
    const scroll = scrolled(this.table, this.texts.heading);
    this.root = make('section', { className: `analysis study-${name}`, hidden: true });
    this.root.append(make('h2', { textContent: this.texts.heading }), this.said, scroll);
    page.model.on(name, () => {
      this.fill();
      page.drawCharts();
      page.show(page.player.t);
    });
  }
  get open() {
    return this.page.model[`${this.name}_shown`];
  }
  toggle() {
    this.page.model[`${this.name}_shown`] = !this.open;
    this.take(this.page.frame);
    this.page.drawCharts();
    this.page.show(this.page.player.t);
  }
  /**
   * Whether there is nothing to be said of this scene, though of its kind there is.
   * @param {Frame} _frame
   */
  empty(_frame) {
    return false;
  }
  /** @param {Frame} frame */
  take(frame) {
    const away = !this.forKinds.includes(frame.kind) || this.empty(frame);
    this.button.ariaPressed = String(this.open && !away);
    this.button.hidden = away;
    this.button.title = this.texts.title;
    this.root.hidden = !this.open || away;
    if (this.root.hidden) this.figure?.close();
    else this.figure?.open().then(() => this.show(this.page.player.t));
    this.fill();
  }
  /**
   * The answer to the choices that are drawn, or null.
   * @returns {Found | null}
   */
  get fresh() {
    const { page, name } = this;
    const found = page.model[name] ? JSON.parse(page.model[name]) : null;
    const same = found && page.names.every((key) => found.chosen[key] === page.frame.chosen[key]);
    return !this.root.hidden && same ? found : null;
  }
  fill() {
    const found = this.fresh;
    const came = this.page.model[this.name];
    this.changed = came !== this.came;
    this.drawn(found?.error ? null : found);
    if (found) this.came = came;
    if (this.root.hidden) return;
    this.root.ariaBusy = String(!found);
    this.said.textContent = !found ? this.texts.idle : found.error ? said(found.error) : this.words(found);
    if (this.figure && found) this.figure.root.hidden = Boolean(found.error) || this.blank(found);
    if (found?.error) this.table.replaceChildren();
    else if (found) this.rows(found);
  }
  /**
   * Whether a figure would show nothing of it.
   * @param {Found} _found
   */
  blank(_found) {
    return false;
  }
  /**
   * What else is to be drawn of it.
   * @param {Found | null} _found
   */
  drawn(_found) {}
  /**
   * @param {Found} _found
   * @returns {string}
   */
  words(_found) {
    return '';
  }
  /**
   * Fill the table.
   * @param {Found} _found
   */
  rows(_found) {}
  /** @param {number} _t  the instant of the clock */
  show(_t) {}
  draw() {}
}

/** @extends {Study<Ensemble>} */
class Trust extends Study {
  static beside = true; // has room in the dock; the charts stay
  perSecond = 1; // of the unit of time shown
  /** @param {Page} page */
  constructor(page) {
    super(page, 'trust');
    const parts = BANDS.map(([name]) => {
      const title = text(`trust.band.${name}`);
      const about = text('trust.about-band', { title });
      return { name: `trust-${name}`, title, about, numbers: () => this.#numbers(name) };
    });
    this.figure = new Figure('trust', parts);
    this.root.append(this.figure.root);
  }
  /** @param {Ensemble | null} found */
  drawn(found) {
    for (const view of [this.page.beam, this.page.mechanism]) view.band = found;
    if (!found || !this.figure || !this.changed) return;
    const [factor, unit] = unitOfTime(found.time[found.time.length - 1]);
    const time = found.time.map((t) => factor * t);
    this.perSecond = factor;
    /** @type {Record<string, unknown[]>} */
    const columns = { time, when: found.time.map((t) => engineering(t, 's', 5)) };
    for (const [name, of] of BANDS) {
      const [low, high] = [Math.min(...found[name].lowest), Math.max(...found[name].highest)];
      const [scale, written] = scaled(Math.max(Math.abs(low), Math.abs(high)), of);
      for (const edge of EDGES) columns[`${name}-${edge}`] = found[name][edge].map((value) => scale * value);
      const room = 0.06 * (high - low) * scale || 1;
      this.figure.range(`trust-${name}-y`, [low * scale - room, high * scale + room]);
      this.figure.set(`trust-${name}-up`, { axis_label: text(`trust.axis.${name}`, { unit: written }) });
      this.figure.set(`trust-${name}-across`, { axis_label: text('panel.time-in', { unit }) });
    }
    this.figure.range('trust-force-x', [time[0], time[time.length - 1]]);
    this.figure.fill('bands', columns);
  }
  /** @param {number} t */
  show(t) {
    for (const [name] of BANDS) this.figure?.cursor(`trust-cursor-${name}`, t * this.perSecond);
  }
  /** @param {'force' | 'displacement' | 'velocity'} name */
  #numbers(name) {
    const found = this.fresh;
    if (!found || found.error) return [[]];
    const unit = BANDS.find(([each]) => each === name)?.[1] ?? '';
    const last = found.time.length - 1;
    const rows = Array.from({ length: ROWS }, (_, k) => Math.round((k / (ROWS - 1)) * last));
    return [
      [text('chart.time'), ...EDGES.map((edge) => text(`trust.edge.${edge}`))],
      ...rows.map((i) => [duration(found.time[i]), ...EDGES.map((edge) => shown(found[name][edge][i], unit))]),
    ];
  }
  /** @param {Ensemble} found */
  words({ summary, runs, notes }) {
    return [said(summary), text('trust.result', { runs }), ...notes.map(said)].join(' ');
  }
  /** @param {Ensemble} found */
  rows({ spread }) {
    const rows = spread.map((row) => {
      const firm = row.verdict === 'firm';
      const values = [row.unperturbed, row.lowest, row.highest].map((value) => shown(value, row.unit));
      const shares = [
        `${figures(100 * row.half_range, 2)} %`,
        firm ? `${figures(row.sensitivity, 2)} %` : text('trust.jumps'),
      ];
      const cells = [
        named('figure', row.quantity),
        text(`trust.verdict.${row.verdict.replaceAll(' ', '-')}`),
        ...values,
        ...shares,
      ];
      return rowOf(cells, { className: row.verdict.replaceAll(' ', '-') });
    });
    this.table.replaceChildren(
      headOf(['', '', ...COLUMNS.map((name) => text(`trust.column.${name}`))]),
      make('tbody', {}, ...rows),
    );
  }
}

export const PANELS = { trust: Trust }; // by their names in the address
