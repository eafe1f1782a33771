// What part of an axis is in view. Charts that share one zoom together.

/** @typedef {import('./scale.js').Range} Range */

const LEAST = 1e-5; // share of the whole that can fill the view
const ROOM = 0.35; // about a stretch that is looked at, as a share of it

export class Axis {
  /** @type {Range} */ whole = [0, 1];
  /** @type {Range} */ view = [0, 1];
  /** @type {Range} */ opened = [0, 1]; // what was in view at first
  untouched = true; // by hand, since the scene was opened
  /** @type {unknown} */ scene = null;
  /** @type {(() => void)[]} */ #watchers = [];

  /**
   * Begin with another whole, all of it or a part from its start on in view; nobody is notified.
   * @param {number} low
   * @param {number} high
   * @param {number} [until]
   */
  load(low, high, until = high) {
    this.whole = [low, high];
    this.opened = [low, Math.min(until, high)];
    this.view = [...this.opened];
  }

  /**
   * Another answer, from 0 on; its first part in view if the scene is opened with that, until a hand moves it. A
   * stretch that a hand has chosen stays in view as long as the scene does.
   * @param {unknown} scene
   * @param {number} high
   * @param {number | null} until
   */
  open(scene, high, until) {
    const same = scene === this.scene;
    const chosen = same && this.moved && this.zoomed ? this.view : null;
    this.untouched = !same || (this.untouched && !this.moved);
    this.scene = scene;
    this.load(0, high, (this.untouched && until) || high);
    if (chosen && chosen[0] < high) this.view = [chosen[0], Math.min(chosen[1], high)];
  }

  /**
   * Make the whole longer or shorter; a part that is in view stays.
   * @param {number} low
   * @param {number} high
   */
  reach(low, high) {
    const { moved, opened, view, whole } = this;
    this.load(low, high, opened[1] < whole[1] ? opened[1] : high);
    if (moved) this.show(view);
  }

  /** Whether a hand has brought something else into view. */
  get moved() {
    return this.view.some((end, k) => end !== this.opened[k]);
  }

  /** Whether less than the whole is in view. */
  get zoomed() {
    return this.view[0] > this.whole[0] || this.view[1] < this.whole[1];
  }

  /**
   * Have a stretch fill the view, as far as the whole reaches, and tell those who watch.
   * @param {Range} stretch
   */
  show([low, high]) {
    const [first, last] = this.whole;
    const span = Math.min(Math.max(high - low, LEAST * (last - first)), last - first);
    const start = Math.min(Math.max(0.5 * (low + high - span), first), last - span);
    this.view = span < last - first ? [start, start + span] : [first, last];
    for (const watcher of this.#watchers) watcher();
  }

  /**
   * Show so many times as much, keeping one value where it is.
   * @param {number} factor
   * @param {number} about
   */
  zoom(factor, about) {
    const [low, high] = this.view;
    this.show([about - (about - low) * factor, about + (high - about) * factor]);
  }

  /**
   * Show a stretch and some room about it, as far as the whole reaches; all of it without a stretch.
   * @param {number | undefined} start
   * @param {number | undefined} end
   * @param {number} least  room, as a share of the whole
   */
  lookAt(start, end, least) {
    if (start === undefined || end === undefined) {
      this.reset();
      return;
    }
    const [first, last] = this.whole;
    const room = Math.max(ROOM * (end - start), least * (last - first));
    this.show([Math.max(first, start - room), Math.min(last, end + room)]);
  }

  /** @param {number} distance */
  pan(distance) {
    const [low, high] = this.view;
    const moved = Math.min(Math.max(distance, this.whole[0] - low), this.whole[1] - high);
    this.show([low + moved, high + moved]);
  }

  reset() {
    this.show(this.whole);
  }

  /** @param {() => void} watcher  called after every change of the view */
  watch(watcher) {
    this.#watchers.push(watcher);
  }
}
