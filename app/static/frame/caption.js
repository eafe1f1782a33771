// Under the bar: what happens at this instant, in one size for all that is said of an impact.
import { make } from '../browser/dom.js';

/** @import { Events } from './story.js' */

export class Caption {
  root = make('p', { className: 'caption' });
  longest = ''; // of all that is said
  constructor() {
    new ResizeObserver(() => this.fit()).observe(this.root);
  }
  /** @param {Events} events */
  say({ caption, events }) {
    const longest = longestOf(events.map(([, sentence]) => sentence));
    if (this.root.textContent === caption && this.longest === longest) return;
    this.root.textContent = caption;
    this.longest = longest;
    this.fit();
  }
  /** The longest sets the size of all; one that is cut even so is smaller still. */
  fit() {
    const { classList, textContent } = this.root;
    const cut = () => this.root.scrollHeight > this.root.clientHeight + 1;
    classList.remove('long', 'longest');
    this.root.textContent = this.longest;
    classList.toggle('long', cut());
    this.root.textContent = textContent;
    classList.toggle('longest', cut());
  }
}

/** @param {string[]} sentences */
const longestOf = (sentences) =>
  sentences.reduce((longest, each) => (each.length > longest.length ? each : longest), '');
