// What a hand does with bodies in space: turn the picture, move the contact along a body, lean the normal.
import { COLORS } from '../charts/styles.js';
import { add, cross, dot, size, times } from './vectors.js';

/** @import { BodyRecord, Vector } from '../messages.js' */
/** @import { Point } from './arrows.js' */
/** @import { BodiesStage } from './stage.js' */

/** @typedef {'place' | 'tilt' | 'turn'} Grip */

const NEAR = 13; // pixels about a handle
const MARGIN = 14; // pixels about the picture that a handle keeps to
const QUICK = 0.008; // radians of turning per pixel
const STEEPEST = 1.5; // [rad] seen from above or below
const SMALL = 1.5; // degrees below which the normal is where it was

/** Where one looks from, besides how the scene is seen: about the upright, then about what lies across [rad]. */
export const LOOKS = { side: [0, 0], oblique: [0.6, 0.45], end: [Math.PI / 2, 0] };

/**
 * Directions of the picture, turned.
 * @param {Vector} across
 * @param {Vector} up
 * @param {number[]} turned
 * @returns {[across: Vector, up: Vector]}
 */
export function turnedBy(across, up, [about, above]) {
  const toward = cross(across, up);
  const right = add(times(across, Math.cos(about)), toward, -Math.sin(about));
  const near = add(times(toward, Math.cos(about)), across, Math.sin(about));
  return [right, add(times(up, Math.cos(above)), near, -Math.sin(above))];
}

/**
 * The longest side of what is struck: its direction, towards the positive axis, and length; null for what has none.
 * @param {{ impactor: BodyRecord, target: BodyRecord }} bodies
 * @returns {[axis: Vector, length: number] | null}
 */
export function longestSide({ impactor, target }) {
  const { axes, sides } = target.shape === 'box' || target.shape === 'ball' ? target : impactor;
  if (!axes || !sides) return null;
  const k = sides.indexOf(Math.max(...sides));
  const most = axes[k].reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a));
  return [times(axes[k], Math.sign(most)), sides[k]];
}

/**
 * How far a direction leans from the first of three, and which way about it, in degrees.
 * @param {Vector} way
 * @param {Vector[]} frame
 * @returns {[tilt: number, way: number]}
 */
export function leanOf(way, [normal, one, two]) {
  const degrees = 180 / Math.PI;
  const tilt = Math.acos(Math.min(Math.max(dot(way, normal) / size(way), -1), 1)) * degrees;
  if (tilt < SMALL) return [0, 0];
  return [tilt, Math.atan2(dot(way, two), dot(way, one)) * degrees];
}

export class Hands {
  /** @type {Grip | null} */ over = null; // what the pointer would take hold of

  /** @param {BodiesStage} stage */
  constructor(stage) {
    this.stage = stage;
    const { canvas } = stage;
    canvas.addEventListener('pointerdown', (event) => this.#take(event));
    canvas.addEventListener('pointermove', (event) => event.buttons || this.#look(event));
    canvas.addEventListener('dblclick', () => stage.look(LOOKS.side));
  }
  get page() {
    return this.stage.striker?.page;
  }
  /** @param {string} name */
  #acts(name) {
    return Boolean(this.page?.frame.acting.includes(name));
  }
  /** Pixels of the normal: no more than there is room for. */
  get reach() {
    const { frame, high, long, wide, x, y } = this.stage;
    const [nx, ny] = this.stage.flat(frame.normal);
    const across = (nx < 0 ? x - MARGIN : wide - MARGIN - x) / Math.max(Math.abs(nx), 1e-9);
    const down = (ny > 0 ? y - MARGIN : high - MARGIN - y) / Math.max(Math.abs(ny), 1e-9);
    return Math.max(Math.min(1.25 * long, across, down), MARGIN);
  }
  /** @returns {Point} the end of the normal */
  get tip() {
    const { frame, x, y } = this.stage;
    const [nx, ny] = this.stage.flat(frame.normal);
    return [x + this.reach * nx, y - this.reach * ny];
  }
  /** @param {PointerEvent} event */
  #look({ offsetX, offsetY }) {
    const { canvas, frame, striker, x, y } = this.stage;
    if (!frame || striker?.over) return;
    const [a, b] = this.tip;
    const tilts = this.#acts('tilt') && Math.hypot(offsetX - a, offsetY - b) < NEAR;
    const moves = this.#acts('place') && longestSide(frame.bodies) && Math.hypot(offsetX - x, offsetY - y) < NEAR;
    const over = tilts ? 'tilt' : moves ? 'place' : 'turn';
    canvas.style.cursor = over === 'turn' ? '' : 'move';
    if (over === this.over) return;
    this.over = over;
    this.stage.redraw();
  }
  /** @param {PointerEvent} event */
  #take(event) {
    this.#look(event);
    const { over, stage } = this;
    const { canvas, striker } = stage;
    if (event.button !== 0 || !stage.frame || !over || striker?.over) return;
    canvas.setPointerCapture(event.pointerId);
    const moved = { place: this.#slides(), tilt: this.#leans(), turn: this.#turns() }[over];
    canvas.onpointermove = ({ clientX, clientY }) => moved(clientX - event.clientX, clientY - event.clientY);
    canvas.onpointerup = canvas.onpointercancel = () => {
      canvas.onpointermove = canvas.onpointerup = canvas.onpointercancel = null;
    };
  }
  /** @returns {(dx: number, dy: number) => void} */
  #turns() {
    const [about, above] = this.stage.turned;
    return (dx, dy) => {
      const up = Math.min(Math.max(above + QUICK * dy, -STEEPEST), STEEPEST);
      this.stage.look([about - QUICK * dx, up]);
    };
  }
  /** @returns {(dx: number, dy: number) => void} */
  #slides() {
    const { frame, scale } = this.stage;
    const [axis, length] = longestSide(frame.bodies) ?? [frame.across, 1];
    const [ax, ay] = this.stage.flat(axis);
    const seen = Math.max(ax * ax + ay * ay, 0.05);
    const before = Number(frame.chosen.place);
    return (dx, dy) => {
      const along = (dx * ax - dy * ay) / seen / scale / length;
      this.page?.choose('place', Number(Math.min(Math.max(before + along, 0), 1).toFixed(3)));
    };
  }
  /** @returns {(dx: number, dy: number) => void} */
  #leans() {
    const { across, frame, up } = this.stage;
    const { reach } = this;
    const high = Number(this.page?.model.spec.tilt.high);
    return (dx, dy) => {
      const way = add(add(frame.normal, across, dx / reach), up, -dy / reach);
      const [tilt, about] = leanOf(way, frame.ownFrame);
      this.page?.choose('tilt', Number(Math.min(tilt, high).toFixed(1)));
      this.page?.choose('tilt_way', Number(about.toFixed(1)));
    };
  }
  /**
   * The normal, and what can be taken hold of.
   * @param {CanvasRenderingContext2D} c
   */
  draw(c) {
    const { x, y } = this.stage;
    const tip = this.tip;
    c.strokeStyle = COLORS.faint;
    c.lineWidth = 1.2;
    c.setLineDash([4, 4]);
    c.beginPath();
    c.moveTo(2 * x - tip[0], 2 * y - tip[1]);
    c.lineTo(...tip);
    c.stroke();
    c.setLineDash([]);
    if (this.#acts('tilt')) this.#ring(c, tip, this.over === 'tilt');
    if (this.#acts('place') && longestSide(this.stage.frame.bodies)) this.#ring(c, [x, y], this.over === 'place');
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {Point} place
   * @param {boolean} taken
   */
  #ring(c, [x, y], taken) {
    c.beginPath();
    c.arc(x, y, taken ? 7 : 5, 0, 7);
    c.fillStyle = '#fff';
    c.strokeStyle = COLORS.waves;
    c.lineWidth = 2;
    c.fill();
    c.stroke();
  }
}
