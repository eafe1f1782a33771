// Where everything is on the page. In the opening one dock slides in beside the picture, with all else in its tabs. The
// laboratory has a dock at either side of the centre; a window that is too narrow for it has the dock of the opening
// instead. Stage and clock never leave, and what opens takes the place of the charts.
import { wanted as scale } from '../charts/canvas.js';
import { family, text } from '../text/catalogue.js';
import { make } from '../browser/dom.js';
import { gripOf } from './grip.js';
import { alone, carried, framed } from '../browser/home.js';
import { keep, kept } from '../browser/store.js';
import { Tabs } from './tabs.js';

// How wide windows are below which it is one of these, in pixels where nobody wants letters larger.
const PHONE = 720;
const TABLET = 1100;
const LOW = 800; // how high a tablet that lies is: what would be above one another has no room, and stands side by side
const LARGE = window.matchMedia('(min-width: 1800px)');
const BESIDE = ['story', 'numbers', 'analysis'];
export const ALL = ['controls', 'charts', ...BESIDE]; // in this order, whatever the order of the texts
/** Of them, those that ask no server for anything, where there is none. */
export const OFFERED = carried ? ['charts', 'story', 'numbers'] : ALL;
const NAMES = family('layout.tab');
export const TITLES = Object.fromEntries(ALL.map((name) => [name, NAMES[name]]));
const CENTRE = 420; // pixels that the docks leave to the centre
const USUAL = 0.58; // of the window that they take at most, unless they were sized, and of that the left one:
const USUAL_LEFT = 0.4;
const DOCK = { usual: 0.42, wide: 0.54 }; // shares of the window that the one beside the picture takes
const LEAST = { left: 220, right: 250, dock: 320 }; // pixels of a dock, in which its words fit

/** @typedef {'desk' | 'lead'} Mode  the laboratory, or the opening, whose own sheet places its parts */
/** @typedef {{ left?: number, right?: number, dock?: number }} Pixels */
/** @typedef {Pixels & { folded?: Record<string, boolean> }} Sizes */

export class Layout {
  /** @type {Mode} */ mode = 'desk';
  /** @type {Sizes} */ sizes = kept('docks', {});
  full = false; // what is open takes the right dock's place too
  uncontrolled = false; // a link hides all that would be at the left
  spare = false; // no analysis is in the right dock: what is open has the room below its menu

  /**
   * @param {{ bar: HTMLElement, choices: HTMLElement, pinned: HTMLElement[], charts: HTMLElement[] }} parts
   * @param {import('../opening/opening.js').Opening} opening
   * @param {() => void} changed  after anything has moved
   */
  constructor({ bar, choices, pinned, charts }, opening, changed) {
    this.opening = opening;
    this.changed = changed;
    this.choices = choices;
    this.tabs = new Tabs(text('layout.tabs'), TITLES, () => this.#settle());
    this.strip = make('div', { className: 'strip' });
    this.pinned = make('div', { className: 'pinned' }, ...pinned, this.strip);
    this.caption = pinned[0];
    this.charts = make('div', { className: 'charts' }, ...charts);
    const none = make('p', { className: 'help none', textContent: text('layout.no-charts') });
    this.tabs.panel('charts').append(none);
    this.wide = make('div', { className: 'wide', hidden: true });
    this.left = make('section', { className: 'dock left', ariaLabel: text('layout.left') });
    this.centre = make('main', { className: 'centre', tabIndex: -1 }, this.pinned);
    const skip = make('button', { type: 'button', className: 'skip', textContent: text('layout.skip') });
    skip.onclick = () => (opening.leads ? opening.question : this.centre).focus();
    this.right = make('section', { className: 'dock right', ariaLabel: text('layout.right') }, this.tabs.root);
    const shut = make('button', {
      type: 'button',
      className: 'sign shut',
      textContent: '×',
      onclick: () => opening.turn('opening'),
    });
    shut.title = text('layout.shut');
    shut.ariaLabel = shut.title;
    this.right.append(shut, ...this.tabs.panels);
    this.grips = ['left', 'right'].map((name) => this.#grip(/** @type {any} */ (name)));
    this.folders = {
      left: this.#folder('left', text('layout.left'), '◧'),
      right: this.#folder('right', text('layout.right'), '◨'),
    };
    bar.prepend(this.folders.left);
    bar.append(this.folders.right);
    this.root = make('div', { className: 'page' }, skip, bar, this.left, this.centre, this.right, ...this.grips);
    const [first, ...others] = opening.parts;
    bar.after(first);
    this.root.append(...others);
    this.root.classList.toggle('embedded', !alone);
    this.root.classList.toggle('framed', framed);
    this.tabs.select('story');
    const moved = () => this.place();
    LARGE.addEventListener('change', moved);
    window.addEventListener('resize', moved);
    const resized = new ResizeObserver(moved);
    if (!alone) resized.observe(this.root);
    this.leave = () => {
      LARGE.removeEventListener('change', moved);
      window.removeEventListener('resize', moved);
      resized.disconnect();
    };
    this.place();
  }
  /** Whether all but picture and clock is in tabs. */
  get tabbed() {
    return this.mode === 'lead';
  }
  /** @returns {[width: number, height: number]} in pixels, of the window or of its place in another's page */
  get #room() {
    const { clientWidth, clientHeight } = this.root;
    return alone || !clientWidth ? [window.innerWidth, window.innerHeight] : [clientWidth, clientHeight];
  }
  /** @param {'left' | 'right'} name */
  folded(name) {
    return Boolean(this.sizes.folded?.[name]) || (name === 'left' && this.uncontrolled);
  }
  /** @param {boolean} uncontrolled  whether there is none to be seen */
  bare(uncontrolled) {
    if (uncontrolled === this.uncontrolled) return;
    this.uncontrolled = this.folders.left.hidden = this.grips[0].hidden = uncontrolled;
    this.#offer();
    this.#settle();
  }
  /** Tabs of the dock beside the picture. */
  get offered() {
    return OFFERED.filter((name) => name !== 'controls' || !this.uncontrolled);
  }
  #offer() {
    this.tabs.offer(this.tabbed ? this.offered : BESIDE);
  }
  /** Put everything where it belongs at this width. */
  place() {
    const [width, height] = this.#room.map((size) => size / scale);
    const { opening } = this;
    const follows = framed && opening.teaching.on; // its height is as its width needs
    const across = width < TABLET && height < Math.min(LOW, width) && !follows;
    const size = width < PHONE || across ? 'phone' : width < TABLET ? 'tablet' : 'desk';
    this.root.dataset.size = size;
    opening.narrow = size !== 'desk';
    /** @type {Mode} */
    const mode = opening.leads ? 'lead' : 'desk';
    this.root.classList.toggle('across', across);
    if (mode !== this.mode || !this.choices.parentElement) {
      this.mode = mode;
      this.root.dataset.mode = mode;
      const { tabbed } = this;
      if (tabbed) opening.ask.after(this.caption);
      else this.pinned.prepend(this.caption);
      this.root.classList.toggle('tabbed', tabbed);
      (tabbed ? this.tabs.panel('charts') : this.centre).append(this.charts);
      if (tabbed) this.tabs.panel('analysis').prepend(this.wide);
      else this.centre.append(this.wide);
      this.charts.hidden = !this.wide.hidden && !tabbed;
      this.#offer();
      if (opening.plan === 'laboratory' && this.tabs.offers('controls')) this.tabs.select('controls');
    }
    this.#settle();
  }
  /** After anything that decides what is seen. */
  #settle() {
    const { opening, tabs } = this;
    const place = opening.docked && tabs.selected === 'controls' ? tabs.panel('controls') : this.left;
    if (this.choices.parentElement !== place) place.append(this.choices);
    this.#measure();
    this.changed();
  }
  /** How wide the docks are. */
  #measure() {
    const { root, sizes } = this;
    const [whole] = this.#room;
    const room = whole - CENTRE;
    const usual = USUAL * whole;
    const least = (/** @type {'left' | 'right' | 'dock'} */ name) => sizes[name] && Math.max(sizes[name], LEAST[name]);
    const left = Math.min(least('left') ?? Math.min(256 * scale, USUAL_LEFT * usual), room / 2);
    const wanted = least('right') ?? Math.min((LARGE.matches ? 560 : 380) * scale, usual - left);
    const right = Math.min(wanted, room - left);
    root.style.setProperty('--left', `${this.folded('left') ? 0 : left}px`);
    root.style.setProperty('--right', `${this.folded('right') || this.full ? 0 : right}px`);
    const studied = this.tabs.selected === 'analysis' && !this.wide.hidden;
    const dock = least('dock') ?? Math.max((studied ? DOCK.wide : DOCK.usual) * whole, LEAST.dock);
    root.style.setProperty('--dock', `${Math.min(dock, room)}px`);
    const { tabbed } = this;
    const { docked } = this.opening;
    this.left.hidden = !tabbed && this.folded('left');
    root.classList.toggle('docked', docked);
    this.right.hidden = tabbed ? !docked : this.folded('right') || this.full;
    const menu = !tabbed && this.tabs.selected === 'analysis' && this.spare;
    root.classList.toggle('spread', menu && !this.wide.hidden && !this.right.hidden);
    this.folders.left.ariaPressed = String(!this.folded('left'));
    this.folders.right.ariaPressed = String(!this.folded('right') && !this.full);
  }
  /** @param {'left' | 'right'} name */
  #grip(name) {
    const label = text(`layout.size.${name}`);
    const own = () => (name === 'left' ? name : this.tabbed ? 'dock' : 'right');
    const resize = (/** @type {number} */ wanted) => {
      this.sizes[own()] = Math.max(wanted, LEAST[own()]);
      this.#measure();
    };
    return gripOf({ label, name, size: () => this[name].clientWidth, resize, rest: () => this.#keep() });
  }
  /**
   * The button in the bar that folds a dock.
   * @param {'left' | 'right'} name
   * @param {string} title
   * @param {string} textContent
   */
  #folder(name, title, textContent) {
    const button = make('button', {
      type: 'button',
      className: `folder ${name}`,
      title,
      ariaLabel: title,
      textContent,
    });
    button.onclick = () => {
      const folded = name === 'right' && this.full ? true : this.folded(name);
      if (name === 'right') this.full = false;
      this.sizes.folded = { ...this.sizes.folded, [name]: !folded };
      this.#keep();
    };
    return button;
  }
  #keep() {
    keep('docks', this.sizes);
    this.#settle();
  }
  /**
   * Have a tab seen.
   * @param {string} name
   */
  show(name) {
    this.tabs.select(name);
    if (!this.tabbed && this.folded('right')) this.sizes.folded = { ...this.sizes.folded, right: false };
    this.#settle();
  }
  /**
   * Something takes the place of the charts, or gives it back.
   * @param {boolean} taken
   * @param {boolean} full  and that of the right dock
   * @param {boolean} spare  in which there is none beside its menu
   */
  take(taken, full, spare) {
    this.spare = spare;
    this.wide.hidden = !taken;
    this.charts.hidden = taken && !this.tabbed;
    this.root.classList.toggle('studying', taken);
    this.full = taken && full;
    this.#settle();
  }
}
