// Everything that is shown of an impulse between bodies in space.
import { BodiesStage } from './stage.js';
import { SpaceStory } from './story.js';

/** @import { SpaceFrame } from '../shell/message.js' */

export class SpaceView {
  after = 0;

  constructor() {
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
    this.stage.load(frame);
  }
  /** @param {number} t */
  show(t) {
    this.stage.draw(t);
  }
  draw() {}
  zoom() {}
}
