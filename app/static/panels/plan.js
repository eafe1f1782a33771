// Which model is enough?: the smallest adequate model for a question, and where the impact lies among all others.
import { headOf, make, rowOf, scrolled } from '../browser/dom.js';
import { family, leftOut, modelled, named, said, text } from '../text/catalogue.js';
import { pretty, share } from '../text/format.js';
import { RegimeMap } from './regime_map.js';
import { percentField } from './unit_field.js';

/** @import { Page } from '../page.js' */
/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Note, Parts } from '../text/catalogue.js' */
/** @import { Regimes } from './regime_map.js' */

/**
 * @typedef {object} Candidate
 * @property {Parts} model
 * @property {number | null} error
 * @property {boolean} [unknown]  nobody has measured it
 * @property {Chosen | null} choices  of the page, that show it
 */
/**
 * @typedef {object} Plan
 * @property {Note} [error]  why there is none
 * @property {Record<string, any>} chosen
 * @property {Candidate[]} candidates  from the smallest up
 * @property {number} picked
 * @property {Note} why
 * @property {{ contact_time?: number, mass_ratio?: number }} groups  what is known of them
 * @property {boolean} measured
 * @property {boolean} light  whether rigid bodies are exact enough
 */

const QUESTIONS = family('name.question');

/**
 * Choices of the page that show one model, all at once.
 * @param {Page} page
 * @param {Chosen} choices
 */
export function choose(page, choices) {
  const [[name, value], ...rest] = Object.entries(choices);
  Object.assign(page.waiting, Object.fromEntries(rest));
  page.send(name, value);
}

/**
 * What is written below the map.
 * @param {Regimes} map
 * @param {boolean} measured
 */
function aboutMap(map, measured) {
  const struck = named('family', map.family);
  return text('map.about', { struck, law: map.law, measured, question: QUESTIONS[map.question] });
}

/**
 * What the errors are, from when on a body that rings is as good as rigid, and where this impact lies.
 * @param {Frame} frame
 * @param {Plan} found
 */
function ruleOf(frame, { groups, light }) {
  const beam = 'main' in frame;
  const { contact_time: lasts } = groups;
  if (lasts === undefined) return ''; // of compact bodies, and of mechanisms, no such time is known
  const rule = text('plan.rule', { beam, light, rigid: lasts === 0, time: pretty(lasts) });
  return `${text('plan.around', { beam })} ${rule}`;
}

class Needs {
  /** @type {string | null} */ point = null; // that was asked for on the map, and not sent

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', textContent: text('plan.heading') });
    this.button.title = text('plan.title');
    const options = Object.entries(QUESTIONS).map(([value, textContent]) => make('option', { value, textContent }));
    this.question = make('select', { ariaLabel: text('plan.question') }, ...options);
    this.question.onchange = () => this.ask('question', this.question.value);
    const send = (/** @type {number} */ value) => this.ask('plan_tolerance', value);
    this.tolerance = percentField(text('plan.tolerance'), 1e-4, 0.5, send);
    this.said = make('p', { className: 'verdict' });
    this.reason = make('p', { className: 'help' });
    this.table = make('table', { className: 'methods plan' });
    this.map = new RegimeMap((point) => {
      this.point = point;
      this.go();
    });
    page.model.on('map_point', () => this.go());
    const asked = make('label', { className: 'part' }, text('plan.asked'), this.question);
    const form = make('div', { className: 'record-form' }, asked, this.tolerance.root);
    const scroll = scrolled(this.table, text('plan.heading'));
    const left = make('div', { className: 'plan-answer' }, form, this.said, scroll, this.reason);
    const sides = make('div', { className: 'sides' }, left, this.map.root);
    const heading = make('h2', { textContent: text('plan.heading') });
    this.root = make('section', { className: 'analysis needs', hidden: true }, heading, sides);
    for (const name of ['plan', 'regimes', 'question', 'plan_tolerance']) page.model.on(name, () => this.fill());
  }
  get open() {
    return this.page.model.plan_shown;
  }
  toggle() {
    this.page.model.plan_shown = !this.open;
    this.take();
  }
  /**
   * @param {string} name
   * @param {number | string} value
   */
  ask(name, value) {
    this.page.model[name] = value;
    this.fill();
  }
  // The newest place that was asked for on the map, when the server is done with the one before.
  go() {
    const { model } = this.page;
    if (model.map_point || !this.point) return;
    const { point } = this;
    this.point = null;
    model.map_point = point;
  }
  take() {
    this.button.ariaPressed = String(this.open);
    this.root.hidden = !this.open;
    this.fill();
  }
  fill() {
    if (this.root.hidden) return;
    const { page } = this;
    const { model } = page;
    /** @type {Plan | null} */
    const found = model.plan ? JSON.parse(model.plan) : null;
    this.question.value = model.question;
    this.tolerance.set(model.plan_tolerance);
    const fresh =
      found &&
      found.chosen.question === model.question &&
      found.chosen.plan_tolerance === model.plan_tolerance &&
      page.names.every((key) => found.chosen[key] === page.frame.chosen[key]);
    this.root.ariaBusy = String(!fresh);
    if (!found) {
      this.said.textContent = text('plan.idle');
      return;
    }
    if (!fresh) return; // what is shown stays until the answer comes
    if (found.error) this.fail(said(found.error));
    else this.tell(found);
  }
  /** @param {string} sentence */
  fail(sentence) {
    this.said.textContent = sentence;
    this.reason.textContent = '';
    this.table.replaceChildren();
    this.map.load('');
  }
  /** @param {Plan} found */
  tell(found) {
    const { candidates, picked } = found;
    const best = candidates[picked];
    const within = best.error !== null && best.error <= found.chosen.plan_tolerance;
    const known = best.error === null ? 'unknown' : best.error ? 'known' : 'none';
    this.said.replaceChildren(
      text('plan.verdict', { within }),
      make('b', { textContent: modelled(best.model) }),
      text('plan.expected', { known, error: share(best.error ?? 0) }),
    );
    this.reason.textContent = `${said(found.why)} ${ruleOf(this.page.frame, found)}`;
    const rows = candidates.map((candidate, k) => this.row(candidate, k === picked));
    this.table.replaceChildren(
      headOf([text('plan.model'), text('plan.error', { around: found.why.code === 'plan-reason' }), '']),
      make('tbody', {}, ...rows),
    );
    this.drawMap(found);
  }
  /** @param {Plan} found */
  drawMap(found) {
    const drawn = this.map.shown;
    const { map, tolerance } = this.map;
    this.map.load(this.page.model.regimes);
    this.map.tolerance = found.chosen.plan_tolerance;
    if (this.map.map) {
      this.map.move(found.groups);
      this.map.about.textContent = aboutMap(this.map.map, found.measured);
    }
    if (map !== this.map.map || tolerance !== this.map.tolerance || drawn !== this.map.shown) this.map.paint();
    else this.map.mark();
  }
  /**
   * @param {Candidate} candidate
   * @param {boolean} picked
   */
  row({ choices, error, model, unknown }, picked) {
    const { page } = this;
    const { chosen } = page.frame;
    const missed = error === null ? text('plan.no-error', { measured: !unknown }) : share(error);
    const line = rowOf([modelled(model), missed, '']);
    const out = leftOut(model.name);
    if (out) line.firstElementChild?.append(make('small', { textContent: out }));
    if (picked) line.ariaCurrent = 'true';
    if (!choices) return line;
    const here = Object.entries(choices).every(([name, value]) => chosen[name] === value);
    const show = make('button', { type: 'button', className: 'when', textContent: text('plan.show', { here }) });
    show.disabled = here;
    show.onclick = () => choose(page, choices);
    const refused = page.frame.refusals?.[choices.method];
    line.lastElementChild?.append(refused ? make('small', { textContent: text('plan.not-on-this-page') }) : show);
    return line;
  }
  show() {}
  draw() {
    if (!this.root.hidden) this.map.draw();
  }
}

export const PANELS = { needs: Needs }; // by their names in the address
