// Names of events beside the rows, each at its time; where not all have room, those about the instant that is shown.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/** @import { Event, Events } from '../frame/story.js' */
/** @import { Section } from './section.js' */

const APART = 24; // pixels between two names, at least
const LOWEST = 2; // pixels that the last one stays above the end of the rows

/**
 * Places for names, as near to where they are wanted as leaves them apart and within bounds.
 * @param {number[]} wanted  ascending
 * @param {number} top
 * @param {number} bottom
 */
export function spread(wanted, top, bottom) {
  const places = [...wanted];
  let last = top - APART;
  for (const [k, y] of places.entries()) places[k] = last = Math.max(y, last + APART);
  let next = bottom + APART;
  for (let k = places.length - 1; k >= 0; k--) places[k] = next = Math.min(places[k], next - APART);
  return places;
}

/**
 * Which names are seen, where there are lines for some: the first and the last line say how many there are beyond.
 * @param {number} count  of all
 * @param {number} lines
 * @param {number} first  that is wanted
 * @returns {[from: number, to: number]}
 */
export function windowOf(count, lines, first) {
  if (count <= lines) return [0, count];
  const some = Math.max(lines - 1, 1); // beside one of these lines
  if (first <= 1) return [0, some];
  if (first + some >= count) return [count - some, count];
  return [first, Math.min(first + Math.max(lines - 2, 1), count)];
}

export class Happens {
  root = make('ol', { className: 'happens', ariaLabel: text('opening.events') });
  before = make('button', { type: 'button', onclick: () => this.#turn(-1) });
  after = make('button', { type: 'button', onclick: () => this.#turn(1) });
  earlier = make('li', { className: 'more', hidden: true }, this.before);
  later = make('li', { className: 'more', hidden: true }, this.after);
  /** @type {Event[]} */ events = [];
  /** @type {HTMLElement[]} */ names = [];
  latest = -1; // that has happened
  first = 0; // that is seen where not all are

  /**
   * @param {Section} section  beside which they stand
   * @param {HTMLElement} below  what stands below them there
   */
  constructor(section, below) {
    this.section = section;
    this.below = below;
  }
  /** @param {Events} story */
  load(story) {
    this.events = story.events.filter(([, , name]) => name);
    this.names = this.events.map(([t, sentence, name = ''], k) => {
      const act = make('button', { type: 'button', title: sentence, textContent: name });
      act.prepend(make('span', { className: 'at', textContent: story.written(t) }));
      act.onclick = () => story.go(t);
      return make('li', { value: k + 1 }, act);
    });
    this.root.replaceChildren(this.earlier, ...this.names, this.later);
    this.latest = -1;
    this.first = 0;
    this.place();
  }
  /** Which of them are within the stretch of time that is seen. */
  get #seen() {
    const [start, end] = this.section.stretch;
    return this.events.flatMap(([t], k) => (t >= start && t <= end ? [k] : []));
  }
  /** Without rows, and where there is no room beside them, all are listed one after the other. */
  get #listed() {
    const { page, shown } = this.section;
    return !shown || page.root.dataset.size !== 'desk';
  }
  get #lines() {
    return this.#listed ? Infinity : Math.floor((this.#tall - LOWEST) / APART) + 1;
  }
  /** Pixels that they have. */
  get #tall() {
    const { below, section } = this;
    return section.box.tall - (below.classList.contains('yields') ? 0 : below.offsetHeight);
  }
  /** Another solve, another size, or another stretch of time. */
  place() {
    const { below } = this;
    below.classList.remove('yields');
    below.classList.toggle('yields', this.#seen.length > this.#lines); // they have its room, too
    this.#follow();
    this.#lay();
  }
  /** What has just happened is among those that are seen. */
  #follow() {
    const seen = this.#seen;
    const at = this.latest < 0 ? 0 : seen.indexOf(this.latest);
    const [from, to] = windowOf(seen.length, this.#lines, this.first);
    if (at >= 0 && at < from) this.first = at;
    else if (at >= to) this.first = at + 1 - Math.max(this.#lines - 2, 1);
  }
  /** @param {1 | -1} way  to later or to earlier ones */
  #turn(way) {
    const { length } = this.#seen;
    const [from, to] = windowOf(length, this.#lines, this.first);
    this.first = way > 0 ? to : Math.max(from - Math.max(this.#lines - 2, 1), 0);
    this.#lay();
    const [pressed, other] = way > 0 ? [this.later, this.before] : [this.earlier, this.after];
    if (pressed.hidden) other.focus(); // it had the focus
  }
  #lay() {
    const { earlier, events, later, names, section } = this;
    const seen = this.#seen;
    const [from, to] = windowOf(seen.length, this.#lines, this.first);
    const shown = seen.slice(from, to);
    names.forEach((name, k) => {
      name.hidden = !shown.includes(k);
    });
    earlier.hidden = from === 0;
    later.hidden = to === seen.length;
    this.before.textContent = text('opening.earlier', { count: from });
    this.after.textContent = text('opening.later', { count: seen.length - to });
    if (this.#listed) return;
    const { top } = section.box;
    const tall = this.#tall;
    const lines = [...(from > 0 ? [earlier] : []), ...shown.map((k) => names[k]), ...(later.hidden ? [] : [later])];
    const wanted = shown.map((k) => section.y(events[k][0]));
    if (from > 0) wanted.unshift(top);
    if (!later.hidden) wanted.push(top + tall);
    const places = spread(wanted, top, top + tall - LOWEST);
    lines.forEach((line, k) => {
      line.style.top = `${places[k]}px`;
    });
  }
  /** @param {number} t */
  mark(t) {
    const latest = this.events.findLastIndex(([when]) => when <= t + 1e-6);
    if (latest === this.latest) return;
    this.latest = latest;
    this.names.forEach((name, k) => name.toggleAttribute('aria-current', k === latest));
    this.place();
  }
}
