// All codes of a class as comma-separated values: a row each, numbers with a point.
import { questionsOf } from '../lesson/code.js';

/** @import { Asks, Answer } from '../lesson/code.js' */
/** @import { Part } from '../lesson/questions.js' */
/** @import { Row } from './lines.js' */

const FORMULA = /^[=+\-@\t\r]/; // what a spreadsheet would work out
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
  choice: () => [['', ({ picked = -1 }) => picked + 1]],
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
  ['.right', ({ right }) => right],
];

/**
 * Options and items are counted from 1, as the lesson file has them; what was left out is empty.
 * @param {Asks} record  the lesson
 * @param {Row[]} rows
 */
export function csvOf(record, rows) {
  const columns = questionsOf(record).flatMap((part) =>
    COLUMNS[part.kind](part).map(([ending, cell]) => ({ name: part.name, ending, cell })),
  );
  const head = ['name', 'code', ...columns.map(({ ending, name }) => name + ending)];
  const lines = rows.map(({ code, name, given }) => [
    name,
    code,
    ...columns.map((column) => {
      const answer = given[column.name];
      return answer && column.cell(answer);
    }),
  ]);
  return BOM + [head, ...lines].map((cells) => `${cells.map(quoted).join(',')}\r\n`).join('');
}
