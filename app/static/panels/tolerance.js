// A tolerance or a computing time instead of a method: what was chosen, why, and how near it really is.
import { headOf, make, rowOf } from '../shell/dom.js';
import { figures, percentDecade, share } from '../text/format.js';
import { described, said } from '../text/catalogue.js';
import { Panel, QUANTITIES, showMethod, shown } from './panel.js';
import { msField, percentField } from './unit_field.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Found
 * @property {string} [error]  why there is nothing
 * @property {Record<string, any>} chosen
 * @property {string} label  of the method that was chosen, with its resolution
 * @property {string} name  of it
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
const LATE = 500; // ms of a search before it can be cancelled
/** @type {Record<string, string>} */
const WITHIN = { tolerance: 'an error', time: 'a computing time' };
const ASKED = ['auto_within', 'auto_quantity', 'auto_tolerance', 'auto_budget', 'auto_waves'];

/** @param {Record<string, string>} names */
const optionsOf = (names) =>
  Object.entries(names).map(([value, textContent]) => make('option', { value, textContent }));

export class Tolerance extends Panel {
  left = false; // the visitor has cancelled the search
  running = false;
  /** @type {number | undefined} */ appearing; // of the button that cancels

  /** @param {Page} page */
  constructor(page) {
    const title = 'say how near the answer must be, or how long it may take, and the page chooses the method';
    super(page, 'auto', 'Choose method by error', title, 'A tolerance or a time instead of a method', ASKED);
    this.quantity = make('select', { ariaLabel: 'Quantity' }, ...optionsOf(QUANTITIES));
    this.quantity.onchange = () => this.ask('auto_quantity', this.quantity.value);
    this.within = make('select', { ariaLabel: 'Keep to' }, ...optionsOf(WITHIN));
    this.within.onchange = () => this.ask('auto_within', this.within.value);
    const complain = (/** @type {string} */ sentence) => page.complain(sentence);
    this.tolerance = percentField('within', 1e-6, 0.5, (value) => this.ask('auto_tolerance', value), complain);
    this.budget = msField('within', 1e-4, 6, (value) => this.ask('auto_budget', value), complain);
    this.stop = make('button', { type: 'button', className: 'whole', onclick: () => this.cancel() });
    for (const name of ['auto_running', 'auto_follows']) page.model.on(name, () => this.fill());
    this.waves = make('input', { type: 'checkbox', onchange: () => this.ask('auto_waves', this.waves.checked) });
    this.mayBeWaves = make('label', { className: 'part' }, this.waves, 'exact waves may be chosen');
    this.shows = make('input', { type: 'checkbox', onchange: () => this.ask('auto_follows', this.shows.checked) });
    this.said = make('p', { className: 'verdict', role: 'status' });
    this.scale = make('div', { className: 'proof', role: 'img' });
    this.why = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods' });
    this.judged = make('span');
    const form = make(
      'div',
      { className: 'record-form' },
      make('label', { className: 'part' }, 'Keep to', this.within),
      this.tolerance.root,
      this.budget.root,
      make('label', { className: 'part' }, this.judged, this.quantity),
      this.mayBeWaves,
      make('label', { className: 'part' }, this.shows, 'show on the page what is chosen'),
      this.stop,
    );
    this.root.append(form, this.said, this.scale, this.why, make('div', { className: 'scroll' }, this.table));
    this.choice();
  }
  // Stop the search, or take it up again.
  cancel() {
    const { model } = this.page;
    this.left = model.auto_running;
    model.auto_running = !this.left;
    this.fill();
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
    input.append(make('option', { value: 'auto', textContent: 'Chosen by a tolerance …' }));
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
  told(found, fresh) {
    const { model } = this.page;
    this.quantity.value = model.auto_quantity;
    this.within.value = model.auto_within;
    this.tolerance.set(model.auto_tolerance);
    this.budget.set(model.auto_budget);
    this.tolerance.root.hidden = model.auto_within === 'time';
    this.budget.root.hidden = !this.tolerance.root.hidden;
    this.judged.textContent = this.budget.root.hidden ? 'in the' : 'and tell the error in the';
    this.waves.checked = model.auto_waves;
    this.mayBeWaves.hidden = Boolean(this.page.frame.refusals?.waves) || this.page.frame.kind === 'bodies';
    this.shows.checked = this.follows;
    this.named();
    this.root.ariaBusy = String(!fresh);
    this.late(model.auto_running, fresh && found ? found.cancelled : this.left);
    if (!found || !fresh) {
      if (this.left) this.said.textContent = 'Cancelled: nothing is known of these choices yet.';
      else if (!found) this.said.textContent = 'Solving, from coarse to fine …';
      return;
    }
    this.scale.hidden = Boolean(found.error);
    if (found.error) {
      this.said.textContent = found.error;
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
  /**
   * An answer that comes soon needs no button to stop it; one that was stopped may be asked for again.
   * @param {boolean} running
   * @param {boolean} left
   */
  late(running, left) {
    this.stop.textContent = running ? 'Cancel' : 'Work it out';
    if (running !== this.running) {
      clearTimeout(this.appearing);
      this.stop.hidden = true;
      if (running) {
        this.left = false;
        this.appearing = window.setTimeout(() => (this.stop.hidden = false), LATE);
      }
    }
    this.running = running;
    if (!running) this.stop.hidden = !left;
  }
  /** @param {Found} found */
  verdict(found) {
    const method = methodOf(found);
    const here = method !== null && shown(this.page, method);
    const show = make('button', { type: 'button', className: 'when', textContent: 'Show it on the page' });
    show.onclick = () => method && showMethod(this.page, method);
    const finer = ' It is finer than the sliders of the page.';
    const shows = here ? [' The page shows it.'] : method ? [' ', show] : [finer];
    const slow = this.follows && found.cost > QUICK && !here;
    const seconds = figures(found.cost, 2);
    this.said.replaceChildren(
      found.cancelled ? 'Cancelled; the best by then: ' : 'Chosen: ',
      make('b', { textContent: described(found.label) }),
      `, with ${estimateOf(found)} in the ${QUANTITIES[found.chosen.auto_quantity]}. ${truthOf(found)}${keptOf(found)}`,
      ...(slow ? [` It takes ${seconds} s an impact, too long to follow the sliders.`] : []),
      ...shows,
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
      ['asked', asked, 'allowed'],
      ['estimate', found.estimate, 'estimated'],
      ['true', found.true, 'true'],
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
      const text = make('span', { textContent: `${word} ${error === 0 ? '0 %' : share(error)}` });
      const mark = make('i', { className: `mark ${kind}${error < EARLY ? ' early' : ''}` }, text);
      mark.title = `${word}: ${share(error)}`;
      mark.style.left = place(error);
      return mark;
    });
    this.scale.replaceChildren(allowed, ...ticks, ...drawn);
    this.scale.ariaLabel = marks.map(({ error, word }) => `${word} error ${share(error)}`).join(', ');
  }
  /** @param {Found} found */
  tried(found) {
    const rows = found.tried.map(({ label, cost, estimated_error: error }) =>
      rowOf(
        [
          described(label) + (label === found.proof ? ' (the proof)' : ''),
          figures(1e3 * cost, 2),
          error === null ? '–' : share(error),
        ],
        label === found.label ? { ariaCurrent: 'true' } : {},
      ),
    );
    const head = headOf(['Solved on the way', 'costs, ms', 'misses, est.']);
    this.table.replaceChildren(head, make('tbody', {}, ...rows));
  }
}

/**
 * What was chosen, if the page can show it.
 * @param {Found} found
 */
const methodOf = ({ choices }) => choices && { ...choices, name: choices.method };

/** @param {Found} found */
function estimateOf({ estimate }) {
  if (estimate === null) return 'an error that nothing here tells';
  return estimate === 0 ? 'no estimated error' : `an estimated error of ${share(estimate)}`;
}

/** @param {Found} found */
function truthOf({ name, true: error }) {
  if (error === null) return 'No exact solution of this scene is known.';
  if (error === 0 && name === 'waves') return 'These are the exact waves themselves.';
  return `Against the exact waves it really misses ${share(error)}.`;
}

/**
 * How far what was asked for is kept.
 * @param {Found} found
 */
function keptOf({ chosen, estimate, met, wall_time: seconds }) {
  const { auto_budget: budget, auto_tolerance: tolerance } = chosen;
  const allowed = `${figures(1e3 * budget, 3)} ms were allowed.`;
  if (met === null) return ` All that was solved on the way took ${figures(1e3 * seconds, 2)} ms; ${allowed}`;
  if (met) return '';
  const within = estimate !== null && estimate <= tolerance;
  return within ? ' Nothing finer proves it.' : ` Not ${share(tolerance)} as asked for.`;
}
