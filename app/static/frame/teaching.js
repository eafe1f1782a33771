// A lesson, which is fetched where the address names one; what it looks like is in the folder of lessons.
import { alone, carried, served } from '../browser/home.js';
import { late, lateSheet } from '../browser/late.js';
import { keep, kept } from '../browser/store.js';
import { text } from '../text/catalogue.js';

/** @import { Page } from '../page.js' */
/** @typedef {import('../lesson/lesson.js').Lesson} Lesson */

const SHEETS = ['lesson.css', 'questions.css', 'print.css'];
const NAME = /^[a-z0-9-]{1,60}$/;
const OWN = 'own'; // what an address calls the lesson of a file, which the tab keeps
const KEPT = 'own-lesson'; // as app/static/courses/own_file.js keeps it

/**
 * What an address asks for.
 * @param {string} search
 * @returns {{ name: string, step: number, language: string } | null}
 */
export function lessonIn(search) {
  const query = new URLSearchParams(search);
  const name = query.get('lesson');
  if (name === null || !alone || carried) return null;
  return { name, step: Math.trunc(Number(query.get('step')) || 1), language: query.get('language') ?? '' };
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
   * @param {{ name: string, step: number, language: string }} asked
   */
  async #open(asked) {
    const { page } = this;
    try {
      this.lesson = await this.#fetched(asked);
      this.lesson.open();
      this.lesson.enter(asked.step - 1, false);
      if (this.lesson.record.untried) page.complain(text('lesson.untried'));
    } catch (error) {
      this.asked = this.lesson = null;
      page.player.bound(Infinity);
      const unknown = error instanceof RangeError;
      const why = text(unknown ? 'lesson.unknown' : 'lesson.lost', { lesson: asked.name.slice(0, 60) });
      page.complain(asked.name === OWN ? text('lesson.own-gone') : why);
      page.layout.place();
      page.tell();
    }
    page.root.style.visibility = '';
  }
  /**
   * @param {{ name: string, language: string }} asked
   * @returns {Promise<Lesson>}
   */
  async #fetched({ language, name }) {
    if (!NAME.test(name)) throw new RangeError();
    const { page } = this;
    const [module, record] = await Promise.all([
      late('lesson/lesson.js'),
      name === OWN ? this.#own() : this.#record(name, language),
    ]);
    await Promise.all(SHEETS.map((each) => lateSheet(`lesson/${each}`, page.root)));
    return new module.Lesson(page, record);
  }
  /**
   * @param {string} name
   * @param {string} language
   */
  async #record(name, language) {
    const address = served(`lessons/${name}`);
    if (language) address.searchParams.set('language', language);
    const answer = await fetch(address);
    if (answer.status === 404) throw new RangeError();
    return answer.json();
  }
  /** That of a file of the visitor's own; what was not tried of it is said once. */
  #own() {
    const { lesson, whole } = kept(KEPT, { lesson: null, whole: true }, true);
    if (!lesson) throw new RangeError();
    keep(KEPT, { lesson, whole: true }, true);
    return Object.assign(lesson, { own: true, untried: !whole });
  }
}
