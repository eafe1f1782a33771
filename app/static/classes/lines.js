// Codes of a class as they were put in, one a line or several, each behind a name or not, or broken over lines: which
// are read, and why others are not.
import { Checked, CodeError, FORM, GROUP, grouped, LETTERS, MOST_LETTERS, plain, readCode } from '../lesson/code.js';

/** @import { Answers, Asks } from '../lesson/code.js' */

/** @typedef {{ line: number, name: string, code: string, given: Answers }} Row */
/**
 * `other`: line of the same
 * @typedef {{ line: number, words: string, why: string, sign: string, other: number }} Unread
 */
/** @typedef {{ line: number, words: string }} Line */
/**
 * What stands between separators: its letters as codes have them, and how many no code has.
 * @typedef {{ line: Line, from: number, to: number, letters: string, wrong: number }} Piece
 */

export const MOST = 500; // lines that are read at once
const SIGNS = 100_000; // of all lines: those after them are too many
const NAME = 80; // signs of a name
const SHOWN = 40; // signs that are said of what cannot be read
const PIECES = 24; // that a code may be broken into
const TRIES = 3; // to read one from where it begins: only by chance, of 130 000, is a part of one checked by its end
const LEAST = 12; // letters of a code
const RARE = 8; // letters of a code for each wrong sign, else it is words

/**
 * Lines with something in them, as many as are read at once.
 * @param {string} written
 */
function linesIn(written) {
  const all = written
    .split('\n')
    .map((words, k) => ({ line: k + 1, words: words.trim() }))
    .filter(({ words }) => words);
  let signs = 0;
  const fits = all.findIndex(({ words }, k) => k >= MOST || (signs += words.length) > SIGNS);
  const lines = fits < 0 ? all : all.slice(0, fits);
  return { lines, beyond: all.length - lines.length };
}

/**
 * @param {Line} line
 * @returns {Piece[]}
 */
const piecesOf = (line) =>
  [...line.words.matchAll(/[^\s,;:|/"']+/g)].map(({ 0: piece, index }) => {
    const letters = plain(piece);
    const wrong = [...letters].filter((each) => !LETTERS.includes(each)).length;
    return { line, from: index, to: index + piece.length, letters, wrong };
  });

/** @param {Piece[]} pieces */
const joined = (pieces) => pieces.map(({ letters }) => letters).join('');

/**
 * @param {Asks} record
 * @param {string} letters
 * @returns {Answers | CodeError}
 */
function tried(record, letters) {
  try {
    return readCode(record, letters);
  } catch (error) {
    if (!(error instanceof CodeError)) throw error;
    return error;
  }
}

/**
 * The code that begins with a piece, which may end in a later line.
 * @param {Asks} record
 * @param {Piece[]} pieces
 * @param {number} from
 * @returns {{ code: string, given: Answers, to: number } | null}
 */
function codeAt(record, pieces, from) {
  if (!pieces[from].letters.startsWith(LETTERS[FORM])) return null;
  const read = new Checked();
  let tries = 0;
  for (let to = from; to < Math.min(from + PIECES, pieces.length) && !pieces[to].wrong && tries < TRIES; to++) {
    if (read.letters.length + pieces[to].letters.length > MOST_LETTERS) return null;
    read.add(pieces[to].letters);
    if (read.letters.length % GROUP || !read.right) continue;
    tries += 1;
    const given = tried(record, read.letters);
    if (!(given instanceof CodeError)) return { code: grouped(read.letters), given, to: to + 1 };
  }
  return null;
}

/**
 * Of words, those that are most like a code, as it is where a letter is wrong; none, where they are like no code.
 * @param {Piece[]} words
 * @returns {[from: number, to: number]}
 */
function likeCode(words) {
  let [most, begun, sum, from, to] = [0, 0, 0, 0, 0];
  for (const [k, { letters, wrong }] of words.entries()) {
    if (sum < 0) [begun, sum] = [k, 0];
    sum += letters.length - RARE * wrong;
    if (sum > most) [most, from, to] = [sum, begun, k + 1];
  }
  return joined(words.slice(from, to)).length >= LEAST ? [from, to] : [0, 0];
}

/**
 * Why words of a line are no code of the lesson.
 * @param {Asks} record
 * @param {Piece[]} words
 */
function faultOf(record, words) {
  const found = words.slice(...likeCode(words)).slice(-PIECES);
  const whys = found.flatMap((_, k) => {
    const each = tried(record, joined(found.slice(k)));
    return each instanceof CodeError ? each : [];
  });
  const whole = whys.find(({ why }) => why === 'other' || why === 'form'); // behind a name that has letters alone
  const part = words.some(({ letters, wrong }) => !wrong && letters.length >= GROUP);
  return whole ?? whys[0] ?? new CodeError(part ? 'short' : 'words');
}

/**
 * Pieces of one line as they are written there, without separators at their ends.
 * @param {Piece[]} pieces
 */
function writtenAs(pieces) {
  const some = pieces.filter(({ letters }) => letters);
  return some.length ? some[0].line.words.slice(some[0].from, some[some.length - 1].to) : '';
}

/**
 * @param {Asks} record  the lesson
 * @param {string} written
 * @returns {{ rows: Row[], unread: Unread[], beyond: number }}  `beyond`: lines that are too many
 */
export function readLines(record, written) {
  const { beyond, lines } = linesIn(written);
  const pieces = lines.flatMap(piecesOf);
  /** @type {Row[]} */
  const rows = [];
  /** @type {Unread[]} */
  const unread = [];
  /** @type {Map<string, number>} */
  const known = new Map();
  const refuse = (/** @type {Piece[]} */ words) => {
    for (const line of new Set(words.map((each) => each.line))) {
      const own = words.filter((each) => each.line === line);
      const said = writtenAs(own).slice(0, SHOWN);
      const { sign, why } = faultOf(record, own);
      if (said) unread.push({ line: line.line, words: said, why, sign, other: 0 });
    }
  };
  let words = 0; // where they begin, before the next code
  for (let k = 0; k < pieces.length; ) {
    const found = codeAt(record, pieces, k);
    if (!found) {
      k += 1;
      continue;
    }
    const { code, given, to } = found;
    const { line } = pieces[k];
    const before = pieces.slice(words, k);
    const own = before.filter((each) => each.line === line);
    const [, named] = likeCode(own); // a name is behind a code that cannot be read
    refuse(before.slice(0, before.length - own.length + named));
    const name = writtenAs(own.slice(named));
    const other = known.get(code);
    if (other) unread.push({ line: line.line, words: line.words.slice(0, SHOWN), why: 'twice', sign: '', other });
    else rows.push({ line: line.line, name: name.slice(0, NAME), code, given });
    known.set(code, other ?? line.line);
    words = k = to;
  }
  refuse(pieces.slice(words));
  return { rows, unread, beyond };
}
