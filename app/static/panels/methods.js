// This impact by every method, in a table.
import { make, rowOf } from '../shell/dom.js';
import { figures } from '../text/format.js';
import { described, said } from '../text/catalogue.js';
import { naming } from '../text/words.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../shell/message.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Row  one method
 * @property {string} name
 * @property {string} label  with its resolution
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
/** @typedef {{ error?: string, chosen: Record<string, any>, rows?: Row[] }} Comparison */

/** @param {number} value */
const inPercent = (value) => (Math.abs(value) < 5e-9 ? '0' : Math.abs(value) < 5e-6 ? '< 0.001' : figures(100 * value));
const COLUMNS = [
  ['Method', ''],
  ['Rebound', 'error, % of v'],
  ['Contact 1', 'lasts too long by, % of T'],
  ['Contacts', 'found of true'],
  ['Reported', 'contacts'],
  ['Raw', 'touches'],
  ['Force', 'error (L2), %'],
  ['Time', 'ms'],
];
const HELP =
  'Errors are against the exact waves of the same scene: of the speed at which the impactor leaves, of the length ' +
  'of contact 1, and of the force over the whole impact. Time is that of a whole solve on this server. ' +
  'A click on a name shows that method beside the exact one.';

export class Methods {
  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: 'Compare methods' });
    this.said = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods' });
    const scroll = make('div', { className: 'scroll' }, this.table);
    const heading = make('h2', { textContent: 'This impact by every method' });
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
    const away = frame.kind !== 'axial';
    this.button.ariaPressed = String(this.open);
    this.button.disabled = away;
    this.button.hidden = frame.kind === 'beam'; // no exact waves to measure by; every method is shown beside modes
    this.button.title = away
      ? 'Bodies in space have one method: the rigid impulse'
      : 'what each of them misses, and what it costs';
    this.root.hidden = !this.open || away;
    if (!this.root.hidden) this.fill();
  }
  fill() {
    const { page } = this;
    /** @type {Comparison | null} */
    const found = page.model.methods ? JSON.parse(page.model.methods) : null;
    const fresh = found !== null && page.names.every((name) => found.chosen[name] === page.frame.chosen[name]);
    this.root.ariaBusy = String(!fresh);
    if (!fresh) this.said.textContent = 'Solving by every method; this takes some seconds …';
    else this.said.textContent = found.error ? `No exact waves to measure by. ${found.error}` : HELP;
    const titles = COLUMNS.map(([name, unit]) =>
      make('th', { scope: 'col' }, name, make('small', { textContent: unit })),
    );
    const rows = found?.rows?.map((row) => this.row(row)) ?? [];
    const head = make('thead', {}, make('tr', {}, ...titles));
    this.table.replaceChildren(...(found?.rows ? [head, make('tbody', {}, ...rows)] : []));
  }
  /** @param {Row} row */
  row(row) {
    const { page } = this;
    const pick = make('button', { type: 'button', className: 'when', textContent: naming(row.name) });
    pick.onclick = () => page.send('method', row.name);
    const name = make('td', {}, row.reason ? naming(row.name) : pick);
    if (row.label !== row.name) name.append(make('small', { textContent: described(row.label) }));
    if (row.reason) {
      const reason = make('td', { colSpan: COLUMNS.length - 1, textContent: said(row.reason) });
      return make('tr', { className: 'refused' }, name, reason);
    }
    const force = make('td', { textContent: row.force_error === null ? '–' : inPercent(row.force_error) });
    if (row.resolved_force_error !== null)
      force.append(make('small', { textContent: `${inPercent(row.resolved_force_error)} averaged` }));
    const { contacts, raw_contacts: touches, true_contacts: true_, true_contacts_found: met } = row;
    const line = rowOf([
      inPercent(row.rebound_error),
      inPercent(row.duration_error),
      `${met} of ${true_}`,
      contacts,
      touches,
    ]);
    line.prepend(name);
    line.append(force, make('td', { textContent: figures(1e3 * row.wall_time) }));
    line.children[3].classList.toggle('missed', met < true_);
    line.children[4].classList.toggle('missed', contacts !== true_);
    line.children[5].classList.toggle('missed', touches > true_);
    if (page.frame.kind === 'axial' && page.frame.other?.name === row.name) line.ariaCurrent = 'true';
    return line;
  }
  show() {}
  draw() {}
}
