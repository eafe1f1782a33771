// What of a scene can be varied on the map: choices that are numbers, and values of bodies.
import { family, text } from '../text/catalogue.js';
import { LABELS } from '../text/words.js';
import { isCoordinate, placeOf, siOf, unitOf } from '../wire/body_values.js';

/** @import { Frame, PartRecord, ValueRecord } from '../messages.js' */
/** @import { Held } from '../wire/held.js' */
/** @import { Model } from '../wire/model.js' */

/**
 * Values in SI units between `low` and `high`.
 * @typedef {object} Axis
 * @property {string} name  of a choice, or the key of a value of a body
 * @property {string} title  as the slider or the field has it
 * @property {string} unit  in which it is shown, or nothing
 * @property {number} factor  SI units in one of these
 * @property {string} si  the SI unit, or nothing
 * @property {number} low
 * @property {number} high
 * @property {boolean} log  whether the scale is logarithmic
 * @property {boolean} whole
 * @property {boolean} body  whether it is a value of a body
 * @property {string} of  the body or the part that has it, or nothing
 */

const FAR = 10; // times the lowest value: as sliders, from there on logarithmic
const AROUND = 4; // times the value of the scene, up and down: values of bodies could be anything
const FIRST = ['mass_ratio', 'speed']; // where nobody has chosen any, after what sets how stiff the contact is
const NAMES = family('body.value');

/** @param {{ low: number, high: number }} ends */
const isLog = ({ low, high }) => low > 0 && high >= FAR * low;

/**
 * All that could be an axis, in the order of the page; nothing that a link holds.
 * @param {Frame} frame
 * @param {Pick<Model, 'spec'>} model
 * @param {Held} [held]  what a link takes from the controls
 * @returns {Axis[]}
 */
export function axesOf(frame, { spec }, held) {
  const choices = frame.acting.filter((name) => spec[name]?.low !== undefined && !held?.stays(name));
  const bodies = held?.bodies || held?.stays('bodies') ? [] : frame.parts;
  const shadows = new Set(choices.flatMap((name) => SET_BY[name] ?? []));
  return [
    ...choices.map((name) => choiceAxis(name, spec[name], held?.bounds.get(name))),
    ...bodies.flatMap((part) => bodyAxes(part, frame.parts)).filter(({ name }) => !shadows.has(name)),
  ];
}

/**
 * The value that a scene has on an axis; NaN where there is none.
 * @param {Axis} axis
 * @param {Pick<Frame, 'chosen' | 'parts'>} frame
 */
export function valueIn({ body, name }, { chosen, parts }) {
  if (!body) return Number(chosen[name]);
  for (const { key, values } of parts)
    for (const { quantity, value } of values) if (`${key}.${quantity}` === name) return Number(value ?? NaN);
  return NaN;
}

/**
 * By slider: the value of a body that it alone sets, which would be the same axis again.
 * @type {Record<string, string>}
 */
const SET_BY = { mass_ratio: 'impactor.mass', slenderness: 'target.length' };

/**
 * @param {string} name
 * @param {import('../wire/model.js').Bounds} bounds
 * @param {[low: number, high: number]} [ends]  that a link gives it
 * @returns {Axis}
 */
function choiceAxis(name, bounds, ends = [bounds.low, bounds.high]) {
  const [low, high] = ends;
  const { title, unit = '' } = LABELS[name];
  return {
    name,
    title,
    unit,
    factor: 1,
    si: unit,
    low,
    high,
    log: isLog({ low, high }),
    whole: bounds.whole,
    body: false,
    of: '',
  };
}

/**
 * @param {PartRecord} part
 * @param {PartRecord[]} parts  all of them
 * @returns {Axis[]}
 */
function bodyAxes(part, parts) {
  const [body, group = body] = part.key.split('.');
  const of = text(`bodies.head.${group}`, {
    ...placeOf(part.key, parts),
    body,
    kind: family('bodies.kind')[part.kind] ?? part.kind,
    strikes: part.strikes,
  });
  return part.values.flatMap((value) => {
    const ends = endsOf(value, parts);
    if (!ends) return [];
    const { sign, factor } = unitOf(value.quantity, Number(value.own ?? value.value));
    const name = `${part.key}.${value.quantity}`;
    const units = { unit: sign, factor, si: siOf(value.quantity) };
    return [{ name, title: NAMES[value.quantity], ...units, ...ends, log: isLog(ends), whole: false, body: true, of }];
  });
}

/**
 * Around the value of the scene, and as far as the value that it has: joints as far as they are apart.
 * @param {ValueRecord} record
 * @param {PartRecord[]} parts
 */
function endsOf({ high, low, own, quantity, value }, parts) {
  if (typeof value !== 'number' || low === null || high === null) return null;
  const middle = typeof own === 'number' ? own : value;
  let ends = [low, high]; // as of Poisson's ratio
  if (isCoordinate(quantity)) {
    const all = parts.flatMap(({ values }) =>
      values.filter((each) => isCoordinate(each.quantity)).map((v) => Number(v.own)),
    );
    const reach = Math.max(...all) - Math.min(...all);
    ends = [middle - reach / 2, middle + reach / 2];
  } else if (low >= 0 && middle > 0) ends = [middle / AROUND, middle * AROUND];
  return { low: Math.max(low, Math.min(ends[0], value)), high: Math.min(high, Math.max(ends[1], value)) };
}

/** @param {string} name  whether it says how stiff the contact is */
export const isStiffness = (name) => name.endsWith('stiffness');

/**
 * Names of axes, in the order in which they are taken where nobody has chosen any; none that is whole.
 * @param {Axis[]} axes
 */
export function usualFirst(axes) {
  const known = axes.filter(({ whole }) => !whole).map(({ name }) => name);
  const stiff = known.filter(isStiffness);
  const usual = new Set(['mass_ratio', ...stiff, ...FIRST, ...known]);
  return [...usual].filter((name) => known.includes(name));
}
