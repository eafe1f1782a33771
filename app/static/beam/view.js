// Everything that is shown of an impact on a beam: stage, views over time, dispersion, contact law, story.
import { Cycle } from '../axial/cycle.js';
import { Axis } from '../charts/axis.js';
import { Gauge } from '../charts/gauge.js';
import { between } from '../charts/scale.js';
import { Supports } from '../charts/supports.js';
import { instantIn } from '../compare/beside.js';
import { make, segments } from '../browser/dom.js';
import { timesOf } from '../form/settings.js';
import { InView } from '../frame/in_view.js';
import { Stack } from '../frame/stack.js';
import { SECONDS } from '../clock/times.js';
import { family, text } from '../text/catalogue.js';
import { engineering } from '../text/format.js';
import { called } from '../text/words.js';
import { BeamForce, BeamMotion, BeamSpaceTime, Dispersion, UNITS } from './charts.js';
import { FIELDS } from './field.js';
import { fieldOf } from './field_of.js';
import { hasForce, sectionOf } from './rows.js';
import { BeamStage } from './stage.js';
import { BeamStory } from './story.js';
import { supportsOf } from './supports.js';

/** @import { Page } from '../page.js' */
/** @import { Chart } from '../charts/chart.js' */
/** @import { Source } from '../charts/gauge.js' */
/** @import { Second } from '../compare/beside.js' */
/** @import { BendingFrame } from '../messages.js' */
/** @import { Band } from './charts.js' */
/** @import { Run } from '../clock/player.js' */
/** @import { BeamField, What } from './field.js' */

/**
 * What has a chart.
 * @typedef {object} Part
 * @property {Chart} chart
 * @property {(band: Band | null) => void} draw
 * @property {(t: number) => void} [cursor]
 */
/**
 * What shows one kind of it.
 * @typedef {object} Parts
 * @property {string} name  by which it is kept what is folded
 * @property {BeamStage} stage
 * @property {BeamStory} story
 * @property {Axis} axis  of time
 * @property {Record<string, Part>} more  charts over time, by name
 */

const QUANTITIES = Object.fromEntries(
  FIELDS.map((what) => [what, { unit: UNITS[what], parts: [what], factor: () => 1 }]),
);
const SECONDS_PLAYED = 24; // no wave comes back as it went: all of it in less than long impacts of rods take
const FIRST = 0.9; // of the first contact: where it is shown at first
const SLOW_SECONDS = 16;
const SLOW_CONTACTS = 4;
const OF_BENDING = ['moment', 'shear'];

/** @template {BendingFrame} [Shown=BendingFrame] */
export class BeamView {
  /** @type {What} */ what = 'moment'; // that the colours show
  usual = 'moment';
  whats = FIELDS;
  after = 1e-9;
  leastRoom = 1e-5;
  linkUnit = 1e-3; // s
  /** @type {Shown} */ frame;
  /** @type {BeamField} */ field;
  /** @type {Band | null} */ band = null; // of an ensemble, behind the curves

  /**
   * @param {Page} page
   * @param {Parts} [parts]
   */
  constructor(page, parts) {
    const own = { name: 'beam', stage: new BeamStage(), story: new BeamStory(page), axis: new Axis(), more: {} };
    const { name, stage, story, axis, more } = parts ?? own;
    const go = (/** @type {number} */ t) => page.player.seek(t);
    this.page = page;
    this.stage = stage;
    this.story = story;
    this.axis = axis;
    this.spaceTime = new BeamSpaceTime(this.axis, go, (what, end) => page.compare.scales.end(what, end));
    this.force = new BeamForce(this.axis, go);
    this.motion = new BeamMotion(this.axis, go);
    this.dispersion = new Dispersion();
    this.cycle = new Cycle();
    this.charts = [this.spaceTime, this.force, this.motion];
    const names = family('beam.colour');
    this.gauge = new Gauge({
      ...{ axis: this.axis, xUnit: SECONDS, quantities: QUANTITIES, names, go },
      written: (t) => engineering(t, 's'),
      move: (place) => this.gaugeAt(place),
      turned: () => page.history.later(),
    });
    this.supports = new Supports(this.axis, SECONDS, go, supportsOf);
    this.axis.watch(() => this.zoomed());
    /** @type {Part[]} */
    const all = [...this.charts, ...Object.values(more), ...this.gauge.parts, this.supports];
    all.push(this.cycle, this.dispersion);
    this.inView = new InView(all, (part) => this.paint(part));
    this.colours = segments(
      text('stage.colour-shows'),
      FIELDS,
      (what) => this.colour(what),
      (what) => names[what],
    );
    this.whole = make('button', { type: 'button', className: 'whole', textContent: text('stage.whole') });
    this.whole.onclick = () => this.page.zoom();
    this.slow = make('button', { type: 'button', className: 'whole slow-motion', textContent: text('beam.view.slow') });
    this.slow.title = text('beam.view.slow-about');
    this.slow.onclick = () => this.slowly();
    this.spaceTime.chart.title.after(this.colours.root);
    const { chart: force } = this.force;
    const beside = Object.fromEntries(Object.entries(more).map(([key, { chart }]) => [key, chart]));
    const { along, over } = this.gauge;
    const late = { stress: over, along, support: this.supports.chart };
    const charts = { waves: this.spaceTime.chart, force, ...beside, moved: this.motion.chart, ...late };
    this.stack = new Stack(name, charts, () => page.redraw(), Object.keys(late));
    this.strip = force;
    this.buttons = [this.slow, this.whole];
    this.story.numbers.prepend(this.cycle.chart.root, this.dispersion.chart.root);
    this.hide(true);
  }
  /** @param {string} what  that the colours are to show */
  colour(what) {
    this.what = /** @type {What} */ (what);
    this.dress();
    this.draw(true);
    this.show(this.page.player.t);
    this.page.history.later();
  }
  /** @param {boolean} hidden */
  hide(hidden) {
    for (const part of [this.stage.root, this.stack.root, ...this.buttons]) part.hidden = hidden;
  }
  /** @param {Shown} frame */
  load(frame) {
    this.frame = frame;
    const { chosen } = frame;
    const until = timesOf(frame).until ?? this.busy;
    this.axis.open(chosen.scene, this.page.compare.span(frame), until && until / frame.trip);
    this.#offer();
    this.take();
    this.cycle.load(frame);
    this.dispersion.load(frame);
    this.stack.lead(frame.chosen.scene, frame.opens.charts);
    const usual = this.usualStrip.find(({ root }) => !root.hidden);
    this.strip = this.stack.leader ?? usual ?? this.force.chart; // is seen in the opening where there are no rows
    for (const button of this.colours.root.children)
      if (button instanceof HTMLElement) button.hidden = !this.shows(button.dataset.kind ?? '');
    this.dress();
  }
  /** Fields and histories of what is shown. */
  take() {
    const { frame } = this;
    this.field = this.fieldsOf(frame);
    this.force.load(frame);
    this.motion.load(frame);
    this.force.chart.root.hidden = this.withoutForce;
    const { beam, chosen, contacts, opens } = frame;
    const has = (/** @type {string} */ what) => this.shows(what) && this.field.has(/** @type {What} */ (what));
    const reach = /** @type {[number, number]} */ ([0, FIELDS.some(has) ? beam.length : 0]);
    const body = { scene: chosen.scene, frame, contacts, usual: opens.place ?? beam.place, read: opens.read, reach };
    this.gauge.load(body, () => this.read(frame), has);
    this.supports.load(frame, contacts, () => this.read(frame));
  }
  /**
   * Its solution as a gauge reads it.
   * @param {Shown} frame
   * @param {string} [room]  of a field that is shown beside another
   * @returns {Source[]}
   */
  read(frame, room) {
    const name = called(frame.main);
    const field = frame === this.frame ? this.field : this.fieldsOf(frame, room);
    return [{ frame, name, key: name.replaceAll(/\W+/g, '_'), style: 'exact', second: 'struck', field }];
  }
  /** @param {number} place  of the gauge [m] */
  gaugeAt(place) {
    this.gauge.asked = place;
    this.draw();
    this.show(this.page.player.t);
    this.page.history.later();
  }
  /**
   * @param {Shown} frame
   * @param {string} [room]
   * @returns {BeamField}
   */
  fieldsOf(frame, room) {
    return fieldOf(frame, room);
  }
  /**
   * @param {Shown} frame
   * @param {BeamStage} [stage]
   * @returns {Second}
   */
  beside(frame, stage = new BeamStage()) {
    const field = this.fieldsOf(frame, 'beside');
    const shownOf = (/** @type {string} */ what) => FIELDS.find((name) => name === what) ?? 'moment';
    return {
      stage,
      load: (what) => stage.load(frame, field, shownOf(what)),
      draw: (now, t) => stage.draw(instantIn(frame, now, t)),
    };
  }
  /** Charts of which the opening shows the first that there is, where it has no rows. */
  get usualStrip() {
    return [this.force.chart, this.motion.chart];
  }
  /** Whether all impacts are impulses without duration, and there is nothing beside that has a force. */
  get withoutForce() {
    return !hasForce(this.frame);
  }
  /** Until when most of it happens [s], where that is but a small part of what is shown. @returns {number | null} */
  get busy() {
    return null;
  }
  /**
   * @param {Shown} frame
   * @returns {Run}
   */
  clock(frame) {
    const { chosen, contacts, duration, kind, trip } = frame;
    const [start, end] = contacts[0] ?? [0, duration];
    const first = start + FIRST * (end - start);
    const perSecond = duration / SECONDS_PLAYED;
    return { kind, scene: chosen.scene, length: duration, unit: trip, perSecond, first, time: timesOf(frame).time };
  }
  /** @param {Shown} frame */
  restitution({ law }) {
    return { note: text(law.damps ? 'controls.of-contact' : 'controls.of-balances') };
  }
  /** What the opening draws over place and time; nothing of impulses, nor of what is struck along its length. */
  get section() {
    const { field, force, frame, stage } = this;
    if (!stage.frame || !stage.leading) return null;
    return sectionOf(frame, field, this.shown, stage, force.chart.content.series);
  }
  /** Its histories have become finer. */
  refine() {
    this.take();
    this.dress();
    this.draw();
    this.show(this.page.player.t);
  }
  /**
   * Whether there is anything of it to be seen in this impact.
   * @param {string} what
   */
  shows(what) {
    return !this.field.lengthwise || !OF_BENDING.includes(what);
  }
  /** What the colours show of this impact. */
  get shown() {
    return this.shows(this.what) ? this.what : 'velocity';
  }
  dress() {
    const { shown } = this;
    this.page.compare.dress(shown);
    this.stage.load(this.frame, this.field, shown);
    this.page.compare.share(this.stage);
    this.spaceTime.load(this.frame, this.field, shown);
    this.colours.show(shown);
  }
  draw(all = false) {
    if (this.frame && !this.stack.root.hidden) this.inView.draw(all);
  }
  /** @param {Part} part */
  paint(part) {
    if (!this.frame) return;
    const { gauge, spaceTime } = this;
    if (part === spaceTime) spaceTime.content.rules = gauge.seen ? [gauge.place / this.frame.beam.length] : [];
    part.draw(this.band);
    this.point(part, this.page.player.t);
  }
  /** @param {number} t */
  show(t) {
    this.stage.draw(t);
    for (const part of this.inView.seen) this.point(part, t);
  }
  /**
   * What a chart shows of one instant.
   * @param {Part} part
   * @param {number} t
   */
  point(part, t) {
    const { time, impactorPath, struckPath, cycleDepth } = this.frame;
    if (!(part instanceof Cycle)) part.cursor?.(t);
    else if (cycleDepth) part.mark(between(time, impactorPath, t) - between(time, struckPath, t), this.force.at(t), t);
  }
  /** What stands beside the caption. */
  #offer() {
    const { zoomed } = this.axis;
    this.whole.hidden = !zoomed;
    this.slow.hidden = this.frame.contacts.length < 2;
  }
  // Another stretch of time fills the views.
  zoomed() {
    this.#offer();
    this.draw();
  }
  // The first contacts, filling the views, and slowly.
  slowly() {
    const { contacts, duration } = this.frame;
    const end = contacts[Math.min(SLOW_CONTACTS, contacts.length) - 1][1];
    this.page.zoom(0, end);
    this.page.player.through(0, Math.min(1.15 * end, duration), SLOW_SECONDS);
  }
  /** Histories as a table to save. */
  rows(points = 2000) {
    const { frame } = this;
    const [{ key: name }] = this.read(frame);
    const moved = [frame.impactorPath, frame.struckPath, frame.impactorRate, frame.struckRate];
    const gauged = this.gauge.seen ? this.gauge.columns : [];
    const columns = ['impactor_m', 'struck_place_m', 'impactor_m_per_s', 'struck_place_m_per_s'];
    const values = Array.from({ length: points + 1 }, (_, k) => {
      const t = (k / points) * frame.duration;
      const gauge = gauged.map(({ at }) => at(t));
      return [t, this.force.at(t), ...moved.map((history) => between(frame.time, history, t)), ...gauge];
    });
    return { names: ['time_s', `force_${name}_N`, ...columns, ...gauged.map((each) => each.name)], values };
  }
}
