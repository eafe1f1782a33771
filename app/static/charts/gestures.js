// What a hand does on a chart. A click sets the clock, a drag over the box zooms into what it has passed, a drag of the
// clock's line moves it, with Shift it moves the view; the wheel zooms; a double click shows all. A finger moves the
// clock, two fingers zoom. Arrow keys move the clock, + and - zoom, 0 shows all.
import { text } from '../text/catalogue.js';
import { valueAt } from './plot.js';

/** @typedef {import('./chart.js').Chart} Chart */

const GRIP = 7; // pixels about the line of the clock in which it can be taken hold of
const TREMBLE = 4; // pixels that a click may move
const NOTCH = 0.0016; // of the wheel: the view changes by e to the power of this for each pixel
const CLOSER = 0.6; // the view after one key
const PAUSE = 300; // ms after the page has scrolled before the wheel zooms
const STEP = 1 / 200; // of the view, for one arrow key; ten times as much with Shift

/** @type {Record<string, 1 | -1>} */
const ARROWS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };

let scrolled = -Infinity; // when the page moved last
document.addEventListener('scroll', () => (scrolled = performance.now()), { passive: true });

/**
 * Know when anything in there is scrolled, too.
 * @param {HTMLElement} root
 */
export const watchScrolling = (root) =>
  root.addEventListener('scroll', () => (scrolled = performance.now()), { capture: true, passive: true });

/** @param {Chart} chart */
export function listen(chart) {
  const { area, axis } = chart;
  area.tabIndex = 0;
  area.role = 'application';
  const about = chart.below.ariaLabel ?? '';
  area.ariaLabel = text('chart.keys', { about, moves: chart.options.go ? (chart.options.moves ?? 'clock') : 'none' });
  const pointers = new Pointers(chart);
  area.onpointerdown = (event) => pointers.down(event);
  area.onpointermove = (event) => pointers.move(event);
  area.onpointerup = (event) => pointers.up(event);
  area.onpointercancel = (event) => pointers.up(event, true);
  area.onpointerleave = (event) => {
    if (event.pointerType !== 'touch') chart.tip.hide();
  };
  area.onblur = () => chart.tip.hide();
  area.ondblclick = () => axis.reset();
  area.onkeydown = (event) => key(chart, event);
  area.addEventListener('wheel', (event) => wheel(chart, event), { passive: false });
}

/**
 * The value under a pointer.
 * @param {Chart} chart
 * @param {{ clientX: number, clientY: number }} event
 */
const under = (chart, event) => valueAt(chart.x, chart.place(event)[0]);

/**
 * A wheel that was scrolling the page goes on doing so; at the whole, zooming out is scrolling.
 * @param {Chart} chart
 * @param {WheelEvent} event
 */
function wheel(chart, event) {
  const { axis } = chart;
  const sideways = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
  const distance = (sideways ? event.deltaX || event.deltaY : event.deltaY) * (event.deltaMode ? 16 : 1);
  const idle = !axis.zoomed && (sideways || distance > 0);
  if (!chart.box || !distance || idle || performance.now() - scrolled < PAUSE) return;
  event.preventDefault();
  if (sideways) axis.pan((distance / chart.frame.w) * (axis.view[1] - axis.view[0]));
  else axis.zoom(Math.exp(distance * NOTCH), under(chart, event));
}

/**
 * @param {Chart} chart
 * @param {KeyboardEvent} event
 */
function key(chart, event) {
  const way = ARROWS[event.key];
  if (event.ctrlKey || event.metaKey || event.altKey || !chart.box) return;
  const { axis, now, options } = chart;
  const [low, high] = axis.view;
  const focus = (now && now.y === undefined ? now.x : chart.inspected?.x) ?? 0.5 * (low + high);
  const about = focus >= low && focus <= high ? focus : 0.5 * (low + high);
  if (way && options.go) {
    const to = Math.min(
      Math.max(focus + way * (event.shiftKey ? 10 : 1) * STEP * (high - low), axis.whole[0]),
      axis.whole[1],
    );
    options.go(to);
    if (to < low || to > high) axis.pan(to < low ? to - low : to - high);
  } else if (way) chart.tip.step(way * (event.shiftKey ? 10 : 1));
  else if (event.key === '+' || event.key === '=') axis.zoom(CLOSER, about);
  else if (event.key === '-') axis.zoom(1 / CLOSER, about);
  else if (event.key === '0') axis.reset();
  else if (event.key === 'Home' && options.go) options.go(low);
  else if (event.key === 'End' && options.go) options.go(high);
  else return;
  event.preventDefault();
  event.stopPropagation();
  chart.tools.tell();
}

/** Mouse, pen and fingers. */
class Pointers {
  /** @type {'none' | 'select' | 'clock' | 'pan' | 'pinch'} */ doing = 'none';
  /** @type {Map<number, PointerEvent>} */ held = new Map();
  from = 0; // where it began: a value
  start = 0; // and in pixels
  /** @type {[number, number]} */ fingers = [0, 0]; // the values that two fingers hold

  /** @param {Chart} chart */
  constructor(chart) {
    this.chart = chart;
  }

  /** @param {PointerEvent} event */
  down(event) {
    const { chart } = this;
    if (event.button !== 0 || !chart.box) return;
    chart.area.setPointerCapture(event.pointerId);
    this.held.set(event.pointerId, event);
    this.from = under(chart, event);
    this.start = event.clientX;
    chart.tip.hide();
    if (this.held.size === 2) this.#pinch();
    else if (event.pointerType === 'touch') this.doing = chart.options.go ? 'clock' : 'none';
    else if (event.shiftKey) this.doing = 'pan';
    else this.doing = this.#onClock(event) ? 'clock' : 'select';
    if (this.doing === 'clock') this.#go(event);
    if (this.doing === 'none') chart.tip.read(event);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { chart } = this;
    if (!chart.box) return;
    if (!this.held.has(event.pointerId)) {
      if (event.pointerType !== 'touch') this.#hover(event);
      return;
    }
    this.held.set(event.pointerId, event);
    if (this.doing === 'clock') this.#go(event);
    else if (this.doing === 'pan') chart.axis.pan(this.from - this.#unbound(event));
    else if (this.doing === 'pinch') this.#spread();
    else if (this.doing === 'select' && (chart.selected || Math.abs(event.clientX - this.start) > TREMBLE)) {
      const to = under(chart, event);
      chart.selected = [Math.min(this.from, to), Math.max(this.from, to)];
      chart.point();
    }
  }

  /**
   * @param {PointerEvent} event
   * @param {boolean} [cancelled]
   */
  up(event, cancelled = false) {
    const { chart } = this;
    if (!this.held.delete(event.pointerId)) return;
    const { selected } = chart;
    chart.selected = null;
    if (this.doing === 'select' && !cancelled) {
      if (selected) chart.axis.show(selected);
      else this.#go(event);
    }
    if (chart.box) chart.point();
    this.doing = 'none';
  }

  /** @param {PointerEvent} event */
  #hover(event) {
    this.chart.tip.read(event);
    this.chart.area.classList.toggle('grip', this.#onClock(event));
  }

  /** @param {PointerEvent} event */
  #go(event) {
    this.chart.options.go?.(under(this.chart, event));
  }

  /**
   * Whether the pointer is at the line of the clock.
   * @param {PointerEvent} event
   */
  #onClock(event) {
    const { chart } = this;
    const { now, options, area } = chart;
    if (!options.go || !now || now.y !== undefined) return false;
    return Math.abs(event.clientX - area.getBoundingClientRect().left - chart.px(now.x)) < GRIP;
  }

  /**
   * The value under a pointer, also beside the box.
   * @param {PointerEvent} event
   */
  #unbound(event) {
    const { x } = this.chart;
    return x[0] + this.chart.place(event)[0] * (x[1] - x[0]);
  }

  #pinch() {
    this.doing = 'pinch';
    const [one, two] = [...this.held.values()];
    this.fingers = [this.#unbound(one), this.#unbound(two)];
  }

  /** The view in which each finger still holds its value. */
  #spread() {
    const { chart } = this;
    const places = [...this.held.values()].map((event) => chart.place(event)[0]);
    const apart = places[1] - places[0];
    if (Math.abs(apart) < 0.02) return;
    const span = Math.abs((this.fingers[1] - this.fingers[0]) / apart);
    const low = this.fingers[0] - places[0] * span;
    chart.axis.show([low, low + span]);
  }
}
