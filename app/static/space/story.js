// One impulse between bodies in space: a sentence and the figures.
import { make, rowOf } from '../browser/dom.js';
import { Warnings, Events, headed, heading, noteOf } from '../frame/story.js';
import { pretty } from '../text/format.js';
import { said, text } from '../text/catalogue.js';
import { coneOf } from './impulse.js';
import { courseOf, impulseAt, wayOf } from './tracks.js';
import { dot } from './vectors.js';

const BODIES = ['impactor', 'target'];
const ALIKE = 1e-9; // difference of two masses that are one

/** @import { SpaceFrame } from '../messages.js' */
/** @import { Page } from '../page.js' */

/** @param {number | number[] | null} value */
function written(value) {
  if (value === null) return '–';
  if (!Array.isArray(value)) return pretty(value);
  return value.map((part) => pretty(Math.abs(part) < 1e-12 ? 0 : part)).join(', ');
}

/**
 * What happens, in words.
 * @param {SpaceFrame} frame
 */
function touchOf(frame) {
  const { friction, impulse, normal, push, sliding } = frame;
  if (!(impulse > 0)) return text('space.move-apart');
  if (!sliding.length || !friction) return text('space.touch', { impulse: pretty(impulse) });
  const share = pretty(sliding[0].until / dot(push, normal));
  const kinds = sliding.map(({ kind }) => kind).join('-then-');
  const slides = text(`space.sliding.${kinds}`, { angle: coneOf(frame), share });
  return text('space.touch-and-rub', { friction: pretty(friction), impulse: pretty(impulse), slides });
}

/**
 * What is felt of the bodies where they touch, of those that turn.
 * @param {SpaceFrame} frame
 */
function feltOf({ figures }) {
  const known = new Map(figures.map(([name, value]) => [name, value]));
  return BODIES.flatMap((body) => {
    const [mass, felt] = [known.get(`${body}-mass`), known.get(`${body}-felt-mass`)].map(Number);
    const turns = felt < mass * (1 - ALIKE);
    return turns ? [text('space.felt', { body, mass, felt, share: felt / mass })] : [];
  }).join(' ');
}

export class SpaceStory {
  /** @param {SpaceFrame} frame */
  question = (frame) => text('opening.question.bodies', { way: wayOf(frame) });
  /** @type {SpaceFrame} */ frame;

  /**
   * @param {Page} page
   * @param {() => boolean} slow  whether the clock runs through the impact
   */
  constructor(page, slow) {
    this.slow = slow;
    this.units = make('p', { className: 'symbols' });
    this.figures = make('table', { className: 'figures' });
    this.trust = make('p', { className: 'trust' });
    this.warnings = new Warnings();
    this.root = make('div', { className: 'story' }, heading(text('story.events')), this.units);
    this.root.append(this.warnings.heading, this.warnings.list);
    this.numbers = make('div', { className: 'story' }, ...headed(text('story.after'), this.figures), this.trust);
    const reached = (/** @type {number} */ t) => impulseAt(this.frame, t);
    this.events = new Events((t) => page.player.seek(t - page.player.start), reached, 1e-9);
  }
  /** @param {SpaceFrame} frame */
  load(frame) {
    const { figures, notes, source, title } = frame;
    this.frame = frame;
    const touch = touchOf(frame);
    this.units.textContent = `${touch} ${feltOf(frame)}`;
    this.events.load(this.slow() ? courseOf(frame, touch) : [[0, touch]]);
    const rows = figures.map(([name, value, unit]) => rowOf([text(`space.row.${name}`), written(value), unit]));
    this.figures.replaceChildren(make('tbody', {}, ...rows));
    this.warnings.load(notes.map(said));
    this.trust.textContent = noteOf(frame, text('story.source', { title, source }));
  }
  /** @param {number} t */
  at(t) {
    this.events.at(t);
  }
}
