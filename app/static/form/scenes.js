// The scene in the bar: its title is a button that opens the gallery, which is fetched when it is first wanted.
import { language, ofScene, text } from '../text/catalogue.js';
import { make } from '../browser/dom.js';
import { alone, carried, served } from '../browser/home.js';
import { late, lateSheet } from '../browser/late.js';
import { MOST_BYTES } from '../wire/own.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @typedef {import('../gallery/gallery.js').Gallery} Gallery */
/** @typedef {import('../gallery/gallery.js').Listed} Listed */

const LONG_TITLE = 45; // letters, beyond which it is written smaller where there is little room
const LONGER_TITLE = 72; // beyond which it is everywhere
const FILE = /\.toml$/i;
const LESSON = /\.(md|markdown)$/i;

/**
 * What a list says of a scene; one of the thesis by its number first.
 * @param {string} scene
 * @param {string} own  its title
 */
export function entryOf(scene, own) {
  const title = ofScene(scene, 'title', own);
  const [, kind, number] = /^(figure|table)-(\d+\.\d+)$/.exec(scene) ?? [];
  return kind ? text('scenes.entry', { kind, number, title }) : title;
}

/** The control of the scene, as others of the form. */
export class SceneButton {
  /** @param {() => void} open */
  constructor(open) {
    this.title = make('span', { className: 'title' });
    this.button = make('button', { type: 'button', className: 'scene', onclick: open }, this.title);
    this.button.setAttribute('aria-haspopup', 'dialog');
    this.root = make('div', { className: 'field field-scene' }, this.button);
  }
  set() {} // its title comes with the answer
  /** @param {string} title */
  say(title) {
    if (this.title.textContent === title) return;
    this.title.textContent = this.button.title = title;
    this.button.ariaLabel = text('gallery.shown', { title });
    this.title.classList.toggle('long', title.length > LONG_TITLE);
    this.title.classList.toggle('longer', title.length > LONGER_TITLE);
  }
}

/** What opens the gallery, and takes a scene file that is dropped anywhere. */
export class Scenes {
  /** @type {Promise<Gallery> | undefined} */ fetched;
  /** @type {Gallery | undefined} */ gallery;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    if (!carried) page.model.on('remove', this.#watch(page.root));
  }
  /** Whether it is open, and what is searched in it; nothing where it is not. */
  get searched() {
    return this.gallery?.root.open ? this.gallery.search.value : null;
  }
  /** @param {string} [words]  that are searched */
  async open(words = '') {
    if (this.page.changes.held.stays('scene')) return;
    const gallery = await this.#gallery();
    gallery?.open(words);
  }
  /** @returns {Promise<Gallery | undefined>} */
  async #gallery() {
    const { page } = this;
    this.fetched ??= (async () => {
      const taught = alone && (!carried || Object.keys(carried.lessons).length > 0); // only a page of its own runs them
      const [module, answer, courses] = await Promise.all([
        late('gallery/gallery.js'),
        carried?.gallery ?? fetch(served(`gallery/${language}`)).then((found) => found.json()),
        taught ? late('courses/courses.js') : null,
      ]);
      const sheets = ['gallery/gallery.css', ...(taught ? ['courses/courses.css'] : [])];
      await Promise.all(sheets.map((each) => lateSheet(each, page.root)));
      /** @type {Gallery} */
      const gallery = new module.Gallery(page, answer, courses?.Courses);
      page.root.append(gallery.root);
      this.gallery = gallery;
      return gallery;
    })();
    try {
      return await this.fetched;
    } catch {
      this.fetched = undefined;
      if (!page.connection?.miss('gallery')) page.complain(text('gallery.lost'));
      return undefined;
    }
  }
  /**
   * Whether a key is its own: that which opens it, and any while it is open.
   * @param {KeyboardEvent} event
   * @param {boolean} taken  by what has the focus
   */
  key(event, taken) {
    if (this.gallery?.root.open) return true;
    if (event.key.toLowerCase() !== 'g' || taken || event.ctrlKey || event.metaKey) return false;
    event.preventDefault();
    this.open();
    return true;
  }
  /**
   * Why the scene that was asked for cannot be: whether the gallery says so.
   * @param {string} sentence
   */
  refused(sentence) {
    return this.gallery?.refused(sentence) ?? false;
  }
  /** @param {Frame} frame */
  load(frame) {
    this.gallery?.take(frame);
  }
  /**
   * Take scene files from wherever they are dropped. Returns what ends it.
   * @param {HTMLElement} root
   */
  #watch(root) {
    const place = alone ? document : root;
    const over = (/** @type {Event} */ event) => {
      const { dataTransfer } = /** @type {DragEvent} */ (event);
      if ([...(dataTransfer?.items ?? [])].some(({ kind }) => kind === 'file')) event.preventDefault();
    };
    const drop = (/** @type {Event} */ event) => {
      const files = /** @type {DragEvent} */ (event).dataTransfer?.files ?? [];
      if (!files.length || event.defaultPrevented) return;
      event.preventDefault();
      const file = [...files].find(({ name }) => FILE.test(name));
      const lesson = alone && !carried && [...files].find(({ name }) => LESSON.test(name));
      if (lesson) this.#learn(lesson);
      else if (file) this.read(file);
      else this.page.complain(text('gallery.no-scene', { lessons: alone && !carried }));
    };
    place.addEventListener('dragover', over);
    place.addEventListener('drop', drop);
    return () => {
      place.removeEventListener('dragover', over);
      place.removeEventListener('drop', drop);
    };
  }
  /** @param {File} file  with a lesson */
  async #learn(file) {
    (await this.#gallery())?.courses?.file.open(file);
  }
  /** @param {File} file  with a scene */
  async read(file) {
    if (this.page.changes.held.stays('scene')) return;
    if (file.size > MOST_BYTES) this.page.complain(text('gallery.too-long'));
    else (await this.#gallery())?.editor.run(await file.text());
  }
}
