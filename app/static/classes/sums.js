// What a class has answered to each question, as tables with bars; places and lines as pictures beside them.
import { make, headOf } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { LABELS } from '../text/words.js';
import { signOf } from '../lesson/answered.js';
import { shareOf } from '../lesson/code.js';
import { elementsOf } from '../lesson/nodes.js';
import { nameOf } from '../lesson/settings.js';
import { foundOf, numbersOf, outcomesOf, pickedOf, placesOf, triesOf } from './counts.js';

/** @import { Answer } from '../lesson/code.js' */
/** @import { Part } from '../lesson/questions.js' */
/** @import { Laid } from './lay.js' */

/** @typedef {{ right: boolean | null, words: (Node | string)[], count: number }} Line  of a table: none has no sign */

/**
 * A sign, and its word for who does not see it.
 * @param {boolean} right
 */
export const saidRight = (right) =>
  make(
    'span',
    {},
    signOf(right),
    make('span', { className: 'class-unseen', textContent: text('class.right', { right }) }),
  );

/**
 * @param {string} caption
 * @param {Line[]} lines
 * @param {number} all  of whom the bars are shares
 */
function tableOf(caption, lines, all) {
  const head = headOf(['', text('class.answer'), text('class.codes'), '']);
  const rows = lines.map(({ count, right, words }) => {
    const bar = make('span', { className: 'class-bar', ariaHidden: 'true' });
    bar.style.setProperty('--share', String(all ? count / all : 0));
    const share = text('class.share', { count, share: all ? Math.round((100 * count) / all) : 0 });
    return make(
      'tr',
      { className: right ? 'class-right' : '' },
      make('td', {}, ...(right === null ? [] : [saidRight(right)])),
      make('th', { scope: 'row' }, ...words),
      make('td', { textContent: share }),
      make('td', {}, bar),
    );
  });
  return make('table', {}, make('caption', { textContent: caption }), head, make('tbody', {}, ...rows));
}

/**
 * @param {Part} part
 * @param {Answer[]} given
 */
function chosen(part, given) {
  const counts = pickedOf(part, given);
  const lines = part.options.map((/** @type {Part} */ option, /** @type {number} */ k) => ({
    ...{ right: Boolean(option.right), words: [`${k + 1}. `, ...elementsOf(option.text)], count: counts[k] },
  }));
  return [tableOf(text('class.of-choice', { count: given.length }), lines, given.length)];
}

/** @param {Answer[]} given */
const tried = (given) => make('p', { textContent: text('class.tries', triesOf(given)) });

/**
 * @param {Part} part
 * @param {Answer[]} given
 */
function numbered(part, given) {
  const { mistakes, unit } = part;
  const lines = numbersOf(part, given).map(({ count, mistake, right, value }) => {
    const number = value === null ? '' : `${figures(value, 4)} ${unit}`;
    const say = mistake < 0 ? [] : elementsOf(mistakes[mistake].say);
    const words = number || mistake >= 0 ? [number, ...(number && say.length ? [': '] : []), ...say] : null;
    return { right, words: words ?? [text('class.others')], count };
  });
  return [tableOf(text('class.of-number', { count: given.length }), lines, given.length), tried(given)];
}

/**
 * @param {Part} part
 * @param {Answer[]} given
 */
function ordered(part, given) {
  const lines = placesOf(part, given).map(({ count, instead, most }, k) => {
    const other = instead < 0 ? '' : text('class.instead', { place: instead + 1, count: most });
    const aside = make('small', { textContent: other });
    return { right: null, words: [`${k + 1}. `, ...elementsOf(part.items[k].text), ' ', aside], count };
  });
  return [tableOf(text('class.of-order', { count: given.length }), lines, given.length), tried(given)];
}

/**
 * Where the slider was, along its range.
 * @param {Part} part
 * @param {Answer[]} given
 */
function set(part, given) {
  const { range, slider } = part;
  const { title, unit = '' } = LABELS[slider];
  const all = foundOf(part, given);
  const within = (/** @type {[number, number] | null} */ of) =>
    of ? text('class.within', { title, low: figures(of[0]), high: figures(of[1]), unit }).trim() : title;
  const lines = part.found.map((/** @type {Part} */ found, /** @type {number} */ k) => {
    const words = [within(found.range), ': ', ...elementsOf(found.say, { start: '…', end: '…', peak: '…' })];
    return { right: null, words, count: all[k].length };
  });
  const at = (/** @type {number} */ value) => `${100 * Math.min(Math.max(shareOf(value, range), 0), 1)}%`;
  const strip = make('div', { className: 'class-strip', role: 'img' });
  strip.ariaLabel = text('class.places', { title, all: all.flat().map((value) => figures(value)) });
  for (const { range: own } of part.found) {
    if (!own) continue;
    const zone = make('span', { className: 'class-zone' });
    Object.assign(zone.style, { left: at(own[0]), right: `calc(100% - ${at(own[1])})` });
    strip.append(zone);
  }
  for (const value of all.flat()) {
    const mark = make('span', { className: 'class-place' });
    mark.style.left = at(value);
    strip.append(mark);
  }
  const ends = make('p', { className: 'class-ends', ariaHidden: 'true' });
  ends.append(...range.map((/** @type {number} */ value) => make('span', { textContent: figures(value) })));
  return [tableOf(text('class.of-set', { count: given.length }), lines, given.length), strip, ends];
}

/**
 * @param {Part} part
 * @param {Answer[]} given
 * @param {Laid} laid
 */
function drawn(part, given, laid) {
  laid.lines = given.map(({ line = [] }) => line);
  laid.root.ariaLabel = text('class.laid', { count: given.length });
  const late = given.filter((each) => each.late).length;
  const counts = outcomesOf(part, given);
  const tables = part.judges.map((/** @type {Part} */ { at, says }, /** @type {number} */ k) => {
    const gaps = laid.gaps(at);
    const lines = Object.entries(counts[k]).map(([outcome, count]) => {
      return { right: outcome === 'yes', words: elementsOf(says[outcome] ?? [], gaps), count };
    });
    return tableOf(text('class.criterion', { number: k + 1 }), lines, given.length);
  });
  const words = text('class.of-sketch', { count: given.length, late });
  requestAnimationFrame(() => laid.draw());
  const named = make('p', { className: 'class-axis', textContent: nameOf(part) });
  return [make('p', { textContent: words }), named, laid.root, make('div', { className: 'class-criteria' }, ...tables)];
}

/** @type {Record<string, (part: Part, given: Answer[], laid: Laid) => Node[]>} */
const KINDS = { choice: chosen, number: numbered, order: ordered, set, sketch: drawn };

/**
 * @param {string} title  of the step
 * @param {Part} part  the question
 * @param {Answer[]} given  of those who have answered it
 * @param {Laid} laid  where lines are drawn, if it is a sketch
 */
export const sumOf = (title, part, given, laid) =>
  make(
    'section',
    { className: 'class-sum' },
    make('h3', { textContent: title }),
    ...KINDS[part.kind](part, given, laid),
  );
