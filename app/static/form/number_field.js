// Fields in which numbers are typed; what is refused stays in its field, with the reason below.
import { text } from '../text/catalogue.js';
import { ambiguous, signsOf, typed } from '../text/units.js';
import { make } from '../browser/dom.js';

const LONGEST = 24; // letters
let made = 0;

/** A field for a number; those with a unit take letters, which keypads for digits lack. */
export function numberInput(whole = false) {
  const inputMode = whole ? 'numeric' : 'text';
  const input = make('input', { type: 'text', inputMode, className: 'number', maxLength: LONGEST });
  input.autocomplete = 'off';
  return input;
}

/**
 * Room for what is wrong with what stands in a field.
 * @param {HTMLInputElement | HTMLSelectElement} input
 */
export function refusalAt(input) {
  const wrong = make('p', { className: 'wrong', role: 'alert', hidden: true, id: `wrong-${(made += 1)}` });
  const complain = (/** @type {string} */ sentence) => {
    wrong.hidden = !sentence;
    wrong.textContent = sentence;
    input.ariaInvalid = sentence ? 'true' : null;
    if (sentence) {
      input.setAttribute('aria-describedby', wrong.id);
      wrong.scrollIntoView({ block: 'nearest' }); // below the field, it may be beyond the edge
    } else input.removeAttribute('aria-describedby');
  };
  return { wrong, complain };
}

/**
 * Why what was typed is no clear number; nothing where only its comma is clear.
 * @param {string} given
 */
export const commaOf = (given) => (ambiguous(given) ? text('refused.comma', { value: given.slice(0, LONGEST) }) : '');

/**
 * @typedef {object} Asked
 * @property {string} control
 * @property {string} sign  of the unit of the field
 * @property {string} [si]  the unit that is sent, where it is another one
 * @property {number} [factor]  of the unit of the field, in that
 * @property {boolean} [whole]
 */

export class NumberField {
  last = ''; // that was shown
  typing = false;

  /**
   * @param {Asked} asked
   * @param {() => [low: number, high: number]} range  in the unit that is sent
   * @param {(value: number) => string} written  how a value is shown
   * @param {(value: number) => void} take
   */
  constructor(asked, range, written, take) {
    this.asked = asked;
    this.range = range;
    this.written = written;
    this.take = take;
    this.input = numberInput(asked.whole);
    const { wrong, complain } = refusalAt(this.input);
    this.wrong = wrong;
    this.complain = complain;
    this.input.oninput = () => {
      this.typing = this.input.value.trim() !== this.last;
      if (!this.typing) complain(''); // what was refused is undone
    };
    this.input.onchange = () => this.#typed();
  }
  #typed() {
    const { asked, input } = this;
    const { sign, si = sign, factor = 1, whole = false } = asked;
    const given = input.value.trim();
    const [low, high] = this.range();
    const value = typed(given, si, factor);
    const possible = value >= low && value <= high && (!whole || Number.isInteger(value));
    const range = { low: low / factor, high: high / factor, unit: sign || 'none', units: signsOf(si), whole };
    const said = { control: asked.control, value: `“${given.slice(0, LONGEST)}”`, ...range };
    this.typing = !possible;
    this.complain(possible ? '' : commaOf(given) || text('refused.typed', said));
    if (!possible) return;
    this.#write(this.written(value));
    this.take(value);
  }
  /** @param {string} shown */
  #write(shown) {
    this.last = this.input.value = shown;
  }
  /**
   * Show a value; what was typed stays while that is the same.
   * @param {number} value
   */
  set(value, always = false) {
    const shown = this.written(value);
    if (this.typing && shown === this.last && !always) return;
    this.typing = false;
    this.complain('');
    this.#write(shown);
  }
}
