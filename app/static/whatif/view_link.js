// What a link says of the view: the result, its axes, what is wanted; then parts by name, of which those are said that
// are not as usual. What is no value here, or of a later version, is passed over.
import { BOUNDS } from './model_jobs.js';
import { longOf, placeOf, usualRange, valueAt } from './places.js';
import { NAMES } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { WhatIf } from './whatif.js' */

const DIGITS = 6;
const LEAST = 0.05; // units of an axis that are shown at least
const MOST = 0.9; // of a value, that a tolerance is

/**
 * @param {Axis} axis
 * @param {[from: number, to: number]} range  places
 */
const endsOf = (axis, range) =>
  range.map((place) => Number(valueAt({ ...axis, whole: false }, place).toPrecision(DIGITS))).join(':');

/** @param {WhatIf} whatif */
export function saidOf(whatif) {
  const { goal, modes, named, result } = whatif;
  const wanted = whatif.wanted[result];
  const parts = [];
  for (const slot of /** @type {const} */ (['x', 'y'])) {
    const axis = whatif.axis(named[slot]);
    if (!axis) continue;
    const ends = endsOf(axis, whatif.range(axis));
    if (ends !== endsOf(axis, usualRange(axis, whatif.value(axis)))) parts.push(`${slot}:${ends}`);
  }
  if (wanted !== undefined && goal.gives && goal.gives !== goal.usual) parts.push(`gives:${goal.gives}`);
  if (wanted !== undefined && goal.holds) parts.push('hold');
  if (modes.mode === 'tolerance')
    for (const [name, part] of modes.tolerance.parts)
      if (whatif.axis(name)) parts.push(`tolerance:${name}:${Number(part.toPrecision(DIGITS))}`);
  if (modes.mode === 'models') parts.push(`within:${modes.models.bound}`);
  const last = wanted === undefined ? (parts.length ? [''] : []) : [wanted];
  return modes.said + [result, named.x, named.y, ...last, ...parts].join(',');
}

/**
 * As a link says, without the view that it begins with.
 * @param {WhatIf} whatif
 * @param {string} said
 */
export function follow(whatif, said) {
  const [result, x, y, wanted, ...parts] = said.split(',');
  const { goal, modes, named } = whatif;
  const known = NAMES.find((name) => name === result);
  if (known) whatif.result = known;
  if (whatif.axis(x)) named.x = x;
  if (whatif.axis(y) && y !== named.x) named.y = y;
  if (wanted && Number.isFinite(Number(wanted))) whatif.wanted[whatif.result] = Number(wanted);
  for (const part of parts) {
    const [name, ...values] = part.split(':');
    if (name === 'x' || name === 'y') show(whatif, whatif.axis({ x, y }[name]), values.map(Number));
    else if (name === 'gives' && whatif.axis(values[0]) && !whatif.axis(values[0])?.whole) [goal.gives] = values;
    else if (name === 'hold' && goal.wanted !== null) goal.keep(true);
    else if (name === 'within' && BOUNDS.includes(Number(values[0]))) modes.models.bound = Number(values[0]);
    else if (name === 'tolerance' && whatif.axis(values[0])) {
      const share = values[1] ? Number(values[1]) : NaN;
      if (share >= 0 && share <= MOST) modes.tolerance.parts.set(values[0], share);
    }
  }
}

/**
 * @param {WhatIf} whatif
 * @param {Axis | undefined} axis
 * @param {number[]} ends
 */
function show(whatif, axis, ends) {
  if (!axis || ends.length !== 2) return;
  const inside = (/** @type {number} */ value) => Math.min(Math.max(value, axis.low), axis.high);
  const [from, to] = ends.map((end) => Math.min(Math.max(placeOf(axis, inside(end)), 0), longOf(axis)));
  if (to - from >= LEAST - 1e-6) whatif.ranges.set(axis, [from, to]); // NaN is not
}
