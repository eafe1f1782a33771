// What hands and keys do on a map: the point is dragged, a tap takes it there, the wheel goes closer, arrows move it;
// the wanted value is set on the bar.
import { longOf, placeOf, roundAt, usualRange } from './places.js';
import { shownOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { WhatIf } from './whatif.js' */

const CURSORS = { point: 'grab', letter: 'pointer', goal: 'move', bar: 'ns-resize', map: 'crosshair' };
const ARROWS = /** @type {Record<string, [number, number]>} */ ({
  ArrowRight: [1, 0],
  ArrowLeft: [-1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
});
const STEP = { small: 0.01, large: 0.05 }; // of the map, by an arrow
const WHEEL = 0.003; // of a pixel of the wheel
const LEAST = 0.05; // units of an axis that a map shows at least

export class Hands {
  /** @type {ReturnType<WhatIf['plane']['under']>} */ drag = null;

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    const { over } = whatif.plane;
    over.onpointerdown = (event) => this.#take(event);
    over.onpointermove = (event) => this.#move(event);
    over.onpointerup = over.onpointercancel = () => this.#leave();
    over.onkeydown = (event) => this.#key(event);
    over.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    over.ondblclick = () => this.all();
  }
  /** @param {MouseEvent} event */
  #where(event) {
    const box = this.whatif.plane.over.getBoundingClientRect();
    return /** @type {[number, number]} */ ([event.clientX - box.left, event.clientY - box.top]);
  }
  /** @param {PointerEvent} event */
  #take(event) {
    const { plane, view } = this.whatif;
    const [px, py] = this.#where(event);
    const under = view && !event.button ? plane.under(px, py) : null;
    if (!under) return;
    if (under === 'letter') return this.whatif.designs.go(plane.letters.under(px, py) ?? '');
    this.drag = under;
    plane.over.setPointerCapture(event.pointerId);
    this.whatif.held = true;
    if (under === 'map' || under === 'bar') this.#move(event);
  }
  /** @param {PointerEvent} event */
  #move(event) {
    const { plane } = this.whatif;
    const [px, py] = this.#where(event);
    if (!this.drag) {
      const under = this.whatif.view && plane.under(px, py);
      plane.over.style.cursor = under ? CURSORS[under] : '';
      this.whatif.look(under === 'map' ? plane.share(px, py) : null);
      return;
    }
    event.preventDefault();
    if (this.drag === 'bar') this.#want(py);
    else if (this.drag === 'goal') this.whatif.goal.pull(this.#at(plane.share(px, py)));
    else this.#go(plane.share(px, py));
  }
  #leave() {
    if (!this.drag) return;
    this.drag = null;
    this.whatif.held = false;
    this.whatif.schedule();
  }
  /** @param {number} py */
  #want(py) {
    const { plane, result } = this.whatif;
    const level = plane.level(py);
    const value = shownOf(result).log ? 10 ** level : level;
    this.whatif.wanted[result] = Number(value.toPrecision(3));
    this.whatif.schedule();
  }
  /**
   * Values of both axes there.
   * @param {[x: number, y: number]} share  of the map
   */
  #at([X, Y]) {
    const { x, y } = this.whatif;
    const at = (/** @type {Axis} */ axis, /** @type {number} */ share) => {
      const [from, to] = this.whatif.range(axis);
      return /** @type {[Axis, number]} */ ([axis, roundAt(axis, from + share * (to - from))]);
    };
    return [at(x, X), at(y, Y)];
  }
  /** @param {[x: number, y: number]} share */
  #go(share) {
    this.whatif.set(this.#at(share));
    this.whatif.over();
  }
  /** @param {KeyboardEvent} event */
  #key(event) {
    const way = ARROWS[event.key];
    const { view, x, y } = this.whatif;
    if (!way || !view) return;
    event.preventDefault();
    event.stopPropagation();
    const step = event.shiftKey ? STEP.large : STEP.small;
    const moved = /** @type {[Axis, number][]} */ (
      [x, y].flatMap((axis, k) => {
        if (!way[k]) return [];
        const [from, to] = this.whatif.range(axis);
        const place = placeOf(axis, this.whatif.value(axis)) + way[k] * step * (to - from);
        return [[axis, roundAt(axis, Math.min(Math.max(place, 0), longOf(axis)))]];
      })
    );
    this.whatif.set(moved);
  }
  /** @param {WheelEvent} event */
  #wheel(event) {
    const { plane, view, x, y } = this.whatif;
    const [px, py] = this.#where(event);
    if (!view || plane.under(px, py) === null) return;
    event.preventDefault();
    const by = Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * WHEEL);
    const shares = plane.share(px, py);
    [x, y].forEach((axis, k) => {
      const [from, to] = this.whatif.range(axis);
      const middle = from + shares[k] * (to - from);
      const long = Math.min(Math.max((to - from) * by, LEAST), longOf(axis));
      const first = Math.min(Math.max(middle - shares[k] * long, 0), longOf(axis) - long);
      this.whatif.ranges.set(axis, [first, first + long]);
    });
    this.whatif.schedule();
  }
  /** All of both axes, or as at first where that is shown. */
  all() {
    const { x, y } = this.whatif;
    const whole = [x, y].every((axis) => {
      const [from, to] = this.whatif.range(axis);
      return from === 0 && to === longOf(axis);
    });
    for (const axis of [x, y])
      this.whatif.ranges.set(axis, whole ? usualRange(axis, this.whatif.value(axis)) : [0, longOf(axis)]);
    this.whatif.schedule();
  }
}
