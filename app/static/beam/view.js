// Everything that is shown of an impact on a beam: stage, views over time, dispersion, contact law, story.
import { Cycle } from '../axial/charts.js';
import { Axis } from '../charts/axis.js';
import { between } from '../charts/scale.js';
import { make, segments } from '../shell/dom.js';
import { InView } from '../shell/in_view.js';
import { Stack } from '../shell/stack.js';
import { family, text } from '../text/catalogue.js';
import { called } from '../text/words.js';
import { BeamForce, BeamMotion, BeamSpaceTime, Dispersion } from './charts.js';
import { Energies } from './energies.js';
import { fieldOf, FIELDS } from './field.js';
import { Reactions } from './reactions.js';
import { BeamStage } from './stage.js';
import { BeamStory } from './story.js';

/** @import { Page } from '../page.js' */
/** @import { BeamFrame } from '../shell/message.js' */
/** @import { Band } from './charts.js' */
/** @import { BeamField, What } from './field.js' */

/**
 * What has a chart.
 * @typedef {BeamSpaceTime | BeamForce | BeamMotion | Reactions | Energies | Dispersion | Cycle} Part
 */

const SLOW_SECONDS = 16;
const SLOW_CONTACTS = 4;
const OF_BENDING = ['moment', 'shear'];
const LEAST_ROOM = 1e-5; // of the whole impact, about what is looked at closely

/**
 * Whether all impacts are impulses without duration, and there is nothing beside that has a force.
 * @param {BeamFrame} frame
 */
const withoutForce = ({ halfForce, main, moving, reference }) =>
  moving ? moving.restitution !== null : main.name === 'rigid' && !reference && !halfForce;

export class BeamView {
  /** @type {What} */ what = 'moment'; // that the colours show
  usual = 'moment';
  whats = FIELDS;
  after = 1e-6;
  /** @type {BeamFrame} */ frame;
  /** @type {BeamField} */ field;
  /** @type {Band | null} */ band = null; // of an ensemble, behind the curves

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.axis = new Axis();
    const go = (/** @type {number} */ t) => page.player.seek(t);
    this.stage = new BeamStage();
    this.spaceTime = new BeamSpaceTime(this.axis, go, (what, end) => page.compare.scales.end(what, end));
    this.force = new BeamForce(this.axis, go);
    this.motion = new BeamMotion(this.axis, go);
    this.dispersion = new Dispersion();
    this.cycle = new Cycle();
    this.reactions = new Reactions(this.axis, go);
    this.energies = new Energies(this.axis, go);
    this.charts = [this.spaceTime, this.force, this.motion];
    this.axis.watch(() => this.zoomed());
    /** @type {Part[]} */
    const parts = [...this.charts, this.reactions, this.energies, this.cycle, this.dispersion];
    this.inView = new InView(parts, (part) => this.paint(part));
    this.story = new BeamStory(page);
    const names = family('beam.colour');
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
    const [waves, force, moved] = this.charts.map(({ chart }) => chart);
    const [reactions, energy] = [this.reactions.chart, this.energies.chart];
    this.stack = new Stack('beam', { waves, force, reactions, energy, moved }, () => page.redraw());
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
  /** @param {BeamFrame} frame */
  load(frame) {
    this.frame = frame;
    this.field = fieldOf(frame);
    const { chosen, opens } = frame;
    this.axis.open(chosen.scene, this.page.compare.span(frame), opens.until && opens.until / frame.trip);
    this.#offer();
    this.force.load(frame);
    this.motion.load(frame);
    this.cycle.load(frame);
    this.reactions.load(frame);
    this.energies.load(frame);
    const { chart: force } = this.force;
    force.root.hidden = withoutForce(frame);
    const first = [force, this.reactions.chart, this.motion.chart].find(({ root }) => !root.hidden);
    const { mechanism } = frame;
    this.spaceTime.chart.root.hidden = Boolean(mechanism && !mechanism.links[mechanism.struck].flexible);
    this.stack.lead(frame.chosen.scene, frame.opens.charts);
    this.strip = this.stack.leader ?? first ?? force; // is seen on a phone, whatever else is
    this.dispersion.load(frame);
    const { lengthwise } = this.field;
    this.spaceTime.chart.title.textContent = text(
      lengthwise && mechanism ? 'beam.chart.waves-along' : 'beam.chart.waves',
    );
    for (const button of this.colours.root.children)
      if (button instanceof HTMLElement) button.hidden = !this.#shows(button.dataset.kind ?? '');
    this.dress();
    this.draw();
  }
  /** Its histories have become finer. */
  refine() {
    const { frame } = this;
    this.field = fieldOf(frame);
    for (const part of [this.force, this.motion, this.reactions, this.energies]) part.load(frame);
    this.force.chart.root.hidden = withoutForce(frame);
    this.dress();
    this.draw();
    this.show(this.page.player.t);
  }
  /**
   * Whether there is anything of it to be seen in this impact.
   * @param {string} what
   */
  #shows(what) {
    if (this.frame.moving) return what !== 'velocity'; // far from any line along which it could be told
    return !this.field.lengthwise || !OF_BENDING.includes(what);
  }
  /** What the colours show of this impact. */
  get shown() {
    return this.#shows(this.what) ? this.what : this.frame.moving ? 'moment' : 'velocity';
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
    if (!(part instanceof Cycle)) {
      if (!(part instanceof Dispersion)) part.cursor(t);
    } else if (cycleDepth) part.mark(between(time, impactorPath, t) - between(time, struckPath, t), this.force.at(t));
  }
  /** A phone has no room for both buttons beside the caption. */
  #offer() {
    const { zoomed } = this.axis;
    this.whole.hidden = !zoomed;
    this.slow.hidden = this.frame.contacts.length < 2 || (zoomed && this.page.layout.mode === 'phone');
  }
  // Another stretch of time fills the views.
  zoomed() {
    this.#offer();
    this.draw();
  }
  /**
   * A stretch and some room about it fill the views; all of the impact without one.
   * @param {number} [start]
   * @param {number} [end]
   */
  zoom(start, end) {
    if (start === undefined || end === undefined) {
      this.axis.reset();
      return;
    }
    this.axis.lookAt(start, end, LEAST_ROOM);
    this.page.player.go(start);
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
    const name = called(frame.main).replaceAll(/\W+/g, '_');
    const moved = [frame.impactorPath, frame.struckPath, frame.impactorRate, frame.struckRate];
    const columns = ['impactor_m', 'struck_place_m', 'impactor_m_per_s', 'struck_place_m_per_s'];
    const values = Array.from({ length: points + 1 }, (_, k) => {
      const t = (k / points) * frame.duration;
      return [t / 1e3, this.force.at(t), ...moved.map((history) => between(frame.time, history, t))];
    });
    return { names: ['time_s', `force_${name}_N`, ...columns], values };
  }
}
