// A lesson file of the visitor's own: the server reads it and tries its scenes; what cannot be is listed by line.
import { make } from '../browser/dom.js';
import { served } from '../browser/home.js';
import { kept, keep } from '../browser/store.js';
import { said, text } from '../text/catalogue.js';

/** @import { Note } from '../text/catalogue.js' */
/** @import { Gallery } from '../gallery/gallery.js' */

/** @typedef {[line: number, sentence: string]} Problem */
/** @typedef {{ lesson?: object, whole?: boolean, problems?: Problem[], count?: number, error?: Note }} Answer */

const OWN = 'own-lesson'; // under which the tab keeps it, for app/static/frame/teaching.js
const MOST = 200_000; // bytes
const BUSY = 429;
const TRIES = 8; // while others from there are being read
const PAUSE = 1500; // ms
const SEEN = 160; // letters of a line

export class LessonFile {
  /** @type {AbortController | null} */ sending = null;

  /** @param {Gallery} gallery */
  constructor(gallery) {
    this.gallery = gallery;
    this.heading = make('h3', { tabIndex: -1 });
    this.status = make('p', { role: 'status' });
    this.list = make('ol', { className: 'problems' });
    const file = make('input', { type: 'file', accept: '.md,.markdown,text/markdown', hidden: true });
    file.onchange = () => {
      if (file.files?.[0]) this.open(file.files[0]);
      file.value = '';
    };
    const act = (/** @type {string} */ textContent, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', className: 'whole', textContent, onclick });
    const again = act(text('lesson.another-file'), () => file.click());
    const back = act(text('gallery.back'), () => [this.stop(), gallery.turn()]);
    const acts = make('div', { className: 'acts' }, again, back, file);
    this.root = make('div', { className: 'editor lesson-file', hidden: true });
    this.root.append(this.heading, this.status, this.list, acts);
  }
  /** Nobody waits for an answer any more. */
  stop() {
    this.sending?.abort();
    this.sending = null;
  }
  /** @param {File} file */
  async open(file) {
    this.stop();
    const mine = (this.sending = new AbortController());
    this.gallery.open();
    this.gallery.turn(this.root);
    this.#say(text('lesson.reading', { file: file.name }), '');
    this.heading.focus();
    try {
      const large = { size: Math.ceil(file.size / 1000), most: MOST / 1000 };
      /** @type {Answer} */
      const answer =
        file.size > MOST
          ? { error: { code: 'serving.lesson.large', severity: 'refusal', values: large } }
          : await this.#sent(file, mine.signal);
      if (answer.error) this.#say(text('lesson.refused', { file: file.name }), said(answer.error));
      else if (answer.problems) await this.#list(file, answer.problems, answer.count ?? 0);
      else this.#start(answer);
    } catch {
      const refused = text('lesson.refused', { file: file.name });
      if (!mine.signal.aborted) this.#say(refused, text('lesson.not-sent'));
    }
  }
  /**
   * @param {File} file
   * @param {AbortSignal} signal
   * @returns {Promise<Answer>}
   */
  async #sent(file, signal) {
    for (let tries = 1; ; tries++) {
      const answer = await fetch(served('lesson'), { method: 'POST', body: file, signal });
      if (answer.status !== BUSY || tries === TRIES) return answer.json();
      await new Promise((again) => setTimeout(again, PAUSE)); // a class behind one address takes turns
    }
  }
  /**
   * @param {string} heading
   * @param {string} status
   */
  #say(heading, status) {
    this.heading.textContent = heading;
    this.status.textContent = status;
    this.list.replaceChildren();
  }
  /**
   * @param {File} file
   * @param {Problem[]} problems
   * @param {number} count  of all
   */
  async #list(file, problems, count) {
    const lines = (await file.text()).split(/\r\n|\r|\n/);
    const first = count > problems.length ? [text('lesson.first-problems', { count: problems.length })] : [];
    const status = [...first, text('lesson.mended')].join(' ');
    this.#say(text('lesson.problems', { count, file: file.name }), status);
    const rows = problems.map(([line, sentence]) => {
      const written = (lines[line - 1] ?? '').trim().slice(0, SEEN);
      const row = make('li', {}, make('b', { textContent: text('lesson.line', { line }) }));
      row.append(make('span', { textContent: sentence }), ...(written ? [make('code', { textContent: written })] : []));
      return row;
    });
    this.list.replaceChildren(...rows);
    this.heading.focus();
  }
  /**
   * It is kept in this tab, where its address finds it.
   * @param {Answer} answer
   */
  #start({ lesson, whole }) {
    keep(OWN, { lesson, whole }, true);
    if (!kept(OWN, null, true)) this.#say(text('lesson.not-kept'), '');
    else location.assign('?lesson=own');
  }
}
