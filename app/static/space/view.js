// Everything that is shown of an impulse between bodies in space.
import { BodiesStage } from './stage.js';
import { SpaceStory } from './story.js';

/** @import { Page } from '../page.js' */
/** @import { SpaceFrame } from '../shell/message.js' */

export class SpaceView {
  after = 0;
  /** @type {SpaceFrame} */ frame;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.stage = new BodiesStage();
    this.story = new SpaceStory();
    /** @type {HTMLElement[]} */
    this.buttons = [];
    this.hide(true);
  }
  /** @param {boolean} hidden */
  hide(hidden) {
    this.stage.root.hidden = hidden;
  }
  /** @param {SpaceFrame} frame */
  load(frame) {
    this.frame = frame;
    this.dress();
  }
  dress() {
    this.page.compare.dress('');
    this.stage.load(this.frame);
    this.page.compare.share(this.stage);
  }
  /** @param {number} t */
  show(t) {
    this.stage.draw(t);
  }
  draw() {}
  zoom() {}
}
