// The button that keeps a solution, its menu, and the kept ones in a row below the clock.
import { KEPT } from '../charts/styles.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { questionsOf } from './questions.js';
import { LETTERS } from '../frame/kept.js';
import { differing, lineOf, shortOf, titleOf } from '../form/settings.js';
import { comparable } from './kinds.js';
import { signOf } from './summary.js';

/** @import { Frame } from '../messages.js' */
/** @import { Compare } from './compare.js' */
/** @import { Run } from './run.js' */

const EDGE = 8; // pixels between the menu and the edge of the window

export class Bar {
  /** @param {Compare} compare */
  constructor(compare) {
    this.compare = compare;
    this.pin = make('button', { type: 'button', className: 'pin', textContent: text('compare.keep') });
    this.pin.title = text('compare.keep-hint');
    this.pin.setAttribute('aria-keyshortcuts', 'K');
    this.pin.onclick = () => compare.keep();
    this.more = make('button', { type: 'button', className: 'pin more-pins', textContent: '▾' });
    this.more.title = this.more.ariaLabel = text('compare.more');
    this.more.ariaExpanded = 'false';
    this.more.onclick = () => this.#toggle();
    this.menu = make('div', { className: 'menu', hidden: true });
    this.button = make('div', { className: 'pins' }, this.pin, this.more, this.menu);
    this.button.onkeydown = (event) => {
      if (event.key === 'Escape') this.#close(true);
    };
    this.button.addEventListener('focusout', (event) => {
      if (!this.button.contains(/** @type {Node | null} */ (event.relatedTarget))) this.#close();
    });
    this.row = make('div', { className: 'runs', role: 'group', ariaLabel: text('compare.runs'), hidden: true });
  }
  #toggle() {
    if (this.menu.hidden) this.#fill();
    this.menu.hidden = !this.menu.hidden;
    const { top } = this.menu.getBoundingClientRect();
    this.menu.style.maxHeight = `${window.innerHeight - top - EDGE}px`; // else the last are below the window
    this.more.ariaExpanded = String(!this.menu.hidden);
  }
  /** Open the menu, from elsewhere on the page. */
  open() {
    this.more.focus();
    if (this.menu.hidden) this.#toggle();
    /** @type {HTMLElement | null} */ (this.menu.querySelector('button'))?.focus();
  }
  /** @param {boolean} [back]  the focus goes back to the button */
  #close(back = false) {
    if (this.menu.hidden) return;
    this.#toggle();
    if (back) this.more.focus();
  }
  /**
   * @param {string} textContent
   * @param {() => void} act
   * @param {boolean} [pressed]
   */
  #item(textContent, act, pressed) {
    const onclick = () => {
      this.#close(true);
      act();
    };
    const item = make('button', { type: 'button', textContent, onclick });
    if (pressed !== undefined) item.ariaPressed = String(pressed);
    return item;
  }
  #fill() {
    const { compare } = this;
    const { frame } = compare.page;
    const asks = questionsOf(frame).map((question) =>
      this.#item(text(`compare.question.${question.question}`), () => compare.ask(question)),
    );
    const heading = make('span', { className: 'menu-title', textContent: text('compare.ready') });
    this.menu.replaceChildren(...(asks.length ? [heading, ...asks, make('hr')] : []));
    if (compare.lockable)
      this.menu.append(this.#item(text('compare.lock'), () => compare.lock(!compare.locked), compare.locked));
    if (!compare.runs.length) return;
    const shown = Boolean(compare.beside);
    const last = compare.runs[compare.runs.length - 1];
    this.menu.append(
      this.#item(text('compare.beside'), () => compare.standBeside(shown ? null : last), shown),
      this.#item(text('compare.clear'), () => compare.clear()),
    );
  }
  /**
   * What is kept, by the settings in which it differs.
   * @param {Frame} now
   * @param {string | null} coming  what is being solved to be compared with it
   */
  load(now, coming) {
    const { compare } = this;
    const { locked, runs } = compare;
    this.row.hidden = !runs.length && !locked;
    this.pin.disabled = !freeLetter(runs);
    this.pin.title = text(this.pin.disabled ? 'compare.full' : 'compare.keep-hint');
    if (this.row.hidden) return;
    const beside = runs.flatMap(({ frame }) => (comparable(now, frame) ? [frame] : []));
    const names = differing([now, ...beside]);
    const chips = runs.map((run) => {
      const { frame } = run;
      return this.#chip(
        run,
        beside.includes(frame) ? shortOf(names, frame) || (coming ? '' : text('compare.same')) : titleOf(frame),
      );
    });
    const own = make('span', { className: 'chip-run now' }, make('b', { textContent: text('compare.now') }));
    const what = coming ?? lineOf(names, now);
    own.append(make('span', { className: 'what', textContent: what, title: what }));
    const lock = make('button', { type: 'button', className: 'chip-run lock', textContent: text('compare.locked') });
    lock.title = text('compare.unlock');
    lock.onclick = () => compare.lock(false);
    this.row.replaceChildren(...(runs.length ? [own, ...chips] : []), ...(locked ? [lock] : []));
  }
  /**
   * @param {Run} run
   * @param {string} what
   */
  #chip(run, what) {
    const { compare } = this;
    const name = run.letter;
    const button = (/** @type {string} */ className, /** @type {string} */ hint, /** @type {() => void} */ onclick) =>
      make('button', { type: 'button', className, title: hint, ariaLabel: hint, onclick });
    const show = button('show', text('compare.show-beside', { name: [name, what].filter(Boolean).join(' ') }), () =>
      compare.standBeside(compare.beside === run ? null : run),
    );
    show.append(signOf(name), ' ', make('span', { className: 'what', textContent: what, title: what }));
    show.ariaPressed = String(compare.beside === run);
    const back = button('back', text('compare.restore', { name }), () => compare.goBack(run));
    back.textContent = '↩';
    const remove = button('remove', text('compare.remove', { name }), () => compare.remove(run));
    remove.textContent = '✕';
    const chip = make('span', { className: 'chip-run' }, show, back, remove);
    chip.style.borderColor = KEPT[name];
    return chip;
  }
}

/**
 * The first letter that is free.
 * @param {Run[]} runs
 */
export const freeLetter = (runs) => LETTERS.find((letter) => runs.every((run) => run.letter !== letter));
