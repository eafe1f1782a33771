// The peak of the force in the small picture as a handle: pulled across, another peak force is wanted, and what gives
// way goes there, as when the contour is pulled.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { Fingers } from './fingers.js';
import { written } from './results.js';

/** @import { Section } from '../opening/section.js' */
/** @import { Goal } from './goal.js' */

const DIGITS = { hand: 3, keys: 4 }; // of what is wanted: a step by key is seen in the fourth
const STEPS = /** @type {Record<string, number>} */ ({
  ...{ ArrowLeft: 0.01, ArrowUp: 0.01, PageUp: 0.1 }, // the scale grows to the left
  ...{ ArrowRight: -0.01, ArrowDown: -0.01, PageDown: -0.1 },
});
const LEAST = 1; // pixels from nought
const ROOM = 104; // pixels that the value takes beside the handle

/**
 * The force where the peak is pulled to.
 * @param {Pick<Section, 'box' | 'most'>} scale
 * @param {number} px
 */
export function forceAt({ box: { base, track }, most }, px) {
  return Number(((Math.max(base - px, LEAST) / track) * most).toPrecision(DIGITS.hand));
}

/**
 * What a key makes of what is wanted, if anything.
 * @param {number} value
 * @param {string} key
 */
export const stepped = (value, key) =>
  key in STEPS ? Number((value * (1 + STEPS[key])).toPrecision(DIGITS.keys)) : null;

export class ForcePull {
  grabbed = NaN; // pixels from the pointer to the peak, while one holds it
  moved = false; // since it was taken
  top = 0; // of the rows in the window, when it was taken

  /** @param {Goal} goal */
  constructor(goal) {
    this.goal = goal;
    this.section = goal.whatif.page.opening.section;
    this.handle = make('button', { type: 'button', role: 'slider', title: text('whatif.pull-about') });
    this.handle.ariaLabel = text('whatif.pull');
    this.handle.ariaValueMin = '0';
    this.handle.setAttribute('aria-orientation', 'horizontal');
    this.value = make('output', { ariaHidden: 'true' }); // the handle says it
    this.root = make('div', { className: 'whatif-pull', hidden: true }, this.value, this.handle);
    new Fingers(this.handle, {
      take: (event) => this.#take(event),
      move: (event) => this.#move(event),
      leave: () => this.leave(),
    });
    this.handle.onkeydown = (event) => this.#key(event);
  }
  /** Whether it is what is seen, and can be had. */
  get #offered() {
    const { goal, section } = this;
    const { result } = goal.whatif;
    if (result !== 'peak_force' || goal.root.hidden || !section.dot) return false;
    const { tall, top } = section.box;
    return section.dot[1] >= top && section.dot[1] <= top + tall; // the stretch of time may be another
  }
  get #now() {
    const { wanted, whatif } = this.goal;
    return wanted ?? whatif.here('peak_force');
  }
  /** The picture was drawn anew, or something else is wanted. */
  follow() {
    const { handle, root, section } = this;
    root.hidden = !this.#offered && Number.isNaN(this.grabbed);
    if (root.hidden || !section.dot) return;
    const now = this.#now;
    const [peak, y] = section.dot;
    const x = this.moved ? section.x(now) : peak;
    root.classList.toggle('pulled', this.moved);
    root.classList.toggle('late', x < ROOM); // no room to its left
    root.style.setProperty('--x', `${x}px`);
    root.style.setProperty('--y', `${y}px`);
    root.style.setProperty('--top', `${section.box.top}px`);
    handle.ariaValueMax = String(Math.max(section.most, now));
    handle.ariaValueNow = String(now);
    handle.ariaValueText = this.value.textContent = written('peak_force', now);
    if (this.moved) this.goal.whatif.page.root.scrollTop += this.root.getBoundingClientRect().top - this.top;
  }
  /** @param {{ clientX: number }} event */
  #across({ clientX }) {
    return clientX - this.root.getBoundingClientRect().left;
  }
  /** @param {PointerEvent} event */
  #take(event) {
    if (event.button > 0 || !this.section.dot) return; // a finger has gone across by now: -1
    this.handle.setPointerCapture(event.pointerId);
    this.grabbed = this.section.dot[0] - this.#across(event);
    this.top = this.root.getBoundingClientRect().top; // solutions that are listed above take room
  }
  /** @param {PointerEvent} event */
  #move(event) {
    if (Number.isNaN(this.grabbed)) return;
    event.preventDefault();
    this.#hold(true);
    this.goal.go(forceAt(this.section, this.#across(event) + this.grabbed));
    this.follow();
  }
  /** It is let go. */
  leave() {
    if (Number.isNaN(this.grabbed)) return;
    this.grabbed = NaN;
    this.#hold(false);
    this.follow();
    this.goal.whatif.schedule();
  }
  /**
   * While it is pulled the scale stays, and its words give way to what is wanted.
   * @param {boolean} moved
   */
  #hold(moved) {
    if (moved === this.moved) return;
    const { page, grip } = this.goal.whatif;
    this.moved = this.section.pulled = grip.hand = moved;
    page.opening.draw();
    page.again();
  }
  /** @param {KeyboardEvent} event */
  #key(event) {
    const next = stepped(this.#now, event.key);
    if (next === null) return;
    event.preventDefault();
    event.stopPropagation();
    this.goal.go(next);
    this.follow();
  }
}
