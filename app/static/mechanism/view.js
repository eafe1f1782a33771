// Everything that is shown of an impact on a mechanism: what is of a beam, of its struck link, and of all joints.
import { BeamView } from '../beam/view.js';
import { Axis } from '../charts/axis.js';
import { text } from '../text/catalogue.js';
import { Energies } from './energies.js';
import { linkField } from './field.js';
import { Reactions } from './reactions.js';
import { MechanismStage } from './stage.js';
import { MechanismStory } from './story.js';
import { tracksOf } from './tracks.js';

/** @import { Page } from '../page.js' */
/** @import { MechanismFrame } from '../messages.js' */

const SECONDS_MOVED = 8; // at least; a longer motion takes the time that it takes
const BUSY = { room: 1.4, most: 0.3 }; // after the last impact; of the whole

/** @extends {BeamView<MechanismFrame>} */
export class MechanismView extends BeamView {
  /** @param {Page} page */
  constructor(page) {
    const axis = new Axis();
    const go = (/** @type {number} */ t) => page.player.seek(t);
    const [reactions, energies] = [new Reactions(axis, go), new Energies(axis, go)];
    const own = { name: 'mechanism', stage: new MechanismStage(), story: new MechanismStory(page), axis };
    super(page, { ...own, more: { reactions, energy: energies } });
    this.reactions = reactions;
    this.energies = energies;
  }
  take() {
    super.take();
    const { frame } = this;
    this.reactions.load(frame);
    this.energies.load(frame);
    const { links, struck } = frame.mechanism;
    const { root, title } = this.spaceTime.chart;
    root.hidden = !links[struck].flexible;
    title.textContent = text(this.field.lengthwise ? 'beam.chart.waves-along' : 'beam.chart.waves');
  }
  /**
   * @param {MechanismFrame} frame
   * @param {string} [room]
   */
  fieldsOf(frame, room) {
    return linkField(frame, room);
  }
  /** @param {MechanismFrame} frame */
  beside(frame) {
    return super.beside(frame, new MechanismStage());
  }
  get busy() {
    const { contacts, duration, moving } = this.frame;
    const last = BUSY.room * (contacts.at(-1)?.[0] ?? 0);
    return this.page.opening.leads && moving && last > 0 && last < BUSY.most * duration ? last : null;
  }
  /** @param {MechanismFrame} frame */
  clock(frame) {
    const run = super.clock(frame);
    if (frame.moving) run.perSecond = frame.duration / Math.max(SECONDS_MOVED, frame.duration);
    return run;
  }
  get leading() {
    return this.frame.mechanism.links.some(({ flexible }) => flexible) ? ['modes', 'mass_ratio'] : [];
  }
  /** What the opening draws of it over time: its picture shows all links, so that rows of one would say little. */
  get section() {
    const { axis, field, force, frame, stage } = this;
    return stage.frame ? tracksOf(frame, field, force.chart.content.series, axis.view, stage.usual.moment) : null;
  }
  get usualStrip() {
    const [force, moved] = super.usualStrip;
    return [force, this.reactions.chart, moved];
  }
  get withoutForce() {
    const { moving } = this.frame;
    return moving ? moving.restitution !== null : super.withoutForce;
  }
  /** @param {string} what */
  shows(what) {
    // far from any line along which a velocity could be read
    return this.frame.moving ? what !== 'velocity' : super.shows(what);
  }
  get shown() {
    if (!this.frame.moving) return super.shown;
    return this.shows(this.what) ? this.what : 'moment';
  }
}
