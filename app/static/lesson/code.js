// The code of a student for a teacher: what was answered in a lesson, as letters that can be written down. It begins
// with its form and some salt, which hides the rest, and ends with a check. Only numbers: nothing here draws.
import { joined } from './judge.js';

/** @import { Part } from './questions.js' */

/** @typedef {{ lesson: string, steps: { parts: Part[] }[] }} Asks  of a lesson, what is needed here */
/**
 * What was answered: the first time, where one may try again.
 * @typedef {object} Answer
 * @property {number} [picked]  of the options
 * @property {number} [value]
 * @property {string} [unit]
 * @property {number} [tries]  so many or more
 * @property {boolean} [right]  in the end
 * @property {number[]} [order]  items by place
 * @property {(number | null)[]} [places]  in each range, where one was found
 * @property {string[]} [outcomes]  of criteria
 * @property {boolean} [late]  drawn after looking at what happens
 * @property {number[]} [line]  values at equal steps from 0 until the end
 */
/** @typedef {Record<string, Answer | null>} Answers  by question; none where it was left out */
/** @typedef {(value: number, base: number) => number} Digit  writes one below its base, or reads one */

export const LETTERS = 'BCDFGHJKLMNPQRSTWXZ'; // no vowel, so no word; none is like another, or like a digit
const SIZE = BigInt(LETTERS.length);
const P = LETTERS.length; // a prime: letters are a field
export const FORM = 1; // of the code
const HEAD = 4; // letters of form and salt
export const SALTS = P ** (HEAD - 1);
const PRINT = 3; // letters of what is asked
export const GROUP = 4; // letters
export const MOST_LETTERS = 1000; // of a code; what reads it takes their square
// Of a primitive polynomial, x⁴ + 15x³ + x² + x + 2: all wrong letters, two of them, and all neighbours that change
// places are found; of all else one in 130 321 is not.
const CHECK = [2, 1, 1, 15];
const START = [1, 2, 3, 4];
const SEAL = [3, 7, 11, 5];
export const MOST_TRIES = 7;
const DIGITS = 4; // of a number
const FAR = 15; // powers of ten
const PLACES = 47; // steps of a slider
export const POINTS = 24; // of a line
const LEVELS = 30; // steps from the lowest value of its chart to the highest

/** Of a criterion, in the order of the code. @type {Record<string, string[]>} */
export const OUTCOMES = {
  falls: ['yes', 'no'],
  rises: ['yes', 'no'],
  jump: ['yes', 'early', 'late', 'small', 'none'],
  'zero-from': ['yes', 'early', 'late', 'none'],
  push: ['yes', 'none'],
  'zero-beyond': ['yes', 'no'],
  near: ['yes', 'high', 'low'],
};

export class CodeError extends Error {
  /**
   * @param {string} why  `short`, `sign`, `check`, `form` or `other`
   * @param {string} [sign]  that no code has
   */
  constructor(why, sign = '') {
    super(why);
    this.why = why;
    this.sign = sign;
  }
}

/** @param {Asks} record */
export const questionsOf = ({ steps }) =>
  steps.flatMap(({ parts }) => parts).filter(({ kind }) => Object.hasOwn(KINDS, kind));

/**
 * A setting of a slider as a share of its range; by ratios where all is positive.
 * @param {number} value
 * @param {[low: number, high: number]} range
 */
export const shareOf = (value, [low, high]) =>
  low > 0 ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);

/**
 * @param {number} share
 * @param {[low: number, high: number]} range
 */
const settingAt = (share, [low, high]) =>
  Number((low > 0 ? low * (high / low) ** share : low + share * (high - low)).toPrecision(3));

/**
 * @param {number} count
 * @returns {number}
 */
const factorial = (count) => (count > 1 ? count * factorial(count - 1) : 1);

/**
 * Whole steps of so many, within them.
 * @param {number} share
 * @param {number} steps
 */
const stepped = (share, steps) => Math.round(Math.min(Math.max(share || 0, 0), 1) * steps);

/**
 * @param {Digit} digit
 * @param {Answer | null} given
 */
function triesIn(digit, given) {
  const tries = digit(given ? Math.min(given.tries ?? 1, MOST_TRIES) : 0, MOST_TRIES + 1);
  return tries ? { tries, right: Boolean(digit(given?.right ? 1 : 0, 2)) } : null;
}

/**
 * Four digits, a power of ten and the unit.
 * @param {Digit} digit
 * @param {Part} part
 * @param {Answer | null} given
 */
function numberIn(digit, { units }, given) {
  const tried = triesIn(digit, given);
  if (!tried) return null;
  const written = given?.value ?? 0;
  const [sized, power = '0'] = Math.abs(written)
    .toExponential(DIGITS - 1)
    .split('e');
  const least = 10 ** (DIGITS - 1);
  const whole = Math.round(Number(sized) * least);
  const digits = digit(whole && whole - least + 1, 9 * least + 1);
  const tens = digit(Math.min(Math.max(Number(power), -FAR), FAR) + FAR, 2 * FAR + 1) - FAR;
  const sign = digit(written < 0 ? 1 : 0, 2) ? '-' : '';
  const unit = units[digit(Math.max(units.indexOf(given?.unit), 0), units.length)];
  const value = digits ? Number(`${sign}${digits + least - 1}e${tens - DIGITS + 1}`) : 0;
  return { value, unit, ...tried };
}

/**
 * A permutation by its number.
 * @param {Digit} digit
 * @param {Part} part
 * @param {Answer | null} given
 */
function orderIn(digit, { items }, given) {
  const tried = triesIn(digit, given);
  if (!tried) return null;
  const left = [...items.keys()];
  const placed = given?.order ?? left;
  let rank = digit(
    placed.reduce((sum, each, k) => {
      const before = placed.slice(k + 1).filter((other) => other < each).length;
      return sum + before * factorial(placed.length - 1 - k);
    }, 0),
    factorial(left.length),
  );
  const order = [...left].map((_, k, all) => {
    const size = factorial(all.length - 1 - k);
    const [item] = left.splice(Math.floor(rank / size), 1);
    rank %= size;
    return item;
  });
  return { order, ...tried };
}

/**
 * @param {Digit} digit
 * @param {Part} part
 * @param {Answer | null} given
 */
function sketchIn(digit, { axis, judges }, given) {
  if (!digit(given ? 1 : 0, 2)) return null;
  const late = Boolean(digit(given?.late ? 1 : 0, 2));
  const outcomes = judges.map((/** @type {Part} */ { criterion }, /** @type {number} */ k) => {
    const all = OUTCOMES[criterion];
    return all[digit(Math.max(all.indexOf(given?.outcomes?.[k] ?? ''), 0), all.length)];
  });
  const [low, high] = axis;
  const line = Array.from({ length: POINTS }, (_, k) => {
    const level = digit(stepped(((given?.line?.[k] ?? low) - low) / (high - low), LEVELS), LEVELS + 1);
    return low + ((high - low) * level) / LEVELS;
  });
  return { outcomes, late, line };
}

/** @type {Record<string, (digit: Digit, part: Part, given: Answer | null) => Answer | null>} */
const KINDS = {
  choice: (digit, { options }, given) => {
    const picked = digit((given?.picked ?? -1) + 1, options.length + 1) - 1;
    return picked < 0 ? null : { picked };
  },
  number: numberIn,
  order: orderIn,
  set: (digit, { found, range }, given) => {
    const places = found.map((/** @type {Part} */ _, /** @type {number} */ k) => {
      const place = given?.places?.[k] ?? null;
      const step = digit(place === null ? 0 : stepped(shareOf(place, range), PLACES) + 1, PLACES + 2);
      return step ? settingAt((step - 1) / PLACES, range) : null;
    });
    return places.some((/** @type {number | null} */ place) => place !== null) ? { places } : null;
  },
  sketch: sketchIn,
};

/**
 * What is kept of answers in the browser, as a code has them.
 * @param {Asks} record
 * @param {Record<string, any>} answers
 * @returns {Answers}
 */
export function givenOf(record, answers) {
  const given = questionsOf(record).map(({ found, kind, name }) => {
    const answer = Object.hasOwn(answers, name) ? answers[name] : null;
    if (kind === 'choice') return [name, answer?.done ? { picked: answer.picked } : null];
    if (kind === 'set') {
      const placeIn = (/** @type {number} */ k) =>
        answer.found.find((/** @type {Part} */ each) => each.which === k)?.place ?? null;
      const places = answer?.done ? found.map((/** @type {Part} */ _, /** @type {number} */ k) => placeIn(k)) : null;
      return [name, places && { places }];
    }
    if (kind === 'sketch') return [name, answer?.done ? drawnOf(answer) : null];
    if (!answer?.first) return [name, null];
    const { done: right, first, tries } = answer;
    return [name, { ...first, tries, right }];
  });
  return Object.fromEntries(given);
}

/** @param {Record<string, any>} answer  to a sketch */
function drawnOf({ late, line, outcomes }) {
  const whole = joined(line.map((/** @type {number | null} */ value) => value ?? NaN));
  const at = (/** @type {number} */ k) => whole[Math.round((k / (POINTS - 1)) * (whole.length - 1))];
  return {
    outcomes: outcomes.map((/** @type {Part} */ { outcome }) => outcome),
    late,
    line: Array.from({ length: POINTS }, (_, k) => at(k)),
  };
}

/** @type {WeakMap<Asks, number>} */
const PRINTS = new WeakMap();

/**
 * A number that stands for what is asked, in whatever language.
 * @param {Asks} record
 */
function printOf(record) {
  const known = PRINTS.get(record);
  if (known !== undefined) return known;
  const asked = questionsOf(record).map(({ axis, found, items, judges, kind, name, options, range, units, until }) => {
    const sizes = [options, items, found].map((list) => list?.length ?? 0);
    const criteria = judges?.map((/** @type {Part} */ { criterion }) => criterion) ?? [];
    return [kind, name, sizes, criteria, units ?? [], range ?? [], axis ?? [], until ?? 0];
  });
  let hash = 0x811c9dc5;
  for (const sign of JSON.stringify([record.lesson, asked]))
    hash = Math.imul(hash ^ (sign.codePointAt(0) ?? 0), 0x01000193) >>> 0;
  PRINTS.set(record, hash % P ** PRINT);
  return hash % P ** PRINT;
}

/**
 * @param {number[]} rest  after the letters before
 * @param {number} value  of a letter
 */
function restAfter(rest, value) {
  const over = (value + rest[3]) % P;
  return CHECK.map((each, k) => ((k ? rest[k - 1] : 0) + (P - over) * each) % P);
}
const sealOf = (/** @type {number[]} */ rest) => SEAL.map((seal, k) => (P - rest[3 - k] + seal) % P);

/**
 * @param {number[]} values  of letters
 * @returns {number[]}  of those that check them
 */
const checkOf = (values) => sealOf(values.reduce(restAfter, START));

/** Letters that come one after the other, and whether the last of them check those before: a step for each. */
export class Checked {
  letters = '';
  #rests = [START];
  /** @param {string} more  of LETTERS */
  add(more) {
    for (const each of more) this.#rests.push(restAfter(this.#rests[this.#rests.length - 1], LETTERS.indexOf(each)));
    this.letters += more;
  }
  get right() {
    const end = this.letters.length - SEAL.length;
    if (end < HEAD + PRINT) return false;
    return sealOf(this.#rests[end]).every((value, k) => this.letters[end + k] === LETTERS[value]);
  }
}

/**
 * Letters that hide others: the same for the same head.
 * @param {number[]} head
 */
function* maskOf(head) {
  let state = head.reduce((sum, each) => sum * P + each, 1);
  for (;;) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    yield Math.floor((state / 2 ** 32) * P);
  }
}

/**
 * @param {number[]} head
 * @param {number[]} values
 * @param {1 | -1} way
 */
function masked(head, values, way) {
  const mask = maskOf(head);
  return values.map((value) => (value + way * Number(mask.next().value) + P) % P);
}

/**
 * Least digit first.
 * @param {bigint} number
 * @param {number} count
 */
const valuesOf = (number, count) =>
  Array.from({ length: count }, (_, k) => Number((number / SIZE ** BigInt(k)) % SIZE));

/**
 * The code of answers.
 * @param {Asks} record
 * @param {Answers} given
 * @param {number} salt  a whole number below `SALTS`, so that the same answers have other letters
 */
export function codeOf(record, given, salt) {
  let [number, size] = [BigInt(printOf(record)), SIZE ** BigInt(PRINT)];
  const write = (/** @type {number} */ value, /** @type {number} */ base) => {
    number += size * BigInt(value);
    size *= BigInt(base);
    return value;
  };
  for (const part of questionsOf(record)) KINDS[part.kind](write, part, given[part.name] ?? null);
  let count = 0;
  while (SIZE ** BigInt(count) < size || (count + HEAD + SEAL.length) % GROUP) count += 1;
  const head = [FORM, ...valuesOf(BigInt(salt), HEAD - 1)];
  const body = [...head, ...masked(head, valuesOf(number, count), 1)];
  return grouped([...body, ...checkOf(body)].map((value) => LETTERS[value]).join(''));
}

/**
 * A code as it is shown, however it was written.
 * @param {string} written
 */
export const grouped = (written) => plain(written).replace(/.{4}(?=.)/g, '$&-');

/**
 * Its letters, large ones, without what is between groups.
 * @param {string} written
 */
export const plain = (written) => written.toUpperCase().replace(/[\s–—_.-]/g, '');

/**
 * What a code says. Raises CodeError for one that is mistyped, of a later form, or of another lesson.
 * @param {Asks} record
 * @param {string} written  small letters or large ones, with whatever between groups
 * @returns {Answers}
 */
export function readCode(record, written) {
  const letters = plain(written);
  if (letters.length > MOST_LETTERS) throw new CodeError('check');
  const wrong = [...letters].find((each) => !LETTERS.includes(each));
  if (letters.length < HEAD + PRINT + SEAL.length) throw new CodeError('short');
  if (wrong) throw new CodeError('sign', wrong);
  const values = [...letters].map((each) => LETTERS.indexOf(each));
  const body = values.slice(0, -SEAL.length);
  if (checkOf(body).join() !== values.slice(-SEAL.length).join()) throw new CodeError('check');
  if (values[0] !== FORM) throw new CodeError('form');
  const head = body.slice(0, HEAD);
  let number = masked(head, body.slice(HEAD), -1).reduceRight((sum, each) => sum * SIZE + BigInt(each), 0n);
  const read = (/** @type {number} */ _, /** @type {number} */ base) => {
    const digit = Number(number % BigInt(base));
    number /= BigInt(base);
    return digit;
  };
  if (read(0, P ** PRINT) !== printOf(record)) throw new CodeError('other');
  const given = questionsOf(record).map((part) => [part.name, KINDS[part.kind](read, part, null)]);
  if (number) throw new CodeError('other');
  return Object.fromEntries(given);
}
