// What is opened on demand below the views: all methods in a table, all mass ratios, a measured record.
import { Needs } from './advice.js';
import { naming } from './charts.js';
import { Measurement } from './record.js';
import { Stability } from './stability.js';
import { Tolerance } from './tolerance.js';
import { TradeOff } from './tradeoff.js';
import { Convergence, Trust } from './trust.js';
import { described } from './words.js';

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
const figures = (value, digits = 3) => Number(value.toPrecision(digits)).toLocaleString('en', { maximumSignificantDigits: digits, useGrouping: false }).replace('-', '−');
const percent = (value) => (Math.abs(value) < 5e-9 ? '0' : Math.abs(value) < 5e-6 ? '< 0.001' : figures(100 * value));
const COLUMNS = [
  ['Method', ''], ['Rebound', 'error, % of v'], ['Contact 1', 'lasts too long by, % of T'], ['Contacts', 'found of true'], ['Reported', 'contacts'],
  ['Raw', 'touches'], ['Force', 'error (L2), %'], ['Time', 'ms'],
];
const RATIO_CURSORS = ['rebound', 'periods', 'contacts'].map((name) => `ratio-cursor-${name}`);

const reveal = (element) => element.scrollIntoView({ behavior: 'smooth', block: 'nearest' });

class Methods {
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: 'Compare methods', onclick: () => this.toggle() });
    this.said = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods' });
    this.root = make('section', { className: 'analysis', hidden: true },
      make('h2', { textContent: 'This blow by every method' }), this.said, make('div', { className: 'scroll' }, this.table));
    page.model.on('methods', () => this.fill());
  }
  get open() { return this.page.model.methods_shown; }
  toggle() {
    this.page.model.methods_shown = !this.open;
    this.take(this.page.frame);
    if (this.open) reveal(this.root);
  }
  take(frame) {
    const away = frame.kind !== 'axial';
    this.button.setAttribute('aria-pressed', String(this.open));
    this.button.disabled = away;
    this.button.hidden = frame.kind === 'beam'; // no exact waves to measure by; every method is shown beside modes
    this.button.title = away ? 'Bodies in space have one method: the rigid impulse' : 'what each of them misses, and what it costs';
    this.root.hidden = !this.open || away;
    if (!this.root.hidden) this.fill();
  }
  fill() {
    const { page } = this, found = page.model.methods ? JSON.parse(page.model.methods) : null;
    const fresh = found && page.names.every((name) => found.chosen[name] === page.frame.chosen[name]);
    this.root.setAttribute('aria-busy', String(!fresh));
    this.said.textContent = !fresh ? 'Solving by every method; this takes some seconds …' : found.error ? `No exact waves to measure by. ${found.error}`
      : 'Errors are against the exact waves of the same scene: of the speed at which the impactor leaves, of the length of contact 1, and of the force over the whole blow. Time is that of a whole solve on this server. A click on a name shows that method beside the exact one.';
    if (!found?.rows) { this.table.replaceChildren(); return; }
    const head = make('thead', {}, make('tr', {}, ...COLUMNS.map(([name, unit]) => make('th', { scope: 'col' }, name, make('small', { textContent: unit })))));
    this.table.replaceChildren(head, make('tbody', {}, ...found.rows.map((row) => this.row(row))));
  }
  row(row) {
    const { page } = this, shown = page.frame.other?.name === row.name;
    const options = row.label.slice(row.name.length).trim();
    const pick = make('button', { type: 'button', className: 'when', textContent: naming(row.name), onclick: () => page.send('method', row.name) });
    const name = make('td', {}, row.reason ? naming(row.name) : pick, ...(options ? [make('small', { textContent: described(row.label) })] : []));
    if (row.reason) return make('tr', { className: 'refused' }, name, make('td', { colSpan: COLUMNS.length - 1, textContent: row.reason }));
    const force = row.force_error === null ? '–' : percent(row.force_error);
    const resolved = row.resolved_force_error === null ? [] : [make('small', { textContent: `${percent(row.resolved_force_error)} averaged` })];
    const cells = [percent(row.rebound_error), percent(row.duration_error), `${row.true_contacts_found} of ${row.true_contacts}`, row.contacts, row.raw_contacts];
    const line = make('tr', {}, name, ...cells.map((text) => make('td', { textContent: text })), make('td', {}, force, ...resolved), make('td', { textContent: figures(1e3 * row.wall_time) }));
    line.children[3].classList.toggle('missed', row.true_contacts_found < row.true_contacts);
    line.children[4].classList.toggle('missed', row.contacts !== row.true_contacts);
    line.children[5].classList.toggle('missed', row.raw_contacts > row.true_contacts);
    if (shown) line.setAttribute('aria-current', 'true');
    return line;
  }
  show() {}
  draw() {}
}

class MassRatios {
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: 'All mass ratios', onclick: () => this.toggle() });
  }
  get open() { return this.page.model.ratios_shown; }
  toggle() {
    this.page.model.ratios_shown = !this.open;
    this.take(this.page.frame);
    this.opened();
  }
  opened() {
    const { page } = this, there = () => this.mark(page.frame), wanted = () => this.open && !this.button.disabled;
    const scroll = () => reveal(document.scrollingElement.lastElementChild ?? document.body);
    if (this.open) page.waiter.expect('ratios', 'Working out the blow for all mass ratios …', there, wanted, scroll);
  }
  take(frame) {
    const one = frame.kind === 'axial' && ['mass', 'sphere'].includes(frame.impactor.kind) && frame.target.kind === 'rod' && !frame.target.endMass;
    const plain = one && frame.chosen.law === 'rigid' && ['fixed', 'free'].includes(frame.target.support);
    this.button.disabled = !plain;
    this.button.hidden = frame.kind === 'beam';
    this.button.title = plain ? 'contacts, their times and the rebound for every mass ratio from 1/1000 to 1000'
      : !one ? 'For a mass on one uniform rod: other scenes have more than one number to vary' : 'For rigid contact, and a rod that is fixed or free: then the mass ratio says all';
    this.button.setAttribute('aria-pressed', String(this.open && plain));
    if (this.open && plain) this.mark(frame);
  }
  // The present scene on the figures below the page, moved without telling the server. Whether they are there.
  mark(frame) {
    const ratio = frame.target.mass / frame.impactor.mass, found = RATIO_CURSORS.map((name) => window.Bokeh.documents.map((d) => d.get_model_by_name(name)).find(Boolean));
    for (const span of found) span?.setv({ location: ratio }, { sync: false });
    return found.every(Boolean);
  }
  show() {}
  draw() {}
}

export class Analyses {
  constructor(page) {
    this.methods = new Methods(page);
    this.ratios = new MassRatios(page);
    this.record = new Measurement(page);
    this.trust = new Trust(page);
    this.convergence = new Convergence(page);
    this.needs = new Needs(page);
    this.tolerance = new Tolerance(page);
    this.tradeoff = new TradeOff(page);
    this.stability = new Stability(page);
    this.all = [this.needs, this.tolerance, this.tradeoff, this.trust, this.convergence, this.methods, this.stability, this.ratios, this.record];
    this.buttons = this.all.map((view) => view.button);
    this.panels = [this.needs, this.tolerance, this.tradeoff, this.trust, this.convergence, this.record, this.methods, this.stability].map((view) => view.root);
  }
  take(frame) { for (const view of this.all) view.take(frame); }
  // Those that are open from the first on.
  resume() {
    const open = this.all.filter((view) => view.open);
    for (const view of open) view.opened?.();
    if (open.length && open[0].root) reveal(open[0].root);
  }
  show(t) { for (const view of this.all) view.show(t); }
  draw() { for (const view of this.all) view.draw(); }
}
