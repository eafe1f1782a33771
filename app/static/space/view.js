// Everything that is shown of an impulse between bodies in space.
import { segments } from '../browser/dom.js';
import { timesOf } from '../form/settings.js';
import { Stack } from '../frame/stack.js';
import { family, text } from '../text/catalogue.js';
import { Course, Hodograph } from './charts.js';
import { LOOKS } from './hands.js';
import { BodiesStage } from './stage.js';
import { SpaceStory } from './story.js';
import { CLOCK, impulseAt, meets, movedAt, shareAt, tracksOf } from './tracks.js';

/** @import { Page } from '../page.js' */
/** @import { Second } from '../compare/beside.js' */
/** @import { Frame, SpaceFrame } from '../messages.js' */

const MOVEMENT = { start: -1, length: 2 }; // in units of the message's duration, the impact at 0
const FIRST = 1.7; // after the impact: where it is shown at first

export class SpaceView {
  after = 0;
  leading = ['friction', 'spin', 'restitution', 'speed'];
  /** @type {SpaceFrame} */ frame;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.stage = new BodiesStage();
    this.story = new SpaceStory(page, () => this.slow);
    this.charts = [new Hodograph(), new Course()];
    const [hodograph, course] = this.charts.map(({ chart }) => chart);
    this.stack = new Stack('bodies', { hodograph, course }, () => page.redraw());
    const names = family('space.look');
    const look = (/** @type {string} */ name) => this.look(/** @type {keyof LOOKS} */ (name));
    this.looks = segments(text('space.looks'), Object.keys(LOOKS), look, (name) => names[name]);
    this.looks.root.classList.add('small');
    this.stage.root.append(this.looks.root);
    /** @type {HTMLElement[]} */
    this.buttons = [];
    this.look('side');
    this.hide(true);
  }
  /** @param {keyof LOOKS} name  from where */
  look(name) {
    this.stage.look(LOOKS[name]);
    this.looks.show(name);
  }
  /** @param {boolean} hidden */
  hide(hidden) {
    for (const part of [this.stage.root, this.stack.root]) part.hidden = hidden;
  }
  /** @param {SpaceFrame} frame */
  load(frame) {
    this.frame = frame;
    this.page.root.classList.toggle('rubs', Boolean(frame.slidePress));
    for (const part of this.charts) part.load(frame);
    this.stack.arrange();
    this.dress();
  }
  /** Whether the clock runs through the impact: in the opening, unless they do not meet. */
  get slow() {
    return this.page.opening.leads && Boolean(this.frame) && meets(this.frame);
  }
  /** @param {SpaceFrame} frame */
  clock(frame) {
    const { chosen, duration } = frame;
    const run = { kind: 'bodies', scene: chosen.scene, unit: duration, first: FIRST, time: timesOf(frame).time };
    if (!this.slow) return { ...run, ...MOVEMENT };
    return { ...run, ...CLOCK, said: (/** @type {number} */ t) => impulseAt(frame, t) };
  }
  /** @param {SpaceFrame} frame  without friction all models are one */
  restitution({ chosen, friction }) {
    return { note: text('controls.in-space', { model: friction > 0 ? chosen.restitution_model : '' }) };
  }
  /**
   * @param {SpaceFrame} frame
   * @returns {Second}
   */
  beside(frame) {
    const stage = new BodiesStage();
    const draw = (/** @type {Frame} */ now, /** @type {number} */ t) =>
      stage.draw('trip' in now ? 1 : (t * now.duration) / frame.duration);
    return { stage, load: () => stage.load(frame), draw };
  }
  get section() {
    return this.slow ? tracksOf(this.frame) : null;
  }
  dress() {
    this.page.compare.dress('');
    this.stage.load(this.frame);
    this.page.compare.share(this.stage);
  }
  /** @param {number} t */
  show(t) {
    if (this.slow) this.stage.draw(movedAt(t), shareAt(t));
    else this.stage.draw(t);
  }
  draw() {
    for (const part of this.charts) if (!part.chart.root.hidden) part.draw();
  }
}
