// Codes of a class as they were put in, one a line, each behind a name or not: which are read, and why others are not.
import { CodeError, grouped, readCode } from '../lesson/code.js';

/** @import { Answers, Asks } from '../lesson/code.js' */

/** @typedef {{ line: number, name: string, code: string, given: Answers }} Row */
/**
 * `other`: line of the same
 * @typedef {{ line: number, words: string, why: string, sign: string, other: number }} Unread
 */

export const MOST = 500; // lines that are read at once
const LONGEST = 400; // signs of a line
const NAME = 80; // signs of a name
const SHOWN = 40; // signs that are said of a line that cannot be read
const PIECES = 24; // of a line, that a code may be broken into
const WHYS = ['other', 'form', 'check', 'sign', 'short']; // what says most of a line first

/**
 * The code at the end of a line, whatever is between its groups, and what is before it.
 * @param {Asks} record
 * @param {string} line
 * @returns {{ name: string, code: string, given: Answers } | CodeError}
 */
function readLine(record, line) {
  const pieces = [...line.matchAll(/[^\s,;"']+/g)].slice(-PIECES);
  let why = new CodeError('short');
  for (let n = 1; n <= pieces.length; n++) {
    const last = pieces.slice(-n);
    const [first, ...others] = last.map(([piece]) => piece.toUpperCase());
    const code = grouped([first, ...others].join(''));
    try {
      const given = readCode(record, code);
      const name = line.slice(0, last[0].index).replace(/^[\s"']+|[\s,;:"']+$/g, '');
      return { name: name.slice(0, NAME), code, given };
    } catch (error) {
      if (!(error instanceof CodeError)) throw error;
      const named = others.length && error.sign && !others.join('').includes(error.sign);
      if (!named && WHYS.indexOf(error.why) < WHYS.indexOf(why.why)) why = error; // a name has any signs
    }
  }
  return why;
}

/**
 * @param {Asks} record  the lesson
 * @param {string} written
 * @returns {{ rows: Row[], unread: Unread[], beyond: number }}  `beyond`: lines that are too many
 */
export function readLines(record, written) {
  const lines = written
    .split('\n')
    .map((each, k) => ({ line: k + 1, words: each.trim().slice(0, LONGEST) }))
    .filter(({ words }) => words);
  /** @type {Row[]} */
  const rows = [];
  /** @type {Unread[]} */
  const unread = [];
  /** @type {Map<string, number>} */
  const known = new Map();
  for (const { line, words } of lines.slice(0, MOST)) {
    const found = readLine(record, words);
    const refused = (/** @type {string} */ why, sign = '', other = 0) =>
      unread.push({ line, words: words.slice(0, SHOWN), why, sign, other });
    if (found instanceof CodeError) refused(found.why, found.sign);
    else if (known.has(found.code)) refused('twice', '', known.get(found.code));
    else {
      known.set(found.code, line);
      rows.push({ line, ...found });
    }
  }
  return { rows, unread, beyond: Math.max(lines.length - MOST, 0) };
}
