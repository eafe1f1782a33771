// All codes of a class in a table: a row each, a column for each question.
import { headOf, make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { signOf } from '../lesson/answered.js';
import { questionsOf } from '../lesson/code.js';
import { saidRight } from './sums.js';

/** @import { Answer } from '../lesson/code.js' */
/** @import { Record_ } from '../lesson/lesson.js' */
/** @import { Part } from '../lesson/questions.js' */
/** @import { Row } from './lines.js' */

/**
 * What was answered first, and what came of all tries.
 * @param {string} first
 * @param {Answer} given
 */
const triedOf = (first, { right = false, tries = 0 }) => [
  ...[text('class.tried', { first, right, tries }), ' '],
  signOf(right),
];

/** @type {Record<string, (part: Part, given: Answer) => (Node | string)[]>} */
const CELLS = {
  choice: ({ options }, { picked = 0 }) => [`${picked + 1} `, saidRight(Boolean(options[picked].right))],
  number: (_, given) => triedOf(`${figures(given.value ?? 0, 4)} ${given.unit}`, given),
  order: (_, given) => {
    const { order = [] } = given;
    const count = order.filter((item, k) => item === k).length;
    return triedOf(text('class.in-place', { count, all: order.length }), given);
  },
  set: (_, { places = [] }) => [places.map((place) => (place === null ? '–' : figures(place))).join('; ')],
  sketch: (_, { late = false, outcomes = [] }) => {
    const count = outcomes.filter((each) => each === 'yes').length;
    const signs = outcomes.map((each) => (each === 'yes' ? '✓' : '○')).join('');
    const said = make('span', {
      className: 'class-unseen',
      textContent: text('class.met', { count, all: outcomes.length }),
    });
    return [make('span', { textContent: signs, ariaHidden: 'true' }), said, ...(late ? [' ', text('class.late')] : [])];
  },
};

/**
 * @param {Record_} record  the lesson
 * @param {Row[]} rows
 */
export function rowsOf(record, rows) {
  const parts = questionsOf(record);
  const titles = parts.map((part) => record.steps.find((step) => step.parts.includes(part))?.title ?? '');
  const head = headOf([text('class.line'), text('class.name'), text('class.student'), ...titles]);
  const body = rows.map(({ code, line, name, given }) => {
    const cells = parts.map((part) => {
      const answer = given[part.name];
      return make('td', {}, ...(answer ? CELLS[part.kind](part, answer) : ['–']));
    });
    const about = make('th', { scope: 'row', textContent: line });
    const written = make('td', {}, make('code', { textContent: code.slice(0, 9) }), code.length > 9 ? ' …' : '');
    written.title = code;
    return make('tr', {}, about, make('td', { textContent: name }), written, ...cells);
  });
  const caption = make('caption', { textContent: text('class.each') });
  const root = make('div', { className: 'class-scroll', role: 'group', tabIndex: 0, ariaLabel: text('class.each') });
  root.append(make('table', {}, caption, head, make('tbody', {}, ...body)));
  return root;
}
