// What a class has answered to a question, counted.
import { judgeNumber } from '../lesson/number.js';

/** @import { Answer } from '../lesson/code.js' */
/** @import { Part } from '../lesson/questions.js' */

const GROUPS = 8; // of other numbers, that are named
const DIGITS = 2; // in which they are the same

/**
 * @param {number} count
 * @param {(k: number) => number} each
 */
const countsOf = (count, each) => Array.from({ length: count }, (_, k) => each(k));

/**
 * How many took each option.
 * @param {Part} part
 * @param {Answer[]} given
 */
export const pickedOf = ({ options }, given) =>
  countsOf(options.length, (k) => given.filter(({ picked }) => picked === k).length);

/**
 * How many had it at once, later, and never.
 * @param {Answer[]} given
 */
export function triesOf(given) {
  const right = given.filter((each) => each.right);
  const first = right.filter(({ tries }) => tries === 1).length;
  return { first, later: right.length - first, never: given.length - right.length };
}

/**
 * Numbers of the first try in the order of their size: those that are right, that a usual mistake gives, and others,
 * the rarest of them as one. `mistake`: which of the usual; -1: none. `value`: in the unit of the question; none where
 * many are in it.
 * @param {Part} part
 * @param {Answer[]} given
 * @returns {{ right: boolean, mistake: number, value: number | null, count: number }[]}
 */
export function numbersOf(part, given) {
  const { answer, factors, mistakes, unit: own, units } = part;
  const factor = (/** @type {string} */ name) => factors[units.indexOf(name)] ?? 1;
  const judged = given.map(({ unit = own, value = 0 }) => ({
    ...judgeNumber(/** @type {any} */ (part), value, unit),
    inOwn: Number(((value * factor(unit)) / factor(own)).toPrecision(DIGITS)),
  }));
  const usual = mistakes.map((/** @type {Part} */ each, /** @type {number} */ k) => ({
    ...{ right: false, mistake: k, value: each.answer },
    count: judged.filter(({ mistake }) => mistake === k).length,
  }));
  /** @type {Map<number, number>} */
  const others = new Map();
  for (const { inOwn, mistake, right } of judged)
    if (!right && mistake < 0) others.set(inOwn, (others.get(inOwn) ?? 0) + 1);
  const often = [...others].sort(([a, m], [b, n]) => n - m || a - b);
  const named = often.slice(0, GROUPS).map(([value, count]) => ({ right: false, mistake: -1, value, count }));
  const rest = often.slice(GROUPS).reduce((sum, [, count]) => sum + count, 0);
  const right = { right: true, mistake: -1, value: answer, count: judged.filter((each) => each.right).length };
  const sized = [right, ...usual, ...named].sort((a, b) => (a.value ?? Infinity) - (b.value ?? Infinity));
  return rest ? [...sized, { right: false, mistake: -1, value: null, count: rest }] : sized;
}

/**
 * How many put each item in its place at once, and where most of the others put it; -1: nowhere.
 * @param {Part} part
 * @param {Answer[]} given
 * @returns {{ count: number, instead: number, most: number }[]}
 */
export const placesOf = ({ items }, given) =>
  items.map((/** @type {Part} */ _, /** @type {number} */ item) => {
    const places = given.map(({ order = [] }) => order.indexOf(item));
    const at = countsOf(items.length, (k) => (k === item ? 0 : places.filter((place) => place === k).length));
    const most = Math.max(...at);
    return { count: places.filter((place) => place === item).length, instead: most ? at.indexOf(most) : -1, most };
  });

/**
 * Settings that were found in each range.
 * @param {Part} part
 * @param {Answer[]} given
 * @returns {number[][]}
 */
export const foundOf = ({ found }, given) =>
  found.map((/** @type {Part} */ _, /** @type {number} */ k) =>
    given.flatMap(({ places }) => places?.[k] ?? []).sort((a, b) => a - b),
  );

/**
 * How often each criterion of a sketch had each outcome.
 * @param {Part} part
 * @param {Answer[]} given
 * @returns {Record<string, number>[]}
 */
export const outcomesOf = ({ judges }, given) =>
  judges.map((/** @type {Part} */ { says }, /** @type {number} */ k) =>
    Object.fromEntries(
      Object.keys(says).map((name) => [name, given.filter(({ outcomes }) => outcomes?.[k] === name).length]),
    ),
  );
