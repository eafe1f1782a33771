// All panels that answer questions beside the solution, and the buttons that open them.
import { make } from '../browser/dom.js';
import { late } from '../browser/late.js';
import { LISTED } from '../text/came.js';
import { text } from '../text/catalogue.js';
import { framed } from './frame.js';

/** @import { Page } from '../page.js' */
/** @import { Layout } from '../frame/layout.js' */
/** @import { Frame } from '../messages.js' */

/**
 * @typedef {object} View  what a button opens
 * @property {string[]} forKinds  of scene
 * @property {HTMLButtonElement} button
 * @property {HTMLElement} root
 * @property {boolean} open
 * @property {(frame: Frame) => void} take  another message
 * @property {() => void} toggle
 * @property {() => void} [opened]  after it was opened or closed
 * @property {(t: number) => void} show  what belongs to the instant
 * @property {() => void} draw
 */

/**
 * @typedef {(new (page: Page) => View) & { beside?: boolean }} Kind  `beside`: has room in the dock; the charts stay
 */

const MODULES = await Promise.all(LISTED.map(([, module]) => late(`panels/${module}.js`)));
/**
 * As app/views/registry.py lists them, with the kinds of scene that they are for.
 * @type {[name: string, kind: Kind, kinds: string[]][]}
 */
const KINDS = LISTED.map(([name, , kinds], place) => [name, MODULES[place].PANELS[name], kinds]);

/**
 * Whether it is open, and for this scene.
 * @param {View} view
 */
const seen = ({ root }) => !root.hidden && !root.classList.contains('away');

export class Analyses {
  /** @type {Layout} */ layout;
  /** @type {View[]} */ order = []; // the one that was opened last at the end
  /** @type {Map<string, View>} */ byName = new Map(); // of the address
  /** @type {Set<View>} */ widened = new Set(); // by hand
  menu = make('nav', { className: 'menu', ariaLabel: text('panel.menu') });
  side = make('div', { className: 'side' });

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    /** @type {View[]} */
    this.all = [];
    /** @type {Set<View>} */
    this.beside = new Set();
    for (const [name, Kind, kinds] of KINDS) {
      const view = new Kind(page);
      view.forKinds = kinds;
      this.byName.set(name, view);
      this.all.push(view);
      if (Kind.beside) this.beside.add(view);
      Object.assign(this, { [name]: view }); // for tests and benches
    }
    const about = make('p', { className: 'help', textContent: text('panel.about') });
    this.menu.append(about, ...this.all.map(({ button }) => button));
    for (const view of this.all) {
      framed(view, { widen: () => this.#widen(view), close: () => this.#close(view) });
      view.button.onclick = () => {
        if (view.open && this.#top(view)) this.#close(view);
        else this.open(view);
      };
    }
  }
  /**
   * Take the places that the page has for analyses.
   * @param {Layout} layout
   */
  settle(layout) {
    this.layout = layout;
    layout.tabs.panel('analysis').append(this.menu, this.side);
    this.arrange();
  }
  /**
   * Whether it is the one that is seen in its place.
   * @param {View} view
   */
  #top(view) {
    return this.#there(this.#isWide(view)).at(-1) === view;
  }
  /** @param {View} view */
  #isWide(view) {
    return !this.beside.has(view) || this.widened.has(view);
  }
  /**
   * Those that are open in one of the two places, the one that was opened last at the end.
   * @param {boolean} wide
   */
  #there(wide) {
    return this.order.filter((view) => seen(view) && this.#isWide(view) === wide);
  }
  /**
   * By hand: it takes the place of the one that is there.
   * @param {View} view
   */
  open(view) {
    const before = this.#there(this.#isWide(view)).at(-1);
    if (before && before !== view) before.toggle();
    if (!view.open) view.toggle();
    this.order = [...this.order.filter((each) => each !== view), view];
    this.arrange();
    if (!this.#isWide(view) || this.layout.tabbed) this.layout.show('analysis');
    view.root.focus({ preventScroll: true });
  }
  /** @param {View} view */
  #close(view) {
    this.widened.delete(view);
    if (view.open) view.toggle();
    this.arrange();
    view.button.focus({ preventScroll: true });
  }
  /** @param {View} view */
  #widen(view) {
    this.widened[this.widened.has(view) ? 'delete' : 'add'](view);
    this.arrange();
  }
  /** Each in its place, and of several only the last. */
  arrange() {
    const { layout, side } = this;
    this.order = this.order.filter(({ open }) => open); // so that a scene may open again what was closed
    const wide = this.#there(true).at(-1);
    const narrow = this.#there(false).at(-1);
    for (const view of this.all) {
      const place = this.#isWide(view) ? layout.wide : side;
      if (view.root.parentElement !== place) place.append(view.root);
      view.root.classList.toggle('behind', view !== wide && view !== narrow);
    }
    layout.tabs.panel('analysis').classList.toggle('occupied', Boolean(wide ?? narrow));
    layout.take(Boolean(wide), wide !== undefined && !this.beside.has(wide) && this.widened.has(wide), !narrow);
  }
  /** @param {Frame} frame */
  take(frame) {
    const before = this.order.map(seen).join();
    for (const view of this.all) view.take(frame);
    const opened = this.all.filter((view) => view.open && seen(view) && !this.order.includes(view)); // by the scene
    this.order.push(...opened);
    if (opened.length && this.layout.tabbed) this.layout.show('analysis');
    if (this.order.map(seen).join() !== before) this.arrange();
  }
  /** Wherever they stand: a lesson has them below its picture, in no place of the page's. */
  get #open() {
    return this.all.filter(({ open }) => open);
  }
  // Those that are open from the first on.
  resume() {
    const open = this.all.filter((view) => view.open);
    if (!open.length) return;
    this.order = open.toReversed();
    this.layout.show('analysis');
    this.arrange();
    for (const view of open) view.opened?.();
  }
  /** @param {number} t */
  show(t) {
    for (const view of this.#open) view.show(t);
  }
  draw() {
    for (const view of this.#open) view.draw();
  }
}
