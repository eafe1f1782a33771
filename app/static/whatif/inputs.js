// Inputs and figures of designs as a table: what the file of each scene holds, by its keys, and what is found of it.
import { roomOf } from '../compare/kinds.js';
import { family, text } from '../text/catalogue.js';
import { COLUMNS } from '../wasm/columns.js';

/** @import { Frame } from '../messages.js' */
/** @typedef {Map<string, string | number | boolean>} Inputs  by key of the scene file */
/** @typedef {{ name: string, frame: Frame, found: ArrayLike<number> }} Design  its figures as COLUMNS has them */

const SAID = ['title', 'source', 'note', 'saved', 'view']; // of a scene file: no inputs
const PART = /^(?:impactor|target)\.(?:(?:rods|links|joints)\.\d+\.)?/;
/** @type {Record<string, string>} */
const UNITS = {
  ...{ 'contact.yield_indentation': 'm', 'contact.full_indentation': 'm' },
  duration: 's',
  ...{ impactor_velocity: 'm/s', target_velocity: 'm/s', peak_force: 'N', contact_time: 's' },
  ...{ peak_indentation: 'm', peak_stress: 'Pa' },
};
const BODIES = family('body.unit');
const STIFFNESS = 'contact.stiffness';

/**
 * What a scene file holds, each value on one line as the server writes it, parts of tables and lists by keys of their
 * own.
 * @param {string} toml
 * @returns {Inputs}
 */
export function inputsOf(toml) {
  /** @type {Inputs} */
  const found = new Map();
  let table = '';
  for (const line of toml.split('\n')) {
    const head = /^\[([\w.-]+)\]$/.exec(line.trim());
    const [, key, rest] = /^([\w-]+) = (.*)$/.exec(line.trim()) ?? [];
    if (head) table = `${head[1]}.`;
    else if (key) flatten(table + key, new Reader(rest).value(), found);
  }
  for (const key of [...found.keys()]) if (SAID.includes(key.split('.')[0])) found.delete(key);
  return found;
}

/**
 * @param {string} key
 * @param {any} value
 * @param {Inputs} found
 */
function flatten(key, value, found) {
  const list = Array.isArray(value) && value.every((each) => typeof each !== 'object');
  if (list) found.set(key, value.join(' '));
  else if (value && typeof value === 'object')
    for (const [name, each] of Object.entries(value)) flatten(`${key}.${name}`, each, found);
  else found.set(key, value);
}

/** Values of TOML that stand on one line. */
class Reader {
  at = 0;

  /** @param {string} line */
  constructor(line) {
    this.line = line;
  }
  /** @param {RegExp} pattern  sticky */
  #take(pattern) {
    pattern.lastIndex = this.at;
    const [found = ''] = pattern.exec(this.line) ?? [];
    this.at += found.length;
    return found;
  }
  /** @returns {any} */
  value() {
    const first = this.line[this.at];
    if (first === '"') return JSON.parse(this.#take(/"(?:[^"\\]|\\.)*"/y));
    if (first === '[') return this.#all(']', (/** @type {any[]} */ all) => all.push(this.value()), []);
    if (first === '{')
      return this.#all(
        '}',
        (/** @type {any} */ all) => (all[this.#take(/[\w-]+ = /y).slice(0, -3)] = this.value()),
        {},
      );
    const word = this.#take(/[^,\s\]}]*/y);
    return word === 'true' || (word === 'false' ? false : Number(word));
  }
  /**
   * @template All
   * @param {string} end
   * @param {(all: All) => void} next
   * @param {All} all
   */
  #all(end, next, all) {
    this.#take(/[[{]\s*/y);
    while (this.at < this.line.length && this.line[this.at] !== end) {
      const before = this.at;
      next(all);
      this.#take(/[\s,]*/y);
      if (this.at === before) break; // it is none that the server writes
    }
    this.at += 1;
    return all;
  }
}

/**
 * @param {string} key
 * @param {Design[]} designs
 */
function unitOf(key, designs) {
  if (key !== STIFFNESS)
    return UNITS[key.replace(/^method\./, '')] ?? (PART.test(key) ? (BODIES[key.replace(PART, '')] ?? '') : '');
  const powers = new Set(designs.map(({ frame }) => roomOf(frame).law(frame).exponent));
  const [power] = powers;
  return powers.size > 1 ? 'N/m^n' : power === 1 ? 'N/m' : `N/m^${power}`;
}

/** @param {string | number | boolean | undefined} value */
const cellOf = (value) => {
  if (value === undefined || (typeof value === 'number' && !Number.isFinite(value))) return '';
  const written = String(value);
  return /[",\n]/.test(written) ? `"${written.replaceAll('"', '""')}"` : written;
};

/**
 * All of them as comma-separated values, below the link to them: readers of tables skip lines that begin with #.
 * @param {Design[]} designs
 * @param {string} link
 */
export function tableOf(designs, link) {
  const inputs = designs.map(({ frame }) => inputsOf(frame.head));
  const keys = [...new Set(inputs.flatMap((each) => [...each.keys()]))];
  const figures = COLUMNS.slice(1);
  const head = [...keys, ...figures].map((key) => [key, unitOf(key, designs)]);
  const names = head.map(([key, unit]) => (unit ? `${key} [${unit}]` : key));
  const rows = designs.map(({ found, frame, name }, k) => [
    ...[name, String(frame.chosen.scene), ...keys.map((key) => inputs[k].get(key))],
    ...figures.map((_, n) => found[n + 1]),
  ]);
  const lines = [[text('whatif.design'), 'scene', ...names], ...rows].map((row) => row.map(cellOf).join(','));
  return [`# link = ${JSON.stringify(link)}`, ...lines, ''].join('\n');
}
