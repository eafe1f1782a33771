// A scene of the visitor's own as text: written, run, and kept once the server has solved it.
import { partsOf } from '../panels/code.js';
import { make } from '../browser/dom.js';
import { keepOwn, LONGEST, MOST_BYTES, nameOf, textOf } from '../wire/own.js';
import { text } from '../text/catalogue.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Gallery } from './gallery.js' */

export class Editor {
  asked = ''; // the name of the scene that is being solved

  /**
   * @param {Page} page
   * @param {Gallery} gallery
   */
  constructor(page, gallery) {
    this.page = page;
    this.gallery = gallery;
    const id = 'own-scene';
    this.field = make('textarea', { id, spellcheck: false, rows: 18, wrap: 'off' });
    this.why = make('p', { className: 'refusal', role: 'alert' });
    const act = (/** @type {string} */ textContent, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', className: 'whole', textContent, onclick });
    const buttons = make(
      'div',
      { className: 'acts' },
      act(text('gallery.run'), () => this.run(this.field.value)),
    );
    buttons.append(act(text('gallery.back'), () => this.gallery.turn()));
    const label = make('label', { htmlFor: id, textContent: text('gallery.editor') });
    this.root = make('div', { className: 'editor', hidden: true }, label, this.field, this.why, buttons);
  }
  /** Begin with the scene that is shown. */
  show() {
    this.#fill(partsOf(this.page.frame.head).scene);
  }
  /** @param {string} name  of one that is kept */
  async load(name) {
    this.#fill(await textOf(name));
  }
  /** @param {string} toml */
  #fill(toml) {
    this.field.value = toml;
    this.why.textContent = '';
    this.gallery.turn(this.root);
    this.field.focus();
    this.field.setSelectionRange(0, 0);
  }
  /** @param {string} toml */
  async run(toml) {
    this.field.value = toml;
    this.why.textContent = '';
    const name = await nameOf(toml);
    this.asked = name;
    if (name.length > LONGEST || toml.length > MOST_BYTES) this.refused(text('gallery.too-long'));
    else if (this.page.frame.chosen.scene === name) this.take(this.page.frame);
    else if (this.page.opening.teaching.on) this.gallery.choose(name);
    else this.page.choose('scene', name);
  }
  /**
   * Whether it was asked for here.
   * @param {string} sentence
   */
  refused(sentence) {
    if (!this.asked) return false;
    this.asked = '';
    this.gallery.open();
    this.gallery.turn(this.root);
    this.why.textContent = sentence;
    return true;
  }
  /** @param {Frame} frame */
  take({ chosen, title }) {
    if (!this.asked || chosen.scene !== this.asked) {
      if (this.page.model.scene !== this.asked) this.asked = ''; // another was chosen before it was solved
      return;
    }
    keepOwn({ name: this.asked, title: title || text('gallery.untitled') });
    this.asked = '';
    this.gallery.turn();
    this.gallery.close();
  }
}
