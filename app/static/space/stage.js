// The stage for bodies in space: both before (faint) and after one impulse, projected without perspective on the plane
// of the message. Lengths are true; time runs from -1 to 1 in units of the message's `duration`, the impact at 0.
import { cleared, letters, sizeOf } from '../charts/canvas.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { brief } from '../text/format.js';
import { arrow, label, stopAt, unlabelled } from './arrows.js';
import { AXES, CORNERS, EDGES } from './box.js';
import { Hands, LOOKS, turnedBy } from './hands.js';
import { drawImpulse, movingAt, nameImpulse } from './impulse.js';
import { corners, drawnAt, legend, spinOf } from './legend.js';
import { poseAt } from './pose.js';
import { summary } from './summary.js';
import { add, cross, dot, size, times, triple } from './vectors.js';

/** @import { BodyRecord, SpaceFrame, Vector } from '../messages.js' */
/** @import { Striker } from '../frame/striker.js' */
/** @import { Point } from './arrows.js' */
/** @import { Pose } from './pose.js' */

/** @typedef {'impactor' | 'target'} Which */
/** @typedef {CanvasRenderingContext2D} Context */

/** @type {Which[]} */
const BOTH = ['target', 'impactor']; // the one that strikes is drawn last
const INK = { impactor: '#33475b', target: '#2f6fa8' };
const FILL = { impactor: [93, 108, 123], target: [120, 170, 212] };
const CIRCLE = Array.from({ length: 49 }, (_, k) => [Math.cos((k / 24) * Math.PI), Math.sin((k / 24) * Math.PI)]);
const FONT = letters(13);
const [GAP, BESIDE] = [16, 48]; // pixels between the picture and what is said beside it, and about the bodies then

export class BodiesStage {
  /** @type {SpaceFrame} */ frame;
  /** @type {number[]} */ turned = LOOKS.side; // the picture, by a hand
  /** @type {Vector} */ across = [1, 0, 0]; // the picture as it is seen
  /** @type {Vector} */ up = [0, 1, 0];
  /** @type {Vector} */ toward = [0, 0, 1]; // who looks
  /** @type {HTMLElement | null} */ lap = null; // what lies over its lower right, in the opening
  time = 0; // that is shown
  share = 1; // of the impulse
  box = [0, 1, 0, 1]; // left, right, low and high of all that moves [m]
  speed = 0; // the largest
  spin = 0;
  // of the picture: pixels in a metre, where the bodies meet, and the length of the largest velocity
  scale = 1;
  x = 0;
  y = 0;
  long = 0;
  wide = 1; // of all of it
  high = 1;
  /** @type {Striker | null} */ striker = null; // by which a hand takes hold

  constructor() {
    this.canvas = make('canvas', { role: 'img', ariaLabel: text('space.about') });
    this.canvas.style.cssText = 'width:100%;height:100%;display:block';
    this.root = make('section', { className: 'stage bodies' }, this.canvas);
    this.hands = new Hands(this);
  }
  /** @param {SpaceFrame} frame */
  load(frame) {
    this.frame = frame;
    this.#measure();
  }
  /**
   * Look from elsewhere.
   * @param {number[]} turned
   */
  look(turned) {
    this.turned = turned;
    if (!this.frame) return;
    this.#measure();
    this.redraw();
  }
  redraw() {
    this.draw(this.time, this.share);
  }
  #measure() {
    const { frame } = this;
    [this.across, this.up] = turnedBy(frame.across, frame.up, this.turned);
    this.toward = cross(this.across, this.up);
    const box = [Infinity, -Infinity, Infinity, -Infinity];
    const both = BOTH.map((name) => frame.bodies[name]).flatMap(({ before, after }) => [before, after]);
    this.speed = Math.max(...both.map(({ velocity }) => size(velocity)));
    this.spin = Math.max(...both.map(({ spin }) => size(spin)));
    for (const name of BOTH) {
      const body = frame.bodies[name];
      if (body.shape === 'stop') continue;
      const half = body.radius ?? (body.sides ? size(body.sides) / 2 : 0);
      const path = this.#path(name);
      for (let k = 0; k < path.length; k += 3) {
        const [x, y] = this.flat(triple(path, k));
        box[0] = Math.min(box[0], x - half);
        box[1] = Math.max(box[1], x + half);
        box[2] = Math.min(box[2], y - half);
        box[3] = Math.max(box[3], y + half);
      }
    }
    this.box = box;
  }
  /** Room about where the bodies meet [m], and the largest velocity and spin. */
  ranges() {
    const [left, right, low, high] = this.box;
    return { left: -left, right, low: -low, high, speed: this.speed, spin: this.spin };
  }
  /** @param {Record<string, number>} ranges  in place of its own */
  adopt({ high, left, low, right, speed, spin }) {
    if (left !== undefined) this.box = [-left, right, -low, high];
    this.speed = speed ?? this.speed;
    this.spin = spin ?? this.spin;
  }
  /** @param {Which} name */
  #path(name) {
    return name === 'impactor' ? this.frame.impactorPath : this.frame.targetPath;
  }
  /**
   * @param {Vector} p
   * @returns {Point}
   */
  flat(p) {
    return [dot(p, this.across), dot(p, this.up)];
  }
  get stopped() {
    return BOTH.some((name) => this.frame.bodies[name].shape === 'stop');
  }
  /** Pixels of a stop to either side. */
  get reach() {
    return Math.max(0.1 * this.frame.size * this.scale, 16);
  }
  get bodies() {
    return BOTH.map((name) => ({ ...this.frame.bodies[name], name }));
  }
  /**
   * @param {number} t  from -1 to 1
   * @param {number} share  of the normal impulse that has been given by then, where its clock is the impulse
   */
  draw(t, share = 1) {
    const { canvas, frame, root } = this;
    if (!frame) return;
    const sheet = cleared(canvas, root);
    if (!sheet) return;
    const { c, height } = sheet;
    const [covered, tall] = this.lap ? sizeOf(this.lap) : [0, 0];
    const width = sheet.width - covered;
    this.fit(width, height);
    [this.time, this.share] = [t, share];
    const now = Math.min(Math.max(t, -1), 1);
    const [tip, contact, ...bodies] = drawnAt(this, now);
    unlabelled(c, [...corners(c, this, now), tip, contact], bodies, sheet.width);
    if (this.stopped) stopAt(c, [this.x, this.y], this.flat(frame.normal), this.reach);
    c.globalAlpha = 0.28;
    for (const name of BOTH) {
      this.trail(c, name);
      this.body(c, name, -1);
      if (now >= 0) this.moves(c, name, -1, frame.bodies[name].before, false);
    }
    c.globalAlpha = 1;
    const struck = now >= 0 && frame.impulse > 0;
    for (const name of BOTH) this.body(c, name, now);
    if (struck) drawImpulse(c, this, this.share, 1 - 0.45 * now);
    for (const name of BOTH) this.moves(c, name, now, movingAt(frame, name, now < 0 ? 0 : this.share), true);
    if (struck) nameImpulse(c, this, this.share);
    this.hands.draw(c);
    this.hold(c, now);
    legend(c, this, now, width, height);
    if (this.lap) summary(c, frame, INK, { left: width + GAP, width: covered - GAP, height: height - tall });
  }
  /**
   * @param {Context} c
   * @param {number} now
   */
  hold(c, now) {
    const { before, radius = 0, shape } = this.frame.bodies.impactor;
    if (!this.striker || shape === 'stop') return;
    const [x, y] = this.at(this.pose('impactor', now).centre);
    const [across, up] = this.flat(before.velocity);
    const fast = Math.hypot(across, up) || 1;
    const width = Math.max(2 * radius * this.scale, 24);
    this.striker.draw(c, { x, y, width, height: width, way: [across / fast, -up / fast], sized: false });
  }
  /**
   * @param {number} width
   * @param {number} height
   */
  fit(width, height) {
    const [left, right, low, high] = this.box;
    const margin = Math.min(this.lap ? BESIDE : 70, 0.14 * Math.min(width, height) + 20);
    const span = Math.max(right - left, high - low, 1e-9);
    this.scale = Math.min(
      (width - 2 * margin) / Math.max(right - left, 0.05 * span),
      (height - 2 * margin) / Math.max(high - low, 0.05 * span),
    );
    this.x = width / 2 - (this.scale * (left + right)) / 2;
    this.y = height / 2 + (this.scale * (low + high)) / 2;
    [this.wide, this.high] = [width, height];
    this.long = 0.2 * Math.min(width, height); // pixels of the longest velocity
  }
  /**
   * @param {Vector} p
   * @returns {Point}
   */
  at(p) {
    const [x, y] = this.flat(p);
    return [this.x + this.scale * x, this.y - this.scale * y];
  }
  /**
   * @param {Which} name
   * @param {number} t
   */
  pose(name, t) {
    const { impactorTurn, targetTurn } = this.frame;
    return poseAt(this.#path(name), name === 'impactor' ? impactorTurn : targetTurn, t);
  }
  /**
   * @param {Context} c
   * @param {Which} name
   */
  trail(c, name) {
    if (this.frame.bodies[name].shape === 'stop') return;
    const path = this.#path(name);
    c.strokeStyle = INK[name];
    c.lineWidth = 1.2;
    c.setLineDash([3, 5]);
    c.beginPath();
    for (let k = 0; k < path.length; k += 3) c.lineTo(...this.at(triple(path, k)));
    c.stroke();
    c.setLineDash([]);
  }
  /**
   * @param {Context} c
   * @param {Which} name
   * @param {number} t
   */
  body(c, name, t) {
    const body = this.frame.bodies[name];
    if (body.shape === 'stop') return;
    const pose = this.pose(name, t);
    const [x, y] = this.at(pose.centre);
    c.strokeStyle = INK[name];
    c.fillStyle = `rgb(${FILL[name]})`;
    c.lineWidth = 1.3;
    c.lineJoin = c.lineCap = 'round';
    if (body.shape === 'box') this.boxed(c, name, body, pose);
    else if (body.shape === 'ball') this.ball(c, body, pose, x, y);
    else {
      c.beginPath();
      c.arc(x, y, 8, 0, 7);
      c.fill();
      c.stroke();
    }
    c.fillStyle = INK[name];
    c.beginPath();
    c.arc(x, y, 2.2, 0, 7);
    c.fill();
  }
  /**
   * The faces that look this way; a rod, which has one side only, as a thick line.
   * @param {Context} c
   * @param {Which} name
   * @param {BodyRecord} body
   * @param {Pose} pose
   */
  boxed(c, name, { axes = AXES, sides = [0, 0, 0] }, { centre, turned }) {
    const half = axes.map((axis, i) => turned(times(axis, sides[i] / 2)));
    if (sides.filter((side) => side === 0).length === 2) {
      this.#stick(c, name, centre, half[sides.findIndex((side) => side > 0)]);
      return;
    }
    for (const [out, one, two] of EDGES) {
      const normal = turned(axes[out]);
      const facing = dot(normal, this.toward);
      const way = Math.sign(facing);
      if (Math.abs(facing) < 1e-6) continue;
      const middle = add(centre, half[out], way);
      const light = 0.72 + 0.28 * Math.abs(facing);
      c.fillStyle = `rgb(${FILL[name].map((v) => Math.round(v * light))})`;
      c.beginPath();
      for (const [a, b] of CORNERS) c.lineTo(...this.at(add(add(middle, half[one], a), half[two], b)));
      c.closePath();
      c.fill();
      c.stroke();
    }
  }
  /**
   * @param {Context} c
   * @param {Which} name
   * @param {Vector} centre
   * @param {Vector} along  half of it
   */
  #stick(c, name, centre, along) {
    /** @type {[color: string, wide: number][]} */
    const strokes = [
      [INK[name], 10],
      [`rgb(${FILL[name]})`, 7.5],
    ];
    for (const [color, wide] of strokes) {
      c.strokeStyle = color;
      c.lineWidth = wide;
      c.beginPath();
      c.moveTo(...this.at(add(centre, along, -1)));
      c.lineTo(...this.at(add(centre, along)));
      c.stroke();
    }
  }
  /**
   * A ball with three painted circles, of each the half that looks this way.
   * @param {Context} c
   * @param {BodyRecord} body
   * @param {Pose} pose
   * @param {number} x
   * @param {number} y
   */
  ball(c, { radius = 0 }, { centre, turned }, x, y) {
    c.beginPath();
    c.arc(x, y, Math.max(radius * this.scale, 3), 0, 7);
    c.fill();
    c.stroke();
    c.lineWidth = 0.9;
    for (let k = 0; k < 3; k++) {
      const a = turned(AXES[k]);
      const b = turned(AXES[(k + 1) % 3]);
      c.beginPath();
      let drawing = false;
      for (const [cosine, sine] of CIRCLE) {
        const out = add(times(a, cosine), b, sine);
        const seen = dot(out, this.toward) >= 0;
        const place = this.at(add(centre, out, radius));
        if (seen && drawing) c.lineTo(...place);
        else if (seen) c.moveTo(...place);
        drawing = seen;
      }
      c.stroke();
    }
  }
  /**
   * Velocity as an arrow from the centre, spin as an arc about it.
   * @param {Context} c
   * @param {Which} name
   * @param {number} t
   * @param {{ velocity: Vector, spin: Vector }} moving
   * @param {boolean} labelled
   */
  moves(c, name, t, { spin, velocity }, labelled) {
    if (this.frame.bodies[name].shape === 'stop') return;
    const from = this.at(this.pose(name, t).centre);
    c.fillStyle = c.strokeStyle = INK[name];
    c.font = FONT;
    if (size(velocity) > 1e-9 * this.speed) {
      const [vx, vy] = this.flat(times(velocity, this.long / this.speed));
      /** @type {Point} */
      const to = [from[0] + vx, from[1] - vy];
      arrow(c, from, to, 2);
      const level = Math.abs(vy) < 0.4 * Math.abs(vx); // below its arrow: ahead lie those of the impulse and the normal
      const place = level ? /** @type {Point} */ ([from[0] + vx / 2, from[1] - vy / 2]) : to;
      if (labelled) label(c, `${brief(size(velocity))} m/s`, place, level ? [0, 1] : [vx, -vy]);
    }
    if (size(spin) > 1e-9 * this.spin) spinOf(c, this, from, spin, labelled, this.#aside(name, t, this.flat(velocity)));
  }
  /**
   * Where a word lies beside a body that is a line, away from where it goes; else below it.
   * @param {Which} name
   * @param {number} t
   * @param {[x: number, y: number]} going
   * @returns {Point}
   */
  #aside(name, t, going) {
    const { axes = AXES, sides = [0, 0, 0] } = this.frame.bodies[name];
    const long = sides.filter((side) => side > 0);
    if (long.length !== 1) return [0, 1];
    const [x, y] = this.flat(this.pose(name, t).turned(axes[sides.findIndex((side) => side > 0)]));
    const way = Math.hypot(x, y);
    if (way < 0.1) return [0, 1]; // seen from its end
    const ahead = going[0] * y - going[1] * x > 0 ? -1 : 1; // of (y, -x), which is across
    return [(ahead * y) / way, (ahead * x) / way];
  }
}
