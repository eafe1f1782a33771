// A mechanism that moves on: links on their ways, bent larger than they are, and the mass where it flies.
import { between, boxOf, roundBelow } from '../charts/scale.js';
import { COLORS } from '../charts/styles.js';
import { given } from '../wire/message.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { drawGhosts, ghostsOf } from './ghosts.js';
import { Mechanism } from './mechanism.js';

/** @import { MechanismFrame } from '../messages.js' */
/** @import { Context, Point } from './mechanism.js' */

const SHOWN_BEND = 0.06; // of the mechanism, that the largest deflection is drawn as
const MOST = 100; // times that bending is drawn larger
const AROUND = { wide: 0.35, tall: 0.08 }; // of the mechanism, as far as which the mass is followed, by the picture
const TOP = 26; // pixels
const GROUND = 8; // more below, where the ground is drawn
const LEAST_FOR_DASHES = 480; // pixels, where there is room to say what they are, and what thin lines are:
const LEAST_FOR_THIN = 520;
const AXES = 20; // pixels, of a moving frame
const PAST = 60; // of its places that names keep clear of
const SEEN = 0.012; // of the whole time for which an impact is marked

export class MovingMechanism extends Mechanism {
  shown = 'bend'; // movement whose scale can be shared
  flight = 1; // which is to scale
  slack = 0; // it is drawn where it goes
  /** @type {[Point, Point][]} */ frames = []; // where links would be unbent, in pixels
  /** @type {{ time: number[], x: number[], y: number[] }} */ beside = { time: [], x: [], y: [] };

  /** @param {MechanismFrame} frame */
  constructor(frame) {
    super(frame, 0);
    this.rows = this.bending.map((bending) => (bending ? new Float64Array(bending.places) : null));
    const flown = given(frame.massPlaces, 'massPlaces');
    const { points } = this;
    this.mass = { x: flown.filter((_, k) => k % 2 === 0), y: flown.filter((_, k) => k % 2 === 1) };
    const places = this.moves.map((move, k) => points[k % points.length] + move);
    const swept = boxOf(places);
    const about = (/** @type {number} */ around) => boxOf([...places, ...this.#near(swept, around)]);
    this.boxes = { wide: about(AROUND.wide), tall: about(AROUND.tall) };
    this.box = this.boxes.wide;
    this.others = ghostsOf(this.times, points, this.moves, this.size);
    this.#meet();
  }
  /** How far the largest movement goes that is drawn larger: bending alone. */
  furthest() {
    return Math.max(0, ...this.bending.map((bending) => bending?.largest ?? 0));
  }
  /** @param {number} reach  the largest deflection of a link [m] */
  magnify(reach) {
    this.factor = reach > 0 ? Math.min(Math.max(roundBelow((SHOWN_BEND * this.size) / reach), 1), MOST) : 1;
    if (this.rows) this.#meet(); // else it is being made
  }
  /**
   * Below what is written at the top, where the mass may fly.
   * @param {number} width
   * @param {number} height
   */
  fit(width, height) {
    this.box = this.boxes[width < height ? 'tall' : 'wide'];
    super.fit(width, height - TOP);
    this.height = height;
    this.center[1] += TOP - GROUND;
  }
  /**
   * Where the mass flies, as long as it is near the links.
   * @param {number[]} box  of these: left, right, low and high
   * @param {number} around  share of its size
   */
  #near([left, right, low, high], around) {
    const room = around * Math.max(right - left, high - low);
    const { x, y } = this.mass;
    const inside = (/** @type {number} */ k) =>
      x[k] > left - room && x[k] < right + room && y[k] > low - room && y[k] < high + room;
    return Array.from(x).flatMap((_, k) => (inside(k) ? [x[k], y[k]] : []));
  }
  /** By how much the mass is drawn elsewhere, so that it meets the link where that is drawn. */
  #meet() {
    const { at, struck } = this.linkage;
    const normals = given(this.frame.normals, 'normals');
    const time = Array.from(normals.subarray(0, normals.length / 2));
    const off = time.map((t) => {
      const [[a, b], [x, y]] = this.ends(struck, t);
      const long = Math.hypot(x - a, y - b) || 1;
      const row = this.bending[struck]?.profile(t, 'deflection');
      const more = row ? (this.factor - 1) * row[Math.round(at * (row.length - 1))] : 0;
      return [(-more * (y - b)) / long, (more * (x - a)) / long];
    });
    this.beside = { time, x: off.map(([x]) => x), y: off.map(([, y]) => y) };
  }
  /**
   * The line from which a link's deflection is drawn: its ends [m].
   * @param {number} n
   * @param {number} t
   * @returns {[Point, Point]}
   */
  ends(n, t) {
    const { moves, points, linkage } = this;
    const [k, part] = this.instant(t);
    const all = 4 * linkage.links.length;
    const value = (/** @type {number} */ i) =>
      points[i] + moves[(k - 1) * all + i] * (1 - part) + moves[k * all + i] * part;
    const i = 4 * n;
    return [
      [value(i), value(i + 1)],
      [value(i + 2), value(i + 3)],
    ];
  }
  /** @type {Mechanism['ghosts']} */
  ghosts(c, t) {
    if (this.led) drawGhosts(c, this.others, t, (x, y) => this.pixel(x, y));
  }
  /** @param {number} t */
  place(t) {
    this.placed = this.linkage.links.map((_, n) => {
      const [[a, b], [x, y]] = this.ends(n, t);
      const row = this.rows[n];
      this.frames[n] = [this.pixel(a, b), this.pixel(x, y)];
      if (!row) return this.frames[n];
      this.bending[n]?.profile(t, 'deflection', row);
      const long = Math.hypot(x - a, y - b) || 1;
      const [across, up] = [(-this.factor * (y - b)) / long, (this.factor * (x - a)) / long];
      return Array.from(row, (bent, j) => {
        const share = j / (row.length - 1);
        return this.pixel(a + share * (x - a) + bent * across, b + share * (y - b) + bent * up);
      });
    });
  }
  /**
   * With the moving frames of those that bend.
   * @type {Mechanism['links']}
   */
  links(c, ...seen) {
    super.links(c, ...seen);
    this.frames.forEach((line, n) => {
      if (this.rows[n]) this.#frame(c, ...line);
    });
  }
  /**
   * The axes of a link's frame at its first end, and where the link would be unbent.
   * @param {Context} c
   * @param {Point} from
   * @param {Point} to
   */
  #frame(c, [a, b], [x, y]) {
    const long = Math.hypot(x - a, y - b) || 1;
    const [across, up] = [(AXES * (x - a)) / long, (AXES * (y - b)) / long];
    c.strokeStyle = COLORS.ink;
    c.lineWidth = 1;
    c.setLineDash([5, 4]);
    c.beginPath();
    c.moveTo(a, b);
    c.lineTo(x, y);
    c.stroke();
    c.setLineDash([]);
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(a + across, b + up);
    c.lineTo(a, b);
    c.lineTo(a + up, b - across);
    c.stroke();
  }
  /**
   * @param {Context} c
   * @param {number} t
   */
  striker(c, t) {
    const { beside, frame, mass, times } = this;
    this.#path(c);
    const normals = given(frame.normals, 'normals');
    const edges = normals.length / 2;
    const normal = (/** @type {number} */ time) => {
      const angle = between(normals.subarray(0, edges), normals.subarray(edges), time);
      return /** @type {Point} */ ([Math.cos(angle), Math.sin(angle)]);
    };
    const step = Math.ceil(times.length / PAST);
    const some = times.filter((_, k) => k % step === 0);
    this.past = Array.from(some, (time, k) => this.middleOf([mass.x[step * k], mass.y[step * k]], normal(time)));
    const off = (/** @type {'x' | 'y'} */ way) => between(times, mass[way], t) + between(beside.time, beside[way], t);
    const touching = frame.contacts.some(([start, end]) => t >= start && t <= end + SEEN * frame.duration);
    const place = /** @type {Point} */ ([off('x'), off('y')]);
    this.striking(c, place, normal(t), touching);
  }
  /**
   * The way of the mass.
   * @param {Context} c
   */
  #path(c) {
    const { x, y } = this.mass;
    c.strokeStyle = COLORS.edge;
    c.lineWidth = 1;
    c.setLineDash([2, 4]);
    c.beginPath();
    for (let k = 0; k < x.length; k++) c.lineTo(...this.pixel(x[k], y[k]));
    c.stroke();
    c.setLineDash([]);
  }
  /** What is drawn larger than it is. */
  get scaleWords() {
    const bends = this.bending.some(Boolean);
    const thin = this.led && this.others.length > 0 && this.width > LEAST_FOR_THIN;
    return text('motion.scale', { times: figures(this.factor, 2), bends, thin, wide: this.width > LEAST_FOR_DASHES });
  }
}
