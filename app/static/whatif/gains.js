// How strongly the result follows each choice: what 1 % more of it does, below its slider, where buttons make it an
// axis.
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { isStiffness, usualFirst } from './axes.js';
import { PLACE, WIDTH, shownOf, valueOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Job } from './points.js' */
/** @import { WhatIf } from './whatif.js' */

const STEP = 0.005; // of a value, both ways
const SLIDERS = 4; // in view

/** @typedef {{ root: HTMLElement, across: HTMLButtonElement, up: HTMLButtonElement, gain: HTMLElement }} Role */

export class Gains {
  /** @type {Map<string, Role>} */ roles = new Map(); // by choice
  asked = ''; // of what
  found = ''; // for what they are known
  /** @type {Map<string, number>} */ gains = new Map(); // of the value, or of the unit of a share
  under = false;

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
  }
  /** Another scene: nothing that was found is of it. */
  forget() {
    this.gains.clear();
  }
  /** Choices of the sliders that are seen. */
  get #axes() {
    const { axes, page, points } = this.whatif;
    return axes.filter(({ body, name, whole }) => !body && !whole && page.controls.fields[name] && points.covers(name));
  }
  /**
   * Sliders in view: those of both axes, what gives way, how stiff the contact is, then others that act.
   * @param {string[]} others  that lead without the map
   */
  leads(others) {
    const { axes, goal, named, page } = this.whatif;
    if (!axes.length) return others; // not yet known
    const more = [...(goal.wanted === null ? [] : [goal.gives]), ...usualFirst(axes).filter(isStiffness)];
    const first = [named.x, named.y, ...more].filter((name) => page.controls.fields[name]);
    const act = others.filter((name) => name !== 'restitution' || this.whatif.axis(name));
    return [...new Set([...first, ...act])].slice(0, SLIDERS);
  }
  /** @param {Axis} axis */
  #role({ name, title }) {
    const known = this.roles.get(name);
    if (known) return known;
    const button = (/** @type {'x' | 'y'} */ slot, /** @type {string} */ sign, /** @type {string} */ about) =>
      make('button', {
        ...{ type: 'button', textContent: sign, title: about, ariaLabel: about },
        onclick: () => this.whatif.choose(slot, name),
      });
    const across = button('x', '→', text('whatif.make-across', { title }));
    const up = button('y', '↑', text('whatif.make-upwards', { title }));
    const gain = make('span');
    const root = make('p', { className: 'whatif-role' }, across, up, gain);
    const role = { root, across, up, gain };
    this.roles.set(name, role);
    return role;
  }
  /** Show what is known, and ask for what is not. */
  follow() {
    const { chosen, named, page, result } = this.whatif;
    page.opening.lead();
    this.asked = JSON.stringify([chosen, result]);
    const axes = this.#axes;
    for (const [name, { root }] of this.roles) if (!axes.some((axis) => axis.name === name)) root.remove();
    for (const axis of axes) {
      const { across, gain, root, up } = this.#role(axis);
      if (!root.isConnected) page.controls.fields[axis.name].root.append(root);
      across.ariaPressed = String(axis.name === named.x);
      up.ariaPressed = String(axis.name === named.y);
      const value = this.gains.get(axis.name);
      const sign = value !== undefined && value > 0 ? '+' : '';
      const unit = shownOf(result).unit === '%' ? text('whatif.points') : '%';
      const said = { gain: `${sign}${figures(value ?? NaN, 2)}\u00a0${unit}` };
      write(gain, Number.isFinite(value) ? text('whatif.gain', said) : '');
      gain.title = text('whatif.gain-about');
    }
  }
  /** @returns {Job | null} */
  next() {
    const { asked } = this;
    const axes = this.#axes;
    if (this.under || asked === this.found || !axes.length) return null;
    this.under = true;
    const { chosen, result } = this.whatif;
    const values = axes.map((axis) => this.whatif.value(axis));
    const rows = axes.flatMap(({ high, low }, k) =>
      [-STEP, STEP].flatMap((step) =>
        values.map((value, n) => (n === k ? Math.min(Math.max(value * (1 + step), low), high) : value)),
      ),
    );
    return {
      ...{ chosen, names: axes.map(({ name }) => name), rows: Float64Array.from(rows) },
      done: (found) => {
        this.under = false;
        if (!found) return;
        this.found = asked;
        this.gains = new Map(axes.map(({ name }, k) => [name, gainOf(found, 2 * k, result, this.whatif.here(result))]));
        this.whatif.schedule();
      },
    };
  }
  leave() {
    for (const { root } of this.roles.values()) root.remove();
  }
}

/**
 * What 1 % more does, in percent, or in points of a share; nothing where a contact is gained or lost between.
 * @param {Float64Array} found
 * @param {number} row  with less; the next one is with more
 * @param {import('./results.js').Result} result
 * @param {number} here
 */
function gainOf(found, row, result, here) {
  const [less, more] = [row * WIDTH, (row + 1) * WIDTH];
  if (found[less] || found[more] || found[less + PLACE.contacts] !== found[more + PLACE.contacts]) return NaN;
  const grown = valueOf(result, found, more) - valueOf(result, found, less);
  if (shownOf(result).whole) return NaN;
  return shownOf(result).unit === '%' ? grown : (100 * grown) / Math.abs(here);
}
