// All codes of a class as comma-separated values: a row each, numbers with a point.
import { questionsOf } from '../lesson/code.js';

/** @import { Asks, Answer } from '../lesson/code.js' */
/** @import { Part } from '../lesson/questions.js' */
/** @import { Row } from './lines.js' */
/** @typedef {{ text?: string, nodes?: Node_[] }} Node_  of a sentence */

const FORMULA = /^[=+\-@\t\r]/; // what a spreadsheet would work out
const POINTS = ['points', 'points.first', 'points.most']; // in the end, at the first try, and how many there can be
const EMAIL = /[^\s,;|<>"'()]+@[^\s,;|<>"'()]+\.[^\s,;|<>"'()]+/;
const ID = /(?<![\p{L}\d+./-])\p{Lu}{0,3}\d{5,}(?![\p{L}\d./-])/u; // of a student, as a course has it
const EDGES = /^[\s,;|<>()]+|[\s,;|<>()]+$/g; // what is left of separators
const BOM = '\ufeff'; // by which spreadsheets know the coding
/** @typedef {string | number | boolean | null | undefined} Cell */

/**
 * Words, such as a name, are never a formula; numbers may begin with a minus.
 * @param {Cell} cell
 */
function quoted(cell) {
  const words = String(cell ?? '').replaceAll('"', '""');
  return typeof cell === 'string' && FORMULA.test(cell) ? `"'${words}"` : `"${words}"`;
}

/**
 * Columns of a question: what each is called, behind the name of the question, and what an answer has in it.
 * @type {Record<string, (part: Part) => [name: string, cell: (given: Answer) => Cell][]>}
 */
const COLUMNS = {
  choice: (part) => [
    ['', ({ picked = -1 }) => picked + 1],
    ['.text', ({ picked = -1 }) => wordsOf(part.options[picked]?.text ?? [])],
    ['.right', (given) => sharesOf(part, given)[0] === 1],
  ],
  number: () => [['', ({ value }) => value], ['.unit', ({ unit }) => unit], ...TRIED],
  order: () => [['', ({ order = [] }) => order.map((item) => item + 1).join(' ')], ...TRIED],
  set: ({ found }) =>
    found.map((/** @type {Part} */ _, /** @type {number} */ k) => [
      `.${k + 1}`,
      (/** @type {Answer} */ { places }) => places?.[k],
    ]),
  sketch: ({ judges }) => [
    ...judges.map((/** @type {Part} */ { criterion }, /** @type {number} */ k) => [
      `.${k + 1}.${criterion}`,
      (/** @type {Answer} */ { outcomes }) => outcomes?.[k],
    ]),
    ['.late', ({ late }) => late],
    ['.line', ({ line = [] }) => line.map((value) => Number(value.toPrecision(4))).join(' ')],
  ],
};
/** @type {[name: string, cell: (given: Answer) => Cell][]} */
const TRIED = [
  ['.tries', ({ tries }) => tries],
  ['.first', ({ right, tries }) => Boolean(right) && tries === 1],
  ['.right', ({ right }) => right],
];

/**
 * @param {Node_[]} nodes
 * @returns {string}
 */
const wordsOf = (nodes) => nodes.map(({ nodes: inner, text }) => text ?? wordsOf(inner ?? [])).join('');

/**
 * What of an answer is right in the end, and at the first try, from 0 to 1: of a line its criteria. A slider and a line
 * are not tried again.
 * @param {Part} part
 * @param {Answer} given
 * @returns {[right: number, first: number]}
 */
export function sharesOf({ judges, kind, options }, { outcomes = [], picked = -1, places = [], right, tries }) {
  if (kind === 'number' || kind === 'order') return [Number(Boolean(right)), Number(Boolean(right) && tries === 1)];
  const met = outcomes.filter((outcome) => outcome === 'yes').length / (judges?.length || 1);
  const found = Number(places.some((place) => place !== null));
  const share = kind === 'choice' ? Number(Boolean(options[picked]?.right)) : kind === 'set' ? found : met;
  return [share, share];
}

/**
 * Points of a student: one for each question, of a line a part of it.
 * @param {Part[]} parts
 * @param {Row['given']} given
 */
function pointsOf(parts, given) {
  const shares = parts.map((part) => {
    const answer = given[part.name];
    return answer ? sharesOf(part, answer) : [0, 0];
  });
  const sum = (/** @type {0 | 1} */ which) => Number(shares.reduce((all, share) => all + share[which], 0).toFixed(2));
  return [sum(0), sum(1), parts.length];
}

/**
 * Who has answered: what stands before a code, and in it the address and number by which a course finds a student.
 * @param {string} written
 * @returns {[name: string, email: string, id: string]}
 */
export function whoOf(written) {
  const [email = ''] = EMAIL.exec(written) ?? [];
  const others = written.replace(email, '');
  const [id = ''] = ID.exec(others) ?? [];
  const name = others.replace(id, '').replace(/(\s*[,;|<>()]\s*){2,}/g, ', ');
  return email || id ? [name.replace(EDGES, ''), email, id] : [written, '', ''];
}

/**
 * Options and items are counted from 1, as the lesson file has them; what was left out is empty.
 * @param {Asks} record  the lesson
 * @param {Row[]} rows
 */
export function csvOf(record, rows) {
  const parts = questionsOf(record);
  const columns = parts.flatMap((part) =>
    COLUMNS[part.kind](part).map(([ending, cell]) => ({ name: part.name, ending, cell })),
  );
  const head = ['name', 'email', 'id', 'code', ...POINTS, ...columns.map(({ ending, name }) => name + ending)];
  const lines = rows.map(({ code, name, given }) => [
    ...whoOf(name),
    code,
    ...pointsOf(parts, given),
    ...columns.map((column) => {
      const answer = given[column.name];
      return answer && column.cell(answer);
    }),
  ]);
  return BOM + [head, ...lines].map((cells) => `${cells.map(quoted).join(',')}\r\n`).join('');
}
