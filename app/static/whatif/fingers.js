// Hands on a map or on curves. The page scrolls under a finger, unless it comes down on what can be gripped, goes
// across, or is lifted where it came down; two fingers pinch.

/** @typedef {[x: number, y: number]} Spot  pixels of the window */
/**
 * @typedef {object} Acts
 * @property {(event: PointerEvent) => void} take
 * @property {(event: PointerEvent) => void} move  also where nothing is taken
 * @property {() => void} leave
 * @property {(event: PointerEvent) => boolean} [grips]  whether a finger takes at once what lies there
 * @property {(from: [Spot, Spot], to: [Spot, Spot]) => void} [pinch]
 */

const SLOP = 8; // pixels across, from which on a finger drags

export class Fingers {
  /** @type {Map<number, Spot>} */ down = new Map();
  /** @type {PointerEvent | null} */ waits = null; // the first finger, of which nobody knows yet
  grips = false; // so that the page stays
  pinched = false; // until all are lifted

  /**
   * @param {HTMLElement} area
   * @param {Acts} acts
   */
  constructor(area, acts) {
    this.acts = acts;
    const touches = (/** @type {PointerEvent} */ { pointerType }) => pointerType !== 'mouse';
    area.onpointerdown = (event) => (touches(event) ? this.#down(event) : acts.take(event));
    area.onpointermove = (event) => (touches(event) ? this.#move(event) : acts.move(event));
    area.onpointerup = (event) => (touches(event) ? this.#up(event, true) : acts.leave());
    area.onpointercancel = (event) => (touches(event) ? this.#up(event, false) : acts.leave());
    const stay = (/** @type {TouchEvent} */ event) => {
      if (event.cancelable && (this.grips || this.pinched)) event.preventDefault();
    };
    for (const name of /** @type {const} */ (['touchstart', 'touchmove']))
      area.addEventListener(name, stay, { passive: false });
  }
  /** @param {PointerEvent} event */
  #down(event) {
    this.down.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.down.size > 1) {
      if (!this.acts.pinch) return;
      this.pinched = true;
      this.waits = null;
      this.acts.leave();
      return;
    }
    this.grips = this.acts.grips?.(event) ?? false;
    if (this.grips) this.acts.take(event);
    else this.waits = event;
  }
  /** @param {PointerEvent} event */
  #move(event) {
    const { acts, down, waits } = this;
    const before = /** @type {Spot[]} */ ([...down.values()]);
    if (!down.has(event.pointerId)) return;
    down.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pinched) {
      const [from, to] = [before, [...down.values()]].map((all) => /** @type {[Spot, Spot]} */ (all.slice(0, 2)));
      if (from.length > 1) acts.pinch?.(from, to);
    } else if (waits) {
      const [across, up] = [event.clientX - waits.clientX, event.clientY - waits.clientY].map(Math.abs);
      if (across <= Math.max(SLOP, up)) return;
      this.waits = null;
      acts.take(event);
    } else acts.move(event);
  }
  /**
   * @param {PointerEvent} event
   * @param {boolean} lifted  not taken by the page, which scrolls
   */
  #up(event, lifted) {
    this.down.delete(event.pointerId);
    if (this.waits && lifted) this.acts.take(this.waits);
    this.waits = null;
    if (!this.pinched) this.acts.leave();
    if (this.down.size) return;
    this.grips = this.pinched = false;
  }
}
