// All scenes: some as moving pictures with a question each, all by chapter, those of the visitor's own; and a search.
import { ownQuestion } from '../opening/question.js';
import { make } from '../browser/dom.js';
import { carried } from '../browser/home.js';
import { forget, ownScenes } from '../wire/own.js';
import { family, said, text } from '../text/catalogue.js';
import { Editor } from './editor.js';
import { Picture, Running } from './picture.js';
import { entry, matches, plain } from './search.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Note } from '../text/catalogue.js' */
/** @import { Part, Sheet } from './picture.js' */
/** @import { Course, Courses } from '../courses/courses.js' */
/** @import { Entry, Found } from './search.js' */

/**
 * @typedef {object} Listed  what the server says of all scenes
 * @property {[group: string, scenes: string[]][]} cards
 * @property {Record<string, Part[]>} pictures
 * @property {Sheet} sheet
 * @property {Course[]} lessons  in their order
 * @property {[heading: Note, scenes: [name: string, title: string, found: Found][]][]} scenes
 */
/** @typedef {{ entry: Entry, root: HTMLElement, button: HTMLButtonElement }} Choice */
/** @typedef {{ root: HTMLElement, choices: Choice[] }} Group */

const ARROWS = ['ArrowDown', 'ArrowUp', 'ArrowLeft', 'ArrowRight'];
const GROUPS = family('gallery.group');

export class Gallery {
  running = new Running();
  all = 0; // scenes
  /** @type {Group[]} */ groups = [];
  /** @type {Map<Element, Picture>} */ pictures = new Map();

  /**
   * @param {Page} page
   * @param {Listed} listed
   * @param {typeof Courses | null} [Taught]  nothing where no lesson runs
   */
  constructor(page, listed, Taught = null) {
    this.page = page;
    this.editor = new Editor(page, this);
    this.search = make('input', { type: 'search', autocomplete: 'off', placeholder: text('gallery.search-about') });
    this.search.ariaLabel = text('gallery.search');
    this.search.oninput = () => this.#find();
    this.count = make('p', { className: 'count', role: 'status' });
    const close = make('button', { type: 'button', className: 'sign', textContent: '✕', onclick: () => this.close() });
    close.title = close.ariaLabel = text('gallery.close');
    this.heading = make('h2', { id: 'gallery', textContent: text('gallery.title'), tabIndex: -1 });
    const head = make('header', { className: 'gallery-head' }, this.heading, this.search, this.count, close);
    this.own = make('section', { className: 'own' });
    this.courses = Taught ? this.#courses(Taught, listed) : null;
    const parts = [this.own, ...this.#cards(listed), ...this.#index(listed)];
    const taught = this.courses?.root ?? make('section');
    taught.append(...lacking());
    this.none = make('p', { className: 'help', hidden: true });
    this.body = make('div', { className: 'gallery-body' }, this.none, taught, ...parts);
    this.root = make('dialog', { className: 'gallery' }, head, this.body, this.editor.root);
    if (this.courses) this.root.append(this.courses.file.root);
    this.root.setAttribute('aria-labelledby', 'gallery');
    this.root.onkeydown = (event) => this.#key(event);
    this.root.onclose = () => {
      this.courses?.file.stop();
      this.running.stopAll();
      page.history.later();
    };
    this.seen = new IntersectionObserver((entries) => this.#see(entries), { root: this.body });
    for (const card of this.pictures.keys()) this.seen.observe(card);
  }
  /**
   * @param {typeof Courses} Taught
   * @param {Listed} listed
   */
  #courses(Taught, { lessons, pictures, sheet }) {
    const pictureOf = (/** @type {string} */ scene) => (pictures[scene] ? new Picture(pictures[scene], sheet) : null);
    const finds = (/** @type {string} */ typed, /** @type {string} */ words) =>
      matches(typed, { scene: '', title: '', number: '', words: plain(words) });
    return new Taught(this, lessons, pictureOf, finds);
  }
  /** @param {Listed} listed */
  #cards({ cards, pictures, scenes, sheet }) {
    const known = new Map(scenes.flatMap(([heading, all]) => all.map((each) => [each[0], { heading, each }])));
    return cards.map(([group, names]) => {
      const choices = names.map((name) => {
        const { each, heading } = /** @type {NonNullable<ReturnType<typeof known.get>>} */ (known.get(name));
        const question = ownQuestion(name);
        const found = entry(name, each[1], each[2], heading, `${question} ${GROUPS[group]}`);
        const picture = new Picture(pictures[name], sheet);
        const button = this.#button(found, 'card');
        button.append(
          picture.canvas,
          make('strong', { textContent: question }),
          make('span', { textContent: found.title }),
        );
        this.pictures.set(button, picture);
        button.onpointerenter = button.onfocus = () => this.running.start(picture);
        button.onpointerleave = button.onblur = () => this.running.stop(picture);
        return { entry: found, root: button, button };
      });
      const list = make('div', { className: 'cards' }, ...choices.map(({ root }) => root));
      const root = make('section', {}, make('h3', { textContent: GROUPS[group] }), list);
      this.groups.push({ root, choices });
      return root;
    });
  }
  /** @param {Listed} listed */
  #index({ scenes }) {
    this.all = scenes.flatMap(([, all]) => all).length;
    const title = make('h3', { textContent: text('gallery.all', { count: this.all }) });
    const parts = scenes.map(([heading, all]) => {
      const choices = all.map(([name, own, found]) => {
        const known = entry(name, own, found, heading);
        const button = this.#button(known, 'entry');
        button.textContent = known.title;
        return { entry: known, root: make('li', {}, button), button };
      });
      const name = make('summary', {
        textContent: text('gallery.chapter', { name: said(heading), count: all.length }),
      });
      const root = make('details', {}, name, make('ul', {}, ...choices.map((each) => each.root)));
      this.groups.push({ root, choices });
      return root;
    });
    return [make('section', { className: 'index' }, title, ...parts)];
  }
  /**
   * @param {{ scene: string }} found
   * @param {string} className
   */
  #button({ scene }, className) {
    const button = make('button', { type: 'button', className, onclick: () => this.choose(scene) });
    button.dataset.scene = scene;
    return button;
  }
  /** The visitor's own scenes, and how to give others. */
  #offer() {
    const act = (/** @type {string} */ textContent, /** @type {() => void} */ onclick, className = 'whole') =>
      make('button', { type: 'button', className, textContent, onclick });
    const file = make('input', { type: 'file', accept: '.toml', hidden: true });
    file.onchange = () => {
      if (file.files?.[0]) this.page.scenes.read(file.files[0]);
      file.value = ''; // the same one may be chosen again, mended
    };
    const rows = ownScenes().map(({ name, title }) => {
      const edit = act(text('gallery.edit'), () => this.editor.load(name));
      const drop = act(text('gallery.forget'), () => [forget(name), this.#offer(), this.#mark()]);
      for (const button of [edit, drop]) button.ariaLabel = `${button.textContent}: ${title}`;
      const button = this.#button({ scene: name }, 'entry');
      button.textContent = title;
      return make('li', {}, button, edit, drop);
    });
    this.own.replaceChildren(
      make('h3', { textContent: text('gallery.own') }),
      make('ul', {}, ...rows),
      make(
        'div',
        { className: 'acts' },
        act(text('gallery.file'), () => file.click()),
        act(text('gallery.write'), () => this.editor.show()),
        make('span', { className: 'help', textContent: text('gallery.drop') }),
        file,
      ),
    );
  }
  /** @param {string} [words]  that are searched */
  open(words = '') {
    if (this.root.open) return;
    this.search.value = words;
    this.#offer();
    this.turn();
    this.root.showModal(); // the browser keeps the focus in it, and gives it back
    this.#find();
    this.#mark();
    this.body.scrollTop = 0;
    for (const picture of this.pictures.values()) picture.draw();
    this.courses?.draw();
    (this.running.touched ? this.heading : this.search).focus(); // else a keyboard would cover half of it
  }
  close() {
    this.root.close();
  }
  /** @param {HTMLElement | null} [part]  that stands in place of the list */
  turn(part = null) {
    for (const each of [this.editor.root, this.courses?.file.root]) if (each) each.hidden = each !== part;
    this.body.hidden = this.search.hidden = this.count.hidden = part !== null;
    this.root.setAttribute('closedby', part ? 'closerequest' : 'any'); // a press beside it ends no writing
  }
  /** @param {string} scene */
  choose(scene) {
    this.close();
    if (this.page.opening.teaching.on) {
      location.assign(`?${new URLSearchParams({ scene })}`); // out of the lesson
      return;
    }
    this.page.player.button.focus(); // so that Space plays what was chosen, and does not open this again
    if (scene !== this.page.frame.chosen.scene) this.page.choose('scene', scene);
  }
  /** @param {string} sentence */
  refused(sentence) {
    return this.editor.refused(sentence);
  }
  /** @param {Frame} frame */
  take(frame) {
    this.editor.take(frame);
  }
  /** Which one is shown. */
  #mark() {
    const { scene } = this.page.frame.chosen;
    for (const button of this.root.querySelectorAll('button[data-scene]'))
      button.ariaCurrent = /** @type {HTMLElement} */ (button).dataset.scene === scene ? 'true' : null;
  }
  /** Only what the words find is seen, and how many that are. */
  #find() {
    const typed = this.search.value.trim();
    const found = new Set();
    for (const { choices, root } of this.groups) {
      const here = choices.filter((choice) => {
        choice.root.hidden = !matches(typed, choice.entry);
        return !choice.root.hidden;
      });
      root.hidden = !here.length;
      if ('open' in root) root.open = typed !== '';
      for (const { entry: known } of here) found.add(known.scene);
    }
    this.own.hidden = typed !== '' || Boolean(carried); // only a server reads files
    this.courses?.find(typed);
    const taught = this.courses && !this.courses.root.hidden;
    this.none.hidden = !typed || found.size > 0 || Boolean(taught);
    this.none.textContent = this.none.hidden ? '' : text('gallery.none', { typed });
    this.count.textContent = text('gallery.count', { count: found.size, all: this.all, part: found.size < this.all });
    this.page.history.later();
  }
  /** @param {IntersectionObserverEntry[]} entries */
  #see(entries) {
    for (const { isIntersecting, target } of entries) {
      const picture = this.pictures.get(target);
      if (!picture) continue;
      if (isIntersecting) picture.draw();
      if (isIntersecting && this.running.touched) this.running.start(picture);
      else if (!isIntersecting) this.running.stop(picture);
    }
  }
  /**
   * Arrows go from scene to scene, as they lie; Enter in the search takes the first that is found.
   * @param {KeyboardEvent} event
   */
  #key(event) {
    const from = /** @type {HTMLElement} */ (event.target);
    const inSearch = from === this.search;
    const listed = [...this.body.querySelectorAll('button[data-scene], a.card, summary')];
    const choices = /** @type {HTMLElement[]} */ (listed.filter((each) => each.checkVisibility()));
    if (inSearch && event.key === 'Escape') {
      event.preventDefault(); // it would only empty the search
      this.close();
    }
    if (inSearch && event.key === 'Enter') {
      event.preventDefault();
      choices.find((each) => each.matches('button, a'))?.click();
      return;
    }
    if (!ARROWS.includes(event.key) || (inSearch && event.key !== 'ArrowDown')) return;
    if (!inSearch && !choices.includes(from)) return;
    event.preventDefault();
    const next = inSearch ? choices[0] : nearest(from, choices, event.key);
    (next ?? (event.key === 'ArrowUp' ? this.search : from)).focus();
  }
}

/**
 * The next one in the way of an arrow.
 * @param {HTMLElement} from
 * @param {HTMLElement[]} all
 * @param {string} key
 */
export function nearest(from, all, key) {
  const middle = (/** @type {HTMLElement} */ each) => {
    const { height, left, top, width } = each.getBoundingClientRect();
    return [left + width / 2, top + height / 2];
  };
  const [x, y] = middle(from);
  const sideways = /Left|Right/.test(key);
  const sign = /Left|Up/.test(key) ? -1 : 1;
  let best;
  let least = Infinity;
  for (const each of all) {
    const [dx, dy] = [middle(each)[0] - x, middle(each)[1] - y];
    const [ahead, aside] = sideways ? [sign * dx, Math.abs(dy)] : [sign * dy, Math.abs(dx)];
    if (ahead < 4 || (sideways && aside > 40)) continue;
    const far = sideways ? ahead : 1000 * ahead + aside; // rows first
    if (far < least) [best, least] = [each, far];
  }
  return best;
}

/** That some lessons need a server, where there is none. */
function lacking() {
  const more = { count: carried?.gallery.lacking ?? 0, laboratory: Boolean(carried?.laboratory) };
  return more.count ? [make('p', { className: 'help', textContent: text('offline.lessons', more) })] : [];
}
