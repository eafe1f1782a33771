// A tolerance or a computing time instead of a method: what was chosen, why, and how near it really is.
import { headOf, make, rowOf, scrolled } from '../browser/dom.js';
import { figures, percentDecade, share } from '../text/format.js';
import { described, family, said, text } from '../text/catalogue.js';
import { Panel, QUANTITIES, showMethod, shown } from './panel.js';
import { Stopper } from './stopper.js';
import { msField, percentField } from './unit_field.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Found
 * @property {Note} [error]  why there is nothing
 * @property {Record<string, any>} chosen
 * @property {string} label  of the method that was chosen, with its resolution
 * @property {boolean} exact
 * @property {{ method: string, modes?: number, elements?: number } | null} choices  of the page, that show it
 * @property {number} cost  of one solve [s]
 * @property {number | null} estimate  of its error
 * @property {number | null} true  its error against the exact waves
 * @property {boolean | null} met  whether the tolerance is kept; null where a time was given
 * @property {Note[]} notes  why it was chosen first
 * @property {string | null} proof  label of what it was compared with
 * @property {{ label: string, cost: number, estimated_error: number | null }[]} tried
 * @property {number} wall_time  of all that was tried [s]
 * @property {boolean} cancelled
 */

const LOWEST = 1e-12; // error at the left end of the scale
const EARLY = 1e-9; // below which a mark is written to its right
const QUICK = 0.25; // s of a solve that a slider can wait for
const WITHIN = family('tolerance.within');
const ASKED = ['auto_within', 'auto_quantity', 'auto_tolerance', 'auto_budget', 'auto_waves'];

/** @param {Record<string, string>} names */
const optionsOf = (names) =>
  Object.entries(names).map(([value, textContent]) => make('option', { value, textContent }));

class Tolerance extends Panel {
  static beside = true; // has room in the dock; the charts stay
  /** @param {Page} page */
  constructor(page) {
    super(page, 'auto', text('tolerance.button'), text('tolerance.title'), text('tolerance.heading'), ASKED);
    this.quantity = make('select', { ariaLabel: text('tolerance.quantity') }, ...optionsOf(QUANTITIES));
    this.quantity.onchange = () => this.ask('auto_quantity', this.quantity.value);
    this.within = make('select', { ariaLabel: text('tolerance.keep-to') }, ...optionsOf(WITHIN));
    this.within.onchange = () => this.ask('auto_within', this.within.value);
    const bound = text('tolerance.bound');
    this.tolerance = percentField(bound, 1e-6, 0.5, (value) => this.ask('auto_tolerance', value));
    this.budget = msField(bound, 1e-4, 6, (value) => this.ask('auto_budget', value));
    this.stopper = new Stopper(page.model, 'auto_running', () => this.fill());
    page.model.on('auto_follows', () => this.fill());
    this.waves = make('input', { type: 'checkbox', onchange: () => this.ask('auto_waves', this.waves.checked) });
    this.mayBeWaves = make('label', { className: 'part' }, this.waves, text('tolerance.waves'));
    this.shows = make('input', { type: 'checkbox', onchange: () => this.ask('auto_follows', this.shows.checked) });
    this.said = make('p', { className: 'verdict', role: 'status' });
    this.scale = make('div', { className: 'proof', role: 'img', hidden: true });
    this.why = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods' });
    this.judged = make('span');
    const form = make(
      'div',
      { className: 'record-form' },
      make('label', { className: 'part' }, text('tolerance.keep-to'), this.within),
      this.tolerance.root,
      this.budget.root,
      make('label', { className: 'part' }, this.judged, this.quantity),
      this.mayBeWaves,
      make('label', { className: 'part' }, this.shows, text('tolerance.follow')),
      this.stopper.root,
    );
    this.root.append(form, this.said, this.scale, this.why, scrolled(this.table, text('tolerance.heading')));
    this.choice();
  }
  // Whether the page shows what is chosen.
  get follows() {
    return this.page.model.auto_follows;
  }
  set follows(value) {
    this.page.model.auto_follows = value;
  }
  // "By tolerance" among the methods of the page.
  choice() {
    const input = this.page.controls.method;
    const pick = () => this.page.send('method', input.value);
    input.append(make('option', { value: 'auto', textContent: text('tolerance.option') }));
    input.onchange = () => {
      const { value } = input;
      this.follows = value === 'auto';
      if (!this.follows) {
        input.value = value; // the list names what is shown meanwhile
        pick();
        this.fill();
        return;
      }
      if (!this.open) this.page.analyses.open(this);
      else this.fill();
    };
    this.page.model.on('method', () => this.named());
  }
  named() {
    const { page } = this;
    page.controls.method.value = this.follows && this.open ? 'auto' : page.model.method;
  }
  opened() {
    if (!this.open) this.follows = false;
    this.named();
  }
  /**
   * @param {string} name
   * @param {number | string | boolean} value
   */
  ask(name, value) {
    this.page.model[name] = value;
    this.fill();
  }
  /**
   * @param {Found | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    const { model } = this.page;
    this.quantity.value = model.auto_quantity;
    this.within.value = model.auto_within;
    this.tolerance.set(model.auto_tolerance);
    this.budget.set(model.auto_budget);
    this.tolerance.root.hidden = model.auto_within === 'time';
    this.budget.root.hidden = !this.tolerance.root.hidden;
    this.judged.textContent = text('tolerance.judged', { time: model.auto_within === 'time' });
    this.waves.checked = model.auto_waves;
    this.mayBeWaves.hidden = this.page.frame.refusals.waves !== null; // refused, or never asked of it
    this.shows.checked = this.follows;
    this.named();
    this.root.ariaBusy = String(!fresh);
    this.stopper.show(fresh && found ? found.cancelled : this.stopper.left);
    if (!found || !fresh) {
      if (this.stopper.left) this.said.textContent = text('tolerance.cancelled');
      else if (!found) this.said.textContent = text('tolerance.idle');
      return;
    }
    this.scale.hidden = Boolean(found.error);
    if (found.error) {
      this.said.textContent = said(found.error);
      this.why.textContent = '';
      this.table.replaceChildren();
      return;
    }
    this.verdict(found);
    this.proof(found);
    this.why.textContent = found.notes.map(said).join(' ');
    this.tried(found);
    const method = methodOf(found);
    if (this.follows && found.cost <= QUICK && method && !shown(this.page, method)) showMethod(this.page, method);
  }
  /** @param {Found} found */
  verdict(found) {
    const method = methodOf(found);
    const here = method !== null && shown(this.page, method);
    const show = make('button', { type: 'button', className: 'when', textContent: text('tolerance.show') });
    show.onclick = () => {
      if (method) showMethod(this.page, method);
    };
    const exact = found.true === 0 && found.exact;
    const words = [truthOf(found, exact && here), keptOf(found)];
    if (this.follows && found.cost > QUICK && !here) words.push(text('tolerance.slow', { time: found.cost }));
    if (!method) words.push(text('tolerance.finer'));
    else if (here && !exact) words.push(text('tolerance.shown'));
    this.said.replaceChildren(
      text('tolerance.chosen', { cancelled: found.cancelled }),
      make('b', { textContent: described(found.label) }),
      `${estimateOf(found)} ${words.filter(Boolean).join(' ')} `,
      ...(here || !method ? [] : [show]),
    );
  }
  /**
   * What is asked, estimated and true, on one logarithmic line.
   * @param {Found} found
   */
  proof(found) {
    const place = (/** @type {number} */ error) =>
      `${100 * (1 - Math.log(Math.max(error, LOWEST)) / Math.log(LOWEST))}%`;
    const asked = found.met === null ? null : found.chosen.auto_tolerance;
    /** @type {[kind: string, error: number | null, word: string][]} */
    const all = [
      ['asked', asked, text('tolerance.mark.asked')],
      ['estimate', found.estimate, text('tolerance.mark.estimate')],
      ['true', found.true, text('tolerance.mark.true')],
    ];
    const marks = all.flatMap(([kind, error, word]) => (error === null ? [] : [{ kind, error, word }]));
    const ticks = [-12, -9, -6, -4, -2, 0].map((power) => {
      const tick = make('i', { className: 'tick', textContent: percentDecade(power) });
      tick.style.left = place(10 ** power);
      return tick;
    });
    const allowed = make('i', { className: 'allowed', hidden: asked === null });
    allowed.style.width = place(asked ?? LOWEST);
    const drawn = marks.map(({ kind, error, word }) => {
      const label = make('span', { textContent: `${word} ${share(error)}` });
      const mark = make('i', { className: `mark ${kind}${error < EARLY ? ' early' : ''}` }, label);
      mark.title = `${word}: ${share(error)}`;
      mark.style.left = place(error);
      return mark;
    });
    this.scale.replaceChildren(allowed, ...ticks, ...drawn);
    this.scale.ariaLabel = marks
      .map(({ error, word }) => text('tolerance.mark.error', { word, error: share(error) }))
      .join(', ');
  }
  /** @param {Found} found */
  tried(found) {
    const rows = found.tried.map(({ label, cost, estimated_error: error }) =>
      rowOf(
        [
          text('tolerance.tried', { method: label, proof: label === found.proof }),
          figures(1e3 * cost, 2),
          error === null ? '–' : share(error),
        ],
        label === found.label ? { ariaCurrent: 'true' } : {},
      ),
    );
    const head = headOf(['solved', 'cost', 'error'].map((name) => text(`tolerance.column.${name}`)));
    this.table.replaceChildren(head, make('tbody', {}, ...rows));
  }
}

/**
 * What was chosen, if the page can show it.
 * @param {Found} found
 */
const methodOf = ({ choices }) => choices && { ...choices, name: choices.method };

/** @param {Found} found */
function estimateOf({ chosen, estimate }) {
  const quantity = QUANTITIES[chosen.auto_quantity];
  const known = estimate === null ? 'unknown' : estimate ? 'known' : 'none';
  return text('tolerance.estimate', { known, quantity, error: share(estimate ?? 0), of: chosen.auto_quantity });
}

/**
 * @param {Found} found
 * @param {boolean} here  it is exact, and shown
 */
function truthOf({ chosen, exact, true: error }, here) {
  if (error === null) return text('tolerance.no-exact');
  if (error === 0 && exact) return text('tolerance.exact', { here });
  return text('tolerance.true', { error: share(error), of: chosen.auto_quantity });
}

/**
 * How far what was asked for is kept.
 * @param {Found} found
 */
function keptOf({ chosen, estimate, met, wall_time: seconds }) {
  const { auto_budget: budget, auto_tolerance: tolerance } = chosen;
  if (met === null) return text('tolerance.took', { took: seconds, allowed: budget });
  if (met) return '';
  const within = estimate !== null && estimate <= tolerance;
  return text('tolerance.not-kept', { within, asked: share(tolerance) });
}

export const PANELS = { tolerance: Tolerance }; // by their names in the address
