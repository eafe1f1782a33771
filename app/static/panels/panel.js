// What the panels beside the solution share: a button, a section, and whether an answer is that to the choices drawn.
import { make } from '../browser/dom.js';
import { family, said, text } from '../text/catalogue.js';

/** @import { Figure } from '../charts/figure.js' */
/** @import { Page } from '../page.js' */
/** @import { Answer } from '../wire/model.js' */

export const QUANTITIES = family('name.quantity');
const OF_THE_METHOD = ['method', 'modes', 'elements', 'motion_seconds', 'motion_links'];

export class Panel {
  /** @type {string | undefined} */ came; // the answer as it came, and what was read of it
  /** @type {Answer | null} */ read = null;
  /** @type {string[]} */ forKinds = []; // of scene, as Python says
  /** @type {string[]} */ by = []; // of what the method is, that on which its answer depends
  /** @type {Figure | null} */ figure = null; // that is shown while the panel is open

  /**
   * `name`: of the properties of the model; `asked`: those that are asked besides the choices.
   * @param {Page} page
   * @param {string} name
   * @param {string} label
   * @param {string} title
   * @param {string} heading
   * @param {string[]} [asked]
   */
  constructor(page, name, label, title, heading, asked = []) {
    this.page = page;
    this.name = name;
    this.asked = asked;
    this.button = make('button', { type: 'button', textContent: label, title });
    this.root = make('section', { className: `analysis ${name}`, hidden: true }, make('h2', { textContent: heading }));
    for (const each of [name, ...asked]) page.model.on(each, () => this.fill());
  }
  get open() {
    return this.page.model[`${this.name}_shown`];
  }
  toggle() {
    this.page.model[`${this.name}_shown`] = !this.open;
    this.take();
    this.opened();
  }
  /** Whether there is nothing to be said of this scene, though of its kind there is. */
  get empty() {
    return false;
  }
  get away() {
    return !this.forKinds.includes(this.page.frame.kind) || this.empty;
  }
  take() {
    this.button.ariaPressed = String(this.open);
    this.button.hidden = this.away;
    this.root.hidden = !this.open || this.away;
    this.frame();
    this.fill();
  }
  /** Show the figure while the panel is open. */
  frame() {
    if (this.root.hidden) this.figure?.close();
    else this.figure?.open().then(() => this.show(this.page.player.t));
  }
  /** @returns {Answer | null} */
  get answer() {
    const answer = this.page.model[this.name];
    if (answer !== this.came) {
      this.came = answer;
      this.read = answer ? JSON.parse(answer) : null;
    }
    return this.read;
  }
  /**
   * Whether an answer is that to the scene drawn, by whatever method it does not depend on, and to what is asked.
   * @param {Answer | null} found
   * @returns {boolean}
   */
  fresh(found) {
    const { by, page } = this;
    if (!found) return false;
    const free = OF_THE_METHOD.filter((key) => !by.includes(key));
    return (
      page.names.every((key) => free.includes(key) || found.chosen[key] === page.frame.chosen[key]) &&
      this.asked.every((key) => found.chosen[key] === page.model[key])
    );
  }
  fill() {
    if (!this.root.hidden && this.page.frame) this.render(this.answer, this.fresh(this.answer));
  }
  /** After it was opened or closed. */
  opened() {}
  /**
   * Say what was found, or that it is awaited.
   * @param {any} _found
   * @param {boolean} _fresh
   */
  render(_found, _fresh) {}
  /** @param {number} _t  the instant of the clock */
  show(_t) {}
  draw() {}
}

/** @typedef {{ name: string, modes?: number, elements?: number }} Shown  a method with its resolution */
const RESOLUTIONS = /** @type {const} */ (['modes', 'elements']);

/**
 * Show a method and its resolution on the page, as far as its sliders reach.
 * @param {Page} page
 * @param {Shown} method
 */
export function showMethod(page, method) {
  const { spec } = page.model;
  /** @type {Record<string, number>} */
  const choices = {};
  const left = [];
  if (!spec.method.options?.includes(method.name)) {
    page.complain(text('panel.cannot-show', { method: method.name }));
    return;
  }
  const refused = page.frame.refusals?.[method.name];
  if (refused && method.name !== spec.method.exact) {
    page.complain(said(refused));
    return;
  }
  for (const name of RESOLUTIONS) {
    const wanted = method[name];
    if (!wanted) continue;
    choices[name] = Math.min(Math.max(wanted, spec[name].low), spec[name].high);
    if (choices[name] !== wanted) left.push(text('panel.as-many', { name, count: choices[name], wanted }));
  }
  Object.assign(page.waiting, choices);
  page.send('method', method.name);
  if (left.length) page.complain(text('panel.shown-with', { what: left.join('; ') }));
}
/**
 * Whether the page shows it.
 * @param {Page} page
 * @param {Shown} method
 */
export const shown = (page, method) =>
  page.frame.chosen.method === method.name &&
  RESOLUTIONS.every((name) => !method[name] || page.frame.chosen[name] === method[name]);
