// What may be chosen where there is no server, and why something else may not.
import { isBodyKey } from '../wire/body_values.js';
import { carried } from '../browser/home.js';
import { family } from '../text/catalogue.js';

/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Spec } from '../wire/model.js' */
/** @import { Note } from '../text/catalogue.js' */

const LONGEST = 80; // letters of a value in an address
const NUMBER = /^\s*[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?\s*$/i; // as a server reads them
const WHOLE = /^\s*[+-]?\d+\s*$/;
const UNITS = family('unit');

/**
 * @param {string} code
 * @param {Record<string, unknown>} [values]
 * @returns {Note}
 */
export const refusal = (code, values = {}) => ({
  code,
  severity: 'refusal',
  values: { laboratory: Boolean(carried?.laboratory), ...values },
});

/**
 * @param {string} name  of a choice that no kernel here follows
 */
export const fixed = (name) => refusal('offline.choice', { control: `control.${name}` });

/**
 * Why a choice cannot have this value; nothing where it can.
 * @param {string} name
 * @param {unknown} value
 * @param {Spec} spec
 * @param {unknown} [given]  as an address has it
 * @returns {Note | null}
 */
export function refusalOf(name, value, spec, given = value) {
  const { high, low, options, whole } = spec[name];
  const control = `control.${name}`;
  const shown = String(given).trim().slice(0, LONGEST) || 'refused.some-text';
  if (options) {
    const all = options.map((each) => `name.${name}.${each}`);
    return options.includes(String(value)) ? null : refusal('refused.choice', { control, value: shown, options: all });
  }
  if (low === undefined) return null; // text
  const within = typeof value === 'number' && value >= low && value <= high && (!whole || Number.isInteger(value));
  const unit = name in UNITS ? `unit.${name}` : 'none';
  return within ? null : refusal('refused.number', { control, value: shown, whole, low, high, unit });
}

/**
 * The choices of an address: what can be used, and a refusal for each that cannot.
 * @param {string} search
 * @param {import('./model.js').Offline} offline
 * @returns {[chosen: Chosen, refused: Note[]]}
 */
export function choicesIn(search, offline) {
  const { answers, spec } = offline;
  const query = new URLSearchParams(search);
  /** @type {Note[]} */
  const refused = [];
  const asked = offline.scene(query.get('scene') ?? spec.scene.default);
  const base = asked ?? /** @type {Frame} */ (offline.scene(spec.scene.options?.[0]));
  if (!asked) refused.push(refusal('offline.scene'));
  const chosen = { ...base.chosen };
  for (const [name, bounds] of Object.entries(spec)) {
    const given = query.get(name);
    if (given === null || name === 'scene' || name === 'bodies') continue;
    const number = (bounds.whole ? WHOLE : NUMBER).test(given) ? Number(given) : NaN;
    const value = bounds.low === undefined ? given : number;
    const why = refusalOf(name, value, spec, given);
    if (why) refused.push(why);
    else if (!Object.is(value, chosen[name]) && !answers.covers(base, [name])) refused.push(fixed(name));
    else chosen[name] = value;
  }
  if ([...query.keys()].some(isBodyKey)) refused.push(fixed('bodies'));
  return [chosen, refused];
}
