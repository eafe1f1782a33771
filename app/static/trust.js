// How far to trust a blow on a beam: the same blow many times with tiny changes; its band goes behind the curves.
import { duration } from './beam_story.js';
import { figures, prefixed } from './beam_stage.js';
import { plainly } from './words.js';

const make = (tag, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
};
const COLUMNS = ['', '', 'this blow', 'lowest', 'highest', 'half range', 'a change of 1 % does'];
const VERDICTS = { firm: '✓ firm', loose: '~ loose', 'not to be trusted': '✗ not to be trusted' };

// A figure in the units of the page.
function shown(value, unit) {
  if (value === null) return '–';
  if (unit === 's') return duration(value * 1e3);
  if (unit === 'm') return `${figures(value * 1e6, 4)} µm`;
  if (unit === 'N') { const [factor, prefix] = prefixed(Math.abs(value)); return `${figures(value * factor, 4)} ${prefix}N`; }
  return `${figures(value, 4)}${unit ? ` ${unit}` : ''}`;
}

// What is asked of the slow pool and drawn when it comes: opened by a button, stale while the choices have changed.
export class Study {
  // `name`: of the two properties of the model; `idle`: said while it is worked out.
  constructor(page, name, label, title, heading, idle) {
    Object.assign(this, { page, name, title, idle });
    this.button = make('button', { type: 'button', textContent: label, onclick: () => this.toggle() });
    this.said = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods' });
    this.root = make('section', { className: `analysis study-${name}`, hidden: true }, make('h2', { textContent: heading }), this.said, make('div', { className: 'scroll' }, this.table));
    page.model.on(name, () => { this.fill(); page.drawCharts(); page.show(page.player.t); });
  }
  get open() { return this.page.model[`${this.name}_shown`]; }
  toggle() {
    this.page.model[`${this.name}_shown`] = !this.open;
    this.take(this.page.frame);
    this.page.drawCharts();
    this.page.show(this.page.player.t);
    if (this.open) this.root.scrollIntoView({ behavior: 'smooth', block: 'nearest' });
  }
  take(frame) {
    const away = frame.kind !== 'beam';
    this.button.setAttribute('aria-pressed', String(this.open && !away));
    this.button.hidden = away;
    this.button.title = this.title;
    this.root.hidden = !this.open || away;
    this.fill();
  }
  // The answer to the choices that are drawn, or null.
  get fresh() {
    const { page, name } = this, found = page.model[name] ? JSON.parse(page.model[name]) : null;
    return !this.root.hidden && found && page.names.every((key) => found.chosen[key] === page.frame.chosen[key]) ? found : null;
  }
  fill() {
    const found = this.fresh;
    this.drawn(found?.error ? null : found);
    if (this.root.hidden) return;
    this.root.setAttribute('aria-busy', String(!found));
    this.said.textContent = !found ? this.idle : found.error ?? this.words(found);
    if (found?.error) this.table.replaceChildren();
    else if (found) this.rows(found);
  }
  drawn() {}
  show() {}
  draw() {}
}

export class Trust extends Study {
  constructor(page) {
    super(page, 'trust', 'How far to trust this', 'the same blow 200 times with tiny changes: which figures follow them in proportion, and which jump', 'How far to trust this blow', 'Striking 200 times with tiny changes; this takes a second or two …');
  }
  drawn(found) { this.page.beam.band = found; }
  words(found) {
    return `${found.told.replaceAll('impactor.mass', 'the impactor’s mass').replaceAll('impactor.length', 'the impactor’s length')} So ${found.runs} blows tell. The band behind the curves of force and displacement holds 90 % of them, the paler one all. ${plainly(found.notes.join(' '))}`;
  }
  rows(found) {
    const head = make('thead', {}, make('tr', {}, ...COLUMNS.map((textContent) => make('th', { scope: 'col', textContent }))));
    const rows = found.spread.map((row) => {
      const values = [row.unperturbed, row.lowest, row.highest].map((value) => shown(value, row.unit));
      const line = make('tr', {}, ...[row.quantity.replaceAll('_', ' '), VERDICTS[row.verdict], ...values, `${figures(100 * row.half_range, 2)} %`, row.verdict === 'firm' ? `${figures(row.sensitivity, 2)} %` : 'jumps'].map((textContent) => make('td', { textContent })));
      line.className = row.verdict.replaceAll(' ', '-');
      return line;
    });
    this.table.replaceChildren(head, make('tbody', {}, ...rows));
  }
}

const STUDIED = ['final_velocity', 'impulse', 'peak_force', 'support_shear', 'peak_shear', 'peak_deflection', 'contacts', 'first_parting', 'last_parting', 'energy_lost'];

export class Convergence extends Study {
  constructor(page) {
    super(page, 'convergence', 'Convergence in modes', 'the same blow with 3, 5, 10, 20 and 40 modes: which figures settle', 'Does one more mode change the answer?', 'Striking with 3, 5, 10, 20 and 40 modes; this takes some seconds …');
  }
  words(found) {
    return `The same blow solved with more and more ${found.kind}. A figure that does not settle is no property of the blow, but of the number of ${found.kind}.`;
  }
  rows(found) {
    const head = make('thead', {}, make('tr', {}, ...['', '', ...found.counts.map((count) => `${count} ${found.kind}`)].map((textContent) => make('th', { scope: 'col', textContent }))));
    const names = STUDIED.filter((name) => name in found.values);
    this.table.replaceChildren(head, make('tbody', {}, ...names.map((name) => {
      const cells = found.values[name].map((value) => shown(value, found.units[name]));
      const line = make('tr', {}, make('td', { textContent: name.replaceAll('_', ' ') }), make('td', { className: 'told', textContent: found.told[name].replace(/^[^:]*: /, '') }), ...cells.map((textContent) => make('td', { textContent })));
      line.className = found.order[name] !== null || /the same for all|^contacts: \d/.test(found.told[name]) ? 'firm' : 'loose';
      return line;
    })));
  }
}
