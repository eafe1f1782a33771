// The command and the Python lines that find the same numbers again: which keys of the scene file the server says that
// an axis stands for, and the values that they have along it.

/** @import { Result } from './results.js' */

const DIGITS = 15;
const ROUNDING = 2e-11; // relative, of choices to 12 digits
const SAME = 1e-9; // relative: a value that is that of an even range
/** By the names of results: those of figures of the library, where they differ. */
const FIGURES = /** @type {Record<string, string>} */ ({
  vibration: 'vibration_share',
  dissipated: 'dissipated_share',
});

/** @typedef {(number | null)[]} Values  none where it is refused */
/** @typedef {[key: string, words: string]} Varied  as `impact study` reads them */

/** @param {Result} name */
export const figureOf = (name) => FIGURES[name] ?? name;

/** @param {number} value */
const plain = (value) => String(Number(value.toPrecision(DIGITS)));

/**
 * Evenly spaced values, or those of a constant factor, as a range; nothing where they are neither.
 * @param {Values} values
 */
function rangeOf(values) {
  const count = values.length;
  const [first, last] = [values[0], values[count - 1]];
  if (first === null || last === null || first === last || count < 2) return null;
  const even = (/** @type {number} */ k) => first + (k / (count - 1)) * (last - first);
  const steady = (/** @type {number} */ k) => first * (last / first) ** (k / (count - 1));
  const ways = first > 0 && last > 0 ? [['log', steady], ['linear', even]] : [['linear', even]]; // prettier-ignore
  for (const [spacing, of] of /** @type {[string, (k: number) => number][]} */ (ways)) {
    const near = (/** @type {number | null} */ value, /** @type {number} */ k) =>
      value === null || Math.abs(value - of(k)) <= SAME * Math.max(Math.abs(value), Math.abs(of(k)));
    if (values.every(near)) {
      const [low, high] = [Math.min(first, last), Math.max(first, last)];
      return `${plain(low)}..${plain(high)}:${count}:${spacing}`;
    }
  }
  return null;
}

/**
 * What is varied, of the values that keys have one after another; nothing where there are none.
 * @param {Record<string, Values>} keys
 * @returns {Varied | null}
 */
export function variedOf(keys) {
  const names = Object.keys(keys);
  if (!names.length) return null;
  if (names.length === 1) {
    const [values] = Object.values(keys);
    const known = values.filter((value) => value !== null);
    return [names[0], rangeOf(values) ?? [...new Set(known.map(plain))].join(',')];
  }
  const rows = keys[names[0]].map((_, k) => names.map((name) => keys[name][k]));
  const known = rows.filter((row) => row.every((value) => value !== null));
  return [names.join(','), known.map((row) => `(${row.map((value) => plain(Number(value))).join(',')})`).join(',')];
}

/**
 * Values of keys along two axes: along the first one, along the other one, at the corner of both. Nothing where a key
 * goes with both, so that they cannot be varied apart.
 * @param {Record<string, Values>} keys
 * @param {number} across  values along the first axis; the corner is the last of all
 * @returns {[x: Record<string, Values>, y: Record<string, Values>] | null}
 */
export function apart(keys, across) {
  const parts = /** @type {[Record<string, Values>, Record<string, Values>]} */ ([{}, {}]);
  for (const [name, values] of Object.entries(keys)) {
    const [x, y] = [values.slice(0, across), values.slice(across, -1)];
    const moved = [x, y].map((some) => differ(some));
    if (moved[0] && moved[1]) return null;
    const own = moved[0] ? x : y;
    if (differ([own[own.length - 1], values[values.length - 1]])) return null;
    parts[moved[0] ? 0 : 1][name] = own;
  }
  return parts;
}

/** @param {Values} values */
function differ(values) {
  const known = values.filter((value) => value !== null);
  return known.some((value) => Math.abs(value - known[0]) > ROUNDING * Math.abs(known[0]));
}

/**
 * What is known within tolerances: between the lowest and the highest value of a key, evenly.
 * @param {Record<string, Values>} keys  at both ends of an input
 * @returns {Varied | null}  nothing where there is not one key
 */
export function withinOf(keys) {
  const [found, more] = Object.entries(keys);
  const [low, high] = (found?.[1] ?? []).toSorted((a, b) => Number(a) - Number(b));
  if (!found || more || low === null || high === null || low === high) return null;
  return [found[0], `${plain(low)}..${plain(high)}`];
}

/** @param {string} word  As a shell reads it. */
const quoted = (word) => (/[^\w.,:=+/-]/.test(word) ? `"${word}"` : word);

const QUESTIONS = /** @type {Partial<Record<Result, string>>} */ ({
  peak_force: 'peak-force',
  ...{ impactor_velocity: 'final-velocities', target_velocity: 'final-velocities', newton: 'final-velocities' },
  contact_time: 'contact-times',
  peak_stress: 'stresses',
});

/**
 * Command and Python by which the library says which model is enough; nothing for what it has no question for.
 * @param {string} file
 * @param {Result} result
 * @param {number} bound
 */
export function planOf(file, result, bound) {
  const question = QUESTIONS[result];
  if (!question) return null;
  const python = [
    ['import', 'solvers'].join(' '),
    '',
    `found = solvers.plan(solvers.load("${file}"), "${question}", ${bound}, solve=True)`,
    'print(found.table())',
  ];
  return {
    command: ['impact', 'plan', file, '--question', question, '--tolerance', bound, '--solve'].join(' '),
    python: python.join('\n'),
  };
}

/**
 * @param {'study' | 'uncertain'} what
 * @param {string} file
 * @param {Varied[]} varied
 * @param {string[]} figures
 */
export function commandOf(what, file, varied, figures) {
  const option = what === 'study' ? '--vary' : '--tolerance';
  const words = varied.flatMap((each) => [option, quoted(each.join('='))]);
  const out = what === 'study' ? ['--out', file.replace(/\.toml$/, '.nc')] : [];
  const command = ['impact', what, file, ...words, ...figures.flatMap((name) => ['--figure', name]), ...out].join(' ');
  return what === 'study' ? `${command}\n${['impact', 'report', out[1]].join(' ')}` : command;
}

/**
 * @param {'study' | 'uncertain'} what
 * @param {string} file
 * @param {Varied[]} varied
 * @param {string[]} figures
 */
export function pythonOf(what, file, varied, figures) {
  const name = what === 'study' ? 'data' : 'found';
  const keys = varied.map(([key, words]) => `        "${key}": "${words}",`);
  const list = figures.map((figure) => `"${figure}"`).join(', ');
  return [
    ['import', 'solvers'].join(' '),
    '',
    `${name} = solvers.${what}(`,
    `    "${file}",`,
    '    {',
    ...keys,
    '    },',
    `    figures=[${list}],`,
    ')',
    what === 'study' ? `solvers.report(${name}).save("${file.replace(/\.toml$/, '.html')}")` : `print(${name})`,
  ].join('\n');
}
