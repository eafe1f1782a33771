// A struck mechanism on the stage: links that move and bend, their joints, and what the joints bear.
import { letters } from '../charts/canvas.js';
import { boxOf, indexAt, roundBelow } from '../charts/scale.js';
import { COLORS, css } from '../charts/styles.js';
import { arrow } from '../beam/flown.js';
import { given } from '../wire/message.js';
import { bendingOf } from './bending.js';
import { drawJoint } from './joints.js';
import { gone, Labels } from './labels.js';
import { text } from '../text/catalogue.js';
import { figures, prefixed } from '../text/format.js';

/** @import { MechanismFrame, MechanismRecord } from '../messages.js' */
/** @import { Drawn } from '../frame/striker.js' */

/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {[x: number, y: number]} Point */

const SHOWN_MOVE = 0.12; // of the mechanism, that the largest movement is drawn as
const ROOM = 46; // pixels about the mechanism, at most
const SHARE_OF_ROOM = [0.07, 0.2]; // of the width and the height of the picture
const LONGEST_ARROW = 44; // pixels, of the largest reaction
const LEAST_ARROW = 3;
const HEAD = 44; // pixels, of words and colours above
const FOOT = 26; // of a support below the lowest link
const NODE = 2.2; // radius
const ROUNDING = 1e-9; // of what the contact gives, below which a joint bears nothing

export class Mechanism {
  factor = 1; // by which movement is drawn larger
  scale = 1; // pixels in a metre
  /** @type {Point} */ middle = [0, 0]; // of the mechanism [m]
  /** @type {Point} */ center = [0, 0]; // and on the canvas
  width = 0; // of its part of the picture, in pixels
  height = 0;
  largest = 0; // reaction [N]
  /** @type {Point[][]} */ placed = []; // links as they are drawn, in pixels
  /** @type {Drawn | null} */ held = null; // where the striker is
  /** @type {Point[]} */ past = []; // where it comes to at other instants, in pixels
  /** @type {import('./labels.js').Box | null} */ away = null; // where it is said how far that has gone

  shown = 'reach'; // movement whose scale can be shared
  led = false; // it is the picture of the opening
  slack = SHOWN_MOVE; // of the mechanism, beside it, for what moves
  flight = 0; // by how much larger the way of the mass is drawn, if not as all else

  /**
   * @param {MechanismFrame} frame
   * @param {number} reach  of the impactor while it touches [m]
   */
  constructor(frame, reach) {
    this.frame = frame;
    /** @type {MechanismRecord} */
    this.linkage = frame.mechanism;
    this.points = given(frame.linkPoints, 'linkPoints');
    this.moves = given(frame.linkMoves, 'linkMoves');
    this.times = given(frame.linkTime, 'linkTime');
    this.places = frame.shapes.linkPoints[1];
    this.bending = bendingOf(frame); // of links whose fields come as shapes
    this.labels = new Labels(this);
    this.box = boxOf(this.points);
    this.size = Math.max(this.box[1] - this.box[0], this.box[3] - this.box[2]);
    this.reach = this.furthest(reach);
    this.magnify(this.reach);
    for (const force of frame.reactions ?? []) this.largest = Math.max(this.largest, Math.abs(force));
    this.sudden = !this.largest; // then all is over at once, and impulses are what there is
    for (const { impulse } of (this.sudden && frame.main.joints) || [])
      this.largest = Math.max(this.largest, ...impulse.map(Math.abs));
    if (this.sudden && this.largest < ROUNDING * Math.abs(frame.main.impulse)) this.largest = 0;
  }
  /**
   * How far the largest movement goes that is drawn larger.
   * @param {number} reach
   */
  furthest(reach) {
    let most = reach;
    for (const move of this.moves) most = Math.max(most, Math.abs(move));
    return most;
  }
  /** @param {number} reach  the largest movement that is to be drawn [m] */
  magnify(reach) {
    this.factor = Math.max(roundBelow((SHOWN_MOVE * this.size) / reach), 1);
  }
  /**
   * @param {number} width
   * @param {number} height
   */
  fit(width, height) {
    this.width = width;
    const [left, right, low, high] = this.box;
    const [across, up] = [Math.max(right - left, 1e-9), Math.max(high - low, 1e-9)];
    const [beside, above] = [width, height].map((pixels, k) => Math.min(ROOM, SHARE_OF_ROOM[k] * pixels));
    this.scale = Math.min((width - 2 * beside) / (across + this.slack * this.size), (height - 2 * above) / up);
    this.middle = [(left + right) / 2, (low + high) / 2];
    this.center = [width / 2, height / 2 + 6];
    this.height = height;
    this.#lower();
  }
  /** Off the words and colours above, if what strikes comes from there, as far as there is room below. */
  #lower() {
    const { contact, normal } = this.linkage;
    const above = this.middleOf(contact, normal)[1] - this.wide / 2;
    const below = this.height - FOOT - this.pixel(0, this.box[2])[1];
    this.center[1] += Math.max(0, Math.min(HEAD - above, below));
  }
  /**
   * @param {number} x
   * @param {number} y  upwards
   * @returns {Point}
   */
  pixel(x, y) {
    return [this.center[0] + (x - this.middle[0]) * this.scale, this.center[1] - (y - this.middle[1]) * this.scale];
  }
  /**
   * Between which instants it is, by the later one, and where.
   * @param {number} t
   */
  instant(t) {
    const { times } = this;
    const k = Math.max(Math.min(indexAt(times, t) + 1, times.length - 1), 1);
    return [k, Math.min(Math.max((t - times[k - 1]) / (times[k] - times[k - 1] || 1), 0), 1)];
  }
  /**
   * Where its links are at other instants, in the opening, if it goes far.
   * @param {Context} _c
   * @param {number} _t
   */
  ghosts(_c, _t) {}
  /** @param {number} t */
  place(t) {
    const { factor, moves, places, points, linkage } = this;
    const [k, part] = this.instant(t);
    const all = 2 * places * linkage.links.length;
    const moved = (/** @type {number} */ i) =>
      points[i] + factor * (moves[(k - 1) * all + i] * (1 - part) + moves[k * all + i] * part);
    this.placed = linkage.links.map((_link, n) =>
      Array.from({ length: places }, (_, j) => this.pixel(...this.#pair(moved, 2 * (n * places + j)))),
    );
  }
  /**
   * @param {(i: number) => number} value
   * @param {number} i
   * @returns {Point}
   */
  #pair(value, i) {
    return [value(i), value(i + 1)];
  }
  /**
   * A place along a link, as it is drawn.
   * @param {number} link
   * @param {number} share  of its length
   * @returns {Point}
   */
  along(link, share) {
    const last = this.placed[link].length - 1;
    const at = Math.min(Math.max(share, 0), 1) * last;
    const k = Math.min(Math.floor(at), last - 1);
    const [[a, b], [c, d]] = [this.placed[link][k], this.placed[link][k + 1]];
    return [a + (at - k) * (c - a), b + (at - k) * (d - b)];
  }
  /** The direction of the impact on the canvas. @returns {Point} */
  get way() {
    const [x, y] = this.linkage.normal;
    return [x, -y];
  }
  /** What is drawn larger than it is. */
  get scaleWords() {
    return text('stage.movement', { times: figures(this.factor, 2) });
  }
  /** Whether there are moments in the struck link. */
  get bends() {
    return this.linkage.links[this.linkage.struck].flexible;
  }
  /**
   * What strikes it, where it has come to.
   * @param {Context} c
   * @param {number} _t
   * @param {number} moved  along the normal [m]
   * @param {boolean} touching
   */
  striker(c, _t, moved, touching) {
    const [nx, ny] = this.linkage.normal;
    const [x, y] = this.linkage.contact;
    this.striking(c, [x + this.factor * moved * nx, y + this.factor * moved * ny], [nx, ny], touching);
  }
  /**
   * The same anywhere, beside the link that it strikes.
   * @param {Context} c
   * @param {Point} place  of the mass, which is a point on the middle line of the link as it strikes [m]
   * @param {Point} normal  into the link
   * @param {boolean} touching
   */
  striking(c, place, [nx, ny], touching) {
    const { impactor } = this.frame;
    const [wx, wy] = [nx, -ny];
    const size = this.wide;
    const [a, b] = this.middleOf(place, [nx, ny]);
    const left = Math.max(-a, a - this.width, -b, b - this.height) > -0.5 * size;
    this.away = null;
    if (left) gone(c, this, [a, b]);
    if (left) return;
    c.save();
    c.translate(a, b);
    c.rotate(Math.atan2(wy, wx));
    c.fillStyle = '#3b4a59';
    c.beginPath();
    if (impactor.kind === 'sphere') c.arc(0, 0, size / 2, 0, 7);
    else c.roundRect(-size / 2, -size / 2, size, size, 5);
    c.fill();
    if (touching) {
      c.fillStyle = COLORS.cursor;
      c.fillRect(size / 2 - 1.5, -size / 2 - 4, 3, size + 8);
    }
    c.restore();
    this.held = { x: a, y: b, width: size, height: size, way: [wx, wy], sized: true };
  }
  /** How large what strikes is drawn [px]. */
  get wide() {
    return Math.min(Math.max(36 * (this.frame.impactor.mass / this.linkage.mass) ** (1 / 6), 18), 48);
  }
  /**
   * Where the middle of what strikes is drawn.
   * @param {Point} place  of its face, on the middle line of the link [m]
   * @param {Point} normal  into the link
   * @returns {Point}
   */
  middleOf(place, [nx, ny]) {
    const aside = 0.5 * (this.thick(this.linkage.struck) + this.wide) + 1;
    const [x, y] = this.pixel(...place);
    return [x - aside * nx, y + aside * ny];
  }
  /** @param {number} n */
  thick(n) {
    return Math.min(Math.max(this.linkage.links[n].depth * this.scale, 6), 16);
  }
  /**
   * @param {Context} c
   * @param {(n: number, share: number) => number} value  that the colours of a link show, at a share of its length
   * @param {number} end  of the colours
   * @param {boolean} fibres  whether both sides of it differ in sign
   */
  links(c, value, end, fibres) {
    c.lineCap = 'round';
    c.lineJoin = 'round';
    this.placed.forEach((line, n) => {
      c.strokeStyle = '#4a5968';
      c.lineWidth = this.thick(n) + 2;
      this.#path(c, line);
      c.strokeStyle = '#c3ccd5';
      c.lineWidth = this.thick(n);
      this.#path(c, line);
      const known = n === this.linkage.struck || this.bending[n];
      if (known && this.linkage.links[n].flexible)
        this.#coloured(c, line, this.thick(n), (share) => value(n, share), end, fibres);
    });
    c.lineCap = 'butt';
    this.#nodes(c);
  }
  /**
   * Those of finite elements.
   * @param {Context} c
   */
  #nodes(c) {
    c.fillStyle = '#ffffff';
    c.strokeStyle = '#1c2733';
    c.lineWidth = 1;
    this.linkage.links.forEach(({ nodes }, n) => {
      for (const share of nodes) {
        c.beginPath();
        c.arc(...this.along(n, share), NODE, 0, 7);
        c.fill();
        c.stroke();
      }
    });
  }
  /**
   * @param {Context} c
   * @param {Point[]} line
   */
  #path(c, line) {
    c.beginPath();
    for (const [x, y] of line) c.lineTo(x, y);
    c.stroke();
  }
  /**
   * Piece by piece, either side of the middle line where fibres differ: a positive moment presses those to its left.
   * @param {Context} c
   * @param {Point[]} line
   * @param {number} thick
   * @param {(share: number) => number} value
   * @param {number} end
   * @param {boolean} fibres
   */
  #coloured(c, line, thick, value, end, fibres) {
    c.lineCap = 'butt';
    for (let k = 1; k < line.length; k++) {
      const [[a, b], [x, y]] = [line[k - 1], line[k]];
      const length = Math.hypot(x - a, y - b) || 1;
      const [across, down] = [(y - b) / length, (a - x) / length];
      const found = value((k - 0.5) / (line.length - 1));
      for (const side of fibres ? [-1, 1] : [0]) {
        const shift = (side * thick) / 4;
        c.strokeStyle = css((side || 1) * found, end);
        c.lineWidth = fibres ? thick / 2 : thick;
        c.beginPath();
        c.moveTo(a + across * shift, b + down * shift);
        c.lineTo(x + across * shift, y + down * shift);
        c.stroke();
      }
    }
  }
  /** @param {Context} c */
  joints(c) {
    for (const joint of this.linkage.joints) drawJoint(c, joint, this.along(joint.link, joint.share));
  }
  /**
   * What each joint does to its second link, as an arrow, at the instant that is placed.
   * @param {Context} c
   * @param {number} t
   */
  reactions(c, t) {
    if (!this.largest) return;
    const found = this.#reactionsAt(t);
    this.linkage.joints.forEach((joint, n) => {
      const [fx, fy] = found[n].map((part) => (part / this.largest) * LONGEST_ARROW);
      if (Math.hypot(fx, fy) >= LEAST_ARROW) arrow(c, this.along(joint.link, joint.share), [fx, -fy]);
    });
  }
  /**
   * Force [N] of every joint, or its impulse [N s] once all is over at once.
   * @param {number} t
   * @returns {Point[]}
   */
  #reactionsAt(t) {
    const { main, reactionTime, reactions } = this.frame;
    const { joints } = this.linkage;
    if (this.sudden || !reactionTime || !reactions)
      return joints.map((_, n) => (t > 0 ? (main.joints?.[n].impulse ?? [0, 0]) : [0, 0]));
    let k = 0;
    while (k < reactionTime.length - 1 && reactionTime[k + 1] <= t) k++;
    return joints.map((_, n) => {
      const at = 3 * (k * joints.length + n);
      return [reactions[at], reactions[at + 1]];
    });
  }
  /**
   * Names of links, and above them what the arrows are.
   * @param {Context} c
   * @param {number} x
   * @param {number} y
   * @param {boolean} narrow  there is room for few words
   */
  words(c, x, y, narrow) {
    c.font = letters(13);
    c.textAlign = 'left';
    c.textBaseline = 'bottom';
    c.fillStyle = COLORS.halfSpace;
    const [factor, prefix] = prefixed(this.largest);
    const most = `${figures(this.largest * factor, 2)} ${prefix}N${this.sudden ? ' s' : ''}`;
    const code = narrow ? 'beam.stage.reactions-short' : 'beam.stage.reactions';
    const arrows = this.largest ? text(code, { sudden: this.sudden, most }) : '';
    c.fillText(arrows, x, y);
    const wide = Math.max(c.measureText(arrows).width, c.measureText(this.scaleWords).width);
    this.labels.draw(c, [[0, 0, x + wide, y], ...(this.away ? [this.away] : [])]);
  }
}
