// The views of a struck beam that share the axis of time: x-t diagram, contact force, motions; and the dispersion of
// its waves.
import { Chart } from '../charts/chart.js';
import { paint, reader } from '../charts/picture.js';
import { Peak, whenLargest } from '../charts/peak.js';
import { averaged, between, pair, stairs, withFiner } from '../charts/scale.js';
import { make, segments } from '../browser/dom.js';
import { given } from '../wire/message.js';
import { SECONDS } from '../clock/times.js';
import { family, named, text } from '../text/catalogue.js';
import { duration, engineering, figures, prefixed, signed } from '../text/format.js';
import { called } from '../text/words.js';

const END = family('beam.end');
const ENDS = {
  joined: [END.first, END.second],
  cantilever: [END.clamp, END.tip],
  'pinned-pinned': [END.pin, END.roller],
  'clamped-clamped': [END.clamp, END.clamp],
  'free-free': [END.free, END.free],
  'pinned-free': [END.pin, END.free],
};
/** @import { Axis } from '../charts/axis.js' */
/** @import { Content, Picture, Series } from '../charts/chart.js' */
/** @import { Range, Samples } from '../charts/scale.js' */
/** @import { BeamFigures, BendingFrame } from '../messages.js' */
/** @import { BeamField, What } from './field.js' */

/**
 * What an ensemble of impacts reached at each instant [s].
 * @typedef {{ lowest: number[], low: number[], high: number[], highest: number[] }} Spread
 * @typedef {{ time: number[], force: Spread, displacement: Spread }} Band
 */

export const UNITS = { moment: 'N m', velocity: 'm/s', shear: 'N', deflection: 'm' };
const BAND = 'rgba(122,94,168,.14)';
const WIDE = 'rgba(122,94,168,.09)';
const SPREAD = 'rgba(122,94,168,.3)';
const REST = 150; // ms without a zoom, after which the picture is computed for what is in view
const OVER = 2; // times the height of the curve that matters, which others may take

const QUANTITIES = family('beam.colour');
const XT = {
  title: text('beam.chart.waves'),
  about: text('beam.chart.waves-about'),
  caption: (/** @type {string} */ _, /** @type {string} */ unit) => text('beam.chart.waves-axes', { unit }),
};

export class BeamSpaceTime {
  /** @type {BendingFrame} */ frame;
  /** @type {BeamField} */ field;
  /** @type {What} */ what;
  /** @type {Content} */ content = { series: [] };
  /** @type {Picture | null} */ whole = null; // of all of the impact, and of what is in view
  /** @type {Picture | null} */ fine = null;
  images = [make('canvas'), make('canvas')];
  /** @type {number | undefined} */ resting;

  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   * @param {(what: What, end: number) => number} end  of the colours, which may be locked
   */
  constructor(axis, go, end) {
    this.end = end;
    this.chart = new Chart({ ...XT, axis, xUnit: SECONDS, y: [1, 0], go });
  }
  /**
   * @param {BendingFrame} frame
   * @param {BeamField} field
   * @param {What} what
   */
  load(frame, field, what) {
    this.frame = frame;
    this.field = field;
    this.what = what;
    const [first, last] = ENDS[frame.beam.support];
    this.chart.label = (v) => (v === 0 ? first : v === 1 ? last : signed(v, 1));
    this.whole = this.fine = null;
    const place = frame.beam.place / frame.beam.length;
    const arrival = frame.beam.length / frame.beam.speedLimit; // nothing in the material runs faster
    const wedge = { x: [arrival, 0, arrival], y: [place - 1, place, place + 1], path: true };
    const way = what === 'moment' || what === 'shear' ? 'positive' : 'forward';
    const red = text('beam.chart.red', { what: QUANTITIES[what], way });
    this.content = {
      series: [{ ...wedge, name: text('beam.chart.fastest'), style: 'limit' }],
      bars: { name: text('beam.chart.contact'), spans: frame.contacts, at: place, least: 1 },
      keys: [{ text: red, color: '#de693e', mark: 'chip' }],
    };
  }
  draw() {
    const { axis } = this.chart;
    clearTimeout(this.resting);
    if (!this.field.has(this.what)) {
      this.chart.show({ ...this.content, blank: text('beam.chart.nothing', { what: QUANTITIES[this.what] }) });
      this.chart.draw();
      return;
    }
    this.whole ??= this.#picture(this.images[0], [0, this.frame.duration]);
    const [start, end] = this.#stretch;
    const fine = this.fine?.x[0] === start && this.fine.x[1] === end ? this.fine : null;
    if (axis.zoomed && !fine) this.resting = window.setTimeout(() => this.#refine(), REST);
    this.#show((axis.zoomed && fine) || this.whole);
  }
  /** @returns {Range} what is in view of the impact; a solution that is kept may last longer */
  get #stretch() {
    const [start, end] = this.chart.axis.view;
    return [start, Math.max(Math.min(end, this.frame.duration), start + 1e-12)];
  }
  #refine() {
    this.fine = this.#picture(this.images[1], this.#stretch);
    this.#show(this.fine);
  }
  /** @param {Picture} picture */
  #show(picture) {
    this.chart.show({ ...this.content, picture });
    this.chart.draw();
  }
  /**
   * The picture of a stretch of time, on a canvas.
   * @param {HTMLCanvasElement} image
   * @param {Range} x
   * @returns {Picture}
   */
  #picture(image, x) {
    const { field, what } = this;
    const values = field.picture(x, what);
    paint(image, values, field.places, this.end(what, field.usualOf(values, 0)));
    const read = reader(values, field.places, x, [0, 1]);
    const probe = (/** @type {number} */ t, /** @type {number} */ place) => {
      const value = read(t, place);
      if (Number.isNaN(value)) return '';
      const at = { what: QUANTITIES[what], value: written(value, what), place: figures(place, 2) };
      return text('beam.chart.probe', at);
    };
    return { image, x: [...x], probe };
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}

/**
 * A value of a field with its unit.
 * @param {number} value
 * @param {What} what
 */
function written(value, what) {
  if (what === 'deflection') return `${figures(1e6 * value)} µm`;
  const [factor, prefix] = what === 'velocity' ? [1, ''] : prefixed(Math.abs(value));
  return `${figures(value * factor)} ${prefix}${UNITS[what]}`;
}

/**
 * 5 to 95 % of an ensemble over the range of all of it.
 * @param {number[]} time
 * @param {Spread} spread
 */
const bandOf = (time, { low, high, lowest, highest }) => ({
  name: text('beam.chart.spread'),
  color: SPREAD,
  x: time,
  areas: [
    { low: lowest, high: highest, color: WIDE },
    { low, high, color: BAND },
  ],
});

export class BeamForce {
  /** @type {BendingFrame} */ frame;
  /** @type {Samples} */ main;
  /** @type {Samples | null} */ raw = null; // of modes, where the force is averaged
  /** @type {Band | null} */ band = null;
  shown = true; // the half-space

  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    this.chart = new Chart({
      title: text('beam.chart.force'),
      about: text('beam.chart.force-about'),
      axis,
      xUnit: SECONDS,
      unit: 'N',
      zero: true,
      pad: [0.04, 0.12],
      go,
    });
    this.half = make('button', {
      type: 'button',
      className: 'whole small',
      textContent: text('beam.chart.half-space'),
    });
    this.half.title = text('beam.chart.half-space-about');
    this.half.onclick = () => {
      this.shown = !this.shown;
      this.#show();
      this.chart.redraw();
    };
    this.chart.value.before(this.half);
    this.peak = new Peak(this.chart.head, duration);
  }
  /** @param {BendingFrame} frame */
  load(frame) {
    this.frame = frame;
    const { law, mainForce, mainTime, modalForce, step } = frame;
    this.raw = null;
    if (modalForce) {
      // what modes say is one force for each step; chatter at the shortest kept period says nothing
      const h = given(step, 'step');
      const window = law.rigid ? frame.main.diagnostics.resolved_time : 0;
      this.raw = window ? stairs(modalForce, h) : null;
      this.main = window ? averaged(modalForce, h, window) : stairs(modalForce, h);
      const fine = pair(mainTime, mainForce); // of a stretch, where steps come in groups
      if (fine && !window) this.main = withFiner(this.main, fine);
    } else this.main = given(pair(mainTime, mainForce), 'mainForce');
    this.half.hidden = !frame.halfForce;
    const { apparent: span, real: touching } = frame.span;
    const { peakForce: force, stillTouching: open } = frame.main;
    const at = whenLargest(this.main);
    this.peak.load(force && span && touching ? { force, at, span, touching, open } : null);
    this.#show();
  }
  #show() {
    const { frame, band } = this;
    this.half.ariaPressed = String(this.shown);
    /** @type {Series[]} */
    const series = [{ ...this.main, name: called(frame.main), cursor: '', style: 'exact' }];
    const reference = pair(frame.referenceTime, frame.referenceForce);
    if (reference && frame.reference) {
      const far = (frame.reference.peakForce ?? 0) > OVER * (frame.main.peakForce ?? Infinity);
      series.push({ ...reference, reach: OVER, name: toCompare(frame.reference, far), style: 'other' });
    }
    const half = this.shown && pair(frame.halfTime, frame.halfForce);
    if (half) {
      const most = Math.max(...Array.from(half.y));
      const [factor, prefix] = prefixed(most);
      const name = text('beam.chart.half-space-curve', { force: `${figures(most * factor, 2)} ${prefix}N` });
      series.push({ ...half, reach: OVER, name, style: 'halfSpace' });
    }
    if (this.raw) series.push({ ...this.raw, reach: OVER, name: text('beam.chart.raw'), style: 'rawExact' });
    this.chart.show({ series, shades: frame.contacts, band: band && bandOf(band.time, band.force) });
  }
  /** @param {Band | null} band */
  draw(band) {
    if (band !== this.band) {
      this.band = band;
      this.#show();
    }
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
  /** @param {number} t */
  at(t) {
    return between(this.main.x, this.main.y, t);
  }
}

/** @typedef {'displacement' | 'velocity'} Kind */

/**
 * @param {BeamFigures} reference
 * @param {boolean} far  whether its force leaves the chart
 */
const toCompare = (reference, far = false) =>
  text('beam.chart.to-compare', { method: called(reference), far, force: engineering(reference.peakForce ?? 0, 'N') });

// Impactor and struck place: where they are, or how fast they go.
export class BeamMotion {
  /** @type {BendingFrame} */ frame;
  /** @type {Band | null} */ band = null;
  /** @type {Kind} */ kind = 'displacement';

  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    const [title, about] = ['motion', 'motion-about'].map((each) => text(`beam.chart.${each}`));
    const caption = (/** @type {string} */ unit) => text('beam.chart.motion-axes', { unit });
    this.chart = new Chart({ title, about, axis, xUnit: SECONDS, unit: 'm', caption, go });
    const press = (/** @type {string} */ kind) => {
      this.kind = /** @type {Kind} */ (kind);
      this.#show();
      this.chart.redraw();
    };
    const kinds = family('beam.kind');
    this.switch = segments(text('beam.chart.shown'), ['displacement', 'velocity'], press, (kind) => kinds[kind]);
    this.switch.root.classList.add('small');
    this.chart.value.before(this.switch.root);
  }
  /** @param {BendingFrame} frame */
  load(frame) {
    this.frame = frame;
    this.#show();
  }
  #show() {
    const { frame, kind, band } = this;
    const { time: x, reference } = frame;
    this.switch.show(kind);
    const places = kind === 'displacement';
    const [impactor, struck] = places ? [frame.impactorPath, frame.struckPath] : [frame.impactorRate, frame.struckRate];
    /** @type {Series[]} */
    const series = [
      { x, y: impactor, name: text('beam.chart.impactor'), cursor: text('beam.chart.impactor'), style: 'exact' },
      { x, y: struck, name: text('beam.chart.struck-place'), cursor: text('beam.chart.struck'), style: 'struck' },
    ];
    if (places && reference) {
      const beside = { x, reach: 0, name: toCompare(reference) };
      series.push({ ...beside, y: given(frame.referenceImpactorPath, 'referenceImpactorPath'), style: 'thinOther' });
      series.push({ ...beside, y: given(frame.referenceStruckPath, 'referenceStruckPath'), style: 'dashedOther' });
    }
    const still = places && pair(frame.staticTime, frame.staticPath);
    const name = called({ name: 'quasi-static', model: frame.staticModel });
    if (still) series.push({ ...still, reach: 0, name, style: 'prediction' });
    const spread = places && band ? bandOf(band.time, band.displacement) : null;
    this.chart.show({ series, unit: places ? 'm' : 'm/s', shades: frame.contacts, band: spread });
  }
  /** @param {Band | null} band */
  draw(band) {
    if (band !== this.band) {
      this.band = band;
      this.#show();
    }
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}

// Frequency over wavenumber by the theory in use, the kept modes on it, and the fastest wave of the material.
export class Dispersion {
  constructor() {
    this.chart = new Chart({
      title: text('beam.chart.dispersion'),
      about: text('beam.chart.dispersion-about'),
      xName: text('beam.chart.wavenumber'),
      xUnit: '1/m',
      unit: 'Hz',
      zero: true,
      pad: [0, 0],
      caption: (unit, xUnit) => text('beam.chart.dispersion-axes', { unit, xUnit }),
      points: true,
    });
    this.chart.root.classList.add('square');
  }
  /** @param {BendingFrame} frame */
  load(frame) {
    const { wavenumbers: x, lower, upper, beam, modeFrequencies, modeWavenumbers } = frame;
    this.chart.root.hidden = !x; // else there is no one curve
    if (!x || !lower || !modeFrequencies || !modeWavenumbers) return;
    const [factor, far] = [0.5 / Math.PI, x[x.length - 1]];
    const { lone } = this.chart;
    const [slow, fast] = modesOf(modeWavenumbers, modeFrequencies, beam.speedLimit);
    const limit = { x: [0, far], y: [0, beam.speedLimit * far] };
    /** @type {Series[]} */
    const series = [
      { ...slow, factor, reach: 0, style: 'mode' },
      { ...fast, factor, reach: 0, style: 'fastMode' },
      { x, y: lower, factor, name: named('theory', beam.theory), style: 'exact' },
    ];
    if (upper && !lone)
      series.push({ x, y: upper, factor, reach: 0, name: text('beam.chart.shear-branch'), style: 'struck' });
    series.push({ ...limit, factor, reach: 0, name: '√(E/ρ)', style: 'limit' });
    const readout = lone ? '' : text('beam.chart.too-fast', { fast: fast.x.length, all: modeWavenumbers.length });
    this.chart.axis.load(0, far);
    this.chart.show({ series, readout });
  }
  draw() {
    this.chart.draw();
  }
}

/**
 * Kept modes that the material can carry, and those that would outrun its fastest wave.
 * @param {ArrayLike<number>} wavenumbers
 * @param {ArrayLike<number>} frequencies
 * @param {number} limit  speed of the fastest wave
 */
function modesOf(wavenumbers, frequencies, limit) {
  /** @type {{ x: number[], y: number[] }[]} */
  const found = [
    { x: [], y: [] },
    { x: [], y: [] },
  ];
  Array.from(wavenumbers).forEach((x, i) => {
    const kind = found[Number(frequencies[i] > limit * x)];
    kind.x.push(x);
    kind.y.push(frequencies[i]);
  });
  return found;
}
