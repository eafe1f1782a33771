// Speed against accuracy: wall time and error of every method from coarse to fine; the best of them are joined.
import { Figure } from '../charts/figure.js';
import { signOf } from '../charts/styles.js';
import { headOf, make, rowOf, segments } from '../browser/dom.js';
import { described, family, said, text } from '../text/catalogue.js';
import { figures, share } from '../text/format.js';
import { shortly } from '../text/words.js';
import { Panel, QUANTITIES, showMethod, shown } from './panel.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */
/** @import { Shown } from './panel.js' */

/**
 * @typedef {object} Row  one method at one resolution
 * @property {string} label
 * @property {string} ladder  rows of one ladder differ in resolution only
 * @property {Shown} method
 * @property {number} rank  of the method among all
 * @property {boolean} exact
 * @property {number} wall_time  [s]
 * @property {[least: number, most: number] | null} [spread]  of several runs
 * @property {Record<string, number | null>} errors  by quantity
 * @property {number | null} estimated_error
 * @property {string[]} best_for  quantities
 * @property {number} true_contacts
 * @property {number} true_contacts_found
 * @property {number} invented_contacts
 * @property {Note[]} note_codes
 */
/** @typedef {Row & { time: number, size: number }} Point  a row with its place: milliseconds and size of the error */

/**
 * @typedef {object} Table
 * @property {Note} [error]
 * @property {Record<string, any>} chosen
 * @property {Row[]} points
 * @property {{ note: Note | null, uncertainty: Record<string, number> }} reference
 * @property {Note[]} remarks
 * @property {{ processor: string, cores: number, python: string }} machine
 * @property {boolean} shipped  with the program; else it was measured on this machine
 * @property {boolean} scaled  its times are those of this machine, by a calibration
 * @property {boolean} scalable
 * @property {boolean} elsewhere  its machine is another than this
 * @property {boolean} changed  methods are no longer those that were measured
 * @property {string} date
 * @property {number} seconds  that it took
 * @property {number} budget
 * @property {string | null} stopped  why it is not whole
 */

const [USUAL, BEST] = [8, 12]; // pixels of a marker
const PICKED = '#c81e4a';
const NEAR = 24; // pixels from a point that is meant
const LEAST = 1e-12; // error that is more than none
const LEFT = 200; // times below the least error that is shown, at most
/** @type {Record<string, number>} */
const ARROWS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };

/** @param {number} seconds */
const ms = (seconds) => `${figures(1e3 * seconds, 3)} ms`;
/** @param {number | null} error */
function signed(error) {
  if (error === null || error === 0) return text('tradeoff.no-error', { known: error === 0 });
  const size = share(Math.abs(error));
  return error < 0 && !/^[<>]/.test(size) ? `−${size}` : size; // what is beyond a bound has no sign
}
/** @param {Row} row */
const contactsOf = (row) => text('panel.found-of', { found: row.true_contacts_found, all: row.true_contacts });
/** @param {string} quantity */
const errorIn = (quantity) => text('tradeoff.error-in', { quantity: QUANTITIES[quantity] });
const COLUMNS = family('tradeoff.column');
const ROWS = family('tradeoff.row'); // of one point

/**
 * Where it was measured, against what, and how far.
 * @param {Table} found
 * @param {boolean} running
 */
function wordsOf(found, running) {
  const { processor, cores, python } = found.machine ?? {};
  const { shipped, scaled, elsewhere, changed } = found;
  const machine = { shipped, scaled, elsewhere, changed, processor, cores: cores ?? 0, python };
  const state = running ? 'running' : found.stopped ? 'stopped' : 'whole';
  const { seconds, date, stopped } = found;
  const reference = found.reference.note ? said(found.reference.note) : text('tradeoff.no-reference');
  const values = { points: found.points.length, state, seconds, date, stopped: stopped ?? '', reference };
  return text('tradeoff.measured', { ...machine, ...values });
}

class TradeOff extends Panel {
  wanted = 'peak-force'; // quantity
  drawn = ''; // what the points depend on
  /** @type {Point[]} */ points = [];
  /** @type {Point | null} */ picked = null;

  /** @param {Page} page */
  constructor(page) {
    super(page, 'tradeoff', text('tradeoff.button'), text('tradeoff.title'), text('tradeoff.heading'), [
      'tradeoff_scaled',
    ]);
    const press = (/** @type {string} */ name) => {
      this.wanted = name;
      this.plot();
      this.pick(null);
    };
    this.kinds = segments(text('tradeoff.error-of'), Object.keys(QUANTITIES), press, (name) => QUANTITIES[name]);
    this.kinds.root.classList.add('small');
    const part = { name: 'tradeoff', title: text('tradeoff.figure'), about: text('tradeoff.about') };
    this.figure = new Figure('tradeoff', [{ ...part, numbers: () => this.#numbers() }]);
    this.area = make('div', { className: 'points' }, this.figure.root);
    this.start = make('button', { type: 'button', className: 'whole', onclick: () => this.measure() });
    this.scale = make('button', { type: 'button', className: 'whole', title: text('tradeoff.scale-title') });
    this.scale.textContent = text('tradeoff.scale');
    this.scale.onclick = () => {
      page.model.tradeoff_scaled = true;
      this.fill();
    };
    this.said = make('p', { className: 'help', role: 'status' });
    this.bar = make('progress', { max: 1, value: 0, hidden: true, ariaLabel: text('tradeoff.so-far') });
    this.point = make('div', { className: 'point', ariaLive: 'polite' });
    this.remarks = make('details', { className: 'help', hidden: true });
    this.sides = make('div', { className: 'sides scatter' }, this.point);
    this.sides.append(make('div', {}, this.kinds.root, this.area));
    const form = make('div', { className: 'record-form' }, this.scale, this.start, this.bar);
    this.root.append(this.said, form, this.sides, this.remarks);
    page.model.on('tradeoff_running', () => this.fill());
    this.listen();
  }
  /** Of which errors are shown: the one that is wanted, unless no method has any of it. */
  get quantity() {
    const { known } = this;
    return known.includes(this.wanted) ? this.wanted : (known[0] ?? this.wanted);
  }
  /** Quantities of which there are errors. */
  get known() {
    const rows = /** @type {Table | null} */ (this.answer)?.points ?? [];
    return Object.keys(QUANTITIES).filter((name) => rows.some(({ errors }) => Number.isFinite(errors[name] ?? NaN)));
  }
  listen() {
    const { area } = this;
    area.tabIndex = 0;
    area.role = 'application';
    area.ariaLabel = text('tradeoff.keys');
    area.onfocus = (event) => {
      if (event.target === area && !this.picked) this.step(0);
    };
    area.onpointerleave = () => this.pick(null);
    area.onkeydown = (event) => {
      if (event.target !== area) return;
      const way = ARROWS[event.key];
      if (way) {
        event.preventDefault();
        this.step(way);
      }
      if (event.key === 'Enter' && this.picked) showMethod(this.page, this.picked.method);
    };
    this.figure?.whenReady(() => this.wire(this.figure?.model('points')));
  }
  /**
   * What a pointer does on the figure: over a point it is read, a click near one shows it on the page.
   * @param {any} source
   */
  wire(source) {
    source.inspect.connect(() => {
      const read = this.points[source.inspected.indices[0]];
      if (read) this.pick(read);
    });
    this.figure?.model('tradeoff').on_event('tap', (/** @type {{ sx: number, sy: number }} */ { sx, sy }) => {
      const point = this.nearest(sx, sy);
      this.pick(point);
      if (point) showMethod(this.page, point.method);
    });
  }
  /**
   * The point that a click means, or null.
   * @param {number} left
   * @param {number} top
   */
  nearest(left, top) {
    let [found, least] = [/** @type {Point | null} */ (null), NEAR];
    for (const point of this.points) {
      const [x, y] = this.figure?.placeOf('tradeoff', point.time, point.size) ?? [];
      const away = Math.hypot(x - left, y - top);
      if (away < least) [found, least] = [point, away];
    }
    return found;
  }
  measure() {
    const { model } = this.page;
    model.tradeoff_running = !model.tradeoff_running;
    this.fill();
  }
  /**
   * @param {Table | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    const running = this.page.model.tradeoff_running;
    const points = found?.points ?? [];
    this.root.ariaBusy = String(!fresh && !running);
    const again = Boolean(points.length && !found?.shipped);
    const asked = this.page.model.tradeoff_scaled;
    this.scale.hidden = running || !found?.scalable || found.scaled || (asked && fresh);
    this.scale.disabled = asked;
    this.start.textContent = running ? text('panel.cancel') : text('tradeoff.measure', { again });
    this.start.ariaPressed = String(running);
    this.bar.hidden = !running;
    this.bar.value = Math.min((found?.seconds ?? 0) / (found?.budget ?? 12), 1);
    const other = running && !fresh ? text('tradeoff.of-before') : '';
    if (!found || found.error) this.said.textContent = found?.error ? said(found.error) : text('tradeoff.idle');
    else if (points.length) this.said.textContent = [wordsOf(found, running), other].filter(Boolean).join(' ');
    else this.said.textContent = text('tradeoff.no-table', { running });
    const remarks = (found?.remarks ?? []).map((remark) => make('p', { textContent: said(remark) }));
    const summary = make('summary', { textContent: text('tradeoff.remarks') });
    this.remarks.hidden = !remarks.length; // or browsers name it themselves
    this.remarks.replaceChildren(...(remarks.length ? [summary, ...remarks] : []));
    this.sides.hidden = !points.length;
    if (points.length) this.plot();
  }
  // What the chosen quantity makes of the points.
  plot() {
    const found = /** @type {Table | null} */ (this.answer);
    const { figure, quantity } = this;
    const { method, modes, elements } = this.page.frame.chosen;
    const drawn = JSON.stringify([this.came, quantity, method, modes, elements]);
    if (!found?.points?.length || !figure || drawn === this.drawn) return;
    this.drawn = drawn;
    this.kinds.show(quantity);
    const sizeOf = (/** @type {Row} */ row) => Math.abs(row.errors[quantity] ?? NaN);
    const floor = Math.max(found.reference.uncertainty?.[quantity] ?? 0, LEAST);
    const known = found.points.map(sizeOf).filter((error) => error > 10 * floor);
    const least = Math.max(floor / 2, Math.min(...known, 1) / LEFT); // what is nearer by far lies at the lower edge
    this.points = found.points
      .filter((row) => Number.isFinite(sizeOf(row)))
      .map((row) => ({ ...row, time: 1e3 * row.wall_time, size: 100 * Math.max(sizeOf(row), least) }))
      .sort((a, b) => a.time - b.time);
    const unknown = 100 * Math.max(floor, 2 * least); // below the uncertainty of the truth nothing is known
    const times = this.points.map((p) => p.time);
    const sizes = this.points.map((p) => p.size);
    figure.range('tradeoff-x', [0.6 * Math.min(...times, 1), 1.7 * Math.max(...times, 10)]);
    figure.range('tradeoff-y', [0.5 * Math.min(...sizes, unknown), 2.5 * Math.max(...sizes, 10)]);
    figure.set('tradeoff-unknown', { top: unknown });
    figure.set('tradeoff-up', { axis_label: text('tradeoff.error-axis', { of: quantity }) });
    const { label } = this.picked ?? {};
    this.picked = this.points.find((p) => p.label === label) ?? null;
    this.#fill(figure);
    this.mark();
  }
  /** @param {Figure} figure */
  #fill(figure) {
    const { points, quantity } = this;
    const column = (/** @type {Point[]} */ from) => ({ time: from.map((p) => p.time), size: from.map((p) => p.size) });
    const ladders = [...new Set(points.map((p) => p.ladder))].map((one) => points.filter((p) => p.ladder === one));
    const joined = ladders.map(column);
    figure.fill('ladders', {
      times: joined.map(({ time }) => time),
      sizes: joined.map(({ size }) => size),
      colour: ladders.map((own) => signOf(own[0].rank).color),
    });
    figure.fill('front', column(this.front()));
    figure.fill('rest', column(this.rest()));
    const claimed = quantity === 'rebound' ? points.filter((p) => (p.estimated_error ?? 0) > 0) : [];
    figure.fill('claims', {
      ...column(claimed),
      claim: claimed.map((p) => 100 * Number(p.estimated_error)),
      colour: claimed.map((p) => signOf(p.rank).color),
      label: claimed.map((p) => described(p.label)),
      claimed: claimed.map((p) => share(Number(p.estimated_error))),
    });
    figure.set('tradeoff-key-3', { visible: claimed.length > 0 });
    const here = points.map((p) => shown(this.page, p.method));
    figure.fill('points', {
      ...column(points),
      colour: points.map((p) => signOf(p.rank).color),
      marker: points.map((p) => signOf(p.rank).marker),
      diameter: points.map((p) => signOf(p.rank).size * (p.best_for.includes(quantity) ? BEST : USUAL)),
      edge: points.map((p, k) => (here[k] ? PICKED : p.best_for.includes(quantity) ? '#1c2733' : '#fff')),
      width: here.map((each) => (each ? 2.5 : 1)),
      label: points.map((p) => described(p.label)),
      method: points.map((p) => shortly(p.method)), // in the legend, which has little room
      solve: points.map((p) => ms(p.wall_time)),
      error: points.map((p) => signed(p.errors[quantity])),
      contacts: points.map(contactsOf),
    });
  }
  #numbers() {
    const { points, quantity } = this;
    const best = (/** @type {Point} */ p) => (p.best_for.includes(quantity) ? text('tradeoff.pareto') : '');
    return [
      [text('tradeoff.column.method'), COLUMNS.solve, errorIn(quantity), COLUMNS.contacts, ''],
      ...points.map((p) => [
        ...[described(p.label), ms(p.wall_time), signed(p.errors[quantity]), contactsOf(p), best(p)],
      ]),
    ];
  }
  // What nothing beats in time and error at once; and the same without exact waves.
  front() {
    return this.points.filter((p) => p.best_for.includes(this.quantity));
  }
  rest() {
    let best = Infinity;
    if (!this.front().some(({ exact }) => exact)) return [];
    return this.points.filter((p) => !p.exact && p.size < best && (best = p.size));
  }
  /** @param {number} way */
  step(way) {
    const { points, picked } = this;
    if (!points.length) return;
    const at = picked ? points.indexOf(picked) : -1;
    this.pick(points[at < 0 ? 0 : (at + way + points.length) % points.length]);
  }
  /** @param {Point | null} point */
  pick(point) {
    if (point === this.picked) return;
    this.picked = point;
    this.mark();
  }
  mark() {
    const { points, picked } = this;
    const selected = this.figure?.model('points')?.selected;
    if (selected) selected.indices = picked ? [points.indexOf(picked)] : [];
    this.point.replaceChildren(...(picked ? this.#about(picked) : this.#best()));
  }
  // The best there are.
  #best() {
    const rest = this.rest();
    const line = (/** @type {Point} */ p) => {
      const show = make('button', { type: 'button', className: 'when', textContent: described(p.label) });
      show.onclick = () => showMethod(this.page, p.method);
      const here = shown(this.page, p.method) ? { ariaCurrent: 'true' } : {};
      return rowOf([show, ms(p.wall_time), signed(p.errors[this.quantity])], here);
    };
    const others = make('th', { scope: 'rowgroup', colSpan: 3, textContent: text('tradeoff.without-waves') });
    const between = make('tr', {}, others);
    const rows = [...this.front().map(line), ...(rest.length ? [between, ...rest.map(line)] : [])];
    const head = headOf([COLUMNS.best, COLUMNS.solve, COLUMNS.error]);
    return [
      make('table', { className: 'methods' }, head, make('tbody', {}, ...rows)),
      make('p', { className: 'help', textContent: text('tradeoff.help', { ripples: this.#ripples() }) }),
    ];
  }
  /** Whether the error is that of a peak which modes only draw as a ripple. */
  #ripples() {
    const { frame } = this.page;
    const jumps = 'rods' in frame && frame.rods.length > 0 && frame.rigid;
    return jumps && this.quantity === 'peak-force';
  }
  /**
   * One point.
   * @param {Point} p
   */
  #about(p) {
    const [least, most] = (p.spread ?? []).map(ms);
    const invented = { contacts: contactsOf(p), count: p.invented_contacts };
    const rows = [
      [ROWS.solve, p.spread ? text('tradeoff.spread', { time: ms(p.wall_time), least, most }) : ms(p.wall_time)],
      ...Object.keys(QUANTITIES)
        .filter((name) => name in p.errors)
        .map((name) => [errorIn(name), signed(p.errors[name])]),
      [ROWS.own, p.estimated_error === null ? '–' : `± ${share(p.estimated_error)}`],
      [ROWS.contacts, text('tradeoff.invented', invented)],
    ];
    return [
      make('h3', { textContent: described(p.label) }),
      make('table', {}, make('tbody', {}, ...rows.map((cells) => rowOf(cells)))),
      ...p.note_codes.slice(0, 2).map((note) => make('p', { className: 'help', textContent: said(note) })),
    ];
  }
}

export const PANELS = { tradeoff: TradeOff }; // by their names in the address
