// The stage of a struck beam: the beam bending, and under it the engineer's diagrams of shear force and moment.
import { cleared, letters, scale as larger } from '../charts/canvas.js';
import { between, roundBelow } from '../charts/scale.js';
import { COLORS, css } from '../charts/styles.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { called } from '../text/words.js';
import { diagrams } from './diagram.js';
import { FIELDS } from './field.js';
import { hasForce } from './rows.js';
import { flown } from './flown.js';
import { legend } from './legend.js';
import { drawSupports } from './supports.js';

/** @import { BendingFrame } from '../messages.js' */
/** @import { Striker } from '../frame/striker.js' */
/** @import { BeamField, Out, What } from './field.js' */

const SMALL = letters(13);
const SAME = 1.001;
const ROOM_OF_COLOURS = 150; // pixels: of their scale and its words
const LINE = 18; // pixels, from one line of words to the next
const LEAST_FOR_DIAGRAMS = [180, 140]; // pixels of height, below which their words would lie on each other; if narrow
const LEADS = { left: 0.3, edge: [48, 30], thick: [0.09, 0.16], striker: [0.24, 84] }; // shares, pixels: if it leads

/** @template {BendingFrame} [Shown=BendingFrame] */
export class BeamStage {
  /** @type {Shown} */ frame;
  /** @type {BeamField} */ field;
  /** @type {What} */ what;
  /** @type {Out} */ values; // of what the colours show, at the instant drawn
  /** @type {Out} */ moved;
  reach = 1; // the largest deflection [m]
  reaching = 'reach'; // name of what can be shared with another picture
  usual = { moment: 1, velocity: 1, shear: 1, deflection: 1 }; // ends of the colours
  factor = 1; // by which movement would be exaggerated if there were room
  scales = { shear: 1, moment: 1 }; // values at the ends of the diagrams
  stressUnit = 1; // MPa in N m
  // places of the picture, in pixels
  width = 0;
  tall = 0;
  narrow = false;
  low = false;
  left = 0;
  long = 0;
  middle = 0;
  scale = 1; // pixels in a metre of deflection
  thick = 0;
  leads = false; // the opening has the page
  taught = false; // a lesson says what there is to be seen: neither diagrams nor the estimate
  drawn = { left: 0, right: 0, rest: 0 }; // its ends, and where it is struck [px]
  hit = { x: 0, y: 0, size: 0, flew: false }; // where the impactor touches; whether it has left the picture
  /** @type {Striker | null} */ striker = null; // by which a hand takes hold

  constructor() {
    this.canvas = make('canvas', { role: 'img', ariaLabel: text('beam.stage.about') });
    this.root = make('section', { className: 'stage beam' }, this.canvas);
  }
  /**
   * @param {Shown} frame
   * @param {BeamField} field
   * @param {What} what
   */
  load(frame, field, what) {
    this.frame = frame;
    this.field = field;
    this.what = what;
    this.reach = this.furthest();
    this.magnify();
    this.usual = { ...field.usual };
    // of both signs alike, so that the zero line stays
    this.scales = { shear: field.usual.shear * 1.25, moment: field.largest.moment * 1.2 };
    this.stressUnit = frame.beam.halfDepth / frame.beam.secondMoment / 1e6;
  }
  /** The largest deflection, and movement of the impactor until it has gone [m]. */
  furthest() {
    const { field, frame } = this;
    const lasting = frame.contacts.at(-1)?.[1] ?? frame.duration;
    let reach = field.largest.deflection;
    for (let k = 0; k < frame.time.length; k++)
      if (frame.time[k] <= lasting || lasting === 0) reach = Math.max(reach, Math.abs(frame.impactorPath[k]));
    return reach;
  }
  /** Movement [m], diagrams and ends of the colours [SI] that fill the picture. */
  ranges() {
    const { reach, reaching, scales, usual } = this;
    return {
      [reaching]: reach,
      ...scales,
      ...Object.fromEntries(Object.entries(usual).map(([key, end]) => [`usual ${key}`, end])),
    };
  }
  /** @param {Record<string, number>} ranges  in place of its own */
  adopt(ranges) {
    this.reach = ranges[this.reaching] ?? this.reach;
    for (const name of /** @type {const} */ (['shear', 'moment']))
      this.scales[name] = ranges[name] ?? this.scales[name];
    for (const name of FIELDS) this.usual[name] = ranges[`usual ${name}`] ?? this.usual[name];
    this.magnify();
  }
  magnify() {
    this.factor = roundBelow((0.13 * this.frame.beam.length) / this.reach);
  }
  /** Whether there are forces within the beam to draw, and room for them. */
  get diagrams() {
    return !this.taught && !this.field.lengthwise && !this.low && !this.leading;
  }
  /** Whether the rows of the opening lie below it. */
  get leading() {
    return this.leads && !this.field.lengthwise && hasForce(this.frame);
  }
  /** Whether they stand beside the picture, not below it. */
  get beside() {
    return false;
  }
  /** @param {number} t */
  draw(t) {
    const { canvas, frame, root } = this;
    if (!frame) return;
    const sheet = cleared(canvas, root);
    if (!sheet) return;
    const { c, width, height } = sheet;
    const narrow = width < 560 * larger;
    this.width = width;
    this.tall = height;
    this.narrow = narrow;
    this.low = height < LEAST_FOR_DIAGRAMS[Number(narrow)];
    const { beside, diagrams: within } = this;
    const [room, down] = this.share(width, height);
    const top = within ? this.above(height) : height;
    this.#places(width, room, top);
    this.scale = Math.min((this.factor * this.long) / frame.beam.length, (0.36 * top) / this.reach);
    this.values = this.field.profile(t, this.what);
    this.moved = this.field.profile(t, 'deflection');
    this.picture(c, t, room, top, height);
    this.words(c);
    if (within) diagrams(c, this, t, beside ? 48 : top, beside ? down - 52 : height - top);
  }
  /**
   * Where the beam lies, and how thick it is.
   * @param {number} width
   * @param {number} room  of its picture
   * @param {number} top  height of that
   */
  #places(width, room, top) {
    const { beside, frame, leading, narrow } = this;
    const { beam } = frame;
    const margin = leading ? LEADS.edge[Number(narrow)] : narrow ? 30 : 64;
    this.left = leading ? LEADS.left * width : beside ? room + margin : margin;
    this.long = width - this.left - (beside ? 20 : margin);
    this.middle = 0.62 * top;
    const [least, most] = leading ? LEADS.thick.map((share) => share * top) : [5, 0.1 * top];
    this.thick = Math.min(Math.max(((2 * beam.halfDepth) / beam.length) * this.long, least), most);
    this.drawn = { left: this.left, right: this.left + this.long, rest: this.struck };
  }
  /**
   * How wide the picture is, and how far down what is drawn beside it goes.
   * @param {number} width
   * @param {number} height
   * @returns {[room: number, down: number]}
   */
  share(width, height) {
    return [width, height];
  }
  /**
   * How high the picture is, of a height that it shares with the diagrams.
   * @param {number} height
   */
  above(height) {
    return 0.56 * height;
  }
  /**
   * What bends, and what strikes it.
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   * @param {number} _width
   * @param {number} _height
   * @param {number} whole  height of the stage
   */
  picture(c, t, _width, _height, whole) {
    this.grid(c, 0, whole);
    this.impactor(c, t);
    this.beam(c);
    this.prediction(c, t);
    this.supports(c);
    this.touch(c, t);
    this.hold(c);
  }
  /** @param {number} j */
  px(j) {
    return this.left + (j / (this.field.places - 1)) * this.long;
  }
  get struck() {
    return this.left + (this.frame.beam.place / this.frame.beam.length) * this.long;
  }
  /** @param {CanvasRenderingContext2D} c */
  line(c) {
    c.beginPath();
    for (let j = 0; j < this.field.places; j++) c.lineTo(this.px(j), this.middle + this.moved[j] * this.scale);
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {number} top
   * @param {number} bottom
   */
  grid(c, top, bottom) {
    // the struck place, through all three pictures
    c.strokeStyle = COLORS.grid;
    c.lineWidth = 1;
    c.setLineDash([3, 4]);
    c.beginPath();
    c.moveTo(this.struck, top + this.middle);
    c.lineTo(this.struck, bottom - 4);
    c.stroke();
    c.setLineDash([]);
  }
  /**
   * The outer fibres in the colours of their stress, which is opposite above and below.
   * @param {CanvasRenderingContext2D} c
   */
  beam(c) {
    const { field, frame, thick, middle, scale, what } = this;
    const half = thick / 2;
    const largest = this.usual[what];
    const last = field.places - 1;
    for (const [above, below, sign] of what === 'moment'
      ? [
          [-half, 0, -1],
          [0, half, 1],
        ]
      : [[-half, half, 1]]) {
      const colours = c.createLinearGradient(this.left, 0, this.left + this.long, 0);
      for (let j = 0; j <= last; j++) colours.addColorStop(j / last, css(sign * this.values[j], largest));
      c.fillStyle = colours;
      c.beginPath();
      for (let j = 0; j <= last; j++) c.lineTo(this.px(j), middle + this.moved[j] * scale + above);
      for (let j = last; j >= 0; j--) c.lineTo(this.px(j), middle + this.moved[j] * scale + below);
      c.fill();
    }
    c.strokeStyle = '#4a5968';
    c.lineWidth = 1.1;
    for (const side of [-half, half]) {
      c.beginPath();
      for (let j = 0; j < field.places; j++) c.lineTo(this.px(j), middle + this.moved[j] * scale + side);
      c.stroke();
    }
    const ends = [0, field.places - 1].map((j) => [this.px(j), middle + this.moved[j] * scale]);
    for (const [x, y] of ends) {
      c.beginPath();
      c.moveTo(x, y - half);
      c.lineTo(x, y + half);
      c.stroke();
    }
    if (frame.beam.endMass) {
      const [x, y] = ends[1];
      const size = Math.min(Math.max(3 * thick, 16), 34);
      c.fillStyle = '#3b4a59';
      c.beginPath();
      c.roundRect(x - size * 0.2, y - size / 2, size, size, 4);
      c.fill();
    }
  }
  /** @param {CanvasRenderingContext2D} c */
  supports(c) {
    const { frame, thick, middle } = this;
    const last = this.field.places - 1;
    drawSupports(c, frame.beam.support, [this.px(0), this.px(last)], middle, thick);
  }
  /**
   * The bending that the same deflection would have at rest, at the height of the quasi-static estimate.
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   */
  prediction(c, t) {
    const { frame } = this;
    const { staticPath, staticShape, staticTime } = frame;
    if (!this.predicts || !staticShape || !staticPath || !staticTime) return;
    const size = between(staticTime, staticPath, t) * this.scale;
    c.strokeStyle = COLORS.prediction;
    c.lineWidth = 1.4;
    c.setLineDash([5, 4]);
    c.beginPath();
    for (let j = 0; j < this.field.places; j++) c.lineTo(this.px(j), this.middle + staticShape[j] * size);
    c.stroke();
    c.setLineDash([]);
  }
  /** Whether the quasi-static estimate is drawn. */
  get predicts() {
    const { staticPath, staticShape } = this.frame;
    return !this.taught && Boolean(staticShape && staticPath);
  }
  get face() {
    return this.middle - this.thick / 2;
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   */
  impactor(c, t) {
    const { frame } = this;
    const { impactor } = frame;
    const x = this.struck;
    const y = this.face + between(frame.time, frame.impactorPath, t) * this.scale;
    const [usual, most] = this.leading ? [LEADS.striker[0] * this.tall, LEADS.striker[1]] : [44, 56];
    const size = Math.min(Math.max(usual * (impactor.mass / frame.beam.mass) ** (1 / 6), 18), most);
    const flew = y < (impactor.kind === 'rod' ? 0.5 : 1) * size;
    this.hit = { x, y, size, flew };
    if (flew) {
      flown(c, impactor.kind, [x, y], this.scale, this.narrow);
      return;
    }
    const fill = c.createLinearGradient(0, y - size, 0, y);
    fill.addColorStop(0, '#5d6c7b');
    fill.addColorStop(1, '#2b3846');
    c.fillStyle = fill;
    c.beginPath();
    if (impactor.kind === 'sphere') c.arc(x, y - size / 2, size / 2, 0, 7);
    else if (impactor.kind === 'rod') c.roundRect(x - size / 5, y - 1.9 * size, 0.4 * size, 1.9 * size, 2);
    else if (impactor.kind === 'beam') {
      c.roundRect(x - size / 2, y - size / 2, size, size / 2, 2);
    } else c.roundRect(x - size / 2, y - size, size, size, 5);
    c.fill();
    if (impactor.kind === 'beam') {
      c.fillStyle = COLORS.faint;
      c.font = SMALL;
      c.textAlign = 'center';
      c.textBaseline = 'bottom';
      c.fillText(text('beam.stage.seen-from-end'), x, y - size / 2 - 3);
    }
  }
  /** @param {CanvasRenderingContext2D} c */
  hold(c) {
    const { x, y, size, flew } = this.hit;
    const sized = !['rod', 'beam'].includes(this.frame.impactor.kind);
    this.striker?.draw(c, flew ? null : { x, y: y - size / 2, width: size, height: size, way: [0, 1], sized });
  }
  /** @param {number} t */
  touching(t) {
    return this.frame.contacts.some(([a, b]) => t >= a && t <= b);
  }
  /**
   * @param {CanvasRenderingContext2D} c
   * @param {number} t
   */
  touch(c, t) {
    if (!this.touching(t)) return;
    const { x, y, size } = this.hit;
    c.fillStyle = COLORS.cursor;
    c.fillRect(x - size / 2 - 5, y - 1.5, size + 10, 3);
  }
  /**
   * @param {CanvasRenderingContext2D} c
   */
  words(c) {
    const { frame, hit, narrow, struck } = this;
    c.fillStyle = COLORS.faint;
    c.font = letters(13);
    c.textBaseline = 'alphabetic';
    c.textAlign = 'left';
    const words = this.scaleWords;
    c.fillText(words, 12, 18);
    const end = 12 + c.measureText(words).width;
    const model = called({ name: 'quasi-static', model: frame.staticModel });
    const dashed = this.predicts && !narrow ? text('beam.stage.dashed', { model }) : '';
    const beside = Math.max(end, 12 + c.measureText(dashed).width);
    const above = struck - hit.size / 2 - beside > ROOM_OF_COLOURS * larger; // else below the scale of colours
    c.fillText(dashed, 12, 18 + (above ? 1 : 3) * LINE * larger);
    if (this.coloured) legend(c, this, above ? beside : end);
  }
  /** Whether anything has the colours of a field. */
  get coloured() {
    return true;
  }
  /** Whether some of it is larger than where the colours end. */
  get beyond() {
    return this.field.largest[this.what] > SAME * this.usual[this.what];
  }
  /** By how much movement is drawn larger. */
  get scaleWords() {
    return text('stage.movement', { times: figures((this.scale * this.frame.beam.length) / this.long, 2) });
  }
  /** Whether it is struck at the right, where the scale of colours would be. */
  get right() {
    const { beam } = this.frame;
    return beam.place > 0.6 * beam.length;
  }
  /**
   * How far down the scale of colours is.
   * @param {number} _x  of its left end
   */
  coloursAt(_x) {
    return 22;
  }
}
