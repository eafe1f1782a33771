// What hands and keys do on a map: the point is dragged, a tap takes it there, the wheel goes closer, arrows move it;
// the wanted value is set on the bar.
import { Fingers } from './fingers.js';
import { longOf, placeOf, roundAt, usualRange } from './places.js';
import { shownOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Spot } from './fingers.js' */
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

  /**
   * @param {WhatIf} whatif
   * @param {Pick<WhatIf, 'plane' | 'view' | 'over'> & { look: (at: Spot | null) => void }} map  of all that are there
   */
  constructor(whatif, map) {
    this.whatif = whatif;
    this.map = map;
    const { over } = map.plane;
    this.fingers = new Fingers(over, {
      take: (event) => this.#take(event),
      move: (event) => this.#move(event),
      leave: () => this.#leave(),
      grips: (event) => ![null, 'map'].includes(map.view && map.plane.under(...this.#where(event))),
      pinch: (from, to) => this.#pinch(from, to),
    });
    over.onpointerleave = () => map.look(null);
    over.onkeydown = (event) => this.#key(event);
    over.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    over.ondblclick = () => this.all();
  }
  /** @param {{ clientX: number, clientY: number }} event */
  #where(event) {
    const box = this.map.plane.over.getBoundingClientRect();
    return /** @type {[number, number]} */ ([event.clientX - box.left, event.clientY - box.top]);
  }
  /** @param {PointerEvent} event */
  #take(event) {
    const { plane, view } = this.map;
    const [px, py] = this.#where(event);
    const under = view && !event.button ? plane.under(px, py) : null;
    if (!under) return;
    if (under === 'letter') return this.whatif.designs.go(plane.letters.under(px, py) ?? '');
    this.drag = under;
    plane.over.setPointerCapture(event.pointerId);
    this.whatif.grip.hand = true;
    if (under === 'map' || under === 'bar') this.#move(event);
  }
  /** @param {PointerEvent} event */
  #move(event) {
    const { plane } = this.map;
    const [px, py] = this.#where(event);
    if (!this.drag) {
      const under = this.map.view && plane.under(px, py);
      plane.over.style.cursor = under ? CURSORS[under] : '';
      this.map.look(under === 'map' ? [px, py] : null);
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
    this.whatif.grip.hand = false;
    this.whatif.schedule();
  }
  /** @param {number} py */
  #want(py) {
    const { result } = this.whatif;
    const { plane } = this.map;
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
    this.map.over();
  }
  /** @param {KeyboardEvent} event */
  #key(event) {
    const way = ARROWS[event.key];
    const { x, y } = this.whatif;
    if (!way || !this.map.view) return;
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
    const { plane, view } = this.map;
    const [px, py] = this.#where(event);
    if (!view || plane.under(px, py) === null) return;
    event.preventDefault();
    const by = Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * WHEEL);
    this.#zoom([px, py], [px, py], by);
  }
  /**
   * Two fingers zoom, and take along what lies between them.
   * @param {[Spot, Spot]} from
   * @param {[Spot, Spot]} to
   */
  #pinch(from, to) {
    if (!this.map.view) return;
    const [wide, wider] = [from, to].map(([a, b]) => Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), 1));
    const middle = (/** @type {[Spot, Spot]} */ [a, b]) =>
      this.#where({ clientX: (a[0] + b[0]) / 2, clientY: (a[1] + b[1]) / 2 });
    this.#zoom(middle(from), middle(to), wide / wider);
  }
  /**
   * Show so many times as much; what was at one place is at another.
   * @param {Spot} from
   * @param {Spot} to
   * @param {number} by
   */
  #zoom(from, to, by) {
    const { x, y } = this.whatif;
    const { plane } = this.map;
    const [was, is] = [plane.share(...from), plane.share(...to)];
    [x, y].forEach((axis, k) => {
      const [low, high] = this.whatif.range(axis);
      const long = Math.min(Math.max((high - low) * by, LEAST), longOf(axis));
      const first = Math.min(Math.max(low + was[k] * (high - low) - is[k] * long, 0), longOf(axis) - long);
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
