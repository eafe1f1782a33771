// The page of a teacher: takes the codes of a class and shows what they say. Nothing of them leaves the browser.
import { download, make } from '../browser/dom.js';
import { keep, kept } from '../browser/store.js';
import { text } from '../text/catalogue.js';
import { questionsOf } from '../lesson/code.js';
import { onlyHere } from '../frame/share.js';
import { eventsOf, timeOf } from '../lesson/events.js';
import { copyButton } from '../lesson/handed.js';
import { keyOf } from '../lesson/print.js';
import { soIn } from '../lesson/sketch.js';
import { csvOf } from './csv.js';
import { frameOf } from './frame.js';
import { Laid } from './lay.js';
import { MOST, readLines } from './lines.js';
import { rowsOf } from './rows.js';
import { sumOf } from './sums.js';

/** @import { Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */
/** @import { Record_, Step } from '../lesson/lesson.js' */
/** @import { Part } from '../lesson/questions.js' */
/** @import { Row, Unread } from './lines.js' */

export class Reading {
  /** @type {Row[]} */ rows = [];

  /**
   * @param {Page} page
   * @param {Record_} record
   */
  constructor(page, record) {
    this.page = page;
    this.record = record;
    this.name = `class.${record.lesson}`;
    const sketches = questionsOf(record).filter(({ kind }) => kind === 'sketch');
    this.laid = new Map(sketches.map((part) => [part, new Laid(part)]));
    this.area = make('textarea', { rows: 8, spellcheck: false, autocomplete: 'off' });
    this.area.value = kept(this.name, '', true);
    this.area.oninput = () => this.#read();
    this.count = make('p', { className: 'class-count', role: 'status' });
    this.unread = make('ul', { className: 'class-unread' });
    this.save = make('button', { type: 'button', className: 'whole', textContent: text('class.save') });
    this.save.onclick = () =>
      download(new Blob([csvOf(record, this.rows)], { type: 'text/csv;charset=utf-8' }), `${this.name}.csv`);
    this.key = make('div', { className: 'lesson-print', lang: record.language });
    this.sums = make('div', { className: 'class-sums', lang: record.language });
    this.root = make('section', { className: 'classes', ariaLabel: text('class.page') }, ...this.#parts());
  }
  #parts() {
    const { area, count, record, save, sums, unread } = this;
    const { own } = record; // has no address elsewhere
    const heading = make('h2', { textContent: text('class.of', { title: record.title }), tabIndex: -1 });
    const address = `?lesson=${own ? 'own' : record.lesson}`;
    const { href } = new URL(address, window.location.href);
    const lesson = make('a', { href: address, textContent: text('class.lesson') });
    const copy = copyButton(text('class.copy-link'), href, () => {});
    const frame = copyButton(text('frame.copy'), frameOf(record), () => {});
    const about = make('p', { textContent: text('class.about') });
    const label = make('label', {}, text('class.lines', { most: MOST }), area);
    const links = own ? [] : [' ', copy, ' ', frame];
    const only = own ? '' : onlyHere();
    const note = make('p', { textContent: only, hidden: !only });
    const key = make('button', { type: 'button', className: 'whole', textContent: text('class.key') });
    key.onclick = () => this.#print();
    const head = make('header', {}, heading, make('p', {}, lesson, ...links, ' ', key), note, about);
    return [head, make('div', { className: 'class-put' }, label, count, unread, save), sums];
  }
  /** Take the place of all else. */
  open() {
    const { page, root } = this;
    page.root.classList.add('reading');
    page.root.append(root);
    this.#read();
    const steps = this.record.steps.filter(({ parts }) => parts.some((part) => this.laid.has(part)));
    this.#solve(steps);
  }
  /** The key alone: what is right, and what is said of it. */
  #print() {
    const { key, laid, page, record } = this;
    const none = { events: {}, curve: null };
    key.replaceChildren(
      ...keyOf(record, (part) => {
        const found = laid.get(part);
        return found?.curve.x.length ? found : none;
      }),
    );
    page.root.append(key);
    window.addEventListener('afterprint', () => key.remove(), { once: true });
    window.print();
  }
  /**
   * What happens, step by step, which lies over the lines then.
   * @param {Step[]} steps  that have a sketch
   */
  #solve([step, ...rest]) {
    if (!step) return;
    const part = step.parts.find((each) => this.laid.has(each));
    this.page.goTo({ scene: step.scene, ...step.choices }, (frame) => {
      if (frame && part) this.#known(part, frame);
      this.#solve(rest);
    });
  }
  /**
   * @param {Part} part
   * @param {Frame} frame
   */
  #known(part, frame) {
    const laid = /** @type {Laid} */ (this.laid.get(part));
    laid.curve = soIn(part, frame);
    laid.events = eventsOf(frame);
    laid.until = timeOf(part.until, laid.events);
    this.#read();
  }
  #read() {
    const { area, record, sums } = this;
    keep(this.name, area.value || undefined, true);
    const { beyond, rows, unread } = readLines(record, area.value);
    this.rows = rows;
    this.count.textContent =
      rows.length + unread.length ? text('class.count', { rows: rows.length, unread: unread.length }) : '';
    const more = beyond ? [make('li', { textContent: text('class.beyond', { most: MOST, beyond }) })] : [];
    this.unread.replaceChildren(...more, ...unread.map((each) => this.#why(each)));
    this.save.hidden = !rows.length;
    const steps = record.steps.flatMap((step) =>
      questionsOf({ ...record, steps: [step] }).map((part) => this.#sum(step, part)),
    );
    sums.replaceChildren(...(rows.length ? [...steps, rowsOf(record, rows)] : []));
  }
  /**
   * @param {Step} step
   * @param {Part} part
   */
  #sum({ title }, part) {
    const given = this.rows.flatMap((row) => row.given[part.name] ?? []);
    return sumOf(title, part, given, /** @type {Laid} */ (this.laid.get(part)));
  }
  /** @param {Unread} unread */
  #why({ line, other, sign, why, words }) {
    const reason = text(`class.why.${why}`, { sign, line: other });
    return make('li', { textContent: text('class.unread', { line, words, reason }) });
  }
}
