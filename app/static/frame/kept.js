// Kept solutions in an address: "A,modes:5;B,law:hertz,mass_ratio:2", each by what differs from its scene's own values.
import { entriesOf, isBodyKey, textOf } from '../wire/body_values.js';
import { isOwn } from '../wire/own.js';

/** @import { Run } from '../compare/run.js' */
/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Spec } from '../wire/model.js' */

const BODY_VALUE = /^[\w.+-]{1,30}$/; // the server knows which can be
const NUMBER = /^-?\d+(\.\d+)?(e[+-]?\d+)?$/;

export const LETTERS = /** @type {const} */ (['A', 'B', 'C', 'D', 'E', 'F', 'G', 'H']);

/** @typedef {(typeof LETTERS)[number]} Letter  by which a kept solution is called and coloured */
/** @typedef {{ letter: Letter, settings: Partial<Chosen> }} Wanted */

/**
 * @param {Run[]} runs
 * @param {Frame} now
 */
export const keptText = (runs, now) =>
  runs
    .map(({ frame: { acting, chosen, own }, letter }) => {
      const differ = (/** @type {string} */ name) =>
        name === 'scene' ? chosen.scene !== now.chosen.scene : acting.includes(name) && chosen[name] !== own[name];
      const settings = Object.keys(chosen).filter((name) => name !== 'bodies' && differ(name));
      const pairs = [...entriesOf(chosen.bodies), ...settings.map((name) => [name, chosen[name]])];
      return [letter, ...pairs.map((pair) => pair.join(':'))].join(',');
    })
    .join(';');

/**
 * What an address says is kept; null where any of it cannot be.
 * @param {string} text
 * @param {Spec} spec
 * @returns {Wanted[] | null}
 */
export function keptOf(text, spec) {
  const found = text.split(';').map((part) => wantedOf(part, spec));
  const letters = new Set(found.map((each) => each?.letter));
  return letters.size === found.length && found.every((each) => each !== null) ? found : null;
}

/**
 * @param {string} text
 * @param {Spec} spec
 * @returns {Wanted | null}
 */
function wantedOf(text, spec) {
  const [first, ...rest] = text.split(',');
  const letter = LETTERS.find((each) => each === first);
  /** @type {Partial<Chosen>} */
  const settings = {};
  /** @type {[key: string, value: string][]} */
  const bodies = [];
  for (const setting of rest) {
    const [name, value = '', ...more] = setting.split(':');
    if (isBodyKey(name) && BODY_VALUE.test(value) && !more.length) {
      bodies.push([name, value]);
      continue;
    }
    const known = Object.hasOwn(spec, name) ? valueOf(name, value, spec[name]) : null;
    if (known === null || more.length) return null;
    settings[name] = known;
  }
  if (bodies.length) settings.bodies = textOf(bodies);
  return letter ? { letter, settings } : null;
}

/**
 * @param {string} name
 * @param {string} value
 * @param {import('../wire/model.js').Bounds} bounds
 */
function valueOf(name, value, { high, low, options, whole }) {
  if (options) return options.includes(value) || (name === 'scene' && isOwn(value)) ? value : null;
  const number = NUMBER.test(value) ? Number(value) : NaN;
  return number >= low && number <= high && (!whole || Number.isInteger(number)) ? number : null;
}
