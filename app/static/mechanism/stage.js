// The stage of a struck mechanism: all of its links, and beside them the diagrams of the struck one.
import { BeamStage } from '../beam/stage.js';
import { sizeOf } from '../charts/canvas.js';
import { between } from '../charts/scale.js';
import { Mechanism } from './mechanism.js';
import { MovingMechanism } from './moving.js';

/** @import { MechanismFrame } from '../messages.js' */

const BESIDE = 0.54; // of the width that the picture has beside diagrams
const [COLOURS, CLEAR] = [48, 4]; // pixels: the height of the scale of colours with its words, and room beside it
const LEAST_FOR_REACTIONS = 440; // pixels of width, below which what the arrows are would run into the mechanism

/** @extends {BeamStage<MechanismFrame>} */
export class MechanismStage extends BeamStage {
  /** @type {Mechanism} */ mechanism;
  /** @type {HTMLElement | null} */ lap = null; // what lies over its lower right
  furthest() {
    const { frame } = this;
    this.mechanism = frame.moving ? new MovingMechanism(frame) : new Mechanism(frame, super.furthest());
    this.reaching = this.mechanism.shown;
    return this.mechanism.reach;
  }
  magnify() {
    super.magnify();
    this.mechanism.magnify(this.reach);
  }
  get diagrams() {
    return !this.taught && !this.field.lengthwise && this.mechanism.bends && !this.narrow;
  }
  get predicts() {
    return false; // the shape is that of one link
  }
  get leading() {
    return false; // rows of one link would say little of all of them
  }
  get beside() {
    return !this.narrow; // a mechanism is about as high as wide
  }
  /** @type {BeamStage['share']} */
  share(width, height) {
    if (!this.lap) return [this.diagrams ? BESIDE * width : width, height];
    const [covered, tall] = sizeOf(this.lap);
    return [width - covered, height - tall];
  }
  /** @param {number} height */
  above(height) {
    return height;
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   * @param {number} width
   * @param {number} height
   */
  picture(c, t, width, height) {
    const { frame, mechanism, values, what } = this;
    c.save();
    if (this.lap) {
      c.beginPath();
      c.rect(0, 0, width, height);
      c.clip(); // the mass flies on under what lies beside it
    }
    mechanism.led = this.leads;
    mechanism.fit(width, height);
    mechanism.place(t);
    const rows = mechanism.bending.map((bending) => bending?.profile(t, what));
    rows[mechanism.linkage.struck] = values;
    const value = (/** @type {number} */ n, /** @type {number} */ share) =>
      rows[n]?.[Math.round(share * (rows[n].length - 1))] ?? 0;
    mechanism.ghosts(c, t);
    mechanism.links(c, value, this.usual[what], what === 'moment');
    mechanism.joints(c);
    mechanism.striker(c, t, between(frame.time, frame.impactorPath, t), this.touching(t));
    mechanism.reactions(c, t);
    mechanism.words(c, 12, 36, width < LEAST_FOR_REACTIONS);
    this.striker?.draw(c, mechanism.held);
    c.restore();
  }
  get coloured() {
    return this.mechanism.bends;
  }
  get scaleWords() {
    return this.mechanism.scaleWords;
  }
  get right() {
    return false; // the impactor flies where it will
  }
  /**
   * At the bottom where what strikes comes past the top at any time, so that they stay where they are.
   * @param {number} x
   */
  coloursAt(x) {
    const { held, height, past, wide } = this.mechanism;
    const places = held ? [...past, [held.x, held.y]] : past;
    const covered = (/** @type {number} */ top) =>
      places.some(([a, b]) => a + 0.5 * wide > x - CLEAR && Math.abs(b - top - 0.5 * COLOURS) < 0.5 * (COLOURS + wide));
    return covered(0) && !covered(height - COLOURS) ? height - (this.narrow ? 14 : 24) : super.coloursAt(x);
  }
}
