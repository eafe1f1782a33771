// The menu of what a visitor takes along: picture, clip, histories, scene, link for a class; what makes it comes late.
import { text } from '../text/catalogue.js';
import { alone, carried } from '../browser/home.js';
import { late, lateSheet } from '../browser/late.js';
import { Menu } from '../browser/menu.js';
import { fileOf } from '../wire/own.js';
import { saveData } from './share.js';

/** @import { Page } from '../page.js' */
/** @typedef {import('../take/clip.js').Clip} Clip */
/** @typedef {typeof import('../take/files.js')} Files */
/** @typedef {(extension: string) => string} Named */

export class Take {
  /** @type {Clip | null} */ clip = null; // that is being recorded
  /** @type {import('../sharing/class_link.js').ClassLink | undefined} */ link;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    const button = { className: 'take', textContent: text('take.button'), title: text('take.about') };
    const menu = new Menu('takes', button);
    this.root = menu.root;
    this.button = menu.button;
    this.button.ariaLabel = button.textContent;
    menu.item(text('take.png'), () => this.#file(({ savePng }, named) => savePng(page, named)));
    menu.item(text('take.svg'), () => this.#file(({ saveSvg }, named) => saveSvg(page, named)));
    menu.item(text('take.clip'), () => this.#file((files, named) => this.#record(files, named)));
    if (!carried) {
      menu.item(text('take.data'), () => saveData(page));
      menu.item(text('take.code'), () => this.#code());
      if (alone) menu.item(text('class.link.title'), () => this.#link());
    }
    const open = this.button.onclick;
    this.button.onclick = (event) => (this.clip ? this.clip.stop() : open?.call(this.button, event));
  }
  /** @param {(files: Files, named: Named) => void} act */
  #file(act) {
    const scene = fileOf(this.page.frame.chosen.scene); // when it was asked for
    const named = (/** @type {string} */ extension) => `strikewave-${scene}.${extension}`;
    this.#try(async () => act(await late('take/files.js'), named));
  }
  #link() {
    const { page } = this;
    this.#try(async () => {
      const sheet = this.link ? null : lateSheet('sharing/class_link.css', page.root);
      const [{ ClassLink }] = await Promise.all([late('sharing/class_link.js'), sheet]);
      (this.link ??= /** @type {import('../sharing/class_link.js').ClassLink} */ (new ClassLink(page))).open();
    });
  }
  /** @param {() => Promise<void>} act */
  async #try(act) {
    try {
      await act();
    } catch {
      if (!this.page.connection?.miss('files')) this.page.complain(text('take.lost'));
    }
  }
  /**
   * @param {Files} files
   * @param {Named} named
   */
  #record({ record }, named) {
    if (this.clip) return; // it was asked for twice before it could begin
    this.clip = record(this.page, named, () => {
      this.clip = null;
      this.#say(text('take.button'));
    });
    if (this.clip) this.#say(text('take.stop'));
    else this.page.complain(text('take.no-clip'));
  }
  /** @param {string} words */
  #say(words) {
    this.button.textContent = this.button.ariaLabel = words;
    this.button.title = text(this.clip ? 'take.stop-about' : 'take.about');
    this.button.classList.toggle('recording', Boolean(this.clip));
  }
  #code() {
    const { analyses, opening } = this.page;
    if (opening.leads) opening.look('analysis');
    const code = analyses.byName.get('code');
    if (code) analyses.open(code);
  }
}
