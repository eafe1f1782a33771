// The page: wires choices, clock and views together. One message from the server per change; none while playing.
import { AxialView } from './axial/view.js';
import { BeamView } from './beam/view.js';
import { whenResized } from './charts/canvas.js';
import { watchScrolling } from './charts/gestures.js';
import { Compare } from './compare/compare.js';
import { FallView, falls } from './fall/view.js';
import { COMPARED } from './kinds.js';
import { MechanismView } from './mechanism/view.js';
import { Analyses } from './panels/panels.js';
import { Bodies } from './form/bodies.js';
import { Caption } from './frame/caption.js';
import { Changes } from './wire/changes.js';
import { Closer } from './wire/closer.js';
import { Connection } from './away/connection.js';
import { Controls } from './form/controls.js';
import { make } from './browser/dom.js';
import { Help } from './frame/help.js';
import { tellHeight } from './frame/framed.js';
import { History } from './frame/history.js';
import { alone, framed } from './browser/home.js';
import { listenToKeys } from './frame/keys.js';
import { Layout } from './frame/layout.js';
import { follow, readLink } from './frame/link.js';
import { Scenes } from './form/scenes.js';
import { refusalIn } from './wire/model.js';
import { decode } from './wire/message.js';
import { Opening } from './opening/opening.js';
import { OwnAnswers } from './wire/own_answers.js';
import { placeOf } from './place.js';
import { Player } from './clock/player.js';
import { copyLink } from './frame/share.js';
import { Striker } from './frame/striker.js';
import { Symbols } from './frame/symbols.js';
import { Take } from './frame/take.js';
import { Toast } from './frame/toast.js';
import { times } from './clock/times.js';
import { cameBack, goOn, keepState } from './frame/state.js';
import { Waiting } from './frame/waiting.js';
import { SpaceView } from './space/view.js';
import { text } from './text/catalogue.js';

/** @import { Chosen, Frame } from './messages.js' */
/** @import { Model } from './wire/model.js' */
/** @import { Event } from './frame/story.js' */
/** @import { Kind, View } from './frame/view.js' */

const READ = 150; // ms for which words stand before they change again

export class Page {
  /** @type {Frame} */ frame; // that is shown
  /** @type {number} */ telling = 0;
  saidAt = 0;
  resumed = false;
  painted = 0; // frames so far
  drawing = 0; // the picture at which all is drawn anew

  /**
   * @param {Model} model
   * @param {HTMLElement} el
   */
  constructor(model, el) {
    this.model = model;
    this.waiter = new Waiting(model);
    this.names = Object.keys(model.spec);
    /** @type {Changes} */
    this.changes = new Changes({
      ...{ model, lost: () => Boolean(this.connection?.lost) },
      ...{ sent: () => this.#sent(), kept: () => this.connection?.tell() },
    });
    this.controls = new Controls(this);
    this.bodies = new Bodies(this);
    this.controls.root.append(this.bodies.root);
    this.caption = new Caption();
    this.player = new Player((t) => this.show(t), {
      events: () => this.events(),
      range: () => this.range(),
      hold: (holding) => this.caption.root.classList.toggle('speaking', holding),
      taken: () => this.history.later(),
    });
    this.history = new History(this);
    this.help = new Help(this);
    this.compare = new Compare(this, COMPARED);
    this.axial = new AxialView(this);
    this.beam = new BeamView(this);
    this.mechanism = MechanismView && new MechanismView(this); // a folder without a server has no such scenes
    this.space = SpaceView && new SpaceView(this);
    const { axial, beam, mechanism, space: bodies } = this;
    const all = Object.entries({ axial, beam, mechanism, bodies, fall: new FallView(this) }).filter(([, view]) => view);
    /** @type {Record<Frame['kind'], View & Kind> & { fall: View }} */
    this.views = /** @type {any} */ (Object.fromEntries(all));
    this.analyses = new Analyses(this);
    this.closer = new Closer(this);
    this.own = new OwnAnswers(this);
    this.opening = new Opening(this);
    this.draft = make('span', { className: 'tag draft', textContent: text('page.draft'), hidden: true });
    this.toast = new Toast();
    const sheet = (/** @type {string} */ name) => make('link', { rel: 'stylesheet', href: placeOf(name) });
    this.layout = this.arrange();
    this.root = this.layout.root;
    this.analyses.settle(this.layout);
    this.scenes = new Scenes(this);
    this.symbols = new Symbols(this.root);
    this.history.watch(this.root);
    for (const { stage } of Object.values(this.views))
      stage.striker = new Striker(this, stage.canvas, () => this.player.go(this.player.t));
    this.root.append(this.toast.root, this.help.root);
    const sheets = alone ? ['sheets.css'] : ['sheets.css', 'frame/embedded.css'];
    el.append(...sheets.map(sheet), this.root, this.waiter.root);
    this.connection = Connection && new Connection(this); // a folder has none that could be lost
    this.listen(model);
    for (const name of this.names) this.controls.show(name, model[name]);
    this.root.inert = true; // until there is a scene
    this.take();
    if (model.refused && this.toast.root.hidden) this.complain(refusalIn(model));
  }
  /** Everything in its place. */
  arrange() {
    const act = (/** @type {string} */ className, /** @type {() => void} */ onclick) => {
      const name = text(`page.${className}`); // on a phone a sign stands for it
      return make('button', { type: 'button', className, textContent: name, ariaLabel: name, onclick });
    };
    const copy = act('copy-link', () => copyLink(this));
    const bar = make('header', { className: 'topbar' }, make('h1', {}, 'Strikewave'), this.controls.scene.root);
    const { redoing, undoing } = this.history;
    const parts = [this.opening.button, undoing, redoing, copy, new Take(this).root, ...this.help.buttons];
    bar.append(make('div', { className: 'keep' }, ...parts));
    const choices = make('div', { className: 'choices' }, this.controls.root);
    const all = Object.values(this.views);
    const buttons = all.flatMap((view) => view.buttons);
    const caption = make('div', { className: 'caption-row' }, this.caption.root, ...buttons);
    this.waiter.place = caption;
    const { bar: kept, second, tag } = this.compare;
    this.player.root.append(kept.button);
    const stages = make(
      'div',
      { className: 'stages' },
      tag,
      this.draft,
      ...all.map(({ stage }) => stage.root),
      second.root,
    );
    const pinned = [caption, stages, this.player.root, kept.row];
    const charts = all.flatMap(({ stack }) => (stack ? [stack.root] : []));
    return new Layout({ bar, choices, pinned, charts }, this.opening, () => this.place());
  }
  /** After the layout has changed. */
  place() {
    if (!this.frame) return;
    this.history.later();
    this.waiter.settle();
    for (const { stack } of Object.values(this.views)) {
      if (stack) stack.beside = this.opening.leads;
      stack?.gather();
    }
    for (const { stage } of Object.values(this.views)) if ('leads' in stage) stage.leads = this.opening.leads;
    this.opening.settle();
    this.opening.lend();
    for (const { stack } of Object.values(this.views)) stack?.arrange();
    this.again();
  }
  /** Have it drawn at the next picture, once for all that asks for it by then. */
  again() {
    this.drawing ||= requestAnimationFrame(() => this.redraw());
  }
  /** Draw what is seen, at the size that it has now. */
  redraw() {
    this.drawing = 0;
    if (!this.frame) return;
    this.drawCharts();
    this.player.go(this.player.t);
  }
  /** @param {Model} model */
  listen(model) {
    model.on('frame', () => this.take());
    model.on('refused', () => {
      const why = refusalIn(model);
      if (!why) return;
      const { goal, sent } = this.changes;
      this.changes.leave();
      this.settle();
      this.waiter.clear();
      for (const name of this.names) if (!(name in this.waiting)) this.controls.show(name, model[name], true);
      this.own.restore();
      if ((sent.includes('scene') && this.scenes.refused(why)) || this.bodies.refused(why)) return;
      if (goal || !this.controls.refused(sent, why)) this.complain(why);
    });
    for (const name of this.names)
      model.on(name, () => {
        if (!(name in this.waiting) && !this.changes.quiet) this.controls.show(name, model[name]);
      });
    const { panels, asked } = model.shared;
    for (const name of [...Object.values(panels), ...Object.values(asked).map(([each]) => each), 'auto_within'])
      model.on(name, () => {
        this.history.write();
      });
    watchScrolling(this.root);
    const deaf = listenToKeys(this);
    times.watch(() => [this.again(), this.tell()]);
    const settled = whenResized(() => this.again());
    for (const { axis } of Object.values(this.views)) axis?.watch(() => this.zoomed());
    const left = () => keepState(this);
    window.addEventListener('pagehide', left);
    model.on('remove', () => {
      window.removeEventListener('pagehide', left);
      this.history.leave();
      this.player.playing = false;
      this.layout.leave();
      this.connection?.leave();
      settled();
      deaf();
    });
  }
  /**
   * @param {string} name
   * @param {number | string} value
   */
  send(name, value) {
    this.player.rest();
    this.history.choose(name, value);
    this.changes.set(name, value, () => this.own.take());
  }
  /**
   * Choose something otherwise than by its control, which follows.
   * @param {string} name
   * @param {number | string} value
   */
  choose(name, value) {
    const allowed = this.changes.allowed(name, value);
    this.controls.show(name, allowed);
    this.send(name, allowed);
  }
  /**
   * Go to settings, those that are not given as the scene has them.
   * @param {Partial<Chosen>} settings
   * @param {(frame: Frame | null) => void} [done]  with the frame that answers them, or nothing
   */
  goTo(settings, done = () => {}) {
    this.player.rest();
    const there = (/** @type {Frame | null} */ frame) => {
      if (frame) this.own.restore();
      done(frame);
    };
    this.opening.stay(() => this.changes.go(settings, there));
  }
  #sent() {
    this.toast.root.hidden = true;
    this.waiter.soon('frame', text('page.solving'));
  }
  get waiting() {
    return this.changes.waiting;
  }
  get asked() {
    return this.changes.asked;
  }
  settle() {
    this.waiter.over('frame');
    this.changes.settle();
  }
  take(data = this.model.frame) {
    if (!data || !data.byteLength) return;
    const frame = decode(data);
    this.changes.take(frame, data);
    if (this.changes.answers(frame)) this.settle(); // what waits is solved while this is drawn
    if (this.changes.quiet || this.own.ahead(frame)) {
      this.changes.arrived(frame); // it is kept, not shown
      return;
    }
    this.frame = frame;
    this.draft.hidden = !frame.draft;
    this.root.inert = false;
    this.analyses.take(this.frame);
    this.compare.take(data, this.frame);
    if (this.root.dataset.kind !== this.kind) this.turn();
    this.root.classList.toggle('hangs', Boolean(this.view.hangs?.(frame)));
    this.view.load(this.frame);
    if (this.resumed) this.view.draw();
    this.closer.later();
    if (!this.opening.placed) this.place();
    this.analyses.draw();
    this.opening.draw(true);
    this.player.load(this.view.clock(this.frame));
    if (this.compare.due) this.compare.keep();
    if (!this.resumed) this.resume();
    this.changes.arrived(this.frame);
    this.tell();
    const { strikewave } = /** @type {any} */ (window); // for tests and benches
    const frames = (strikewave?.frames ?? 0) + 1;
    Object.assign(window, { strikewave: { page: this, frames } });
  }
  /** Show a kind of impact in place of another. */
  turn() {
    this.root.dataset.kind = this.kind;
    for (const view of Object.values(this.views)) view.hide(view !== this.view);
    this.layout.tabs.panel('story').replaceChildren(this.compare.summary.root, this.story.root);
    this.layout.tabs.panel('numbers').replaceChildren(this.compare.summary.numbers, this.story.numbers);
    this.place();
  }
  resume() {
    this.own.prepare();
    document.getElementById('still')?.remove();
    this.analyses.resume();
    const timed = follow(this, readLink(alone ? window.location.search : '', this));
    if (framed) tellHeight(this);
    const state = this.opening.teaching.start() ? null : cameBack();
    if (state) goOn(this, state);
    else if (!timed && !window.matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.tour();
    this.resumed = true;
  }
  /**
   * Words and address follow once the picture is painted, and not more often than they can be read.
   */
  tell() {
    const write = () => {
      this.saidAt = performance.now();
      this.telling = 0;
      const known = !this.own.made.has(this.frame); // to the server, too
      this.controls.arrange(this.frame, this.views[this.frame.kind]);
      const parts = [this.story, this.opening, ...(known ? [this.bodies, this.scenes] : [])];
      for (const part of parts) part.load(this.frame);
      this.story.at(this.player.t + this.player.start);
      if (known) this.compare.tell(this.frame);
      for (const root of [this.story.root, this.story.numbers]) this.symbols.mark(root);
      this.say();
      this.player.mark();
      if (known) this.history.follow();
    };
    if (!this.saidAt) write();
    else this.telling ||= window.setTimeout(write, Math.max(40, this.saidAt + READ - performance.now()));
  }
  /** Of the view: that of the frame, unless the opening shows what the laboratory does not. */
  get kind() {
    return this.opening.follows && falls(this.frame) ? 'fall' : this.frame.kind;
  }
  get view() {
    return this.views[this.kind];
  }
  get story() {
    return this.view.story;
  }
  drawCharts() {
    this.view.draw();
    this.opening.draw();
    this.analyses.draw();
  }
  /** @param {number} t */
  show(t) {
    if (!this.resumed) return; // it is drawn once all is in its place
    this.view.show(t);
    this.compare.show(t);
    this.opening.show(t);
    if (!this.telling) {
      this.story.at(t);
      this.say();
    }
    this.analyses.show(t);
    this.painted++;
  }
  /** Under the bar: what happens at this instant. */
  say() {
    this.caption.say(this.story.events);
  }
  /** @returns {Event[]} at the instants at which what they have changed is seen */
  events() {
    if (!this.frame) return [];
    const { after } = this.view;
    return this.story.events.events.map(([t, sentence]) => [t + after, sentence]);
  }
  /** @returns {[start: number, end: number]} the stretch of time in view */
  range() {
    const { player } = this;
    const axis = this.frame && this.view.axis;
    return axis ? axis.view : [player.start, player.start + player.duration];
  }
  /**
   * A stretch of time and some room about it fill the views; without one all of it does.
   * @param {number} [start]
   * @param {number} [end]
   */
  zoom(start, end) {
    const { axis, leastRoom = 0 } = this.view;
    axis?.lookAt(start, end, leastRoom);
    if (axis && start !== undefined) this.player.go(start);
  }
  zoomed() {
    this.opening.draw();
    this.closer.later();
    this.history.later();
    this.player.look();
  }
  /** @param {string} sentence */
  complain(sentence) {
    this.toast.say(sentence);
  }
}

/** @param {{ model: Model, el: HTMLElement }} options */
export function render({ model, el }) {
  new Page(model, el);
}
