// A button and the menu that drops from it; Escape closes it, and whatever else takes the focus.
import { make } from './dom.js';

export class Menu {
  /**
   * @param {string} className  of both
   * @param {{ className: string, textContent: string, title: string }} button
   */
  constructor(className, button) {
    this.button = make('button', { type: 'button', ...button, onclick: () => this.toggle() });
    this.button.ariaExpanded = 'false';
    this.list = make('div', { className: 'drop', hidden: true });
    this.root = make('div', { className }, this.button, this.list);
    this.root.onkeydown = (event) => {
      if (event.key !== 'Escape' || this.list.hidden) return;
      event.stopPropagation();
      this.close(true);
    };
    this.root.addEventListener('focusout', (event) => {
      if (!this.root.contains(/** @type {Node | null} */ (event.relatedTarget))) this.close();
    });
  }
  /**
   * @param {string} textContent
   * @param {() => void} act
   * @param {boolean} [stays]  the menu stays open
   */
  item(textContent, act, stays = false) {
    const onclick = () => {
      act();
      if (!stays) this.close(true);
    };
    const button = make('button', { type: 'button', textContent, onclick });
    this.list.append(button);
    return button;
  }
  toggle() {
    this.list.hidden = !this.list.hidden;
    this.button.ariaExpanded = String(!this.list.hidden);
  }
  /** @param {boolean} [back]  the focus goes back to the button */
  close(back = false) {
    if (this.list.hidden) return;
    this.toggle();
    if (back) this.button.focus();
  }
}
