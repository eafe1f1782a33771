// A lesson on paper: all its steps with room for answers, and no answer. The key is for the page of the teacher.
import { FIGURE } from './below.js';
import { contextOf } from '../charts/canvas.js';
import { FINE, pictureOf } from '../charts/save.js';
import { make } from '../browser/dom.js';
import { late } from '../browser/late.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { LABELS } from '../text/words.js';
import * as drawing from './drawing.js';
import { timeOf } from './events.js';
import { valueWords } from './goal.js';
import { elementsOf } from './nodes.js';
import { quantityWords, unitWord } from './number.js';
import { mixed } from './order.js';
import { asks } from './questions.js';
import { marksOf, nameOf } from './settings.js';
import { soIn } from './sketch.js';

/** @import { Events } from './events.js' */
/** @import { Samples } from '../charts/scale.js' */
/** @import { Lesson } from './lesson.js' */
/** @import { Part } from './questions.js' */
/** @typedef {{ src: string, width?: number }} Picture  `width`: in pixels of the page, so that letters are as there */
/** @typedef {{ events: Events, curve: Samples | null, stage: Picture[], below: Picture[] }} Shown  of a step */

const CHART = { width: 704, height: 300 }; // pixels of an empty one
const INKS = { edge: '#000000', faint: '#000000', grid: '#8b95a1' }; // to be read when printed
// on paper nothing was moved or drawn
const UNKNOWN = { start: '…', end: '…', peak: '…', yours: '…', true: '…', at: '…', off: '…' };
const WAIT = 20_000; // ms for the pictures of a step
const PAINTED = 600; // ms that a figure takes to be drawn anew
const LOOK = 100; // ms until it is seen again whether an analysis is there

/**
 * @param {string} textContent
 * @param {string} [className]
 */
const line = (textContent, className = '') => make('p', { textContent, className });

/** @param {number} ms */
const after = (ms) => new Promise((done) => setTimeout(done, ms));

/**
 * @param {Picture} picture
 * @param {string} className
 */
function imageOf({ src, width }, className) {
  const image = make('img', { src, className, alt: '' });
  if (width) image.style.width = `${width}px`;
  return image;
}

/**
 * Axes with the given point, to be drawn on, or with what happens.
 * @param {Part} part
 * @param {Happens} shown
 * @param {boolean} full
 */
function chartOf(part, { curve, events }, full) {
  const { axis, given, until } = part;
  const marks = marksOf(part);
  const { width, height } = CHART;
  const canvas = make('canvas', { width: FINE * width, height: FINE * height });
  const c = contextOf(canvas);
  const chart = { axis, marks, until: timeOf(until, events) || 1 };
  c.scale(FINE, FINE);
  const paper = new drawing.Paper(width, height, chart);
  drawing.axes(c, paper, INKS);
  if (full && curve && marks) drawing.border(c, paper, curve);
  else if (full && curve) drawing.truth(c, paper, curve, Infinity);
  else if (given) drawing.dot(c, paper, given);
  return imageOf({ src: canvas.toDataURL(), width }, 'print-chart');
}

/** @type {Record<string, (part: Part, lesson: Lesson, shown: Shown) => Node[]>} */
const ASKED = {
  choice: ({ options }) =>
    options.map((/** @type {Part} */ each) => make('p', { className: 'print-box' }, ...elementsOf(each.text))),
  number: ({ units }) => [make('p', { className: 'print-blank' }, units.map(unitWord).join(' / '))],
  order: ({ items }) => [
    line(text('lesson.number-them')),
    ...mixed(items.length).map((k) => make('p', { className: 'print-place' }, ...elementsOf(items[k].text))),
  ],
  set: ({ range, slider, start }) => [
    line(
      text('lesson.on-paper', {
        value: valueWords(slider, start).trim(),
        low: figures(range[0]),
        high: figures(range[1]),
      }),
    ),
    make('p', { className: 'print-blank' }, LABELS[slider].unit ?? ''),
  ],
  sketch: (part, _, shown) => [line(nameOf(part)), chartOf(part, shown, false)],
};

/** @typedef {Pick<Shown, 'events' | 'curve'>} Happens  of a step */
/** @type {Record<string, (part: Part, shown: Happens) => Node[]>} */
const RIGHT = {
  choice: ({ options }) =>
    options
      .toSorted((/** @type {Part} */ a, /** @type {Part} */ b) => Number(b.right) - Number(a.right))
      .flatMap((/** @type {Part} */ { right, say, text: words }) => [
        make('p', { className: 'print-option' }, make(right ? 'b' : 'em', {}, ...elementsOf(words))),
        make('p', {}, ...elementsOf(say)),
      ]),
  number: ({ answer, tolerance, unit, yes }) => [
    make(
      'p',
      {},
      make('b', { textContent: quantityWords(answer, unit, 4) }),
      ` (± ${quantityWords(tolerance, unit, 2)})`,
    ),
    make('p', {}, ...elementsOf(yes)),
  ],
  order: ({ items }) => [
    make('ol', {}, ...items.map((/** @type {Part} */ each) => make('li', {}, ...elementsOf(each.text)))),
  ],
  set: ({ found, goal, slider }) =>
    found.map((/** @type {Part} */ { range, say }) => {
      const { title, unit = '' } = LABELS[slider];
      const [low, high] = (range ?? []).map((/** @type {number} */ end) => figures(end));
      const where = range
        ? text('class.within', { title, low, high, unit }).trim()
        : `${goal.quantity} ${goal.relation} ${figures(goal.value)}`; // as the file of the lesson has it
      return make('p', {}, make('b', { textContent: where }), ': ', ...elementsOf(say, UNKNOWN));
    }),
  sketch: (part, shown) => [
    ...(shown.curve ? [chartOf(part, shown, true)] : []),
    ...part.judges.map((/** @type {Part} */ each) => make('p', {}, ...elementsOf(each.says.yes, UNKNOWN))),
  ],
};

/**
 * What is right, step by step, for who teaches it.
 * @param {import('./lesson.js').Record_} record
 * @param {(part: Part) => Happens} shownOf  what happens, for the lines that are drawn
 */
export function keyOf(record, shownOf) {
  const steps = record.steps.flatMap(({ parts, title }, k) => {
    const part = parts.find(asks);
    const heading = make('h2', { textContent: `${k + 1}. ${title}` });
    return part ? [make('section', {}, heading, ...RIGHT[part.kind](part, shownOf(part)))] : [];
  });
  return [make('h1', { textContent: text('lesson.key-of', { title: record.title }) }), ...steps];
}

export class Print {
  /** @type {Map<number, Shown>} */ shown = new Map(); // by step
  root = make('div', { className: 'lesson-print' });

  /** @param {Lesson} lesson */
  constructor(lesson) {
    this.lesson = lesson;
    const name = text('lesson.print');
    this.button = make('button', { type: 'button', textContent: name });
    this.button.className = 'lesson-paper';
    this.button.onclick = () => this.#offer();
    const act = make('button', {
      type: 'button',
      className: 'lesson-main',
      textContent: name,
      onclick: () => this.print(),
    });
    const cancel = make('button', {
      type: 'button',
      textContent: text('lesson.cancel'),
      onclick: () => this.dialog.close(),
    });
    const heading = make('h2', { textContent: text('lesson.print-title') });
    const acts = make('p', {}, act, ' ', cancel);
    this.dialog = make('dialog', { className: 'lesson-printing', ariaLabel: heading.textContent ?? '' });
    this.dialog.append(heading, line(text('lesson.print-about')), acts);
    this.dialog.onclick = ({ target }) => {
      if (target === this.dialog) this.dialog.close(); // beside it
    };
    window.addEventListener('beforeprint', () => this.#fill());
  }
  #offer() {
    if (!this.dialog.isConnected) this.lesson.page.root.append(this.dialog);
    this.dialog.showModal();
  }
  /** With pictures of all steps, each of which is shown for a moment as it is before anything is answered. */
  async print() {
    this.dialog.close();
    const { lesson } = this;
    const { at, progress, still } = lesson;
    const { root } = lesson.page;
    root.dataset.printing = text('lesson.printing');
    root.classList.add('printing'); // where pictures are as wide as a sheet, and nobody sees what is still ahead
    Object.assign(lesson, {
      paper: true,
      still: true,
      progress: { ...progress, far: 0, answers: Object.create(null), ends: { ...progress.ends } },
    });
    for (const k of lesson.record.steps.keys()) await this.#look(k);
    Object.assign(lesson, { progress, still });
    root.classList.remove('printing');
    await lesson.enter(at, false);
    lesson.paper = false;
    this.#fill();
    window.print();
  }
  /** @param {number} k */
  async #look(k) {
    const { lesson } = this;
    const { page } = lesson;
    const { parts } = lesson.record.steps[k];
    if (this.shown.has(k) || parts.some(sums)) return;
    if (!(await Promise.race([lesson.enter(k, false), after(WAIT)]))) return;
    page.layout.place();
    await this.#settled();
    const { printed } = await late('take/files.js');
    const taken = (/** @type {Iterable<Element>} */ all) =>
      [...all].flatMap((each) => {
        if (!each.checkVisibility()) return [];
        const chart = Object.values(lesson.below.charts).find((one) => one?.root === each);
        return chart ? { src: pictureOf(chart).toDataURL(), width: chart.width } : printed(page, each);
      });
    const rows = lesson.rows ? page.root.querySelectorAll('.section') : [];
    const part = parts.find(({ kind }) => kind === 'sketch');
    this.shown.set(k, {
      events: lesson.events,
      curve: part ? soIn(part, page.frame) : null,
      stage: taken(page.root.querySelectorAll('.stages')),
      below: taken([...rows, ...lesson.below.root.children]),
    });
  }
  /** Until all that is shown is drawn at its size, and analyses and maps have come. */
  async #settled() {
    const { below } = this.lesson;
    const latest = performance.now() + WAIT;
    do await after(LOOK);
    while (below.awaited && performance.now() < latest);
    if (below.root.querySelector(FIGURE)) await after(PAINTED);
    await new Promise((painted) => requestAnimationFrame(() => requestAnimationFrame(painted)));
  }
  /** What is printed, as the page stands. */
  #fill() {
    const { lesson, root } = this;
    const { record } = lesson;
    const { page } = lesson;
    if (!root.isConnected) page.root.append(root);
    const drawn = record.steps.findIndex(({ parts }) => parts.some(({ kind }) => kind === 'sketch'));
    const stage = lesson.coming ? [] : [{ src: page.view.stage.canvas.toDataURL() }];
    const seen = new Set();
    const steps = record.steps.flatMap((step, k) => {
      const part = step.parts.find(asks);
      const none = { events: lesson.events, curve: null, stage: k === lesson.at ? stage : [], below: [] };
      const shown = this.shown.get(k) ?? none;
      const below = shown.below.map((each) => imageOf(each, 'print-below'));
      const tells = drawn >= 0 && k >= drawn; // what is to be drawn
      if (step.parts.some(sums)) return []; // which says what is so
      const texts = step.parts.filter(({ kind }) => kind === 'text').flatMap(({ nodes }) => elementsOf(nodes));
      const stills = shown.stage.filter(({ src }) => !seen.has(src) && seen.add(src)); // each once
      const pictures = [...stills.map((each) => imageOf(each, 'print-still')), ...(tells ? [] : below)];
      const asked = part ? ASKED[part.kind](part, lesson, shown) : [];
      return [
        make('section', {}, make('h2', { textContent: `${k + 1}. ${step.title}` }), ...texts, ...pictures, ...asked),
      ];
    });
    const title = make('h1', { textContent: record.title_before });
    const all = record.steps.every(({ parts }, k) => this.shown.has(k) || parts.some(sums));
    const whole = all || !this.button.isConnected;
    const note = whole ? [] : [line(text('lesson.pictures'), 'print-note')];
    const who = make(
      'p',
      { className: 'print-who' },
      ...['lesson.name', 'lesson.date'].map((each) => make('span', { textContent: text(each) })),
    );
    root.replaceChildren(title, who, ...note, ...steps);
  }
}

/** @param {Part} part */
const sums = ({ kind }) => kind === 'summary';
