// The views of an impact along one axis: x-t diagram, contact force and displacements over time.
import { Chart } from '../charts/chart.js';
import { Peak, timesOf, whenLargest } from '../charts/peak.js';
import { paint, reader } from '../charts/picture.js';
import { averaged, between, pair, stairs } from '../charts/scale.js';
import { make, write } from '../browser/dom.js';
import { given } from '../wire/message.js';
import { TRIPS, times } from '../clock/times.js';
import { text } from '../text/catalogue.js';
import { figures, signed } from '../text/format.js';
import { called } from '../text/words.js';
import { betweenOf, forcesOf, movementsOf } from './cradle.js';
import { drawnFromOther } from './drawn.js';
import { RigidField } from './fields.js';
import { forceOf } from './force.js';

/** @import { Axis } from '../charts/axis.js' */
/** @import { Picture, Series } from '../charts/chart.js' */
/** @import { Range, Samples } from '../charts/scale.js' */
/** @import { AxialFrame } from '../messages.js' */
/** @import { Field, What } from './fields.js' */

const COLUMNS = 480;
const ROWS = 121;
const MODAL_COLUMNS = 200; // fewer for modes, which cost a sum each
const MODAL_ROWS = 61;
const REST = 150; // ms without a zoom, after which the picture is computed for what is in view
const TRAINS = 2.5; // heights of the exact force that another may take: trains of impulses have no height

/**
 * A tick beside one rod.
 * @param {number} share  of its length
 */
const placeOnRod = (share) =>
  share === 0 ? text('axial.chart.struck') : share === 1 ? text('axial.chart.far-end') : signed(share, 1);

/** @param {number} stress  [Pa] */
const pressed = (stress) => text('axial.chart.stress', { tension: stress < 0, value: figures(Math.abs(stress) / 1e6) });
/** @param {number} velocity  [m/s] */
const moving = (velocity) => text('axial.chart.velocity', { value: figures(velocity) });

export class SpaceTime {
  several = false; // rods
  reach = 1; // metres in a unit of places
  /** @type {number[]} */ joints = []; // of rods
  /** @type {number | null} */ marked = null; // a place [m] that another chart is of
  images = [make('canvas'), make('canvas')]; // of all of the impact, and of what is in view
  /** @type {Picture | null} */ whole = null;
  /** @type {((image: HTMLCanvasElement, stretch: Range) => Picture) | null} */ paint = null;
  /** @type {(() => void) | null} */ due = null; // makes the picture, once it is seen
  /** @type {number | undefined} */ resting;

  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    this.chart = new Chart({
      title: text('axial.chart.waves'),
      about: text('axial.chart.waves-about'),
      axis,
      xUnit: TRIPS,
      y: [1, 0], // the struck end on top
      caption: () => text('axial.chart.waves-axes', { several: this.several, unit: times.shown[1] }),
      go,
    });
  }
  /**
   * Rebuild the picture; `largest` is the end of the colour scale.
   * @param {AxialFrame} frame
   * @param {Field} field
   * @param {What} what
   * @param {number} largest
   */
  load(frame, field, what, largest) {
    const { duration, rods } = frame;
    // places as shares of one rod, or in metres where there are several, of which those that strike lie above zero
    this.several = rods.length > 1;
    const reach = this.several ? 1 : field.to || 1;
    this.reach = reach;
    this.joints = rods.slice(1).map((rod) => rod.from / reach);
    const [from, to] = [field.from / reach, field.to / reach];
    this.chart.options.y = [to, from];
    this.chart.label = this.several ? (v, digits) => signed(v, Math.max(digits, 1)) : placeOnRod;
    const { contacts } = (drawnFromOther(frame) && frame.other) || frame.exact;
    const about = {
      series: [],
      rules: this.#rules(),
      bars: { name: text('axial.chart.in-contact'), spans: contacts, at: 0, least: 2 },
    };
    this.whole = this.due = null;
    if (field instanceof RigidField) {
      const method = frame.other ? called(frame.other) : '';
      this.chart.show({ ...about, blank: text('axial.chart.no-waves', { method }) });
      return;
    }
    const made = (/** @type {HTMLCanvasElement} */ canvas, /** @type {Range} */ stretch) =>
      this.#picture(frame, field, what, largest, canvas, stretch);
    this.paint = made;
    this.due = () => {
      this.due = null;
      this.whole = made(this.images[0], [0, duration]);
      this.chart.show({ ...about, picture: this.whole });
      this.look();
    };
  }
  /** After another stretch has come into view: the picture is computed for it, once it rests. */
  look() {
    const { axis } = this.chart;
    clearTimeout(this.resting);
    if (!this.whole) return;
    this.chart.show({ ...this.chart.own, picture: this.whole });
    if (!axis.zoomed) return;
    this.resting = window.setTimeout(() => {
      const [start, end] = axis.view;
      const last = Math.min(end, this.whole?.x[1] ?? 0); // a solution that is kept may last longer
      if (last <= start || !this.paint) return;
      this.chart.show({ ...this.chart.own, picture: this.paint(this.images[1], [start, last]) });
      this.chart.redraw();
    }, REST);
  }
  /**
   * @param {AxialFrame} frame
   * @param {Field} field
   * @param {What} what
   * @param {number} largest
   * @param {HTMLCanvasElement} image
   * @param {Range} stretch
   * @returns {Picture}
   */
  #picture(frame, field, what, largest, image, stretch) {
    const [to, from] = /** @type {Range} */ (this.chart.options.y);
    const [columns, rows] = field.coarse ? [MODAL_COLUMNS, MODAL_ROWS] : [COLUMNS, ROWS];
    const values = new Float32Array(columns * rows);
    field.image(stretch, what, columns, rows, (column, profile) => values.set(profile, column * rows));
    paint(image, values, rows, largest);
    const read = reader(values, rows, stretch, [from, to]);
    const probe = (/** @type {number} */ t, /** @type {number} */ place) => {
      const value = read(t, place);
      if (Number.isNaN(value)) return '';
      const found = what === 'stress' ? pressed(value * frame.stressUnit) : moving(value * frame.speed);
      return text('axial.chart.probe', { value: found, place: figures(place, 2), several: this.several });
    };
    return { image, x: stretch, probe };
  }
  #rules() {
    return this.marked === null ? this.joints : [...this.joints, this.marked / this.reach];
  }
  /**
   * A dashed line at a place, or no more.
   * @param {number | null} place  [m]
   */
  mark(place) {
    if (place === this.marked) return;
    this.marked = place;
    this.chart.show({ ...this.chart.own, rules: this.#rules() });
  }
  draw() {
    if (this.chart.area.offsetParent) this.due?.(); // takes as long as all else
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}

export class Force {
  /** @type {Samples} */ exact;
  /** @type {Samples | null} */ other = null;
  /** @type {Samples | null} */ raw = null; // of modes, before it is averaged

  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    this.chart = new Chart({
      title: text('axial.chart.force'),
      about: text('axial.chart.force-about'),
      axis,
      xUnit: TRIPS,
      unit: 'N',
      zero: true,
      pad: [0.04, 0.25],
      go,
    });
    this.peak = new Peak(this.chart.head, (t) => times.written(t));
  }
  /** @param {AxialFrame} frame */
  load(frame) {
    const { modalForce, other } = frame;
    this.exact = forceOf(frame);
    const impulse = other?.sudden; // without a height
    this.other = impulse ? null : pair(frame.otherTime, frame.otherForce);
    this.raw = null;
    if (modalForce && other) {
      const step = given(frame.step, 'step');
      const window = given(other.diagnostics.resolved_time, 'resolved_time') / frame.trip;
      this.raw = stairs(modalForce, step);
      this.other = averaged(modalForce, step, window);
    }
    this.#tell(frame);
    this.chart.show({ series: this.#series(frame), shades: frame.exact.contacts });
  }
  /** @param {AxialFrame} frame */
  #tell({ exact: { contacts, peakForce: force, stillTouching: open }, duration, trip }) {
    times.load({ duration, trip });
    const [span, touching] = timesOf(contacts);
    this.peak.load(force && this.exact.x.length ? { force, at: whenLargest(this.exact), span, touching, open } : null);
  }
  /**
   * @param {AxialFrame} frame
   * @returns {Series[]}
   */
  #series(frame) {
    const { balanceForce, balanceTime, exact, forceUnit: factor, other, record, target } = frame;
    const first = called(exact);
    const about = target.row ? betweenOf({ first: 1, second: 2 }) : { name: first, cursor: first };
    /** @type {Series[]} */
    const found = [{ ...this.exact, factor, ...about, style: 'exact' }];
    if (target.row) found.push(...forcesOf(frame));
    if (this.other && other) {
      const name = called(other);
      const reach = this.raw ? Infinity : TRAINS;
      found.push({ ...this.other, factor, reach, name, cursor: name, style: 'other' });
    }
    const impulses = pair(balanceTime, balanceForce);
    if (impulses) found.push({ ...impulses, factor, name: text('axial.chart.impulse-over-step'), style: 'impulses' });
    if (this.raw && other) {
      const touches = other.diagnostics.raw_contacts ?? 0;
      const name = text('axial.chart.raw', { touches, more: touches > other.contacts.length });
      found.push({ ...this.raw, factor, reach: 0, name, style: 'raw' });
    }
    const measured = text('axial.chart.measured');
    if (record) found.push({ x: record.time, y: record.force, factor, reach: 0, name: measured, style: 'record' });
    return found;
  }
  draw() {
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
  /**
   * Force at t, in units of the message.
   * @param {number} t
   */
  at(t) {
    return between(this.exact.x, this.exact.y, t);
  }
}

// what curves are called in the legend, and at the cursor
const MASS = { name: text('axial.chart.impactor'), cursor: text('axial.chart.mass') };
const FACE = { name: text('axial.chart.face'), cursor: text('axial.chart.end') };
const WHOLE = { name: text('axial.chart.whole'), cursor: text('axial.chart.whole') };
// Where the struck end is what the rod is described by, a mass that flies off takes no more room than this
const ASIDE = /** @type {const} */ ({ reach: 1, below: 0.5 });

export class Displacements {
  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    this.chart = new Chart({
      title: text('axial.chart.motion'),
      about: text('axial.chart.motion-about'),
      axis,
      xUnit: TRIPS,
      unit: 'm',
      zero: 'whole',
      caption: (unit) => text('axial.chart.motion-axes', { unit }),
      go,
    });
  }
  /** @param {AxialFrame} frame */
  load(frame) {
    const { attached, duration, prediction, other, target } = frame;
    const factor = frame.speed * frame.trip;
    const { motionTime: x } = frame;
    /** @type {Series[]} */
    const series = [
      { x, y: frame.exactMass, factor, ...MASS, ...(attached ? ASIDE : {}), style: 'exact' },
      { x, y: frame.exactEnd, factor, ...FACE, style: 'struck' },
    ];
    write(this.chart.title, text(target.row ? 'axial.cradle.motion' : 'axial.chart.motion'));
    if (target.row) series.splice(0, 2, ...movementsOf(frame));
    if (frame.exactWhole) series.push({ x, y: frame.exactWhole, factor, ...WHOLE, reach: 0, style: 'whole' });
    if (other) {
      const name = called(other);
      series.push({ x, y: given(frame.otherMass, 'otherMass'), factor, reach: 0, name, style: 'thinOther' });
      const end = attached ? text('axial.chart.reference', { name }) : name;
      series.push({ x, y: given(frame.otherEnd, 'otherEnd'), factor, reach: 0, name: end, style: 'dashedOther' });
    }
    if (prediction && !attached) {
      const straight = (/** @type {number} */ rate) => ({ x: [0, duration], y: [0, rate * duration], factor });
      series.push({
        ...straight(prediction.impactor),
        reach: 'whole',
        name: text('axial.prediction'),
        style: 'prediction',
      });
      if (!target.held)
        series.push({
          ...straight(prediction.target),
          reach: 0,
          name: text('axial.chart.prediction-of-target'),
          style: 'dots',
        });
    }
    this.chart.show({ series, shades: frame.exact.contacts });
  }
  draw() {
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}
