// The stage: the bodies themselves, movement exaggerated by a stated factor.
import { cleared, letters, scale as zoom } from '../charts/canvas.js';
import { hatch, isHatched, stretchesOf } from '../charts/hatch.js';
import { roundBelow } from '../charts/scale.js';
import { COLORS, css } from '../charts/styles.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures, grouped, localised, scaled } from '../text/format.js';
import { strikesBody } from './drawn.js';
import { RigidField } from './fields.js';
import { pushed } from './pushed.js';
import { axis, barNames, endMass, masses, onward, push, runs, specimen, striker, struckBody, wall } from './bodies.js';
import { cradle, swing } from './cradle.js';
import { middleOf, thickOf } from './heights.js';
import { scaleBar } from './scale_bar.js';
import { placing, seamIn } from './traces.js';
import { reachOf } from './reach.js';
import { drawnLength, pendulum, shapeOf, turningBar, WIDTH } from './pendulum.js';

/** @import { AxialFrame, RodRecord } from '../messages.js' */
/** @import { Striker } from '../frame/striker.js' */
/** @import { Hung } from './cradle.js' */
/** @import { Field, What } from './fields.js' */

const SLICES = 241;
const BODY_AT = 0.62; // of the width: where rods strike what has no waves
const RINGS = 24; // over all rods; half as many on one
const BODY = 56; // pixels of a striker as heavy as what it strikes
const PRESSED = 0.16; // of the striker that the deepest indentation may take
const REACH = 0.16; // of what is drawn that the largest movement takes
const [EDGE, ONWARD] = [6, 36]; // pixels left at the edges, and of the sign of an endless rod
const NARROW = 560; // pixels of width
const LEAST_ROOM = 12; // pixels in which anything can move
const LEADS = { left: 0.3, bends: 0.44, gap: 0.075 }; // shares, where the picture leads
const FACE = 0.45; // of the picture: where a body without length is struck
const SIGNED = 30; // pixels of a body that has room for a sign
const BALLS = 4; // times larger or smaller at most that a ball of another mass is drawn
const ROW = { struck: 0.34, leads: 0.44, most: 0.5 }; // of it: where a row of balls is struck; what it takes at most

export class Stage {
  /** @type {AxialFrame} */ frame;
  /** @type {Field} */ field;
  /** @type {What} */ what;
  /** @type {Striker | null} */ striker = null; // by which a hand takes hold
  largest = 1; // the end of the colours
  span = 1; // length drawn [m]; 0 where nothing has one
  moves = { reach: 1, pressed: 0, back: 0, ahead: 0 }; // how far [m]
  time = 0; // that is drawn
  factor = 1; // by which movement is exaggerated
  scale = 1; // pixels in a unit of displacement
  pushes = false; // forces of the contact are drawn as arrows
  leads = false; // the rows of the opening lie below it
  drawn = { left: 0, right: 0, rest: 0 }; // where rods are at rest, and the struck face [px]
  place = placing([0, 1], [0, 1], null); // where a place [m] of theirs is [px]
  /** @type {Hung[]} */ row = []; // balls as they hang
  values = new Float64Array(SLICES);
  moved = new Float64Array(SLICES);

  constructor() {
    this.canvas = make('canvas', { role: 'img', ariaLabel: text('axial.stage.about') });
    this.root = make('section', { className: 'stage' }, this.canvas);
  }
  /**
   * @param {AxialFrame} frame
   * @param {Field} field
   * @param {What} what
   * @param {number} largest
   */
  load(frame, field, what, largest) {
    this.frame = frame;
    this.field = field;
    this.what = what;
    this.largest = largest;
    this.span = field.to - field.from;
    this.moves = reachOf(frame, field);
    this.row = []; // of the scene before
  }
  /** What is drawn of movement [m]. */
  ranges() {
    return { ...this.moves };
  }
  /** @param {Record<string, number>} ranges  in place of its own */
  adopt(ranges) {
    this.moves = { ...this.moves, ...ranges };
  }
  /**
   * How movement is drawn: its largest takes a share of the picture, and the deepest indentation one of the striker.
   * Beside a length, of a rod or of a ball, it is exaggerated by a factor, which is rounded to 1, 2 or 5.
   * @param {number} length  of what is drawn [px]
   * @param {number} size  of the striker
   * @param {[left: number, right: number]} room  beside it
   * @param {number} hung  pixels in a metre of a pendulum
   */
  #fit(length, size, room, hung) {
    const { frame, moves, span } = this;
    const { ahead, back, pressed, reach } = moves;
    const within = (/** @type {number} */ pixels, /** @type {number} */ moved) =>
      moved > 0 ? Math.max(pixels, LEAST_ROOM) / moved : Infinity;
    const edges = Math.min(within(room[0], back), within(room[1], ahead));
    const most = Math.min((REACH * length) / reach, within(PRESSED * size, pressed), edges); // [px/m]
    const radius = this.#radius(frame.impactor.radius ?? 0);
    const true_ = span > 0 ? length / span : radius > 0 ? size / (2 * radius) : hung;
    this.factor = true_ > 0 ? roundBelow(most / true_) : 0;
    this.scale = (true_ > 0 ? this.factor * true_ : most) * frame.speed * frame.trip;
  }
  /**
   * Of a ball that is drawn: with another mass than its scene gives it, it is as large as that would be.
   * @param {number} radius  as the scene has it, which the contact is about [m]
   */
  #radius(radius) {
    const { chosen, own, target } = this.frame;
    if (target.shape !== 'ball' || !chosen || !own) return radius; // outside the page
    const heavier = Number(own.mass_ratio) / Number(chosen.mass_ratio);
    return radius * Math.min(Math.max(Math.cbrt(heavier), 1 / BALLS), BALLS);
  }
  /**
   * Sizes of the striker and of a struck body without waves: by the radii of two balls, else by their masses.
   * @param {number} width
   * @param {number} height
   * @returns {[striker: number, struck: number]}
   */
  #sizes(width, height) {
    const { impactor, rods, target } = this.frame;
    const most = Math.min(0.16 * width, (target.row ? 0.32 : 0.62) * height); // below the words, where it is near them
    if (target.row) {
      const radii = [impactor.radius ?? target.row[0], ...target.row];
      const sum = radii.reduce((a, b) => a + b);
      const unit = Math.min(most / Math.max(...radii), (ROW.most * width) / sum);
      return [unit * radii[0], unit * radii[1]];
    }
    if (target.shape === 'ball' && target.radius && impactor.kind === 'sphere' && impactor.radius) {
      const own = this.#radius(impactor.radius);
      const larger = Math.max(own, target.radius);
      return [(most * own) / larger, (most * target.radius) / larger];
    }
    const held = target.held && (!this.span || strikesBody(rods)); // a wall has no mass to compare with
    const heavy = held ? 1 : impactor.mass / target.mass;
    const usual = this.leads ? thickOf(height, true, rods.length > 0) : BODY;
    const own = Math.min(Math.max(usual * heavy ** (1 / 6), 22), most);
    return [own, Math.min(0.36 * height, 68)];
  }
  /**
   * Where rods begin and end at rest: with room to fly off, unless they are held.
   * @param {number} width
   */
  #places(width) {
    const { impactor, rods, target } = this.frame;
    const rod = impactor.kind === 'rod';
    if (strikesBody(rods)) return [(this.leads ? LEADS.left : 0.1) * width, BODY_AT * width];
    const bends = this.frame.exactBend && width > NARROW; // its bar is laid flat at the left
    const left = (this.leads ? (bends ? LEADS.bends : LEADS.left) : rod ? 0.08 : width < NARROW ? 0.25 : 0.21) * width;
    if (target.held && target.support !== 'anechoic') return [left, width - (target.rotation ? 66 : 30)];
    return [left, (rod ? 0.86 : 0.82) * width];
  }
  /** @param {number} t */
  draw(t) {
    const { canvas, field, frame } = this;
    this.time = t;
    if (!frame) return;
    const sheet = cleared(canvas, this.root);
    if (!sheet) return;
    const { c, width, height } = sheet;
    const { rods, impactor } = frame;
    const hangs = impactor.kind === 'pendulum';
    const thick = thickOf(height, this.leads, rods.length > 0);
    const middle = middleOf(height, thick, this.leads, rods.length > 0, hangs);
    const [size, struck] = this.#sizes(width, height);
    const [left, right] = this.#places(width);
    const struckAt = (frame.target.row ? (this.leads ? ROW.leads : ROW.struck) : FACE) * width;
    const beyond = frame.target.support === 'anechoic' ? ONWARD : frame.target.endMass ? 0.8 * thick : 0;
    const behind = ['rod', 'pulse'].includes(impactor.kind) ? 0 : size;
    /** @type {[number, number]} */
    const room = frame.target.row
      ? [swing(height), swing(height)]
      : [
          this.leads ? LEADS.gap * width : (rods.length ? left : struckAt) - behind - EDGE,
          width - right - beyond - EDGE,
        ];
    this.#fit(right - left, size, room, hangs ? drawnLength(frame, middle, height) / Number(impactor.length) : 0);
    const meeting = field.mass(t) > field.face(t);
    if (impactor.kind === 'pendulum') this.#pendulum(c, t, rods.length ? left : FACE * width, middle, height);
    const rest = rods.length ? this.#chain(c, t, left, right, middle, thick) : struckAt;
    this.drawn = { left, right, rest };
    const face = rest + field.face(t) * this.scale;
    const own = rest + field.mass(t) * this.scale;
    const meet = meeting ? (face + own) / 2 : undefined;
    if (frame.turningBar) turningBar(c, frame, t, { rest, middle, scale: this.scale, height });
    else if ((!rods.length || strikesBody(rods)) && !frame.target.row)
      struckBody(c, frame, { face, middle, size: impactor.kind === 'pendulum' ? 2 * WIDTH : struck, meet }, width);
    const contact = this.touching(t);
    if (frame.target.row) {
      this.row = cradle(c, frame, t, { rest, width, height, scale: this.scale, size });
      const [{ x, y }] = this.row;
      this.striker?.draw(c, { x, y, width: size, height: size, way: [1, 0], sized: false });
    } else if (impactor.kind === 'pulse') {
      if (contact) push(c, rest, middle, thick);
    } else if (impactor.kind === 'rod') this.#rod(c, left, rest, face, middle, thick, contact);
    else if (impactor.kind === 'pendulum') {
      if (contact) this.#touch(c, own, middle, 3 * WIDTH);
    } else {
      const prediction = frame.prediction && rest + frame.prediction.impactor * t * this.scale;
      striker(c, frame, { face: own, middle, size, meet }, prediction);
      if (contact) this.#touch(c, meet ?? own, middle, size);
      const drawn = { x: own - size / 2, y: middle, width: size, height: size };
      this.striker?.draw(c, { ...drawn, way: [1, 0], sized: frame.target.shape !== 'ball' });
      if (this.leads && rods.length === 1 && size > SIGNED) masses(c, [drawn.x, middle], [right, middle + thick / 2]);
    }
    if (t > 0 && rods.length === 1 && rods[0].mirror && !(field instanceof RigidField))
      this.front(c, t, left, right - left, middle - thick / 2, size > thick ? own : -Infinity);
    this.#measure(c, width, height);
  }
  /**
   * The rods, and what is at their far end; returns where the struck face is at rest.
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   * @param {number} left
   * @param {number} right
   * @param {number} middle
   * @param {number} thick
   */
  #chain(c, t, left, right, middle, thick) {
    const { target } = this.frame;
    this.field.profile(t, this.what, this.values);
    this.field.profile(t, 'displacement', this.moved);
    const seam = this.leads && !(this.field instanceof RigidField) ? seamIn(this.frame, right - left) : null;
    this.place = placing([this.field.from, this.field.to], [left, right], seam);
    this.rods(c, middle, thick, this.scale);
    const rest = this.place(0);
    if (seam) {
      specimen(c, seam, this.place, { middle, thick });
      barNames(c, this.frame, this.place, { middle, thick });
    }
    if (target.rotation) axis(c, right, middle, thick);
    else if (target.support === 'fixed') wall(c, right, middle, thick);
    if (target.support === 'anechoic') onward(c, right + this.moved[SLICES - 1] * this.scale, middle, thick);
    if (target.endMass) endMass(c, right + this.moved[SLICES - 1] * this.scale, middle, thick);
    return rest;
  }
  /**
   * A rod that strikes: where it presses, and what can be taken hold of.
   * @param {CanvasRenderingContext2D} c
   * @param {number} left
   * @param {number} rest
   * @param {number} face
   * @param {number} middle
   * @param {number} thick
   * @param {boolean} contact
   */
  #rod(c, left, rest, face, middle, thick, contact) {
    if (contact) this.#touch(c, face, middle, thick + 6);
    const width = rest - left;
    this.striker?.draw(c, { x: left + width / 2, y: middle, width, height: thick, way: [1, 0], sized: false });
  }
  /**
   * A pendulum that strikes, behind what it presses in, and what of it can be taken hold of.
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   * @param {number} rest
   * @param {number} middle
   * @param {number} height
   */
  #pendulum(c, t, rest, middle, height) {
    const { field, frame, scale } = this;
    const own = field.mass(t);
    const shape = shapeOf(frame, field.solution, t, own);
    pendulum(c, frame, shape, { rest, middle, scale, height }, frame.prediction && frame.prediction.impactor * t);
    const drawn = { x: rest + own * scale - WIDTH / 2, y: middle, width: WIDTH, height: 3 * WIDTH };
    this.striker?.draw(c, { ...drawn, way: [1, 0], sized: false });
  }
  /**
   * Where two bodies press on each other.
   * @param {CanvasRenderingContext2D} c
   * @param {number} x
   * @param {number} middle
   * @param {number} size
   */
  #touch(c, x, middle, size) {
    c.fillStyle = COLORS.cursor;
    c.fillRect(x - 1.5, middle - size / 2 - 5, 3, size + 10);
    if (this.pushes && this.drawn.right > 0)
      pushed(c, this.frame, [x, middle], this.time, this.drawn.right - this.drawn.left);
  }
  /** @param {number} t */
  touching(t) {
    const { frame, field } = this;
    return Boolean(frame[field.solution]?.contacts.some(([a, b]) => t >= a && t <= b));
  }
  /**
   * How movement is drawn, beside the bodies where these are to scale, else by a length; and the colours.
   * @param {CanvasRenderingContext2D} c
   * @param {number} width
   * @param {number} height
   */
  #measure(c, width, height) {
    const { factor, frame } = this;
    c.textBaseline = 'alphabetic';
    const [below, above] = frame.rods.length ? scaleBar(c, this, width, height) : [width, width];
    c.fillStyle = c.strokeStyle = COLORS.faint;
    c.font = letters(13);
    c.textAlign = 'left';
    if (factor) {
      const times = factor >= 1 ? grouped(factor) : localised(factor.toPrecision(1));
      const words = text('stage.movement', { times });
      const end = 12 + c.measureText(words).width;
      c.fillText(words, 12, end < below ? height - 1 - 3 * zoom : end < above ? height - 12 - 14 * zoom : 14 * zoom);
    }
    if (frame.rods.length || frame.target.row) return;
    const perMetre = this.scale / (frame.speed * frame.trip);
    const long = roundBelow(90 / perMetre);
    const [times, unit] = scaled(long, 'm');
    const top = factor ? 12 : height - 24; // below, unless the factor is there
    c.lineWidth = 2;
    c.beginPath();
    c.moveTo(12, top);
    c.lineTo(12 + long * perMetre, top);
    c.stroke();
    c.fillText(text('axial.stage.of-movement', { length: `${figures(long * times)} ${unit}` }), 12, top + 14);
  }
  /**
   * Every rod slice by slice, its height by the side of its section.
   * @param {CanvasRenderingContext2D} c
   * @param {number} middle
   * @param {number} thick
   * @param {number} scale
   */
  rods(c, middle, thick, scale) {
    const { field, frame, place } = this;
    const widest = Math.max(...frame.rods.map((rod) => rod.area));
    frame.rods.forEach((rod, number) => {
      const tall = thick * Math.max(Math.sqrt(rod.area / widest), 0.18);
      const top = middle - tall / 2;
      const [first, last] = this.#slices(rod);
      /** @type {[number, number]} */
      const ends = [place(rod.from) + this.moved[first] * scale, place(rod.to) + this.moved[last] * scale];
      const at = (/** @type {number} */ k) =>
        place(field.from + (k / (SLICES - 1)) * this.span) + this.moved[k] * scale;
      const x = (/** @type {number} */ k) => (k <= first ? ends[0] : k >= last ? ends[1] : at(k));
      if (first === last) {
        c.fillStyle = css(this.values[first], this.largest);
        c.fillRect(ends[0], top, ends[1] - ends[0], tall);
      }
      for (let i = first; i < last; i++) {
        c.fillStyle = css(0.5 * (this.values[i] + this.values[i + 1]), this.largest);
        c.fillRect(x(i), top, x(i + 1) - x(i) + 0.7, tall);
      }
      const tense = (/** @type {number} */ k) => isHatched(this.values[first + k], this.largest);
      const one = first === last && tense(0);
      hatch(c, one ? [ends] : stretchesOf(last - first, tense, (k) => x(first + k)), top, tall);
      c.strokeStyle = '#4a5968';
      c.lineWidth = 1.2;
      c.strokeRect(ends[0], top, ends[1] - ends[0], tall);
      c.strokeStyle = 'rgba(28,39,51,.28)'; // rings painted on the rods, evenly spaced before the impact
      c.beginPath();
      for (let k = 1; k < RINGS; k++) {
        const i = Math.round((k * (SLICES - 1)) / (frame.rods.length > 1 ? RINGS : RINGS / 2));
        if (i <= first || i >= last) continue;
        c.moveTo(at(i), top);
        c.lineTo(at(i), top + tall);
      }
      c.stroke();
      if (number && rod.joint === 'bonded') {
        c.fillStyle = '#4a5968';
        c.fillRect(ends[0] - 1, top - 3, 2, tall + 6);
      }
    });
  }
  /**
   * First and last slice of a rod, a hair inside: at a joint that has opened the field jumps.
   * @param {RodRecord} rod
   */
  #slices({ from, to }) {
    const inside = (to - from) * 1e-6;
    const slot = (/** @type {number} */ x) => ((x - this.field.from) / this.span) * (SLICES - 1);
    const first = Math.ceil(slot(from + inside));
    return [first, Math.max(Math.floor(slot(to - inside)), first)];
  }
  /**
   * Where the front that set out at first touch is now, and which way it runs.
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   * @param {number} left
   * @param {number} length
   * @param {number} top
   * @param {number} least  where its name may begin: beside a striker that is higher
   */
  front(c, t, left, length, top, least) {
    const trip = t - Math.floor(t);
    const outward = trip < 0.5;
    const place = outward ? 2 * trip : 2 - 2 * trip;
    const i = Math.round(place * (SLICES - 1));
    const x = left + place * length + this.moved[i] * this.scale;
    const name = text('axial.stage.wave', { rigid: this.frame.rigid });
    runs(c, [x, top - 9], outward ? 1 : -1, name, [least, left + length]);
  }
}
