// Kept solutions beside the one that is shown, in the story and among the numbers.
import { KEPT } from '../charts/styles.js';
import { headOf, make, rowOf } from '../browser/dom.js';
import { headed, heading } from '../frame/story.js';
import { text } from '../text/catalogue.js';
import { bound, comparedOf, difference, leastSaid, sentences, sideBySide, written } from './figures.js';
import { differing, lineOf, titleOf } from '../form/settings.js';
import { comparable } from './kinds.js';
import { verdictOf } from './verdict.js';

/** @import { Frame } from '../messages.js' */
/** @import { Letter } from '../frame/kept.js' */
/** @import { Run } from './run.js' */

/**
 * The sign of a kept solution, in its colour.
 * @param {Letter} letter
 */
export function signOf(letter) {
  const sign = make('b', { className: 'sign-of', textContent: letter });
  sign.style.background = KEPT[letter];
  return sign;
}

/**
 * A value that goes on a second line with its whole unit, if at all.
 * @param {string} words
 */
const parted = (words) => words.replace(/ (.*)/, (_, unit) => ` ${bound(unit)}`);

const SENTENCES = /(?<=[.!?]) +(?=\p{Lu})/u; // between them

/**
 * What is said of kept solutions: their letters, in what they differ, what the comparison is of, what it teaches, and
 * by how much their figures differ.
 * @typedef {{ letters: Letter[], head: string, help?: string, teaches?: string, lines?: string[] }} Paragraph
 */

/**
 * One paragraph for each kept solution, and one for all that are another kind of impact. What one has said the next
 * does not say again.
 * @param {Frame} now
 * @param {Run[]} runs
 * @param {string | null} coming
 * @returns {Paragraph[]}
 */
export function paragraphsOf(now, runs, coming) {
  const others = runs.filter(({ frame }) => !comparable(now, frame));
  const names = others.map(({ frame, letter }) => text('compare.other-name', { name: letter, title: titleOf(frame) }));
  const head = text('compare.other-kind', { names, count: names.length });
  const apart = others.length ? [{ letters: others.map(({ letter }) => letter), head }] : [];
  const met = new Set();
  const once = (/** @type {string | undefined} */ words) =>
    (words ?? '')
      .split(SENTENCES)
      .filter((each) => !met.has(each) && met.add(each))
      .join(' ');
  const own = runs.filter(({ frame }) => comparable(now, frame)).map((run) => paragraphOf(now, run, coming));
  return [...own.map((each) => ({ ...each, help: once(each.help), teaches: once(each.teaches) })), ...apart];
}

/**
 * @param {Frame} now
 * @param {Run} run
 * @param {string | null} coming
 * @returns {Paragraph}
 */
function paragraphOf(now, { asked, frame, letter }, coming) {
  const names = differing([now, frame]);
  const settings = { name: letter, now: lineOf(names, now), settings: lineOf(names, frame) };
  if (!names.length) return { letters: [letter], head: coming ?? text('compare.against-same', settings) };
  const which = comparedOf(now, frame);
  const [own, other] = sideBySide([
    [now, which],
    [frame, which],
  ]);
  const found = sentences(own, other);
  return {
    letters: [letter],
    head: text('compare.against', settings),
    help: which === 'other' ? text('compare.only-method') : '',
    teaches: verdictOf(now, frame, names, asked),
    lines: found.length ? found : [leastSaid(own, other)],
  };
}

/** @param {Paragraph} paragraph */
function paragraph({ letters, head, help, teaches, lines = [] }) {
  const root = make('div', { className: 'against' }, make('p', {}, ...letters.map(signOf), head));
  if (help) root.append(make('p', { className: 'help', textContent: help }));
  if (teaches) root.append(make('p', { className: 'teaches', textContent: teaches }));
  if (lines.length) root.append(make('ul', {}, ...lines.map((textContent) => make('li', { textContent }))));
  return root;
}

export class Summary {
  constructor() {
    this.list = make('div');
    this.root = make(
      'section',
      { className: 'story compared', hidden: true },
      heading(text('compare.title')),
      this.list,
    );
    this.table = make('table', { className: 'side-by-side' });
    this.numbers = make(
      'section',
      { className: 'story compared', hidden: true },
      ...headed(text('compare.title'), this.table),
    );
  }
  /**
   * @param {Frame} now
   * @param {Run[]} runs
   * @param {string | null} coming  what is being solved to be compared with them
   */
  load(now, runs, coming) {
    this.root.hidden = this.numbers.hidden = !runs.length;
    if (!runs.length) return;
    this.list.replaceChildren(...paragraphsOf(now, runs, coming).map(paragraph));
    const beside = runs.filter(({ frame }) => comparable(now, frame));
    this.numbers.hidden = !beside.length;
    if (beside.length) this.#fill(now, beside);
  }
  /**
   * @param {Frame} now
   * @param {Run[]} runs
   */
  #fill(now, runs) {
    const compared = runs.map(({ frame }) => comparedOf(now, frame));
    // figures of the other method only where it is what differs in all of them
    const which = compared.every((each) => each === 'other') ? 'other' : 'exact';
    const [own, ...others] = sideBySide([now, ...runs.map(({ frame }) => frame)].map((frame) => [frame, which]));
    const rows = own.map((figure) => {
      const cells = others.map((figures) => {
        const other = figures.find(({ key }) => key === figure.key);
        const change = make('small', { textContent: other ? bound(difference(other, figure)) : '' });
        return make('span', {}, other ? parted(written(other)) : '–', ' ', change);
      });
      return rowOf([figure.name, parted(written(figure)), ...cells]);
    });
    const head = headOf(['', text('compare.now'), ...runs.map(({ letter }) => letter)]);
    const named = [...head.querySelectorAll('th')].slice(-runs.length);
    runs.forEach(({ letter }, k) => (named[k].style.color = KEPT[letter]));
    this.table.replaceChildren(head, make('tbody', {}, ...rows));
  }
}
