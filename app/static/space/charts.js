// How the contact of bodies in space slides: the hodograph of the sliding velocity, and velocities over the impulse.
import { Chart } from '../charts/chart.js';
import { sizeOf } from '../charts/canvas.js';
import { text } from '../text/catalogue.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Numbers, SpaceFrame } from '../messages.js' */

const ROOM = 1.15; // about what is drawn
const EDGES = [62, 34]; // pixels that a chart takes for its ticks, across and upward

/**
 * From the least to the largest of them and zero, with some room.
 * @param {Numbers} values
 * @returns {[middle: number, half: number]}
 */
function spanOf(values) {
  const [low, high] = [Math.min(0, ...values), Math.max(0, ...values)];
  return [(low + high) / 2, (ROOM * (high - low)) / 2];
}

/**
 * One point.
 * @param {Numbers} x
 * @param {Numbers} y
 * @param {number} k
 * @param {string} name
 * @param {Series['style']} style
 * @returns {Series}
 */
const point = (x, y, k, name, style) => ({ x: [x[k]], y: [y[k]], name, style, path: true });

export class Hodograph {
  /** @type {[middle: number, half: number][]} */ spans = []; // of velocities, across and upward

  constructor() {
    this.chart = new Chart({
      title: text('space.chart.hodograph'),
      about: text('space.chart.hodograph-about'),
      xName: text('space.chart.along'),
      xUnit: 'm/s',
      y: [-1, 1],
      caption: () => text('space.chart.hodograph-axes'),
      points: true,
    });
  }
  /** @param {SpaceFrame} frame */
  load({ slideAlong: x, slideAside: y }) {
    this.chart.root.hidden = !x;
    if (!x || !y) return;
    this.spans = [spanOf(x), spanOf(y)];
    const last = x.length - 1;
    this.#even();
    this.chart.show({
      series: [
        { x, y, path: true, name: text('space.chart.slides'), style: 'exact' },
        point(x, y, 0, text('space.chart.first'), 'impulses'),
        point(x, y, last, text('space.chart.last'), 'mode'),
      ],
      rules: [0],
    });
  }
  // As many pixels to a metre a second across as upward.
  #even() {
    if (!this.spans.length) return;
    const [width, height] = sizeOf(this.chart.area);
    const room = [Math.max(width - EDGES[0], 1), Math.max(height - EDGES[1], 1)];
    const pixel = Math.max(...this.spans.map(([, half], k) => (2 * half) / room[k])) || 1;
    const [x, y] = this.spans.map(([middle], k) => [middle - 0.5 * pixel * room[k], middle + 0.5 * pixel * room[k]]);
    this.chart.options.y = [y[0], y[1]];
    this.chart.axis.load(x[0], x[1]);
  }
  draw() {
    this.#even();
    this.chart.draw();
  }
}

export class Course {
  constructor() {
    this.chart = new Chart({
      title: text('space.chart.course'),
      about: text('space.chart.course-about'),
      xName: text('space.chart.press'),
      xUnit: 'N s',
      unit: 'm/s',
      zero: true,
      pad: [0.08, 0.08],
      caption: (unit) => text('space.chart.course-axes', { unit }),
    });
  }
  /** @param {SpaceFrame} frame */
  load({ slideAlong, slideAside, slideParting, slidePress: x, sliding }) {
    this.chart.root.hidden = !x;
    if (!x || !slideAlong || !slideAside || !slideParting) return;
    /** @type {[number, number][]} */
    const spans = sliding.map(({ until }, k) => [k ? sliding[k - 1].until : 0, until]);
    const sticks = spans.filter((_, k) => sliding[k].kind === 'stick');
    const speed = slideAlong.map((v, k) => Math.hypot(v, slideAside[k]));
    this.chart.axis.load(0, x[x.length - 1]);
    this.chart.show({
      series: [
        { x, y: slideParting, name: text('space.chart.parting'), style: 'exact' },
        { x, y: speed, name: text('space.chart.speed'), style: 'other' },
      ],
      bars: sticks.length ? { name: text('space.chart.sticks'), spans: sticks, at: 0, least: 2 } : undefined,
      rules: [0],
    });
  }
  draw() {
    this.chart.draw();
  }
}
