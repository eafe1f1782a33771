// What if …: the scene as a point on a map over two choices. The picture lives on beside it; whatever is moved, point,
// slider or axis, thousands of impacts follow.
import { make, write } from '../browser/dom.js';
import { inTurn } from '../browser/turns.js';
import { sizeOf } from '../charts/canvas.js';
import { grouped } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { Along } from './along.js';
import { axesOf, usualFirst, valueIn } from './axes.js';
import { Borders } from './borders.js';
import { Designs } from './designs.js';
import { Gains } from './gains.js';
import { Goal } from './goal.js';
import { Hands } from './hands.js';
import { Grip } from './grip.js';
import { Lattice, Lattices } from './lattice.js';
import { MapWords } from './map_words.js';
import { Window } from './window.js';
import { MapJobs } from './map_jobs.js';
import { BOUNDS } from './model_jobs.js';
import { Modes } from './modes.js';
import { Plane } from './plane.js';
import { placeOf } from './places.js';
import { Points } from './points.js';
import { Ranges } from './ranges.js';
import { NAMES, shownOf, valueOf } from './results.js';
import { follow, saidOf } from './view_link.js';
import { Sentence } from './sentence.js';
import { ServerWork } from './server_work.js';
import { figuresOfWhole } from '../wasm/columns.js';
import { Tiles, domainOf } from './tiles.js';

/** @import { Chosen } from '../messages.js' */
/** @import { Page } from '../page.js' */
/** @import { Axis } from './axes.js' */
/** @import { Domain } from './plane.js' */
/** @import { Result } from './results.js' */

const KEPT = 16; // lattices
const STREAM = 100; // ms between pictures of what comes in while nothing is held
const OFTEN_NONE = ['target_velocity', 'dissipated', 'contact_time', 'vibration']; // where held, or in no time
const LEAST = 1e-9;
const OFF = 0.12; // of a scale, that the values may be off by before it follows

export class WhatIf {
  /** @type {Axis[]} */ axes = [];
  /** @type {Result} */ result = 'peak_force';
  /** @type {Record<'x' | 'y', string>} */ named = { x: '', y: '' };
  ranges = new Ranges();
  lattices = new Lattices(KEPT, (number) => new Lattice(number));
  /** @type {Lattice | null} */ lattice = null;
  /** @type {Window | null} */ view = null;
  /** @type {Record<string, number>} */ wanted = {}; // by result
  /** @type {Domain | null} */ domain = null;
  domainOf = '';
  scene = '';
  asked = ''; // by a link
  seen = ''; // what of which lattice
  filled = ''; // with which result
  painted = ''; // what the map shows
  open = false;
  grip = new Grip(() => this.schedule());
  due = false; // whether it waits to be drawn, and that
  turn = () => this.draw();
  /** @type {number | undefined} */ streaming;

  /**
   * @param {Page} page
   * @param {() => void} close  by hand
   */
  constructor(page, close) {
    this.page = page;
    this.jobs = new MapJobs(this);
    const of = (/** @type {'next' | 'rest'} */ name) => () => (this.open ? this.jobs[name]() : null);
    this.points = new Points(page, of('next'), of('rest'));
    this.sentence = new Sentence((slot, name) => this.choose(slot, name));
    this.plane = new Plane();
    this.goal = new Goal(this);
    this.designs = new Designs(this);
    this.gains = new Gains(this);
    this.tiles = new Tiles((result) => this.choose('of', result));
    this.status = make('p', { className: 'whatif-status', role: 'status' });
    this.words = make('p', { className: 'whatif-said', ariaLive: 'polite' });
    this.modes = new Modes(this);
    this.borders = new Borders(this);
    const [name, title] = [text('whatif.back'), text('whatif.back-about')];
    const named = { textContent: name, ariaLabel: name, title }; // on a phone it is a sign
    this.back = make('button', { type: 'button', className: 'whole whatif-back', ...named, onclick: close });
    this.along = new Along(this);
    this.head = make('div', { className: 'whatif-head' }, this.sentence.root, this.modes.segments.root);
    this.head.append(this.designs.keep, this.along.root, this.back);
    this.side = make('div', { className: 'whatif-side' }, this.tiles.root, this.goal.root, this.designs.root);
    this.work = new ServerWork(this);
    const now = make('div', { className: 'whatif-now' }, this.status, this.work.root);
    this.foot = make('div', { className: 'whatif-foot' }, now, this.borders.root, this.words);
    this.parts = [this.head, this.plane.root, ...this.modes.parts, this.foot, this.side, this.goal.force.root];
    this.hands = new Hands(this, this);
    this.spoken = new MapWords(this);
  }
  /**
   * Have it in place of the picture.
   * @param {string} said  by a link
   */
  async enter(said) {
    if (this.open) return;
    this.open = true;
    this.asked = this.modes.follow(said);
    this.place();
    if (!this.points.ready) {
      write(this.status, text('whatif.preparing'));
      await this.points.prepare();
    }
    if (!this.open) return;
    this.take();
    this.page.place();
  }
  /** Take the place of the picture. */
  place() {
    this.page.root.dataset.whatif = this.modes.mode;
    this.page.compare.reach();
    this.page.root.append(...this.parts);
  }
  /** Give it back. */
  clear() {
    delete this.page.root.dataset.whatif;
    this.page.compare.reach();
    for (const part of this.parts) part.remove();
  }
  /** What a link says of it. */
  get said() {
    return saidOf(this);
  }
  leave() {
    this.open = false;
    this.goal.force.leave();
    this.clear();
    this.gains.leave();
    this.points.leave();
    this.points.ready = false;
    this.page.place();
  }
  get held() {
    return this.grip.holds;
  }
  /** Choices as they are shown. */
  get chosen() {
    return this.page.frame.chosen;
  }
  /** @param {string} name */
  axis(name) {
    return this.axes.find((each) => each.name === name);
  }
  get x() {
    return /** @type {Axis} */ (this.axis(this.named.x));
  }
  get y() {
    return /** @type {Axis} */ (this.axis(this.named.y));
  }
  /**
   * The present value of an axis.
   * @param {Axis} axis
   */
  value(axis) {
    return valueIn(axis, this.page.frame);
  }
  /** @param {Axis} axis  Places that are shown. */
  range(axis) {
    return this.ranges.of(axis, this.value(axis));
  }
  /** Another answer is shown, of the server or of the browser itself. */
  take() {
    if (!this.open || !this.points.ready) return;
    const { frame } = this.page;
    const scene = JSON.stringify([frame.chosen.scene, frame.kind]);
    const acts = (/** @type {string} */ name) => name !== 'restitution' || !('damps' in frame) || frame.damps;
    this.axes = axesOf(frame, this.page.model, this.page.changes.held).filter(
      ({ high, low, name }) => high > low && acts(name), // restitution may be that of a prediction alone
    );
    if (scene !== this.scene) {
      this.scene = scene;
      this.ranges.clear();
      this.lattices.clear();
      this.modes.forget();
      this.gains.forget();
      this.wanted = {};
      this.named = { x: '', y: '' };
    }
    if (this.asked) follow(this, this.asked);
    this.asked = '';
    this.#settle();
    this.schedule();
  }
  /** Axes that there are. */
  #settle() {
    const there = usualFirst(this.axes);
    if (!this.axis(this.named.x)) this.named.x = there.find((name) => name !== this.named.y) ?? '';
    if (!this.axis(this.named.y)) this.named.y = there.find((name) => name !== this.named.x) ?? '';
    for (const axis of this.axes) this.ranges.follow(axis, this.value(axis));
  }
  /**
   * @param {import('./sentence.js').Slot} slot
   * @param {string} name
   */
  choose(slot, name) {
    if (slot === 'of') this.result = /** @type {Result} */ (name);
    else if (slot === 'within') this.modes.models.bound = Number(name);
    else {
      const other = slot === 'x' ? 'y' : 'x';
      if (this.named[other] === name) this.named[other] = this.named[slot];
      this.named[slot] = name;
    }
    this.schedule();
  }
  schedule() {
    if (this.open) this.due = inTurn(this.turn);
  }
  /** Impacts have come in: shown at once where they are waited for, else some times a second. */
  came() {
    if (this.held || (this.modes.shown?.jobs.rough ?? this.jobs.coarse)) this.schedule();
    else this.streaming ??= window.setTimeout(() => [(this.streaming = undefined), this.schedule()], STREAM);
  }
  /** What is kept of the scene as it is chosen, but for its axes. */
  #lattice() {
    const { named } = this;
    const others = Object.entries(this.chosen).filter(([name]) => name !== named.x && name !== named.y);
    return this.lattices.get(JSON.stringify([named.x, named.y, this.points.source === this.points.own, others]));
  }
  /** All that follows. */
  draw() {
    this.due = false;
    const { plane, points, x, y } = this;
    const { shown } = this.modes;
    if (!this.open || !points.ready || !(shown ?? plane).measure()) return;
    if (!x || !y || !points.about(this.chosen, [x.name, y.name])) {
      this.view = null;
      this.jobs.plan(null);
      write(this.status, text(x && y ? 'whatif.not-here' : 'whatif.no-axes'));
      this.work.follow();
      return;
    }
    const results = this.#results();
    if (this.jobs.own.found && !results.includes(this.result)) [this.result] = results;
    if (shown) this.#instead(shown, results);
    else {
      this.#look(x, y);
      this.#paint();
      this.over();
      this.borders.follow();
    }
    this.beside(results);
    this.say();
    this.work.follow();
    this.spoken.follow();
    this.along.behind.follow();
    points.feed();
  }
  /**
   * All that stands beside the map: title, small maps, what is wanted, what each choice does.
   * @param {Result[]} results
   */
  beside(results) {
    const { x, y } = this;
    const { bound: within } = this.modes.models;
    this.sentence.show({ results, axes: this.axes, of: this.result, x, y, bounds: BOUNDS, within });
    this.tiles.offer(results);
    this.designs.follow();
    if (this.modes.shown) this.tiles.say((result) => this.here(result), this.result);
    else this.#tile();
    this.goal.follow();
    this.goal.draw();
    this.gains.follow();
    this.along.follow();
  }
  /**
   * What of the lattice is seen, where that is not known already.
   * @param {Axis} x
   * @param {Axis} y
   */
  #look(x, y) {
    const lattice = this.#lattice();
    const [[x0, x1], [y0, y1]] = [this.range(x), this.range(y)];
    const { h, w } = this.plane.plot;
    const cell = this.points.cell([w, h], this.held);
    const seen = JSON.stringify([lattice.number, lattice.version, x0, x1, y0, y1, w, h, cell]);
    if (this.view && seen === this.seen) return;
    this.seen = seen;
    if (this.lattice && lattice !== this.lattice) this.grip.move();
    this.lattice = lattice;
    this.view = new Window(lattice, { x, y, x0, x1, y0, y1 }, [w, h], cell);
    this.jobs.plan(this.view);
  }
  /** The map, where anything that it shows has changed. */
  #paint() {
    const { held, plane, result, view } = this;
    if (!view) return;
    const wanted = this.wanted[result] ?? null;
    const filled = `${this.seen} ${result}`;
    if (filled !== this.filled) {
      view.fill(result);
      this.#scale();
    }
    this.filled = filled;
    const painted = JSON.stringify([filled, this.domain, wanted, held, plane.blank, sizeOf(plane.root)]);
    if (!this.domain || painted === this.painted) return;
    plane.draw(view, result, this.domain, wanted, held);
    this.painted = painted;
  }
  /**
   * Another view in the place of the map.
   * @param {NonNullable<Modes['shown']>} shown
   * @param {Result[]} results
   */
  #instead(shown, results) {
    this.view = null;
    this.seen = '';
    this.jobs.plan(null);
    this.borders.rest();
    shown.draw(results);
    this.domain = shown.domain;
    this.domainOf = '';
  }
  /** @param {[number, number] | null} at  What is under a pointer. */
  look(at) {
    this.borders.look(at);
  }
  /** What is above the map: the point of the scene. */
  over() {
    const { plane, view, x, y } = this;
    if (!view || !this.domain) return;
    const values = /** @type {[number, number]} */ ([this.value(x), this.value(y)]);
    const at = /** @type {[number, number]} */ ([placeOf(x, values[0]), placeOf(y, values[1])]);
    const wanted = this.wanted[this.result] ?? null;
    plane.drawOver(
      { x, y, at, values, result: this.result, value: this.here(this.result), wanted, ...this.designs.shown },
      view.axes,
    );
  }
  /**
   * What the page has found of the scene.
   * @param {Result} result
   */
  here(result) {
    const value = valueOf(result, figuresOfWhole(this.page.frame));
    const { found } = this.jobs.own;
    return Number.isNaN(value) && found ? valueOf(result, found) : value;
  }
  /** Results that there are in this scene. */
  #results() {
    const { found } = this.jobs.own;
    const there = NAMES.filter((name) => Number.isFinite(this.here(name)));
    const some = there.filter((name) => !OFTEN_NONE.includes(name) || Math.abs(this.here(name)) > LEAST);
    if (found || some.length) return some.length ? some : NAMES;
    return NAMES;
  }
  /** The scale follows where values have gone far beyond it, or it is of something else. */
  #scale() {
    const { held, result, view } = this;
    const found = view && domainOf(view, result);
    const of = JSON.stringify([result, this.named, this.scene]);
    if (!found) {
      if (of !== this.domainOf) this.domain = shownOf(result).whole ? [0.5, 5.5] : null;
      return;
    }
    const { domain } = this;
    const off = domain && Math.max(...found.map((end, k) => Math.abs(end - domain[k]))) / (domain[1] - domain[0]);
    if (of === this.domainOf && off !== null && (held || off < OFF) && !this.jobs.coarse) return;
    this.domain = found;
    this.domainOf = of;
  }
  #tile() {
    this.tiles.say((result) => this.here(result), this.result);
    const { view, x, y } = this;
    const wait = this.tiles.wait(() => this.schedule());
    if (wait || !view || (this.held && this.jobs.coarse)) return;
    const share = (/** @type {Axis} */ axis) => {
      const [from, to] = this.range(axis);
      return (placeOf(axis, this.value(axis)) - from) / (to - from);
    };
    if (this.tiles.draw(view, [share(x), share(y)], this.seen)) this.filled = ''; // it is with another result by now
  }
  /** How many impacts there are, by what, and how wrong that is. */
  say() {
    const { points } = this;
    const count = grouped(points.solved);
    const where = points.source === points.own ? 'browser' : 'server';
    const busy = String(!this.jobs.idle && !points.stopped);
    const said = [text('whatif.status', { count, where, busy }), ...points.by].join(' · ');
    write(this.status, this.modes.shown === this.modes.models ? this.modes.models.status : said);
  }
  /**
   * Set choices by hand.
   * @param {[axis: Axis, value: number][]} values
   */
  set(values) {
    for (const [axis, value] of values) {
      if (axis.body) this.page.bodies.set(axis.name, value);
      else this.page.choose(axis.name, value);
    }
  }
}
