// A lesson on the page: its steps, what each shows, and what was answered, which the browser keeps.
import { make } from '../browser/dom.js';
import { keep, kept } from '../browser/store.js';
import { text } from '../text/catalogue.js';
import { engineering, figures } from '../text/format.js';
import { times } from '../clock/times.js';
import { refusalIn } from '../wire/model.js';
import { brought } from './answered.js';
import { Bar } from './bar.js';
import { Below } from './below.js';
import { Coming } from './coming.js';
import { endingOf } from './ending.js';
import { eventsOf, fallenOf, timeOf, unitOf } from './events.js';
import { First } from './first.js';
import { dress, rowsUntil, showingAt } from './picture.js';
import { elementsOf } from './nodes.js';
import { PROJECTOR } from './projector.js';
import { asks, questionOf } from './questions.js';
import { Second } from './second.js';
import { Sketch } from './sketch.js';
import { summaryOf } from './summary.js';

/** @import { Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */
/** @import { Events } from './events.js' */
/** @import { Part, Progress, Question } from './questions.js' */

/**
 * @typedef {object} Step  as app/lessons/record.py writes it
 * @property {string} title
 * @property {string} scene
 * @property {Record<string, any>} choices
 * @property {Part[]} parts
 */
/**
 * @typedef {object} Record_
 * @property {string} lesson
 * @property {boolean} [own]  of a file of the visitor's
 * @property {boolean} [untried]  whether it was not tried as a whole
 * @property {number} version
 * @property {string} language
 * @property {string} title
 * @property {string} title_before
 * @property {string} next
 * @property {string} next_title
 * @property {Step[]} steps
 */

const AT_FIRST = ['bodies'];
const PLAIN = ['bodies', 'forces', 'opening', 'rows']; // what of it is no chart
const FLAGS = [PROJECTOR].filter((name) => new URLSearchParams(globalThis.location?.search).has(name));
const BARE_T = 'T'; // of `time`: how long one is, is not said

export class Lesson {
  at = -1;
  /** @type {Question | null} */ question = null;
  coming = false; // the scene of this step is still to come
  paper = false; // steps are shown to be printed
  /** @type {Events} */ events = {};
  unit = 1; // of the page's clock, that a T is
  rows = false; // whether they are seen below the picture
  flags = FLAGS; // of the address
  until = (/** @type {Frame} */ frame) => (this.at < 0 ? null : rowsUntil(this, frame, this.#shown));

  /**
   * @param {Page} page
   * @param {Record_} record
   */
  constructor(page, record) {
    this.page = page;
    this.record = record;
    this.key = `lesson.${record.own ? 'own.' : ''}${record.lesson}`;
    /** @type {Progress} */
    this.progress = this.#kept();
    this.still = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.heading = make('h2', { tabIndex: -1, lang: record.language });
    this.words = make('div', { className: 'lesson-words', lang: record.language });
    this.asked = make('div', { className: 'lesson-asked', lang: record.language });
    this.spoken = make('p', { className: 'lesson-spoken', role: 'status' });
    const column = make('div', { className: 'lesson-column' }, this.words, this.asked);
    this.root = make('section', { className: 'lesson', ariaLabel: text('lesson.lesson') }, column, this.spoken);
    this.bar = new Bar(this);
    this.below = new Below(page, () => this.sliders ?? []);
    this.awaited = new Coming(page);
    this.second = new Second(page);
    this.first = new First(page);
    const word = make('span', { className: 'lesson-word', textContent: text('lesson.back') });
    this.back = make('button', { type: 'button', ariaLabel: text('lesson.back') }, '← ', word);
    this.back.onclick = () => this.enter(this.at - 1);
    this.onwards = make('button', { type: 'button', onclick: () => this.enter(this.at + 1) });
    this.moves = make('nav', { className: 'lesson-moves', ariaLabel: text('lesson.steps') }, this.back, this.onwards);
    this.moves.append(...endingOf(this));
  }
  /** What it asks: answers to other questions are of no use. */
  get #questions() {
    const all = this.record.steps.flatMap((step) => step.parts).filter(asks);
    const size = (/** @type {Part} */ { items, judges, options }) => (items ?? judges ?? options ?? []).length;
    return JSON.stringify(all.map((part) => [part.kind, part.name, size(part)]));
  }
  /** @returns {Progress} */
  #kept() {
    const fresh = { of: this.#questions, far: 0, answers: {} };
    const found = kept(this.key, fresh);
    const answers = Object.assign(Object.create(null), found?.of === fresh.of ? found.answers : {}); // by any name
    return { ...(found?.of === fresh.of ? found : fresh), answers };
  }
  /** Take the place of the opening's own words. */
  open() {
    const { player, root } = this.page;
    root.classList.add('teaching');
    player.looping = false;
    this.page.opening.section.lone = true;
    this.page.opening.question = this.heading; // to which one skips
    for (const { stage } of Object.values(this.page.views)) if ('striker' in stage) stage.striker = null; // no hand
    root.querySelector('.topbar h1')?.after(this.bar.root);
    this.awaited.over(this.bar.root); // where it is not over what is asked
    root.append(this.root, this.moves);
    this.page.controls.root.addEventListener('change', () => this.question?.settle?.());
    if (this.flags.includes(PROJECTOR)) this.bar.projector.turn(true);
  }
  get step() {
    return this.record.steps[this.at];
  }
  /** What the address says of it. */
  get query() {
    return `lesson=${this.record.own ? 'own' : this.record.lesson}&step=${this.at + 1}${this.bar.said}`;
  }
  /** The part that says what is shown: that of this step, or before. */
  get #scene() {
    return this.step.parts.find(({ kind }) => kind === 'scene') ?? {};
  }
  /** Whether the scene is seen as it opens: what is dropped, over all its bounces. */
  get opens() {
    return this.at >= 0 && this.#shown.includes('opening');
  }
  get #after() {
    return this.step.parts.find(({ kind }) => kind === 'after') ?? {};
  }
  /** @returns {string[]} what is shown by now */
  get #shown() {
    return showingAt(this).show ?? AT_FIRST;
  }
  /** Its title, which says nothing that is asked first. */
  get title() {
    const { steps, title, title_before: before } = this.record;
    const first = steps.flatMap((step) => step.parts).find(asks);
    return first && !this.progress.answers[first.name]?.done ? before : title;
  }
  /** Whether the visitor has been at a later step. */
  get looked() {
    return this.progress.far > this.at;
  }
  /**
   * What was answered to a question, to be changed and kept.
   * @template Answer
   * @param {string} name
   * @param {Answer} fresh
   * @returns {any}
   */
  answerOf(name, fresh) {
    return (this.progress.answers[name] ??= JSON.parse(JSON.stringify(fresh)));
  }
  keep() {
    if (!this.paper) keep(this.key, this.progress);
  }
  /** Forget all answers. Returns what brings them back. */
  restart() {
    const { at, progress } = this;
    const turn = (/** @type {Progress} */ to, /** @type {number} */ step) => {
      this.progress = to;
      this.keep();
      this.enter(step);
    };
    turn({ of: this.#questions, far: 0, answers: Object.create(null) }, 0);
    return () => turn(progress, at);
  }
  /**
   * A time in T, as it is written.
   * @param {number} t
   */
  timeWords(t) {
    if (this.unit !== 1 || this.opens) return engineering(t * this.unit, 's'); // as all the page has it
    return `${figures(Number(t.toFixed(2)), 4)} T`;
  }
  /** @param {string} sentence */
  speak(sentence) {
    this.spoken.textContent = sentence;
  }
  /**
   * @param {number} at
   * @param {boolean} [focus]
   * @returns {Promise<boolean>}  whether it is there, with what stands beside it
   */
  enter(at, focus = true) {
    const { page, progress, record } = this;
    this.question?.chart?.remove();
    const first = this.at < 0;
    this.at = Math.min(Math.max(at, 0), record.steps.length - 1);
    progress.far = Math.max(progress.far, this.at);
    this.coming = true;
    this.first.lay(this.at, false);
    page.player.bound(0);
    page.compare.scales.least = progress.ends ??= {};
    page.controls.bound({}); // else the way to this step would be held by those of the one before
    this.speak('');
    this.#render();
    this.keep();
    if (focus) this.heading.focus();
    const { beside } = this.#scene;
    const own = this.at;
    this.second.want(beside && Object.keys(beside).length ? { ...this.#settings, ...beside } : null);
    const there = new Promise((done) => {
      page.goTo(this.#settings, (frame) => {
        if (own !== this.at) done(this.awaited.end());
        else done(frame ? this.#arrive(frame) : this.awaited.refuse(refusalIn(page.model)));
      });
    });
    if (this.coming) this.awaited.begin(first);
    page.history.write();
    return there.then(() => !this.coming && own === this.at);
  }
  /** @param {Frame} frame  of this step */
  #arrive(frame) {
    this.coming = false;
    if (this.page.root.dataset.kind !== this.page.kind) this.page.take(this.page.changes.bytes);
    this.page.compare.scales.keep(this.progress.ends);
    this.keep();
    this.awaited.over(this.bar.root);
    this.first.lay(this.at, (this.sliders ?? []).length > 0);
    this.page.controls.bound(this.question?.bounds ?? {});
    this.load(frame);
    this.below.show(this.below.names, true, showingAt(this).map);
    this.#begin();
    return this.#beside(frame);
  }
  /** All that is chosen in this step. */
  get #settings() {
    return { scene: this.step.scene, ...this.step.choices, ...this.question?.choices };
  }
  /** Whether what happens is still to be said. */
  get #closed() {
    return Boolean(this.question?.predicts && !this.question.done);
  }
  /**
   * What stands beside it is seen with what happens.
   * @param {Frame} frame
   */
  async #beside({ chosen }) {
    await this.second.solve(chosen);
    if (this.second.run) this.second.show(!this.#closed);
  }
  #render() {
    const { step } = this;
    const part = step.parts.find(asks);
    this.question = part ? questionOf(this, part) : null;
    this.heading.textContent = step.title;
    const texts = step.parts.filter(({ kind }) => kind === 'text');
    this.words.replaceChildren(this.heading, ...texts.flatMap(({ nodes }) => elementsOf(nodes)));
    this.tail = make('div', { className: 'lesson-after' });
    this.asked.replaceChildren(...(this.question ? [this.question.root] : []), this.tail);
    this.root.scrollTop = 0;
    this.#follow();
    this.arrange();
  }
  /** What comes behind the answer, and where one can go. */
  #follow() {
    const { at, question, record } = this;
    const last = at === record.steps.length - 1;
    const open = question && !question.done;
    const sums = this.step.parts.filter(({ kind }) => kind === 'summary').map((part) => summaryOf(this, part));
    const nodes = !open && this.#laid ? elementsOf(this.#after.nodes ?? []) : [];
    this.tail?.replaceChildren(...nodes, ...sums);
    this.back.disabled = at === 0;
    this.page.root.classList.toggle('last-step', last); // which has other ways to go on
    this.onwards.textContent = text(open ? 'lesson.skip' : 'lesson.next');
    this.onwards.classList.toggle('ready', !open);
    this.bar.show();
  }
  /** What a sketch explains, it explains beside the rod. */
  get #laid() {
    return !(this.question instanceof Sketch) || this.question.laid;
  }
  /** What is seen below the picture, and which sliders. */
  arrange() {
    const { page, question } = this;
    const chart = question?.chart && !(question instanceof Sketch && question.laid) ? question.chart : null;
    this.rows = !chart && this.#shown.includes('rows');
    const closed = Boolean(chart) || this.#closed;
    const charts = this.#shown.filter((name) => (closed ? name === question?.over : !PLAIN.includes(name)));
    this.below.question = question?.over ? question : null;
    this.below.show(charts, !this.coming, showingAt(this).map);
    const { root } = page;
    root.classList.toggle('sketching', Boolean(chart));
    if (chart && !chart.isConnected) this.root.after(chart); // Tab goes on to it
    if (!chart) question?.chart?.remove();
    dress(this, this.#shown, this.#closed);
    const slider = Object.keys(question?.choices ?? {});
    this.sliders = [...new Set([...slider, ...(this.#scene.sliders ?? [])])];
    page.controls.lead(this.sliders);
    root.classList.toggle('slides', this.sliders.length > 0);
    root.classList.toggle('waits', Boolean(chart && !question?.done));
    this.#bare();
    if (page.frame) page.layout.place();
    question?.draw?.();
    this.#follow();
  }
  /** How long a T is, is no longer a riddle once it is answered. */
  #bare() {
    times.bare = this.#scene.time === BARE_T && !this.question?.done;
    this.page.root.classList.toggle('untimed', times.bare);
  }
  /** @param {number | string} time  on the page's clock */
  #clock(time) {
    return timeOf(time, this.events) * this.unit;
  }
  /** @param {[number | string, number | string] | null} [span] */
  #span(span) {
    const [from, to] = (span ?? []).map((time) => this.#clock(time));
    return from === undefined || !(to > from) ? null : [from, to];
  }
  /** How far one may look before one has said what happens. */
  #limit() {
    const { at, play } = this.#scene;
    const { player } = this.page;
    if (!this.#closed) return Infinity;
    if (this.question?.chart) return 0;
    const end = this.#span(play)?.[1] ?? ((at ?? null) === null ? NaN : this.#clock(at));
    return Number.isFinite(end) ? Math.max(end - player.start, 0) : Infinity;
  }
  #begin() {
    const { player } = this.page;
    player.bound(this.#limit(), text('lesson.answer-first'));
    const done = this.question?.done;
    const after = this.#after;
    const part = done && (after.play || (after.at ?? null) !== null) ? after : this.#scene;
    const at = part.at ?? (done ? part.play?.[1] : null) ?? null;
    if (at !== null) this.stand(this.#clock(at));
    else if (!done && part.play) this.play(part.play);
    else this.stand(0);
  }
  /** @param {[number | string, number | string]} span */
  play(span) {
    const found = this.#span(span);
    if (!found) return;
    const { player } = this.page;
    const [from, to] = found.map((t) => Math.min(Math.max(t - player.start, 0), player.duration));
    if (this.still || to <= from) this.stand(to + player.start);
    else player.through(from, to, (to - from) / player.usual);
  }
  /** @param {number} t  from the first touch on */
  stand(t) {
    const { player } = this.page;
    if (player.playing) player.toggle();
    player.go(t - player.start);
  }
  /**
   * A question is answered: what happens may be seen.
   * @param {string} sentence  that is spoken
   * @param {boolean} [shows]  whether it is played
   */
  answered(sentence, shows = true) {
    const { page, question } = this;
    this.keep();
    page.player.bound(Infinity);
    this.arrange();
    if (this.second.run) this.second.show(true);
    if (sentence) this.speak(sentence);
    if (!shows) return;
    const said = this.asked.querySelector('.lesson-said, .lesson-judged');
    if (said instanceof HTMLElement) said.focus({ preventScroll: true });
    brought(this.asked, this.below.root);
    const { at, play } = this.#after;
    if (play) this.play(play);
    else if ((at ?? null) !== null) this.stand(this.#clock(at));
    else if (question instanceof Sketch && question.rolls) this.play([0, question.drawn.until]);
    else if (this.#scene.play) this.play(this.#scene.play);
  }
  /** @param {Frame} frame  that is shown now */
  load(frame) {
    this.events = (this.opens && fallenOf(frame)) || eventsOf(frame);
    this.unit = unitOf(frame);
    if (this.coming) return;
    this.second.lay(!this.#closed);
    this.page.controls.lead(this.sliders ?? []);
    this.question?.load?.(frame);
  }
  /**
   * Whether it is what has been chosen in the end: no hand holds the slider, and the server has answered.
   * @param {Frame} frame
   * @param {string} slider
   */
  rests(frame, slider) {
    const { controls, own } = this.page;
    return !frame.draft && !own.made.has(frame) && !own.behind && !controls.holds(slider);
  }
  /** @param {number} t */
  show(t) {
    this.question?.show?.(t);
  }
}
