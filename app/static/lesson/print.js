// A lesson on paper: all its steps with room for answers, and no answer; a key for the teacher on a page of its own.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { LABELS } from '../text/words.js';
import * as drawing from './drawing.js';
import { eventsOf, timeOf } from './events.js';
import { elementsOf } from './nodes.js';
import { quantityWords, unitWord } from './number.js';
import { mixed } from './order.js';
import { asks } from './questions.js';

/** @import { Events } from './events.js' */
/** @import { Lesson, Step } from './lesson.js' */
/** @import { Part } from './questions.js' */

export const KEY = 'key'; // in the address
const CHART = { width: 900, height: 420 }; // pixels of an empty one
const UNKNOWN = { start: '…', end: '…', peak: '…', yours: '…', true: '…' }; // on paper nothing was moved or drawn
const WAIT = 20_000; // ms for the picture of a step

/**
 * @param {string} textContent
 * @param {string} [className]
 */
const line = (textContent, className = '') => make('p', { textContent, className });

/**
 * Axes with the given point, to be drawn on.
 * @param {Part} part
 * @param {Events} events
 */
function emptyChart({ axis, given, until }, events) {
  const canvas = make('canvas', { ...CHART, className: 'print-chart' });
  const c = canvas.getContext('2d');
  const chart = { axis, until: timeOf(until, events) || 1 };
  if (!c) return canvas;
  const paper = new drawing.Paper(CHART.width, CHART.height, chart);
  drawing.axes(c, paper);
  if (given) drawing.dot(c, paper, given);
  return make('img', { src: canvas.toDataURL(), className: 'print-chart', alt: '' });
}

/** @type {Record<string, (part: Part, lesson: Lesson, events: Events) => Node[]>} */
const ASKED = {
  choice: ({ options }) =>
    options.map((/** @type {Part} */ each) => make('p', { className: 'print-box' }, ...elementsOf(each.text))),
  number: ({ units }) => [make('p', { className: 'print-blank' }, units.map(unitWord).join(' / '))],
  order: ({ items }) =>
    mixed(items.length).map((k) => make('p', { className: 'print-box' }, ...elementsOf(items[k].text))),
  set: ({ slider, start }, lesson) => [
    line(text('lesson.from', { value: lesson.valueWords(slider, start).trim() })),
    make('p', { className: 'print-blank' }),
  ],
  sketch: (part, _, events) => [
    line(text('lesson.axis', { track: text(`lesson.track.${part.track}`), unit: part.unit })),
    emptyChart(part, events),
  ],
};

/** @type {Record<string, (part: Part) => Node[]>} */
const RIGHT = {
  choice: ({ options }) =>
    options
      .filter((/** @type {Part} */ each) => each.right)
      .flatMap((/** @type {Part} */ each) => [
        make('p', {}, make('b', {}, ...elementsOf(each.text))),
        make('p', {}, ...elementsOf(each.say)),
      ]),
  number: ({ answer, unit, yes }) => [
    make('p', {}, make('b', { textContent: quantityWords(answer, unit, 4) })),
    make('p', {}, ...elementsOf(yes)),
  ],
  order: ({ items }) => [
    make('ol', {}, ...items.map((/** @type {Part} */ each) => make('li', {}, ...elementsOf(each.text)))),
  ],
  set: ({ found, slider }) =>
    found.map((/** @type {Part} */ { range, say }) => {
      const { title, unit = '' } = LABELS[slider];
      const ends = range?.map((/** @type {number} */ end) => figures(end));
      const where = ends
        ? [make('b', { textContent: text('class.within', { title, low: ends[0], high: ends[1], unit }).trim() })]
        : [];
      return make('p', {}, ...where, ...(ends ? [': '] : []), ...elementsOf(say, UNKNOWN));
    }),
  sketch: ({ judges }) =>
    judges.map((/** @type {Part} */ each) => make('p', {}, ...elementsOf(each.says.yes, UNKNOWN))),
};

export class Print {
  /** @type {Map<number, string>} */ stills = new Map(); // by step
  /** @type {Map<number, Events>} */ events = new Map();
  root = make('div', { className: 'lesson-print' });

  /** @param {Lesson} lesson */
  constructor(lesson) {
    this.lesson = lesson;
    this.key = make('input', { type: 'checkbox' });
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
    this.label = make('label', {}, this.key, ' ', text('lesson.key'));
    this.dialog = make('dialog', { className: 'lesson-printing', ariaLabel: name }, this.label, act);
    this.dialog.setAttribute('closedby', 'any');
    window.addEventListener('beforeprint', () => this.#fill());
  }
  #offer() {
    if (!this.dialog.isConnected) {
      this.lesson.page.root.append(this.dialog);
      this.key.checked = this.lesson.flags.includes(KEY);
    }
    this.dialog.showModal();
  }
  /** With a picture of each step, which is shown for a moment. */
  async print() {
    this.dialog.close();
    const { lesson } = this;
    const { at } = lesson;
    lesson.page.root.classList.add('printing'); // where pictures are as wide as a sheet
    lesson.awaited.begin(true); // nobody sees steps that are still ahead
    lesson.page.controls.bound({}); // which are not held by the slider of this one
    for (const k of lesson.record.steps.keys()) await this.#still(k);
    lesson.page.root.classList.remove('printing');
    lesson.enter(at, false);
    this.#fill();
    window.print();
  }
  /** @param {number} k */
  async #still(k) {
    const { lesson } = this;
    const { page } = lesson;
    const step = lesson.record.steps[k];
    if (this.stills.has(k)) return;
    lesson.coming = true; // so that nothing of it counts
    const frame = await new Promise((arrived) => {
      setTimeout(arrived, WAIT);
      page.goTo({ scene: step.scene, ...step.choices, ...placeOf(step) }, arrived);
    });
    if (!frame) return;
    this.events.set(k, eventsOf(frame));
    page.layout.place();
    const { player } = page;
    player.bound(Infinity);
    player.go(0); // before anything has happened
    await new Promise((painted) => requestAnimationFrame(() => requestAnimationFrame(painted)));
    player.go(0);
    this.stills.set(k, page.view.stage.canvas.toDataURL());
  }
  /** What is printed, as the page stands. */
  #fill() {
    const { lesson, root } = this;
    const { record } = lesson;
    const { page } = lesson;
    if (!root.isConnected) page.root.append(root);
    const wanted = this.dialog.isConnected ? this.key.checked : lesson.flags.includes(KEY);
    /** @type {HTMLElement[]} */
    const key = [make('h1', { textContent: text('lesson.key-of', { title: record.title }) })];
    const shown = lesson.coming ? '' : page.view.stage.canvas.toDataURL();
    let all = true;
    const steps = record.steps.flatMap((step, k) => {
      const part = step.parts.find(asks);
      if (part) key.push(make('section', {}, make('h2', { textContent: step.title }), ...RIGHT[part.kind](part)));
      if (step.parts.some(({ kind }) => kind === 'summary')) return []; // which says what is so
      const texts = step.parts.filter(({ kind }) => kind === 'text').flatMap(({ nodes }) => elementsOf(nodes));
      const src = this.stills.get(k) ?? (k === lesson.at ? shown : '');
      all &&= Boolean(src);
      const still = src ? [make('img', { src, className: 'print-still', alt: '' })] : [];
      const asked = part ? ASKED[part.kind](part, lesson, this.events.get(k) ?? lesson.events) : [];
      return [
        make('section', {}, make('h2', { textContent: `${k + 1}. ${step.title}` }), ...texts, ...still, ...asked),
      ];
    });
    const title = make('h1', { textContent: record.title_before });
    const whole = all || !this.button.isConnected;
    const note = whole ? [] : [line(text('lesson.pictures'), 'print-note')];
    root.replaceChildren(
      title,
      ...note,
      ...steps,
      ...(wanted ? [make('div', { className: 'print-key' }, ...key)] : []),
    );
  }
}

/**
 * Where the slider of a step begins.
 * @param {Step} step
 * @returns {Record<string, number>}
 */
function placeOf(step) {
  const part = step.parts.find(({ kind }) => kind === 'set');
  return part ? { [part.slider]: part.start } : {};
}
