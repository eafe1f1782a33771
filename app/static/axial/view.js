// Everything that is shown of an impact along one axis: stage, views over time, contact law, story.
import { Axis } from '../charts/axis.js';
import { Gauge } from '../charts/gauge.js';
import { between } from '../charts/scale.js';
import { Supports } from '../charts/supports.js';
import { instantIn } from '../compare/beside.js';
import { make, segments } from '../browser/dom.js';
import { timesOf } from '../form/settings.js';
import { Stack } from '../frame/stack.js';
import { TRIPS, times } from '../clock/times.js';
import { family, text } from '../text/catalogue.js';
import { engineering } from '../text/format.js';
import { byOf, called, errorsOf } from '../text/words.js';
import { Displacements, Force, SpaceTime } from './charts.js';
import { cradleRows } from './cradle_rows.js';
import { Cycle } from './cycle.js';
import { drawnBy, drawnFromOther } from './drawn.js';
import { exactFieldOf, fieldOf, otherFieldOf } from './field_of.js';
import { RigidField, unitOf } from './fields.js';
import { Moments } from './moments.js';
import { noteOf, predicts } from './restitution.js';
import { Stage } from './stage.js';
import { Story } from './story.js';
import { filledOf, tracesOf } from './traces.js';
import { barOf, tracksOf } from './tracks.js';
import { wallOf } from './wall.js';

/** @import { Page } from '../page.js' */
/** @import { Source } from '../charts/gauge.js' */
/** @import { Second } from '../compare/beside.js' */
/** @import { AxialFrame } from '../messages.js' */
/** @import { Scene } from '../opening/section.js' */
/** @import { Field, What } from './fields.js' */

/** @type {Record<string, import('../charts/gauge.js').Quantity>} */
const QUANTITIES = {
  stress: { unit: 'Pa', parts: ['stress'], factor: ({ stressUnit }) => stressUnit },
  strain: { unit: 'µm/m', parts: ['stress'], factor: (frame) => (1e6 * frame.speed) / waveSpeeds(frame)[0] },
  waves: { unit: 'Pa', parts: ['right', 'left'], factor: ({ stressUnit }) => stressUnit },
  velocity: { unit: 'm/s', parts: ['velocity'], factor: ({ speed }) => speed, mean: ({ rods }) => rods.length === 1 },
  displacement: { unit: 'm', parts: ['displacement'], factor: ({ speed, trip }) => speed * trip },
};

const FIRST = [0.36, 0.4]; // of T, of it all at most: where it is shown at first, once waves have set out

/**
 * Of each rod [m/s]. A wave of velocity v has the stress of one `stressUnit`, and the strain v / c.
 * @param {AxialFrame} frame
 */
const waveSpeeds = ({ rods, trip }) => rods.map(({ from, to, transit }) => (to - from) / (transit * trip));

/**
 * Whether all rods are of one material: by c and by rho c, which is the impedance over the area.
 * @param {AxialFrame} frame
 */
function alike(frame) {
  const speeds = waveSpeeds(frame);
  const densities = frame.rods.map(({ impedance, area }) => impedance / area);
  return [speeds, densities].every((all) => all.every((value) => Math.abs(value / all[0] - 1) < 1e-6));
}

/** @param {{ name: string }} figures */
const keyOf = ({ name }) => name.replaceAll('-', '_');

export class AxialView {
  /** @type {What} */ what = 'stress'; // that the colours show
  usual = 'stress';
  /** @type {What[]} */ whats = ['stress', 'velocity'];
  after = 2e-4;
  leastRoom = 1e-4;
  /** @type {AxialFrame} */ frame;
  /** @type {Field} */ exactField;
  /** @type {Field | null} */ #otherField = null; // made when it is first asked for

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.axis = new Axis();
    const go = (/** @type {number} */ t) => page.player.seek(t);
    this.stage = new Stage();
    this.spaceTime = new SpaceTime(this.axis, go);
    this.force = new Force(this.axis, go);
    this.displacements = new Displacements(this.axis, go);
    this.moments = new Moments(this.axis, go);
    this.gauge = new Gauge({
      ...{ axis: this.axis, xUnit: TRIPS, quantities: QUANTITIES, names: family('gauge.quantity'), go },
      written: (t) => times.written(t),
      move: (place) => this.gaugeAt(place),
      turned: () => page.history.later(),
    });
    this.supports = new Supports(this.axis, TRIPS, go, wallOf);
    const own = [this.spaceTime, this.force, this.displacements, this.moments];
    this.charts = [...own, ...this.gauge.parts, this.supports];
    this.cycle = new Cycle();
    this.story = new Story(
      (t) => page.player.seek(t + this.after),
      (start, end) => page.zoom(start, end),
    );
    this.axis.watch(() => this.zoomed());
    const names = family('axial.colour');
    this.colours = segments(
      text('stage.colour-shows'),
      this.whats,
      (what) => this.colour(what),
      (what) => names[what],
    );
    this.whole = make('button', { type: 'button', className: 'whole', textContent: text('stage.whole') });
    this.whole.onclick = () => this.page.zoom();
    this.spaceTime.chart.title.after(this.colours.root);
    const [waves, force, moved, moments, stress, along, support] = this.charts.map(({ chart }) => chart);
    const charts = { waves, force, moments, moved, stress, along, support };
    this.stack = new Stack('axial', charts, () => page.redraw(), ['stress', 'along', 'support']);
    this.strip = force; // is seen in the opening where there are no rows
    this.buttons = [this.whole];
    this.story.numbers.prepend(this.cycle.chart.root);
    this.hide(true);
  }
  /** @param {string} what  that the colours are to show */
  colour(what) {
    this.what = /** @type {What} */ (what);
    this.dress();
    this.draw();
    this.page.player.go(this.page.player.t);
    this.page.history.later();
  }
  /** @param {boolean} hidden */
  hide(hidden) {
    for (const part of [this.stage.root, this.stack.root, this.whole]) part.hidden = hidden;
  }
  /** @param {AxialFrame} frame */
  load(frame) {
    this.frame = frame;
    times.load(frame);
    this.exactField = exactFieldOf(frame);
    this.#otherField = null;
    const { until } = timesOf(frame);
    const taught = this.page.opening.teaching.lesson?.until(frame);
    this.axis.open(frame.chosen.scene, this.page.compare.span(frame), taught ?? (until && until / frame.trip));
    this.whole.hidden = !this.axis.zoomed;
    this.spaceTime.chart.root.hidden = !frame.rods.length;
    this.force.chart.root.hidden = frame.exact.sudden && (frame.other?.sudden ?? true); // impulses without duration
    this.force.load(frame);
    this.displacements.load(frame);
    this.moments.load(frame);
    this.#gauge();
    this.stack.lead(frame.chosen.scene, frame.opens.charts);
    this.cycle.load(frame);
    this.dress();
  }
  /** @param {AxialFrame} frame */
  clock(frame) {
    const { chosen, duration, trip } = frame;
    const { time } = timesOf(frame);
    const first = Math.min(FIRST[0], FIRST[1] * duration);
    return { kind: 'axial', scene: chosen.scene, length: duration, unit: trip, trips: true, first, time };
  }
  /** Its histories have become finer. */
  refine() {
    const { frame } = this;
    this.exactField = exactFieldOf(frame);
    this.#otherField = null;
    this.force.load(frame);
    this.displacements.load(frame);
    this.moments.load(frame);
    this.#gauge();
    this.dress();
    this.draw();
    this.show(this.page.player.t);
  }
  // The field that the pictures show.
  get field() {
    return drawnFromOther(this.frame) ? this.otherField : this.exactField;
  }
  get otherField() {
    return (this.#otherField ??= otherFieldOf(this.frame));
  }
  get leading() {
    return this.frame.exactBend ? ['modes', 'speed'] : [];
  }
  /** @param {AxialFrame} frame */
  hangs({ impactor }) {
    return impactor.kind === 'pendulum';
  }
  /**
   * @param {AxialFrame} frame
   * @param {string} [exact]  method that is beside all others
   */
  restitution(frame, exact) {
    return { note: noteOf(frame, exact), predicts: predicts(frame) };
  }
  /** What the opening draws over place and time; nothing of bodies that no wave runs through. */
  get section() {
    if (!this.frame) return null;
    const { field, force, frame, stage, what } = this;
    if (frame.target.row && stage.row.length) return this.#row(cradleRows(frame, stage));
    if (!frame.rods.length) return tracksOf(frame, field, force.chart.own.series);
    const forces = force.chart.own.series.filter(({ style }) => style !== 'raw');
    if (field instanceof RigidField || !forces[0]?.x.length) return null;
    const { largest, place, scale } = stage;
    const at = (/** @type {number} */ share) => place(field.from + share * (field.to - field.from));
    const drawn = { ...stage.drawn, at };
    const first = frame.rods[0].from === 0;
    const strikes = first && frame.impactor.kind !== 'pulse';
    const title = text('opening.rows', { what: frame.rods.length > 1 ? 'rods' : 'rod' });
    const about =
      frame.rods.length === 1 && frame.rods[0].mirror && !times.bare
        ? text('opening.trip', { trip: engineering(frame.trip, 's') })
        : '';
    const clock = times.shown;
    return {
      about,
      by: drawnBy(frame),
      clock,
      contacts: frame.exact.contacts,
      drawn,
      duration: frame.duration,
      ends: first ? field : null,
      field,
      forces,
      held: frame.target.held && frame.target.support !== 'anechoic',
      largest,
      prediction: frame.prediction?.impactor ?? null,
      scale,
      seam: filledOf(frame, field, stage, this.axis.view),
      strikes,
      title,
      traces: tracesOf(frame, field, stage, this.axis.view),
      tracks: barOf(frame, field.solution),
      what,
    };
  }
  /**
   * What it draws of a row of balls.
   * @param {ReturnType<typeof cradleRows>} rows
   * @returns {Scene}
   */
  #row(rows) {
    const { force, frame } = this;
    const { contacts } = frame.exact;
    return {
      ...rows,
      ...{ about: text('opening.pressed'), title: text('opening.rows', { what: 'row' }), what: 'push', scale: 0 },
      by: byOf(called(frame.exact), errorsOf(frame.exact)),
      clock: times.shown,
      contacts,
      duration: frame.duration,
      ends: null,
      forces: force.chart.own.series,
      strikes: false,
    };
  }
  // Colours of stage and x-t diagram.
  dress() {
    const { field, frame, what } = this;
    const largest = this.page.compare.dress(what, this.exactField.largest(what), unitOf(frame, what));
    if (frame.rods.length) this.spaceTime.load(frame, field, what, largest);
    this.stage.load(frame, field, what, largest);
    this.page.compare.share(this.stage);
    this.colours.show(what);
  }
  draw() {
    for (const part of [...this.charts, this.cycle]) if (!part.chart.root.hidden) part.draw();
    this.#mark();
  }
  /** The x-t diagram says where the gauge is while that is seen. */
  #mark() {
    if (this.frame?.rods.length) this.spaceTime.mark(this.gauge.seen ? this.gauge.place : null);
  }
  #gauge() {
    const { chosen, exact, opens, rods } = this.frame;
    const reach = /** @type {[number, number]} */ (rods.length ? [rods[0].from, rods[rods.length - 1].to] : [0, 0]);
    const body = {
      scene: chosen.scene,
      frame: this.frame,
      contacts: exact.contacts,
      usual: opens.place,
      read: opens.read,
      reach,
    };
    this.gauge.load(
      body,
      () => this.read(this.frame),
      (what) => what !== 'strain' || alike(this.frame),
    );
    this.supports.load(this.frame, exact.contacts, () => this.read(this.frame));
  }
  /**
   * Its solutions as a gauge reads them, the exact one first.
   * @param {AxialFrame} frame
   * @returns {Source[]}
   */
  read(frame) {
    const own = frame === this.frame;
    const { exact, other } = frame;
    /** @type {Source[]} */
    const found = [
      {
        ...{ frame, name: called(exact), key: keyOf(exact), style: 'exact', second: 'struck' },
        field: own ? this.exactField : exactFieldOf(frame),
      },
    ];
    if (other)
      found.push({
        ...{ frame, name: called(other), key: keyOf(other), style: 'other', second: 'dashedOther' },
        field: own ? this.otherField : otherFieldOf(frame),
      });
    return found;
  }
  /** @param {number} place  of the gauge [m] */
  gaugeAt(place) {
    this.gauge.asked = place;
    this.draw();
    this.show(this.page.player.t);
    this.page.history.later();
  }
  /**
   * @param {AxialFrame} frame
   * @returns {Second}
   */
  beside(frame) {
    const [stage, field] = [new Stage(), fieldOf(frame)];
    const shownOf = (/** @type {string} */ what) => this.whats.find((name) => name === what);
    const endOf = (/** @type {What} */ what) => field.largest(what) * unitOf(frame, what);
    return {
      stage,
      end: (what) => (shownOf(what) ? endOf(/** @type {What} */ (what)) : 0),
      load: (what, end) => {
        const shown = shownOf(what) ?? 'stress';
        stage.load(frame, field, shown, (end || endOf(shown)) / unitOf(frame, shown));
      },
      draw: (now, t) => stage.draw(instantIn(frame, now, t)),
    };
  }
  /**
   * A measured force has come, or gone.
   * @param {AxialFrame} frame
   * @param {import('../frame/view.js').Measured | null} record
   */
  overlay(frame, record) {
    const { forceUnit, trip } = frame;
    delete frame.record;
    if (record)
      frame.record = { time: record.time.map((t) => t / trip), force: record.force.map((f) => f / forceUnit) };
    if (frame === this.frame) this.force.load(frame);
  }
  /** @param {number} t */
  show(t) {
    const { frame } = this;
    this.stage.draw(t);
    for (const part of this.charts) if (!part.chart.root.hidden) part.cursor(t);
    if (!frame.cycleDepth) return;
    const moved = between(frame.motionTime, frame.exactMass, t) - between(frame.motionTime, frame.exactEnd, t);
    this.cycle.mark(moved * frame.speed * frame.trip, this.force.at(t) * frame.forceUnit, t * frame.trip);
  }
  // Another stretch of time fills the views.
  zoomed() {
    this.whole.hidden = !this.axis.zoomed;
    if (!this.frame) return;
    if (this.frame.rods.length) this.spaceTime.look();
    for (const part of this.charts) {
      if (part.chart.root.hidden) continue;
      part.draw();
      part.cursor(this.page.player.t);
    }
  }
  /** Histories as a table to save. */
  rows(points = 2000) {
    const { frame } = this;
    const length = frame.speed * frame.trip;
    const fields = frame.other ? [this.exactField, this.otherField] : [this.exactField];
    const forces = frame.other ? [this.force.exact, this.force.other] : [this.force.exact];
    const own = this.read(frame).map(({ key }) => key);
    const places = own.flatMap((name) => [`impactor_${name}_m`, `struck_face_${name}_m`]);
    const { columns } = this.gauge;
    const names = ['time_s', ...own.map((name) => `force_${name}_N`), ...places, ...columns.map(({ name }) => name)];
    const values = Array.from({ length: points + 1 }, (_, k) => {
      const t = (k / points) * frame.duration;
      const force = forces.map((each) => (each ? between(each.x, each.y, t) : NaN) * frame.forceUnit);
      const moved = fields.flatMap((field) => [field.mass(t) * length, field.end(t) * length]);
      const gauge = columns.map(({ at }) => at(t));
      return [t * frame.trip, ...force, ...moved, ...gauge];
    });
    return { names, values };
  }
}
