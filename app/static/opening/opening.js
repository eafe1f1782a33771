// The opening view: one large picture, one question, a few sliders. All else is in a dock that slides in beside the
// picture, one click away; the laboratory has it all at once.
import { queryOf } from '../frame/address.js';
import { alone, carried, framed } from '../browser/home.js';
import { make } from '../browser/dom.js';
import { TITLES } from '../frame/layout.js';
import { lessonIn, Teaching } from '../frame/teaching.js';
import { isChanged } from '../form/settings.js';
import { CLOSER } from '../wire/held.js';
import { keep, kept } from '../browser/store.js';
import { family, text } from '../text/catalogue.js';
import { Door } from './door.js';
import { Happens } from './happens.js';
import { questionOf } from './question.js';
import { Section } from './section.js';

/** @import { Page } from '../page.js' */
/** @import { Frame, Try } from '../messages.js' */

const PLAN = 'plan'; // under which is kept which of them was seen last
/** @type {Plan[]} */
const PLANS = ['opening', 'docks', 'laboratory'];
const WALK = 12; // steps in which a slider goes where a question sends it
const STEP = 60; // ms between them
/** Sliders that lead, of those that act. */
const LEADING = ['mass_ratio', 'law', 'restitution', 'modes', 'place', 'speed', 'friction', 'tilt'];
const FOUR = 4;
const WHATS = family('opening.what-if');

/** @typedef {'opening' | 'docks' | 'laboratory'} Plan  `docks`: the opening with the dock beside its picture */

/**
 * @param {Frame} frame
 * @param {string[]} [first]  that go before others
 */
const leadingOf = ({ acting }, first = []) =>
  [...new Set([...first, ...LEADING])].filter((name) => acting.includes(name)).slice(0, FOUR);

/**
 * What can be tried, first what a leading slider shows.
 * @param {Frame} frame
 * @param {string[]} leading
 */
function changesOf(frame, leading) {
  const place = (/** @type {Try} */ [, name]) => (leading.includes(name) ? leading.indexOf(name) : FOUR);
  const known = frame.opens.trials.filter(([say]) => say in WHATS); // a visitor's scene may say others
  return known.toSorted((one, other) => place(one) - place(other));
}

/**
 * Which of them a visitor sees first: what a link says, else its picture, beside it the dock that has what it names.
 * @param {string} search  of the address
 * @returns {Plan}
 */
function planOf(search) {
  if (!alone) return 'laboratory';
  if (lessonIn(search)) return 'opening';
  const query = new URLSearchParams(search);
  const asked = PLANS.find((name) => name === query.get('layout'));
  if (carried || framed) return asked === 'docks' ? asked : 'opening';
  for (const key of ['gallery', 'language']) query.delete(key); // which go with any
  const named = query.has('panel') || query.has('tab') ? 'docks' : 'opening';
  return asked ?? (query.size ? named : kept(PLAN, 'opening'));
}

const SOURCED = ['scene', 'law', 'method', 'restitution']; // by the source of a scene, where a link does not hide them

export class Opening {
  /** @type {Plan} */ plan = planOf(alone ? window.location.search : '');
  tried = 0; // changes of this scene
  lent = false; // whether the dock is open because the scene asks for it
  scene = '';
  coming = ''; // the scene that history brings, as it was seen then
  narrow = false; // the window has no room for the laboratory: the dock stands for it
  /** @type {boolean | null} */ led = null; // whether its picture was seen last
  due = true; // rows are to be drawn
  answered = false; // only because of another solve
  /** @type {number | undefined} */ walking; // a slider, step by step

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.section = new Section(page);
    this.teaching = new Teaching(page); // a lesson, which has this picture and words of its own
    this.question = make('h2', { tabIndex: -1 });
    this.change = make('button', { type: 'button', className: 'what-if', onclick: () => this.#change() });
    this.ask = make('div', { className: 'ask' }, this.question);
    this.door = new Door(page);
    this.side = make('div', { className: 'aside' }, this.ask, this.change);
    this.shares = make('div', { className: 'energy shares', hidden: true });
    this.happens = new Happens(this.section, this.shares);
    this.closer = make('nav', { className: 'closer', ariaLabel: text('opening.closer') });
    const lenses = Object.values(page.views).flatMap(({ lens }) => lens ?? []);
    this.parts = [this.side, this.section.root, this.happens.root, this.shares, ...lenses, this.closer];
    this.button = make('button', { type: 'button', className: 'to-opening', textContent: text('opening.back') });
    this.button.title = text('opening.back-about');
    this.button.onclick = () => this.turn('opening');
    this.button.hidden = !alone;
  }
  get #leading() {
    const { frame, view } = this.page;
    return leadingOf(frame, view.leading);
  }
  get #changes() {
    const { changes, frame } = this.page;
    return changesOf(frame, this.#leading).filter(([, name, value]) => changes.allowed(name, value) === value);
  }
  /** Whether what is dropped is followed until it lies still; a lesson is about one impact, unless it asks for that. */
  get follows() {
    return this.plan === 'opening' && (!this.teaching.on || Boolean(this.teaching.lesson?.opens));
  }
  /** Whether its picture is what is seen. */
  get leads() {
    return this.plan !== 'laboratory' || this.narrow;
  }
  /** Whether the dock is beside it. */
  get docked() {
    return this.leads && this.plan !== 'opening';
  }
  /**
   * What a link says of it: nothing of the picture alone, which it leads to otherwise.
   * @returns {[key: string, value: string][]}
   */
  get said() {
    const { plan } = this;
    return alone && plan !== 'opening' ? [['layout', plan]] : [];
  }
  /** What its rows are of; nothing of bodies that have none. */
  get shown() {
    return this.leads && !this.teaching.hides ? (this.page.view.section ?? null) : null;
  }
  /** The chart that is seen below the stage where the others have no room. */
  get #strip() {
    const { view } = this.page;
    const tabbed = this.docked && this.narrow; // they have it
    const lent = this.leads && !this.shown && !this.teaching.hides && !tabbed;
    return lent && view.strip && !view.strip.root.hidden ? view.strip.root : null;
  }
  get #bare() {
    return this.leads && !this.#strip && !this.shown;
  }
  /** Whether the picture is about as high as wide; on a desk it goes down beside the tracks. */
  get #tall() {
    const { docked, page, shown } = this;
    return Boolean(shown && !docked && !this.teaching.on && !page.compare.beside && !shown.drawn && shown.tall);
  }
  /** Put the chart there, or have the stage take its room. */
  lend() {
    const { layout, root } = this.page;
    layout.strip.replaceChildren(...(this.#strip ? [this.#strip] : []));
    root.classList.toggle('bare', this.#bare);
    const tall = this.#tall;
    root.classList.toggle('tall', tall);
    const { stage } = this.page.view;
    const over = tall && root.dataset.size === 'desk';
    if ('lap' in stage) stage.lap = over ? this.section.root : null;
    this.teaching.lesson?.below.lend();
  }
  /** Whether it is there as this scene wants it. */
  get placed() {
    const { layout, root } = this.page;
    const as = (/** @type {string} */ name, /** @type {boolean} */ wanted) => root.classList.contains(name) === wanted;
    const there = layout.strip.firstChild === this.#strip && this.teaching.placed;
    return there && as('bare', this.#bare) && as('tall', this.#tall);
  }
  /**
   * @param {Plan} plan
   * @param {boolean} [byHand]  so that it is what is seen first the next time, and has the focus
   */
  turn(plan, byHand = true) {
    this.lent = false;
    if (plan === this.plan || this.teaching.on) return;
    this.door.close();
    this.plan = plan;
    this.led = this.leads;
    if (alone && byHand) keep(PLAN, plan);
    if (byHand && this.page.frame) this.scene = String(this.page.frame.chosen.scene); // it is seen as the hand says
    this.page.layout.place();
    this.#turned();
    this.load(this.page.frame);
    if (!byHand) return;
    const { centre, tabs } = this.page.layout;
    (this.docked ? tabs.tab : this.leads ? this.question : centre)?.focus(); // what had the focus is gone
    this.page.history.write();
  }
  /**
   * History goes to an entry: what is seen is as it was.
   * @param {import('../frame/history.js').Entry} entry
   */
  come({ chosen, lent = false, plan = this.plan, tab }) {
    this.coming = String(chosen.scene);
    if (tab && plan === 'docks') this.page.layout.tabs.select(tab);
    this.turn(plan, false);
    if (tab && this.docked) this.page.layout.show(tab);
    this.lent = lent;
  }
  /** The window has become too narrow for the laboratory, or wide enough. */
  settle() {
    const { leads, led } = this;
    this.led = leads;
    if (led !== null && led !== leads) this.#turned();
  }
  /** Opening and laboratory may show the same frame otherwise. */
  #turned() {
    const { page } = this;
    if (page.root.dataset.kind !== page.kind) {
      page.turn();
      page.view.load(page.frame);
    }
    page.player.load(page.view.clock(page.frame));
    page.tell();
  }
  /**
   * Have the dock beside the picture.
   * @param {string} tab  of it
   */
  look(tab) {
    this.page.layout.tabs.select(tab);
    this.turn('docks');
    this.page.layout.show(tab); // where it was there already
  }
  /**
   * Escape closes the dock; the map has keys of its own.
   * @param {KeyboardEvent} event
   */
  key(event) {
    if (this.door.key(event)) return true;
    if (event.key !== 'Escape' || !this.docked) return false;
    this.turn('opening');
    return true;
  }
  /**
   * Something else is done: the slider that a question has sent off stays where it is.
   * @param {() => void} act
   */
  stay(act) {
    clearTimeout(this.walking);
    this.walking = 0;
    act();
  }
  /**
   * Words, once the picture is drawn.
   * @param {Frame} frame
   */
  load(frame) {
    if (!this.leads) return;
    this.teaching.lesson?.load(frame);
    if (this.teaching.on) return;
    if (this.scene !== frame.chosen.scene) this.#arrive(frame);
    this.question.textContent = questionOf(frame, this.page.view.story);
    const changes = this.#changes;
    this.change.hidden = !changes.length;
    if (changes.length) this.change.textContent = `${WHATS[changes[this.tried % changes.length][0]]} →`;
    this.#share();
    this.lead();
    this.#offer(frame);
    this.happens.load(this.page.story.events);
    this.happens.mark(this.page.player.t + this.page.player.start);
  }
  /** Have the sliders in view that lead; with the map, those of its axes are among them. */
  lead() {
    this.page.controls.lead(this.door.leads(this.#leading));
  }
  /** Where the energy is in the end, as the story has it. */
  #share() {
    const { energy } = this.page.story;
    this.shares.hidden = !energy?.childElementCount;
    if (!energy) return;
    const head = make('span', { textContent: text('opening.energy') });
    this.shares.replaceChildren(head, ...energy.cloneNode(true).childNodes);
  }
  /**
   * Another scene: the dock opens on what it is about, and closes with it unless a hand has opened it.
   * @param {Frame} frame
   */
  #arrive({ chosen, opens: { tab } }) {
    const { coming, scene } = this;
    this.tried = 0;
    this.scene = String(chosen.scene);
    this.coming = '';
    if (!scene || coming === this.scene) return; // where an address or the history leads is as that says
    const { lent } = this;
    if (tab && (lent || !this.docked)) {
      this.page.layout.tabs.select(tab);
      this.turn('docks', false);
      this.page.layout.show(tab);
      this.lent = true;
    } else if (!tab && lent) this.turn('opening', false);
  }
  /**
   * Ways to look closer.
   * @param {Frame} frame
   */
  #offer(frame) {
    const source = isChanged(frame) ? '' : frame.source;
    this.closer.hidden = this.page.changes.held.hidden.has(CLOSER);
    if (this.closer.dataset.said === source) return;
    this.closer.dataset.said = source;
    const { hidden } = this.page.changes.held;
    const shown = SOURCED.some((name) => hidden.has(name)) ? '' : source;
    const enter = (/** @type {string} */ textContent, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', textContent, onclick });
    const laboratory = enter(text(carried ? 'offline.laboratory' : 'opening.laboratory'), () => this.#leave());
    laboratory.className = 'to-laboratory';
    const tabs = this.page.layout.offered.map((tab) => enter(TITLES[tab], () => this.look(tab)));
    this.closer.replaceChildren(
      make('span', { textContent: text('opening.closer') }),
      this.door.button,
      ...tabs,
      ...((carried ? carried.laboratory : !framed) ? [laboratory] : []),
      make('span', { className: 'source', textContent: shown && text('opening.source', { source }) }),
    );
  }
  /** To the laboratory, which another place has where there is no server. */
  #leave() {
    if (!carried) {
      this.turn('laboratory');
      return;
    }
    const query = new URLSearchParams(queryOf(this.page, true));
    query.set('layout', 'laboratory');
    window.open(`${carried.laboratory}?${query}`, '_blank', 'noopener');
  }
  /**
   * Another solve, or another size: the rows lie below the bodies, which are drawn first.
   * @param {boolean} [answered]  by a solve: its events are written soon, and the names of those before stay until then
   */
  draw(answered = false) {
    this.answered = this.due ? this.answered && answered : answered;
    this.due = true;
    this.door.take();
    this.teaching.lesson?.below.map?.take();
  }
  /** @param {number} t */
  show(t) {
    if (!this.leads) return;
    if (this.due) this.section.draw(this.shown);
    if (this.due) this.door.drawn();
    if (this.due && !this.answered) this.happens.place();
    this.due = false;
    this.section.show(t);
    this.happens.mark(t);
    this.teaching.lesson?.show(t);
  }
  /** The change that is offered: a slider walks there, so that one sees what it does. */
  #change() {
    const { page } = this;
    const changes = this.#changes;
    const [, name, value] = changes[this.tried % changes.length] ?? [];
    if (name === undefined || value === undefined) return;
    this.tried += 1;
    const { options, whole } = page.model.spec[name];
    const [from, to] = [Number(page.frame.chosen[name]), Number(value)];
    if (options || whole || !(from > 0 && to > 0)) {
      page.choose(name, value);
      return;
    }
    const walk = (/** @type {number} */ step) => {
      page.choose(name, Number((from * (to / from) ** (step / WALK)).toPrecision(step < WALK ? 3 : 12)));
      this.walking = step < WALK ? window.setTimeout(() => walk(step + 1), STEP) : 0;
    };
    this.stay(() => walk(1));
  }
}
