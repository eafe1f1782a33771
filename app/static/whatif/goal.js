// A value that is wanted, and the choice that gives way to it: all its values that deliver it, as buttons and as dots
// on the curve of the result. It can be held while others move.
import { cleared } from '../charts/canvas.js';
import { NumberField } from '../form/number_field.js';
import { pretty } from '../text/format.js';
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { ForcePull } from './force_pull.js';
import { COLOR, disc, mark } from './ink.js';
import { placeOf, valueAt, writtenOn } from './places.js';
import { Seek, nearestTo } from './seek.js';
import { shownOf, titleOf, unitFor, written } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Sought } from './seek.js' */
/** @import { WhatIf } from './whatif.js' */

const SAME = 1e-7; // of an axis: what is held is not moved by less
const MOST = 12; // values that are listed
const ENDS = /** @type {Record<'log' | 'linear', [number, number]>} */ ({ log: [1e-12, 1e15], linear: [-1e15, 1e15] });

export class Goal {
  /** @type {Sought | null} */ sought = null;
  gives = ''; // the axis that gives way
  holds = false;
  signature = ''; // of what was asked last

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    this.seek = new Seek((sought) => this.#take(sought));
    this.pulling = new Seek((sought) => this.#pulled(sought));
    const ends = () => ENDS[shownOf(whatif.result).log ? 'log' : 'linear'];
    const shown = (/** @type {number} */ value) => pretty(value / this.number.asked.factor);
    this.number = /** @type {NumberField & { asked: { factor: number } }} */ (
      new NumberField({ control: '', sign: '', factor: 1 }, ends, shown, (value) => this.want(value))
    );
    this.number.input.ariaLabel = text('whatif.wanted');
    this.unit = make('span');
    this.hold = make('button', { type: 'button', className: 'whole small', textContent: text('whatif.hold') });
    this.hold.title = text('whatif.hold-about');
    this.hold.onclick = () => this.keep(!this.holds);
    this.clear = make('button', { type: 'button', className: 'sign', textContent: '✕', title: text('whatif.clear') });
    this.clear.ariaLabel = text('whatif.clear');
    this.clear.onclick = () => this.want(null);
    this.choice = make('select', { ariaLabel: text('whatif.gives') });
    this.choice.onchange = () => {
      this.gives = this.choice.value;
      this.follow();
      this.whatif.schedule();
    };
    this.roots = make('span', { className: 'whatif-roots' });
    this.scan = make('canvas', { role: 'img', ariaLabel: text('whatif.scan') });
    this.box = make('div', { className: 'whatif-scan' }, this.scan);
    const name = make('strong', { textContent: text('whatif.wanted') });
    const first = make('div', { className: 'whatif-line' }, name, this.number.input, this.unit, this.hold, this.clear);
    this.second = make(
      'div',
      { className: 'whatif-line' },
      this.choice,
      make('span', { textContent: text('whatif.by') }),
    );
    this.second.append(this.roots);
    this.root = make('section', { className: 'whatif-goal' }, first, this.number.wrong, this.second, this.box);
    this.root.ariaLabel = text('whatif.wanted');
    this.force = new ForcePull(this);
  }
  /** @returns {Axis | undefined} */
  get axis() {
    return this.whatif.axis(this.gives);
  }
  get wanted() {
    return this.whatif.wanted[this.whatif.result] ?? null;
  }
  /** @param {number | null} value */
  want(value) {
    const { whatif } = this;
    if (value === null) {
      delete whatif.wanted[whatif.result];
      this.keep(false);
    } else whatif.wanted[whatif.result] = value;
    whatif.schedule();
  }
  /** @param {boolean} holds */
  keep(holds) {
    this.holds = holds;
    this.hold.ariaPressed = String(holds);
    this.whatif.schedule();
  }
  /** How many of the unit that is shown one is. */
  get #factor() {
    const { domain, result } = this.whatif;
    return unitFor(result, domain ?? [0, 0]);
  }
  /** What gives way where nobody has chosen it: a choice that is no axis and acts at once, or else the axis upwards. */
  get usual() {
    const { axes, named, points } = this.whatif;
    const free = axes.filter(({ body, name, whole }) => !body && !whole && name !== named.x && name !== named.y);
    return free.find(({ name }) => points.covers(name))?.name ?? named.y;
  }
  /** What there is changed: seek again, where anything that it hangs on has. */
  follow() {
    const { page, result } = this.whatif;
    if (!this.axis) this.gives = this.usual;
    const { axis, wanted } = this;
    const models = this.whatif.modes.mode === 'models'; // which have no values
    this.root.hidden = Boolean(shownOf(result).whole) || !axis || models;
    if (this.root.hidden || wanted === null || !axis) {
      this.seek.ask(null);
      this.sought = null;
      this.signature = '';
      return;
    }
    const others = Object.entries(page.frame.chosen).filter(([name]) => name !== axis.name);
    const signature = JSON.stringify([others, result, wanted, axis]);
    if (signature === this.signature) return;
    this.signature = signature;
    this.seek.ask({ axis, result, wanted, chosen: page.frame.chosen, fixed: [] });
  }
  /**
   * The contour is pulled to a place: what gives way moves until it goes through there.
   * @param {[axis: Axis, value: number][]} there
   */
  pull(there) {
    const { axis, wanted, whatif } = this;
    if (wanted === null || !axis) return;
    const others = there.filter(([each]) => each !== axis);
    const fixed = others.map(([each, value]) => /** @type {[string, number]} */ ([each.name, value]));
    this.pulling.ask({ axis, result: whatif.result, wanted, chosen: whatif.chosen, fixed });
    whatif.points.feed();
  }
  /**
   * Another value is wanted, and what gives way goes there at once.
   * @param {number} value
   */
  go(value) {
    this.want(value);
    this.pull([]);
  }
  /** @param {Sought} sought */
  #pulled(sought) {
    const { axis } = sought.asked;
    const place = nearestTo(sought, placeOf(axis, this.whatif.value(axis)));
    if (place !== null) this.whatif.set([[axis, Number(valueAt(axis, place).toPrecision(6))]]);
    else if (sought.asked.fixed.length) this.roots.replaceChildren(text('whatif.not-there')); // else all are listed
  }
  /** @param {Sought} sought */
  #take(sought) {
    this.sought = sought;
    const { axis, whatif } = this;
    const { asked } = sought;
    if (this.holds && axis?.name === asked.axis.name && asked.wanted === this.wanted) {
      const here = placeOf(axis, whatif.value(axis));
      const root = nearestTo(sought, here);
      if (root !== null && Math.abs(root - here) > SAME)
        whatif.set([[axis, Number(valueAt(axis, root).toPrecision(9))]]);
    }
    this.draw();
  }
  /** Everything that is written and drawn of it. */
  draw() {
    const { axis, sought, wanted, whatif } = this;
    const [factor, unit] = this.#factor;
    write(this.unit, unit);
    const { number } = this;
    const { result } = whatif;
    number.asked = { control: titleOf(result), sign: unit, si: shownOf(result).unit, factor: 1 / factor };
    if (wanted !== null) number.set(wanted);
    else if (!number.typing) number.input.value = '';
    this.hold.hidden = this.clear.hidden = this.second.hidden = this.box.hidden = wanted === null;
    const can = whatif.axes.filter(({ whole }) => !whole);
    const options = can.map(({ name, of, title }) => [name, of ? `${title}, ${of}` : title]);
    if (this.choice.dataset.options !== String(options)) {
      this.choice.dataset.options = String(options);
      this.choice.replaceChildren(...options.map(([value, words]) => make('option', { value, textContent: words })));
    }
    this.choice.value = this.gives;
    this.force.follow();
    if (wanted === null || !axis || !sought || sought.asked.axis.name !== axis.name) {
      this.roots.replaceChildren(this.seek.idle ? '' : text('whatif.seeking'));
      this.roots.dataset.known = '';
      cleared(this.scan, this.box); // of another choice
      return;
    }
    this.#list(sought, axis);
    this.#curve(sought, axis);
  }
  /**
   * @param {Sought} sought
   * @param {Axis} axis
   */
  #list(sought, axis) {
    const { roots, leaps, values } = sought;
    const known = JSON.stringify([roots, leaps.length, values, axis.name]);
    if (this.roots.dataset.known === known) return;
    this.roots.dataset.known = known;
    const buttons = roots.slice(0, MOST).map((place) => {
      const value = valueAt(axis, place);
      const act = () => this.whatif.set([[axis, Number(value.toPrecision(9))]]);
      const words = `${writtenOn(axis, value)} ${axis.unit}`.trim();
      return make('button', { type: 'button', className: 'whole small', textContent: words, onclick: act });
    });
    const some = values.filter((value) => Number.isFinite(value));
    const { result } = sought.asked;
    const reach = { low: written(result, Math.min(...some)), high: written(result, Math.max(...some)) };
    const none = roots.length ? '' : text(some.length ? 'whatif.none' : 'whatif.nothing', reach);
    const unknown = values.length - some.length;
    const open = unknown && some.length ? text('whatif.unknown', { count: unknown, all: values.length }) : '';
    const leapt = leaps.length ? text('whatif.leaps', { count: leaps.length }) : '';
    this.roots.replaceChildren(...buttons, [none, leapt, open].filter(Boolean).join(' '));
  }
  /**
   * @param {Sought} sought
   * @param {Axis} axis
   */
  #curve({ asked, contacts, places, roots, values }, axis) {
    const found = cleared(this.scan, this.box);
    if (!found) return;
    const { c, height, width } = found;
    const { log } = shownOf(asked.result);
    const of = (/** @type {number} */ value) => (log ? Math.log10(value) : value);
    const all = [...values.filter((value) => Number.isFinite(value)), asked.wanted].map(of);
    const [low, high] = [Math.min(...all), Math.max(...all)];
    const last = places[places.length - 1];
    const xOf = (/** @type {number} */ place) => 6 + (place / last) * (width - 12);
    const yOf = (/** @type {number} */ value) => height - 8 - ((of(value) - low) / (high - low || 1)) * (height - 16);
    c.strokeStyle = COLOR.accent;
    c.lineWidth = 1.25;
    c.setLineDash([5, 4]);
    mark(c, 0, yOf(asked.wanted), width, 0);
    c.setLineDash([]);
    c.beginPath();
    values.forEach((value, k) => {
      if (!Number.isFinite(value)) return;
      const broken = !k || !Number.isFinite(values[k - 1]) || contacts[k] !== contacts[k - 1];
      if (broken) c.moveTo(xOf(places[k]), yOf(value));
      else c.lineTo(xOf(places[k]), yOf(value));
    });
    c.strokeStyle = COLOR.ink;
    c.lineWidth = 1.75;
    c.stroke();
    for (const place of roots) disc(c, xOf(place), yOf(asked.wanted), 4.5, COLOR.accent);
    const here = this.whatif.here(asked.result);
    if (Number.isFinite(here)) disc(c, xOf(placeOf(axis, this.whatif.value(axis))), yOf(here), 4, COLOR.soft);
  }
}
