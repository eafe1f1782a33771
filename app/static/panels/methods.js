// This impact by every method, in a table.
import { make, rowOf, scrolled } from '../browser/dom.js';
import { figures, localised } from '../text/format.js';
import { described, family, leftOut, methodOf, said, text } from '../text/catalogue.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Row  one method
 * @property {string} name
 * @property {string} label  with its resolution
 * @property {string | null} model  of a method that has several
 * @property {Note | null} reason  why it cannot solve the scene
 * @property {number} rebound_error
 * @property {number} duration_error
 * @property {number} true_contacts
 * @property {number} true_contacts_found
 * @property {number} contacts
 * @property {number} raw_contacts
 * @property {number | null} force_error
 * @property {number | null} resolved_force_error
 * @property {number} wall_time
 */
/** @typedef {{ error?: Note, chosen: Record<string, any>, rows?: Row[] }} Comparison */

/** @param {number} value */
const inPercent = (value) =>
  Math.abs(value) < 5e-9 ? '0' : Math.abs(value) < 5e-6 ? `< ${localised('0.001')}` : figures(100 * value);
const COLUMNS = ['method', 'rebound', 'time', 'duration', 'found', 'reported', 'raw', 'force']; // a phone shows three
const UNITS = family('methods.unit'); // below the names of columns

class Methods {
  /** @type {string[]} */ forKinds = []; // of scene, as Python says

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: text('methods.button') });
    this.said = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods all-methods' });
    const scroll = scrolled(this.table, text('methods.heading'));
    const heading = make('h2', { textContent: text('methods.heading') });
    this.root = make('section', { className: 'analysis', hidden: true }, heading, this.said, scroll);
    page.model.on('methods', () => this.fill());
  }
  get open() {
    return this.page.model.methods_shown;
  }
  toggle() {
    this.page.model.methods_shown = !this.open;
    this.take(this.page.frame);
  }
  /** @param {Frame} frame */
  take(frame) {
    const away = !this.forKinds.includes(frame.kind);
    this.button.ariaPressed = String(this.open);
    this.button.disabled = away;
    this.button.hidden = 'main' in frame; // no exact waves to measure by; every method is shown beside modes
    this.button.title = text(away ? 'methods.in-space' : 'methods.title');
    this.root.hidden = !this.open || away;
    if (!this.root.hidden) this.fill();
  }
  fill() {
    const { page } = this;
    /** @type {Comparison | null} */
    const found = page.model.methods ? JSON.parse(page.model.methods) : null;
    const fresh = found !== null && page.names.every((name) => found.chosen[name] === page.frame.chosen[name]);
    this.root.ariaBusy = String(!fresh);
    if (!fresh) this.said.textContent = text('methods.idle');
    else
      this.said.textContent = found.error ? text('methods.no-waves', { why: said(found.error) }) : text('methods.help');
    const titles = COLUMNS.map((name) =>
      make('th', { scope: 'col' }, text(`methods.column.${name}`), make('small', { textContent: UNITS[name] ?? '' })),
    );
    const rows = found?.rows?.map((row) => this.row(row)) ?? [];
    const head = make('thead', {}, make('tr', {}, ...titles));
    this.table.replaceChildren(...(found?.rows ? [head, make('tbody', {}, ...rows)] : []));
  }
  /** @param {Row} row */
  row(row) {
    const { page } = this;
    const called = methodOf(row.name, row.model ?? '');
    const pick = make('button', { type: 'button', className: 'when', textContent: called });
    pick.onclick = () => page.send('method', row.name);
    const name = make('td', {}, row.reason ? called : pick);
    const more = leftOut(row.model ?? '') || described(row.label);
    if (more !== called) name.append(make('small', { textContent: more }));
    if (row.reason) {
      const reason = make('td', { colSpan: COLUMNS.length - 1, textContent: said(row.reason) });
      return make('tr', { className: 'refused' }, name, reason);
    }
    const force = make('td', { textContent: row.force_error === null ? '–' : inPercent(row.force_error) });
    if (row.resolved_force_error !== null)
      force.append(
        make('small', { textContent: text('methods.averaged', { error: inPercent(row.resolved_force_error) }) }),
      );
    const { contacts, raw_contacts: touches, true_contacts: true_, true_contacts_found: met } = row;
    const line = rowOf([
      inPercent(row.rebound_error),
      figures(1e3 * row.wall_time),
      inPercent(row.duration_error),
      text('panel.found-of', { found: met, all: true_ }),
      contacts,
      touches,
    ]);
    line.prepend(name);
    line.append(force);
    const [found, reported, raw] = [...line.children].slice(COLUMNS.indexOf('found'));
    found.classList.toggle('missed', met < true_);
    reported.classList.toggle('missed', contacts !== true_);
    raw.classList.toggle('missed', touches > true_);
    if ('other' in page.frame && page.frame.other?.name === row.name) line.ariaCurrent = 'true';
    return line;
  }
  show() {}
  draw() {}
}

export const PANELS = { methods: Methods }; // by their names in the address
