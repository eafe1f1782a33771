// The way to the map, and back: fetched when it is first opened.
import { make } from '../browser/dom.js';
import { late } from '../browser/late.js';
import { text } from '../text/catalogue.js';

/** @import { Page } from '../page.js' */
/** @import { WhatIf } from '../whatif/whatif.js' */

const KEY = 'w';

export class Door {
  /** @type {WhatIf | null} */ whatif = null; // once it was opened
  opened = false;
  scrolled = 0; // the picture, before

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.button = make('button', { type: 'button', className: 'to-map', textContent: text('opening.map') });
    this.button.title = text('opening.map-about');
    this.button.onclick = () => this.open();
  }
  /**
   * Have the map in place of the picture.
   * @param {string} [said]  what a link says of it
   */
  async open(said = '') {
    const { opening } = this.page;
    if (this.opened || opening.teaching.on) return;
    if (opening.plan !== 'opening') opening.turn('opening');
    this.opened = true;
    try {
      /** @type {typeof import('../whatif/entry.js')} */
      const { WhatIf: Map } = await late('whatif/entry.js');
      this.whatif ??= new Map(this.page, () => this.close());
    } catch {
      this.opened = false; // the server is gone
      this.page.complain(text('opening.no-map'));
      return;
    }
    if (!this.opened) return;
    const { root } = this.page;
    this.scrolled = root.scrollTop;
    const ready = this.whatif.enter(said); // it has the place of the picture by now
    root.scrollTop = 0;
    await ready;
    this.page.history.later();
  }
  close() {
    if (!this.opened) return;
    const { opening, root } = this.page;
    this.opened = false;
    this.whatif?.leave();
    opening.lead();
    this.button.focus({ preventScroll: true });
    root.scrollTop = this.scrolled;
    this.page.history.later();
  }
  /**
   * Sliders that are in view.
   * @param {string[]} names  without the map
   */
  leads(names) {
    return (this.opened && this.whatif?.gains.leads(names)) || names;
  }
  /** What a link says of it. */
  get said() {
    return this.opened && this.whatif ? this.whatif.said : null;
  }
  /** Another answer is shown. */
  take() {
    if (this.opened) this.whatif?.take();
  }
  /** The picture beside it was drawn anew. */
  drawn() {
    if (this.opened) this.whatif?.goal.force.follow();
  }
  /**
   * W opens it, Escape leads back.
   * @param {KeyboardEvent} event
   */
  key({ key }) {
    if (key === 'Escape' && this.opened) this.close();
    else if (key.toLowerCase() === KEY && !this.opened) this.open();
    else return false;
    return true;
  }
}
