// The help: keys, what is where, and the documentation where its address is set.
import { family, text } from '../text/catalogue.js';
import { make } from '../browser/dom.js';
import { alone, carried, framed } from '../browser/home.js';
import { wayOut } from './framed.js';
import { languagesOf } from './language.js';

/** @import { Page } from '../page.js' */

const KEYS = [
  'play',
  'step',
  'event',
  'pace',
  'loop',
  'keep',
  'map',
  'undo',
  'redo',
  'slider',
  'steps',
  'freeze',
  'zoom',
  'gallery',
  'help',
  'close',
];
const FINGERS = ['clock', 'zoom', 'striker', 'events', 'tabs'];
const PARTS = ['bar', 'picture', 'rows', 'closer', 'clock', 'controls', 'charts', 'story', 'numbers', 'analysis'];
const DOCUMENTS = ['page', 'lessons', 'scenes', 'records', 'how-it-is-computed', 'how-exact', 'command-line'];

/** Where the documentation is served, or nothing. */
const documentation = () => JSON.parse(document.getElementById('session')?.textContent || '{}').documentation ?? '';

/**
 * A table of what a name means.
 * @param {string[]} names
 * @param {Record<string, string>} heads
 * @param {Record<string, string>} meanings
 * @param {'kbd' | 'span'} tag
 */
const tableOf = (names, heads, meanings, tag) =>
  make(
    'table',
    {},
    ...names.map((name) => {
      const head = make('th', { scope: 'row' }, make(tag, { textContent: heads[name] }));
      return make('tr', {}, head, make('td', { textContent: meanings[name] }));
    }),
  );

export class Help {
  /** @param {Page} page */
  constructor(page) {
    const name = text('help.open');
    this.button = make('button', { type: 'button', className: 'open-help', textContent: '?', title: name });
    this.button.ariaLabel = name;
    this.button.setAttribute('aria-haspopup', 'dialog');
    this.button.onclick = () => this.open();
    const words = { type: 'button', className: 'to-lessons', textContent: text('gallery.lessons') };
    const lessons = make('button', { ...words, onclick: () => page.scenes.open() });
    lessons.setAttribute('aria-haspopup', 'dialog');
    const taught = alone && !carried && !page.changes.held.stays('scene') ? [lessons] : []; // its gallery opens
    this.buttons = framed ? [wayOut(page)] : [...taught, ...languagesOf(page), this.button];
    const close = make('button', { type: 'button', className: 'sign', textContent: '✕', onclick: () => this.close() });
    close.title = close.ariaLabel = text('help.close');
    const head = make(
      'header',
      { className: 'panel-head' },
      make('h2', { id: 'help', textContent: text('help.title') }),
    );
    head.append(close);
    this.root = make('dialog', { className: 'help-dialog' }, head);
    this.root.setAttribute('aria-labelledby', 'help');
    if (matchMedia('(hover: none) and (pointer: coarse)').matches)
      this.#part('help.fingers', tableOf(FINGERS, family('help.finger'), family('help.touch'), 'span'));
    else this.#part('help.keys', tableOf(KEYS, family('help.key'), family('help.does'), 'kbd'));
    this.#part('help.parts', tableOf(PARTS, family('help.part'), family('help.about'), 'span'));
    const address = documentation();
    if (address) this.#part('help.more', this.#links(address));
    this.root.onclick = (event) => {
      if (event.target === this.root) this.close(); // beside it
    };
  }
  /**
   * @param {string} title
   * @param {HTMLElement} content
   */
  #part(title, content) {
    this.root.append(make('section', {}, make('h3', { textContent: text(title) }), content));
  }
  /** @param {string} address */
  #links(address) {
    const pages = family('help.page');
    const addresses = family('help.address');
    const link = (/** @type {string} */ name) =>
      make('a', {
        href: new URL(addresses[name], `${address.replace(/\/*$/, '')}/`).href,
        target: '_blank',
        rel: 'noopener',
        textContent: text('help.document', { page: pages[name] }),
      });
    return make('ul', {}, ...DOCUMENTS.map((name) => make('li', {}, link(name))));
  }
  open() {
    if (!this.root.open) this.root.showModal(); // the browser keeps the focus in it, and gives it back
  }
  close() {
    this.root.close();
  }
  /**
   * Whether a key is its own: that which opens it, and any while it is open.
   * @param {KeyboardEvent} event
   * @param {boolean} taken  by what has the focus
   */
  key(event, taken) {
    if (this.root.open) return true;
    if (event.key !== 'F1' && (event.key !== '?' || taken)) return false;
    event.preventDefault();
    this.open();
    return true;
  }
}
