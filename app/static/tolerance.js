// A tolerance or a computing time instead of a method: what was chosen, why, and how near it really is.
import { msField, percentField, share } from './advice.js';
import { figures } from './beam_stage.js';
import { percentDecade } from './logplot.js';
import { make, Panel, QUANTITIES, showMethod, shown } from './panel.js';
import { described, plainly } from './words.js';

const LOWEST = 1e-12, EARLY = 1e-9, QUICK = 0.25; // s of a solve that a slider can wait for
const LATE = 500; // ms
const WITHIN = { tolerance: 'an error', time: 'a computing time' };

export class Tolerance extends Panel {
  constructor(page) {
    super(page, 'auto', 'Within a tolerance', 'say how near the answer must be, or how long it may take, and the page chooses the method', 'A tolerance or a time instead of a method', ['auto_within', 'auto_quantity', 'auto_tolerance', 'auto_budget', 'auto_waves']);
    this.quantity = make('select', { ariaLabel: 'Quantity' }, ...Object.entries(QUANTITIES).map(([value, textContent]) => make('option', { value, textContent })));
    this.quantity.onchange = () => this.ask('auto_quantity', this.quantity.value);
    const complain = (sentence) => page.complain(sentence);
    this.within = make('select', { ariaLabel: 'Keep to' }, ...Object.entries(WITHIN).map(([value, textContent]) => make('option', { value, textContent })));
    this.within.onchange = () => this.ask('auto_within', this.within.value);
    this.tolerance = percentField('within', 1e-6, 0.5, (value) => this.ask('auto_tolerance', value), complain);
    this.budget = msField('within', 1e-4, 6, (value) => this.ask('auto_budget', value), complain);
    this.stop = make('button', { type: 'button', className: 'whole', onclick: () => { this.left = page.model.auto_running; page.model.auto_running = !this.left; this.fill(); } });
    for (const name of ['auto_running', 'auto_follows']) page.model.on(name, () => this.fill());
    this.waves = make('input', { type: 'checkbox', onchange: () => this.ask('auto_waves', this.waves.checked) });
    this.shows = make('input', { type: 'checkbox', onchange: () => { this.follows = this.shows.checked; this.fill(); } });
    this.said = make('p', { className: 'verdict', role: 'status' });
    this.scale = make('div', { className: 'proof', role: 'img' });
    this.why = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods' });
    this.root.append(make('div', { className: 'record-form' }, make('label', { className: 'part' }, 'Keep to', this.within), this.tolerance.root, this.budget.root, make('label', { className: 'part' }, this.judged = make('span'), this.quantity), make('label', { className: 'part' }, this.waves, 'exact waves may be chosen'), make('label', { className: 'part' }, this.shows, 'show on the page what is chosen'), this.stop), this.said, this.scale, this.why, make('div', { className: 'scroll' }, this.table));
    this.choice();
  }
  // Whether the page shows what is chosen.
  get follows() { return this.page.model.auto_follows; }
  set follows(value) { this.page.model.auto_follows = value; }
  // "By tolerance" among the methods of the page.
  choice() {
    const { input } = this.page.controls.fields.method, pick = input.onchange;
    input.append(make('option', { value: 'auto', textContent: 'Chosen by a tolerance …' }));
    input.onchange = () => {
      const { value } = input;
      this.follows = value === 'auto';
      if (!this.follows) { input.value = value; pick(); this.fill(); return; } // the list names what is shown meanwhile
      if (!this.open) this.toggle();
      else this.fill();
    };
    this.page.model.on('method', () => this.named());
  }
  named() {
    const { page } = this;
    page.controls.fields.method.input.value = this.follows && this.open ? 'auto' : page.model.method;
  }
  opened() { if (!this.open) this.follows = false; this.named(); }
  ask(name, value) {
    this.page.model[name] = value;
    this.fill();
  }
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
    this.waves.parentElement.hidden = Boolean(this.page.frame.refusals?.waves) || this.page.frame.kind === 'bodies';
    this.shows.checked = this.follows;
    this.named();
    this.root.setAttribute('aria-busy', String(!fresh));
    this.late(model.auto_running, fresh ? found.cancelled : this.left);
    if (!fresh) {
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
    this.why.textContent = plainly([found.why, ...found.doubts].join(' '));
    this.tried(found);
    if (this.follows && found.cost <= QUICK && found.choices && !shown(this.page, { ...found.choices, name: found.choices.method })) showMethod(this.page, { ...found.choices, name: found.choices.method });
  }
  // An answer that comes soon needs no button to stop it; one that was stopped may be asked for again.
  late(running, left) {
    this.stop.textContent = running ? 'Cancel' : 'Work it out';
    if (running !== this.running) {
      clearTimeout(this.waiting);
      this.stop.hidden = true;
      if (running) { this.left = false; this.waiting = setTimeout(() => { this.stop.hidden = false; }, LATE); }
    }
    this.running = running;
    if (!running) this.stop.hidden = !left;
  }
  verdict(found) {
    const { page } = this, method = found.choices && { ...found.choices, name: found.choices.method }, here = method && shown(page, method);
    const show = method && !here ? [' ', make('button', { type: 'button', className: 'when', textContent: 'Show it on the page', onclick: () => showMethod(page, method) })] : here ? [' The page shows it.'] : [' It is finer than the sliders of the page.'];
    const slow = this.follows && found.cost > QUICK && !here ? [` It takes ${figures(found.cost, 2)} s a blow, too long to follow the sliders.`] : [];
    const told = found.estimate === null ? 'an error that nothing here tells' : found.estimate === 0 ? 'no estimated error' : `an estimated error of ${share(found.estimate)}`;
    const true_ = found.true === null ? 'No exact solution of this scene is known.' : found.true === 0 && found.name === 'waves' ? 'These are the exact waves themselves.' : `Against the exact waves it really misses ${share(found.true)}.`;
    const kept = found.met === null ? ` All that was solved on the way took ${figures(1e3 * found.wall_time, 2)} ms; ${figures(1e3 * found.chosen.auto_budget, 3)} ms were allowed.` : found.met ? '' : found.estimate !== null && found.estimate <= found.chosen.auto_tolerance ? ' Nothing finer proves it.' : ` Not ${share(found.chosen.auto_tolerance)} as asked for.`;
    this.said.replaceChildren(found.cancelled ? 'Cancelled; the best by then: ' : 'Chosen: ', make('b', { textContent: described(found.label) }), `, with ${told} in the ${QUANTITIES[found.chosen.auto_quantity]}. ${true_}${kept}`, ...slow, ...show);
  }
  // What is asked, estimated and true, on one logarithmic line.
  proof(found) {
    const place = (error) => `${100 * (1 - Math.log(Math.max(error, LOWEST)) / Math.log(LOWEST))}%`;
    const asked = found.met === null ? null : found.chosen.auto_tolerance;
    const marks = [['asked', asked, 'allowed'], ['estimate', found.estimate, 'estimated'], ['true', found.true, 'true']].filter(([, error]) => error !== null);
    const ticks = [-12, -9, -6, -4, -2, 0].map((power) => { const tick = make('i', { className: 'tick', textContent: percentDecade(power) }); tick.style.left = place(10 ** power); return tick; });
    const allowed = make('i', { className: 'allowed' });
    if (asked !== null) allowed.style.width = place(asked);
    this.scale.replaceChildren(...(asked === null ? [] : [allowed]), ...ticks, ...marks.map(([kind, error, word]) => { const mark = make('i', { className: `mark ${kind}${error < EARLY ? ' early' : ''}`, title: `${word}: ${share(error)}` }, make('span', { textContent: `${word} ${error === 0 ? '0 %' : share(error)}` })); mark.style.left = place(error); return mark; }));
    this.scale.setAttribute('aria-label', marks.map(([, error, word]) => `${word} error ${share(error)}`).join(', '));
  }
  tried(found) {
    const head = make('thead', {}, make('tr', {}, ...['Solved on the way', 'costs, ms', 'misses, est.'].map((textContent) => make('th', { scope: 'col', textContent }))));
    const rows = found.tried.map((row) => {
      const line = make('tr', {}, make('td', { textContent: described(row.label) + (row.label === found.proof ? ' (the proof)' : '') }), make('td', { textContent: figures(1e3 * row.cost, 2) }), make('td', { textContent: row.estimated_error === null ? '–' : share(row.estimated_error) }));
      if (row.label === found.label) line.setAttribute('aria-current', 'true');
      return line;
    });
    this.table.replaceChildren(head, make('tbody', {}, ...rows));
  }
}
