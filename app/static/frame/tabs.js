// Tabs: one of several things in the same place. Arrow keys go from one to the next, as everywhere.
import { make } from '../browser/dom.js';

/** @type {Record<string, number>} */
const WAYS = { ArrowRight: 1, ArrowLeft: -1 };
let made = 0;

export class Tabs {
  /** @type {Map<string, { tab: HTMLButtonElement, panel: HTMLElement }>} */ entries = new Map();
  selected = '';

  /**
   * @param {string} ariaLabel
   * @param {Record<string, string>} titles  by name
   * @param {() => void} chosen  one of them, by a hand
   */
  constructor(ariaLabel, titles, chosen) {
    this.root = make('div', { className: 'tabs', role: 'tablist', ariaLabel });
    this.root.onkeydown = (event) => this.#key(event);
    made += 1;
    for (const [name, textContent] of Object.entries(titles)) {
      const tab = make('button', { type: 'button', role: 'tab', id: `tab-${made}-${name}`, textContent });
      const panel = make('div', { role: 'tabpanel', className: `tab-panel of-${name}` });
      panel.setAttribute('aria-labelledby', tab.id);
      tab.onclick = () => {
        this.select(name);
        chosen();
      };
      this.entries.set(name, { tab, panel });
      this.root.append(tab);
    }
  }
  /** That is selected. */
  get tab() {
    return this.entries.get(this.selected)?.tab;
  }
  get panels() {
    return [...this.entries.values()].map(({ panel }) => panel);
  }
  /** @param {string} name */
  panel(name) {
    const entry = this.entries.get(name);
    if (!entry) throw new Error(`there is no tab ${name}`);
    return entry.panel;
  }
  /** @param {string} name */
  select(name) {
    this.selected = name;
    for (const [each, { tab, panel }] of this.entries) {
      tab.ariaSelected = String(each === name);
      tab.tabIndex = each === name ? 0 : -1;
      panel.hidden = each !== name;
    }
  }
  /**
   * Which tabs there are; the first where the selected one is none of them.
   * @param {string[]} names
   */
  offer(names) {
    for (const [name, { tab }] of this.entries) tab.hidden = !names.includes(name);
    if (!names.includes(this.selected)) this.select(names[0]);
  }
  /** @param {string} name */
  offers(name) {
    return this.entries.get(name)?.tab.hidden === false;
  }
  /** @param {KeyboardEvent} event */
  #key(event) {
    const way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    const there = [...this.entries.values()].map(({ tab }) => tab).filter((tab) => !tab.hidden);
    const now = there.findIndex((tab) => tab.ariaSelected === 'true');
    const next = there[(now + way + there.length) % there.length];
    next.click();
    next.focus();
  }
}
