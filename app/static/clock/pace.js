// How fast the clock runs: as a multiple of the usual pace, or as a share of real time.
import { text } from '../text/catalogue.js';
import { grouped, localised } from '../text/format.js';
import { make } from '../browser/dom.js';

const MULTIPLES = [0.1, 0.25, 0.5, 1, 2, 4];
const SLOWED = [1e6, 2e5, 1e5, 5e4, 2e4, 1e4, 5e3, 2e3, 1e3, 100, 10, 1]; // times

/** @param {number} times */
const slowed = (times) =>
  times < 1.05 && times > 0.95 ? text('pace.whole') : times > 1 ? `1/${grouped(Number(times.toPrecision(2)))}` : '';

export class PaceMenu {
  speed = 1; // over the usual
  #usual = 0; // seconds of the impact in a second of playback

  /** @param {() => void} changed */
  constructor(changed) {
    this.changed = changed;
    const option = (/** @type {string} */ value) => make('option', { value });
    this.multiples = MULTIPLES.map((times) => option(String(times)));
    const real = SLOWED.map((times) => make('option', { value: `1/${times}`, textContent: slowed(times) }));
    const pace = text('pace.title');
    this.root = make('select', { className: 'pace', ariaLabel: pace, title: `${pace} (< >)` });
    this.root.append(make('optgroup', { label: text('pace.usual') }, ...this.multiples));
    this.root.append(make('optgroup', { label: text('pace.real') }, ...real));
    this.root.value = '1';
    this.root.onchange = () => this.#choose();
  }
  get value() {
    return this.root.value;
  }
  set value(value) {
    this.root.value = value;
    this.#choose();
  }
  #choose() {
    const [, times] = this.root.value.split('/');
    this.speed = times ? 1 / Number(times) / this.#usual : Number(this.root.value);
    this.changed();
  }
  /**
   * Another impact: what the paces mean in it.
   * @param {number} usual  seconds of it in a second of playback
   */
  load(usual) {
    if (usual === this.#usual) return;
    this.#usual = usual;
    MULTIPLES.forEach((times, k) => {
      const share = slowed(1 / (usual * times));
      this.multiples[k].textContent = `${localised(String(times))}×${share ? ` · ${share}` : ''}`;
    });
    if (this.root.value.includes('/')) this.#choose();
  }
  /** @param {number} way  slower or faster */
  next(way) {
    const of = this.root.selectedOptions[0]?.parentElement;
    const next = this.root.selectedIndex + way;
    const option = this.root.options[next];
    if (!option || option.parentElement !== of) return;
    this.root.selectedIndex = next;
    this.#choose();
  }
}
