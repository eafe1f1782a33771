// Between two designs: a slider takes the scene along the way from one to the other, by equal steps of all axes.
import { differing } from '../form/settings.js';
import { make, write } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { LABELS } from '../text/words.js';
import { entriesOf, textOf } from '../wire/body_values.js';
import { valueIn } from './axes.js';
import { placeOf, valueAt } from './places.js';

/** @import { Run } from '../compare/run.js' */
/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Axis } from './axes.js' */
/** @import { WhatIf } from './whatif.js' */

const STEPS = 100;

/**
 * Values by axis in which two designs differ.
 * @typedef {{ axis: Axis, from: number, to: number }} Change
 */

/**
 * @param {Frame} from
 * @param {Frame} to
 * @returns {[Map<string, string>, Map<string, string>]}  values of bodies that differ from those of the scene
 */
const bodiesOf = (from, to) => [new Map(entriesOf(from.chosen.bodies)), new Map(entriesOf(to.chosen.bodies))];

/**
 * In what two designs differ: numbers that have an axis, and what has nothing between, in words.
 * @param {Axis[]} axes
 * @param {Frame} from
 * @param {Frame} to
 * @returns {{ changes: Change[], others: string[] }}
 */
export function changesOf(axes, from, to) {
  const [before, after] = bodiesOf(from, to);
  const keys = [...new Set([...before.keys(), ...after.keys()])].filter((key) => before.get(key) !== after.get(key));
  const names = [...differing([from, to]).filter((name) => name !== 'bodies'), ...keys];
  /** @type {Change[]} */
  const changes = [];
  const others = [];
  for (const name of names) {
    const axis = axes.find((each) => each.name === name);
    const [a, b] = axis ? [valueIn(axis, from), valueIn(axis, to)] : [NaN, NaN];
    if (axis && Number.isFinite(a) && Number.isFinite(b)) changes.push({ axis, from: a, to: b });
    else others.push(LABELS[name]?.title ?? text(`body.value.${name.replace(/^.*?\.(\w+\.\d+\.)?/, '')}`));
  }
  return { changes, others };
}

/**
 * The choices of a scene on the way.
 * @param {Change[]} changes
 * @param {Frame} from
 * @param {Frame} to
 * @param {number} share  0: from, 1: to
 * @returns {Chosen}
 */
export function between(changes, from, to, share) {
  if (share <= 0 || share >= 1) return share <= 0 ? from.chosen : to.chosen;
  const found = { ...from.chosen };
  const [bodies] = bodiesOf(from, to);
  for (const { axis, from: a, to: b } of changes) {
    const value = valueAt(axis, placeOf(axis, a) + share * (placeOf(axis, b) - placeOf(axis, a)));
    if (axis.body) bodies.set(axis.name, String(value));
    else found[axis.name] = value;
  }
  found.bodies = textOf([...bodies]);
  return found;
}

/**
 * How far along the way a scene is, by the first of what changes.
 * @param {Change[]} changes
 * @param {Frame} now
 */
export function shareAlong([change], now) {
  if (!change) return 0;
  const { axis, from, to } = change;
  const [a, b, at] = [from, to, valueIn(axis, now)].map((value) => placeOf(axis, value));
  return Number.isFinite(at) ? Math.min(Math.max((at - a) / (b - a), 0), 1) : 0;
}

export class Morph {
  /** @type {Record<'from' | 'to', string>} */ letters = { from: '', to: '' };
  /** @type {Change[]} */ changes = [];
  /** @type {Run | undefined} */ from;
  /** @type {Run | undefined} */ to;

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    const choice = (/** @type {'from' | 'to'} */ end, /** @type {string} */ ariaLabel) => {
      const made = make('select', { ariaLabel });
      made.onchange = () => {
        this.letters[end] = made.value;
        whatif.schedule();
      };
      return made;
    };
    this.ends = { from: choice('from', text('whatif.morph-from')), to: choice('to', text('whatif.morph-to')) };
    this.range = make('input', { type: 'range', min: 0, max: STEPS, step: 1 });
    this.range.oninput = () => this.go(Number(this.range.value) / STEPS);
    this.root = make('div', { className: 'whatif-morph' }, this.ends.from, this.range, this.ends.to);
    this.wrong = make('p');
  }
  /**
   * Which there are, and how far between them the scene is.
   * @param {Run[]} runs
   */
  follow(runs) {
    this.root.hidden = runs.length < 2;
    const names = runs.map(({ letter }) => letter).join('');
    const of = (/** @type {string} */ name) => runs.find(({ letter }) => letter === name);
    const { ends, letters } = this;
    this.from = of(letters.from) ?? runs.find(({ letter }) => letter !== letters.to);
    this.to = of(letters.to) ?? runs.find((run) => run !== this.from);
    const { from, to } = this;
    this.changes = [];
    write(this.wrong, '');
    if (this.root.hidden || !from || !to) return;
    Object.assign(letters, { from: from.letter, to: to.letter });
    for (const end of /** @type {const} */ (['from', 'to'])) {
      const select = ends[end];
      if (select.dataset.options !== names) {
        select.dataset.options = names;
        select.replaceChildren(...[...names].map((value) => make('option', { value, textContent: value })));
      }
      select.value = letters[end];
    }
    const { changes, others } = changesOf(this.whatif.axes, from.frame, to.frame);
    const moves = changes.length > 0 && !others.length;
    this.range.disabled = !moves;
    this.range.ariaLabel = text('whatif.morph', letters);
    if (others.length) write(this.wrong, text('whatif.no-between', { ...letters, names: others }));
    if (!moves) return;
    this.changes = changes;
    const share = shareAlong(changes, this.whatif.page.frame);
    this.range.style.setProperty('--fill', `${100 * share}%`);
    this.range.ariaValueText = `${Math.round(100 * share)} %`;
    if (!this.whatif.page.own.behind) this.range.value = String(Math.round(STEPS * share));
  }
  /** @param {number} share  Take the scene there. */
  go(share) {
    const { changes, from, to, whatif } = this;
    const { page } = whatif;
    if (!from || !to || !changes.length) return;
    const wanted = between(changes, from.frame, to.frame, share);
    const { chosen } = page.frame;
    if (chosen.scene !== wanted.scene || chosen.bodies !== wanted.bodies) {
      page.history.choose('bodies', wanted.bodies); // one step, as long as it is moved on
      page.goTo(wanted);
      return;
    }
    const moved = changes.map(({ axis }) => axis.name); // also where they are back: others may be on their way
    const acts = new Set([...from.frame.acting, ...moved]);
    for (const name of page.names)
      if (acts.has(name) && (moved.includes(name) || !Object.is(chosen[name], wanted[name])))
        page.choose(name, wanted[name]);
  }
}
