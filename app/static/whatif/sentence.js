// The title of a map: a sentence whose words are the choices.
import { make } from '../browser/dom.js';
import { pretty } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { titleOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Result } from './results.js' */

export const SLOTS = { of: '⟦of⟧', x: '⟦x⟧', y: '⟦y⟧', within: '⟦within⟧' }; // stand for the choices
/** @typedef {keyof typeof SLOTS} Slot */

/** @param {number} share */
export const percent = (share) => `${pretty(100 * share)} %`;

/** @param {Axis} axis */
export const nameOf = ({ of, title }) => (of ? `${title}, ${of}` : title);

export class Sentence {
  /** @type {Record<Slot, HTMLSelectElement>} */ choices;

  /** @param {(slot: Slot, name: string) => void} choose */
  constructor(choose) {
    const select = (/** @type {Slot} */ slot, /** @type {string} */ ariaLabel) => {
      const made = make('select', { ariaLabel });
      made.onchange = () => choose(slot, made.value);
      return made;
    };
    this.choices = {
      of: select('of', text('whatif.of')),
      x: select('x', text('whatif.across')),
      y: select('y', text('whatif.upwards')),
      within: select('within', text('whatif.within')),
    };
    this.root = make('h2', { className: 'whatif-sentence', tabIndex: -1 });
    this.say(text('whatif.sentence', SLOTS));
  }
  /** @param {string} sentence  with signs in the places of choices */
  say(sentence) {
    const pieces = sentence.split(/(⟦\w+⟧)/).map((piece) => {
      const slot = /** @type {Slot | undefined} */ (Object.entries(SLOTS).find(([, sign]) => sign === piece)?.[0]);
      return slot ? this.choices[slot] : piece;
    });
    this.root.replaceChildren(...pieces);
  }
  /**
   * @param {{ results: Result[], axes: Axis[], of: Result, x: Axis, y: Axis, bounds: number[], within: number }} shown
   */
  show({ axes, bounds, of, results, within, x, y }) {
    this.#list(
      this.choices.of,
      results.map((name) => [name, titleOf(name)]),
      of,
    );
    const all = (/** @type {Axis} */ other) =>
      axes.filter((each) => each !== other).map((each) => [each.name, nameOf(each)]);
    this.#list(this.choices.x, all(y), x.name);
    this.#list(this.choices.y, all(x), y.name);
    this.#list(
      this.choices.within,
      bounds.map((bound) => [String(bound), percent(bound)]),
      String(within),
    );
  }
  /**
   * @param {HTMLSelectElement} select
   * @param {string[][]} options  value and words
   * @param {string} value
   */
  #list(select, options, value) {
    const known = JSON.stringify(options);
    if (select.dataset.options !== known) {
      select.replaceChildren(...options.map(([name, words]) => make('option', { value: name, textContent: words })));
      select.dataset.options = known;
    }
    if (select.value !== value) select.value = value;
  }
}
