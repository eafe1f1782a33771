// A lesson, or the page that reads codes of its class: fetched where the address names one; see the folders of both.
import { alone, carried, framed, served } from '../browser/home.js';
import { late, lateSheet } from '../browser/late.js';
import { keep, kept } from '../browser/store.js';
import { text } from '../text/catalogue.js';

/** @import { Page } from '../page.js' */
/** @typedef {import('../lesson/lesson.js').Lesson} Lesson */
/** @typedef {import('../lesson/lesson.js').Record_} Record_ */
/** @typedef {{ name: string, step: number, language: string, reads: boolean }} Asked  `reads`: codes of its class */

const SHEETS = ['lesson.css', 'questions.css', 'print.css'];
const NAME = /^[a-z0-9-]{1,60}$/;
const OWN = 'own'; // what an address calls the lesson of a file, which the tab keeps
const KEPT = 'own-lesson'; // as app/static/courses/own_file.js keeps it

/**
 * What an address asks for.
 * @param {string} search
 * @returns {Asked | null}
 */
export function lessonIn(search) {
  const query = new URLSearchParams(search);
  const reads = query.has('class');
  const name = query.get(reads ? 'class' : 'lesson');
  if (name === null || !alone) return null;
  return { name, step: Math.trunc(Number(query.get('step')) || 1), language: query.get('language') ?? '', reads };
}

/**
 * One that came with the page.
 * @param {import('../browser/home.js').Carried} came
 * @param {string} name
 */
function recordOf({ lessons }, name) {
  if (!Object.hasOwn(lessons, name)) throw new RangeError();
  return lessons[name];
}

export class Teaching {
  /** @type {Lesson | null} */ lesson = null;
  asked = lessonIn(alone ? window.location.search : '');

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
  }
  /** Whether there is one, or will be. */
  get on() {
    return this.asked !== null;
  }
  /** Whether rows and charts are none of what is shown. */
  get hides() {
    return this.on && !this.lesson?.rows;
  }
  /** Whether its charts are where they are seen. */
  get placed() {
    return this.lesson?.below.placed ?? true;
  }
  /** Whether there is one; it is then fetched, and nothing of what happens is seen before. */
  start() {
    const { asked, page } = this;
    if (!asked) return false;
    page.root.style.visibility = 'hidden';
    page.player.limit = 0;
    this.#open(asked);
    return true;
  }
  /**
   * Open it at its step. Without it the page goes on, and says why.
   * @param {Asked} asked
   */
  async #open(asked) {
    const { page } = this;
    try {
      if (carried && asked.reads) throw new RangeError();
      const came = carried && recordOf(carried, asked.name); // before what is not there is fetched
      const [record, { Lesson }] = await Promise.all([came ?? this.#record(asked), late('lesson/lesson.js')]);
      await Promise.all(SHEETS.map((each) => lateSheet(`lesson/${each}`, page.root)));
      if (asked.reads) await this.#read(record);
      else {
        this.lesson = /** @type {Lesson} */ (new Lesson(page, record));
        this.lesson.open();
        this.lesson.enter(asked.step - 1, false);
        if (record.untried) page.complain(text('lesson.untried'));
      }
    } catch (error) {
      this.asked = this.lesson = null;
      page.player.bound(Infinity);
      const unknown = error instanceof RangeError;
      const known = asked.name === OWN ? 'lesson.own-gone' : unknown ? 'lesson.unknown' : 'lesson.lost';
      const more = { lesson: asked.name.slice(0, 60), laboratory: Boolean(carried?.laboratory) };
      const lacking = asked.reads ? 'offline.codes' : 'offline.lesson';
      page.complain(text(carried ? lacking : known, more));
      page.layout.place();
      page.tell();
    }
    page.root.style.visibility = '';
    if (!framed) this.lesson?.heading.focus({ preventScroll: true }); // the page of a course keeps its own
  }
  /**
   * @param {Asked} asked
   * @returns {Promise<Record_>}  what it says
   */
  async #record({ language, name }) {
    if (!NAME.test(name)) throw new RangeError();
    if (name === OWN) return this.#own();
    const address = served(`lessons/${name}`);
    if (language) address.searchParams.set('language', language);
    const answer = await fetch(address);
    if (answer.status === 404) throw new RangeError();
    return answer.json();
  }
  /** @param {Record_} record */
  async #read(record) {
    const { Reading } = await late('classes/classes.js'); // which has parts of lessons
    await lateSheet('classes/classes.css', this.page.root);
    new Reading(this.page, record).open();
  }
  /** That of a file of the visitor's own; what was not tried of it is said once. */
  #own() {
    const { lesson, whole } = kept(KEPT, { lesson: null, whole: true }, true);
    if (!lesson) throw new RangeError();
    keep(KEPT, { lesson, whole: true }, true);
    return Object.assign(lesson, { own: true, untried: !whole });
  }
}
