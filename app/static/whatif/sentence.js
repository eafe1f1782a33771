// The title of a map: a sentence whose words are the choices.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { titleOf } from './results.js';

/** @import { Axis } from './axes.js' */
/** @import { Result } from './results.js' */

export const SLOTS = { of: '⟦of⟧', x: '⟦x⟧', y: '⟦y⟧' }; // stand for the choices

/** @param {Axis} axis */
export const nameOf = ({ of, title }) => (of ? `${title}, ${of}` : title);

export class Sentence {
  /** @type {Record<'of' | 'x' | 'y', HTMLSelectElement>} */ choices;

  /** @param {(slot: 'of' | 'x' | 'y', name: string) => void} choose */
  constructor(choose) {
    const select = (/** @type {'of' | 'x' | 'y'} */ slot, /** @type {string} */ ariaLabel) => {
      const made = make('select', { ariaLabel });
      made.onchange = () => choose(slot, made.value);
      return made;
    };
    this.choices = {
      of: select('of', text('whatif.of')),
      x: select('x', text('whatif.across')),
      y: select('y', text('whatif.upwards')),
    };
    this.root = make('h2', { className: 'whatif-sentence', tabIndex: -1 });
    this.say(text('whatif.sentence', SLOTS));
  }
  /** @param {string} sentence  with signs in the places of choices */
  say(sentence) {
    const pieces = sentence.split(/(⟦\w+⟧)/).map((piece) => {
      const slot = /** @type {'of' | 'x' | 'y' | undefined} */ (
        Object.entries(SLOTS).find(([, sign]) => sign === piece)?.[0]
      );
      return slot ? this.choices[slot] : piece;
    });
    this.root.replaceChildren(...pieces);
  }
  /**
   * @param {{ results: Result[], axes: Axis[], of: Result, x: Axis, y: Axis }} shown
   */
  show({ axes, of, results, x, y }) {
    this.#list(
      this.choices.of,
      results.map((name) => [name, titleOf(name)]),
      of,
    );
    const all = (/** @type {Axis} */ other) =>
      axes.filter((each) => each !== other).map((each) => [each.name, nameOf(each)]);
    this.#list(this.choices.x, all(y), x.name);
    this.#list(this.choices.y, all(x), y.name);
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
