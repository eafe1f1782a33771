// A body that is dropped and bounces, as the opening shows it: its height over time. The laboratory shows one impact.
import { make } from '../browser/dom.js';
import { timesOf } from '../form/settings.js';
import { Events } from '../frame/story.js';
import { text } from '../text/catalogue.js';
import { figures, length, percent, speed } from '../text/format.js';
import { fallOf } from './fall.js';
import { impactsOf, Lens } from './lens.js';
import { FallStage } from './stage.js';

/** @import { Page } from '../page.js' */
/** @import { AxialFrame, Frame } from '../messages.js' */
/** @import { Event } from '../frame/story.js' */
/** @import { Fall } from './fall.js' */

const NAMED = 4; // bounces that have a name

/** @param {Frame} frame  whether it is of a dropped body */
export const falls = (frame) => 'fall' in frame && Boolean(frame.fall);

/**
 * @param {Fall} fall
 * @returns {Event[]}
 */
export function eventsOf({ bounces, gravity, height, rest }) {
  const found = bounces.map(({ height: rises, restitution, t }, k) => {
    const before = k ? bounces[k - 1].height : height;
    const values = {
      ...{ number: k + 1, fast: speed(Math.sqrt(2 * gravity * before)), stays: rises <= 0 },
      ...{ left: percent(Math.max(restitution, 0)), share: percent(rises / before) },
    };
    const name = k < NAMED ? text('fall.named.bounce', { number: k + 1 }) : undefined;
    return /** @type {Event} */ ([t, text('fall.event.bounce', values), name]);
  });
  /** @type {Event} */
  const first = [0, text('fall.event.let-go', { height: length(height) }), text('fall.named.let-go')];
  /** @type {Event[]} */
  const last =
    rest === null ? [] : [[rest, text('fall.event.rest', { time: figures(rest, 3) }), text('fall.named.rest')]];
  return [first, ...found.filter(([t]) => rest === null || t < rest), ...last];
}

const FIRST = 0.36; // of it all: where it is shown at first

export class FallView {
  after = 1e-9;
  /** @type {HTMLElement[]} */ buttons = [];
  /** @type {Fall | null} */ fall = null;
  given = false;
  closer = new Lens();
  lens = this.closer.root;

  /** @param {Page} page */
  constructor(page) {
    const go = (/** @type {number} */ t) => page.player.seek(t);
    this.stage = new FallStage(go);
    const events = new Events(go, (t) => `${figures(t, 3)} s`, 1e-9);
    const [root, numbers] = [make('div', { className: 'story' }, events.root), make('div')];
    const load = () => events.load(this.fall ? eventsOf(this.fall) : []);
    const question = () => this.#question;
    this.story = { events, root, numbers, load, question, at: (/** @type {number} */ t) => events.at(t) };
    this.hide(true);
  }
  /** @param {boolean} hidden */
  hide(hidden) {
    this.stage.root.hidden = hidden;
    this.lens.hidden = hidden || !this.closer.impacts.length;
  }
  /** @param {AxialFrame} frame */
  load(frame) {
    this.given = frame.rigid; // its restitution, as nothing gives way
    this.fall = fallOf(frame);
    this.stage.load(this.fall);
    this.closer.load(this.fall ? impactsOf(frame, this.fall.bounces) : []);
  }
  /** @param {AxialFrame} frame */
  clock(frame) {
    const end = this.fall?.end ?? 1;
    const { time } = timesOf(frame);
    return { kind: 'fall', scene: frame.chosen.scene, length: end, unit: 1, first: FIRST * end, time };
  }
  get leading() {
    return this.given ? ['restitution', 'speed', 'law'] : ['speed', 'law'];
  }
  get #question() {
    const { bounces = [], rest = null } = this.fall ?? {};
    const last = bounces[bounces.length - 1]?.restitution ?? 0;
    const goes = rest !== null ? 'rests' : last >= 1 ? 'never' : 'less';
    return text('opening.question.fall', { way: bounces.length < 2 ? 'stays' : goes });
  }
  dress() {}
  draw() {
    this.closer.draw();
  }
  zoom() {}
  /** @param {number} t */
  show(t) {
    this.stage.draw(t);
    this.closer.show(t);
  }
}
