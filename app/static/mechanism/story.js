// What happens to a struck mechanism, in words and figures, tied to the moment shown.
import { spanOf } from '../beam/events.js';
import { BeamStory } from '../beam/story.js';
import { family, text } from '../text/catalogue.js';
import { duration } from '../text/format.js';
import { impactTable, keptOf, movingEvents, movingNow, movingReasons, movingShares } from './moving_story.js';
import { Joints, mechanismEvents, mechanismReasons } from './resting_story.js';

/** @import { Row } from '../beam/story.js' */
/** @import { Page } from '../page.js' */
/** @import { BeamFigures, MechanismFrame } from '../messages.js' */

/** @extends {BeamStory<MechanismFrame>} */
export class MechanismStory extends BeamStory {
  /** @param {Page} page */
  constructor(page) {
    super(page);
    this.joints = new Joints();
    this.source.before(this.joints.root);
  }
  /** @param {MechanismFrame} frame */
  question({ main, moving }) {
    return text('opening.question.mechanism', { moving: Boolean(moving), contacts: main.contacts });
  }
  /** @param {MechanismFrame} frame */
  load(frame) {
    super.load(frame);
    this.joints.load(frame);
  }
  narrate() {
    const { frame } = this;
    const { moving } = frame;
    this.events.load(moving ? movingEvents(frame) : mechanismEvents(frame));
    const { contacts } = frame.main;
    this.whyHeading.textContent = moving ? text('motion.title') : text('beam.why.title', { contacts });
    this.why.textContent = moving ? movingReasons(frame) : mechanismReasons(frame);
    this.span.textContent = moving ? keptOf(frame) : spanOf(frame);
  }
  contactTable() {
    if (this.frame.moving) impactTable(this.table, this.frame, (t) => this.page.player.seek(t));
    else super.contactTable();
  }
  get about() {
    return 'beam.note.beside-rigid';
  }
  /**
   * @param {BeamFigures[]} both
   * @returns {Row[]}
   */
  rows(both) {
    const { beam, moving } = this.frame;
    if (!moving) return super.rows(both);
    const names = beam.held ? ['impactor-at-end'] : ['impactor-at-end', 'target-at-end'];
    return [...this.leaving(both, names), ...this.dents(both), ...this.solved()];
  }
  shares() {
    if (!this.frame.moving) return super.shares();
    this.went.textContent = text('motion.went', { time: duration(this.frame.duration) });
    return movingShares(this.energy, this.frame);
  }
  parts() {
    return { ...super.parts(), ...family('beam.mechanism.energy') };
  }
  /**
   * @param {number} t
   * @param {number} here  the contact that lasts, if any
   */
  sentence(t, here) {
    return this.frame.moving ? movingNow(this.frame, t, this.values(t)) : super.sentence(t, here);
  }
}
