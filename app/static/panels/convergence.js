// The same impact at several resolutions: by modes, elements or steps, and by the restitution of balances.
import { Figure } from '../charts/figure.js';
import { signOf } from '../charts/styles.js';
import { headOf, make, rowOf, segments } from '../browser/dom.js';
import { family, named, said, text } from '../text/catalogue.js';
import { factorOf } from '../text/units.js';
import { Study, shown } from './trust.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Note } from '../text/catalogue.js' */
/** @import { Words } from './trust.js' */

/**
 * @typedef {object} Columns
 * @property {string} kind  what is varied
 * @property {string[]} kinds  what can be
 * @property {number[]} counts  or steps [s], or restitutions
 * @property {Record<string, (number | null)[]>} values
 * @property {Record<string, (number | null)[]>} differences  to the finest, as shares
 * @property {Record<string, string>} units
 * @property {Record<string, Note>} summary_codes
 * @property {Record<string, number | null>} order
 * @property {string} [reference]  method of the impact without balances
 * @property {Record<string, number>} [reference_values]
 */
/** @typedef {Words & Columns} Orders */
const SCALED = ['s', 'm', 'N', 'Pa']; // units that values have prefixes of
const KINDS = ['modes', 'elements', 'step', 'restitution'];
const DIAMETER = 8; // pixels of a marker
const LEAST = 1e-8; // share of a value that is more than none
const SETTLING = new Set(['same-for-all', 'converges', 'vanishes', 'settled', 'contacts-settle']); // have a limit
const STUDIED = [
  'final_velocity',
  'first_velocity',
  'last_parting',
  'first_parting',
  'balances',
  'mean_jump',
  'energy_lost_share',
  'joint_impulse',
  'joint_moment_impulse',
  'impulse',
  'peak_force',
  'support_shear',
  'peak_shear',
  'peak_deflection',
  'support_stress',
  'peak_stress',
  'contacts',
  'energy_lost',
];
const INSTEAD = { energy_lost: 'energy_lost_share' }; // where the first of both is not shown

/**
 * What there is of it, the most telling first.
 * @param {Orders} found
 */
const quantitiesOf = ({ values }) =>
  STUDIED.filter((name) => name in values && !(name === 'energy_lost' && INSTEAD[name] in values));

/** @extends {Study<Orders>} */
class Convergence extends Study {
  /** @param {Page} page */
  constructor(page) {
    super(page, 'convergence');
    const part = { name: 'convergence', title: text('convergence.figure'), about: text('convergence.about') };
    this.figure = new Figure('convergence', [part]);
    const kinds = family('convergence.kind');
    this.pick = segments(
      text('convergence.by'),
      KINDS,
      (kind) => this.#vary(kind),
      (kind) => kinds[kind],
    );
    this.said.before(this.pick.root);
    this.root.append(this.figure.root);
    page.model.on('convergence_by', () => this.fill());
  }
  /** @param {Frame} frame */
  empty(frame) {
    return 'rods' in frame && !frame.rods.length;
  }
  /** @param {string} kind */
  #vary(kind) {
    this.page.model.convergence_by = kind;
    this.fill();
  }
  get fresh() {
    const found = super.fresh;
    return found?.chosen.convergence_by === this.page.model.convergence_by ? found : null;
  }
  /** @param {Orders} found */
  blank({ kind }) {
    return kind === 'restitution'; // none of them is the finest
  }
  /** @param {Orders | null} found  quantities that differ by nothing have no place on the logarithmic axis */
  drawn(found) {
    if (!found?.differences || !this.figure || !this.changed) return;
    const { counts: given, differences, kind, units, values } = found;
    const counts = kind === 'step' ? given.map((step) => step / factorOf('s', 'µs')) : given;
    const points = quantitiesOf(found).flatMap((name, k) => {
      const { color, marker, size: scale } = signOf(k);
      return differences[name].flatMap((difference, i) => {
        const there = difference !== null && difference > LEAST && i < counts.length - 1;
        const value = shown(values[name][i], units[name]);
        const quantity = named('figure', name);
        return there ? [{ count: counts[i], size: 100 * difference, color, marker, scale, quantity, value }] : [];
      });
    });
    const quantities = [...new Set(points.map(({ quantity }) => quantity))];
    const lines = quantities.map((one) => points.filter(({ quantity }) => quantity === one));
    this.figure.fill('lines', {
      counts: lines.map((line) => line.map(({ count }) => count)),
      sizes: lines.map((line) => line.map(({ size }) => size)),
      colour: lines.map(([first]) => first.color),
    });
    this.figure.fill('differences', {
      count: points.map(({ count }) => count),
      size: points.map(({ size }) => size),
      colour: points.map(({ color }) => color),
      marker: points.map(({ marker }) => marker),
      diameter: points.map(({ scale }) => DIAMETER * scale),
      quantity: points.map(({ quantity }) => quantity),
      value: points.map(({ value }) => value),
    });
    const sizes = points.map(({ size }) => size);
    const compared = counts.slice(0, -1);
    this.figure.set('convergence-across', { axis_label: text('convergence.axis', { kind }) });
    this.figure.set('convergence-counts', { ticks: counts, minor_ticks: [] });
    this.figure.range('convergence-x', [0.8 * Math.min(...compared), 1.25 * Math.max(...compared)]);
    this.figure.range('convergence-y', [0.5 * Math.min(...sizes, 10), 2 * Math.max(...sizes, 10)]);
  }
  /** @param {Orders} found */
  words({ kind }) {
    return text('convergence.help', { kind });
  }
  /** @param {Orders} found */
  rows(found) {
    const { counts, kind, kinds, reference, reference_values: beside, units, values } = found;
    const { summary_codes: summary } = found;
    this.pick.root.hidden = kinds.length < 2;
    this.pick.show(kind);
    for (const button of this.pick.root.children)
      if (button instanceof HTMLElement) button.hidden = !kinds.includes(button.dataset.kind ?? '');
    const rows = quantitiesOf(found).map((name) => {
      const settles = SETTLING.has(summary[name].code);
      const unit = SCALED.includes(units[name]) ? units[name] : ''; // else it stands once
      const all = [...values[name], ...(reference ? [beside?.[name] ?? null] : [])];
      const title = unit || !units[name] ? named('figure', name) : `${named('figure', name)}, ${units[name]}`;
      const cells = [title, said(summary[name]), ...all.map((value) => shown(value, unit))];
      const line = rowOf(cells, { className: kind === 'restitution' ? '' : settles ? 'firm' : 'loose' });
      line.children[1].className = 'summary';
      return line;
    });
    const heads = counts.map((value) =>
      kind === 'step' ? shown(value, 's') : text('convergence.level', { kind, value }),
    );
    const last = reference ? [named('reference', reference)] : [];
    const levels = counts.length + last.length;
    this.table.style.setProperty('--levels', String(levels));
    this.table.style.setProperty('--columns', String(1 + levels));
    this.table.replaceChildren(headOf(['', '', ...heads, ...last]), make('tbody', {}, ...rows));
  }
}

export const PANELS = { convergence: Convergence }; // by its name in the address
