// The form: one control for each choice, made from the bounds that the server holds.
import { titleOf } from './settings.js';
import { said, text } from '../text/catalogue.js';
import { LABELS, METHODS } from '../text/words.js';
import { make } from '../browser/dom.js';
import { entryOf, SceneButton } from './scenes.js';
import { Slider } from './slider.js';

/** @import { AxialFrame, Cushion, Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */
/** @import { Kind } from '../frame/view.js' */

const DROPS = { default: 1, low: 0.001, high: 100, whole: false }; // m

/**
 * @typedef {object} Control
 * @property {HTMLElement} root
 * @property {(value: any, refused: boolean) => void} set
 * @property {(sentence: string) => void} [complain]  below its value
 */

export class Controls {
  /** @type {Record<string, Control>} */ fields = {};

  /** @param {Page} page */
  constructor(page) {
    const { spec } = page.model;
    this.page = page;
    this.spec = spec;
    this.held = page.changes.held;
    this.scene = new SceneButton(() => page.scenes.open());
    this.fields.scene = this.scene; // which stands in the bar
    this.root = make('form', { className: 'controls' });
    this.root.onsubmit = (event) => event.preventDefault();
    for (const name of Object.keys(spec)) {
      if (name === 'scene' || (!spec[name].options && spec[name].low === undefined)) continue; // bodies have own fields
      this.fields[name] = spec[name].options ? this.#select(name) : this.#slider(name);
      this.root.append(this.fields[name].root);
    }
    this.fields.drop_height = new Slider('drop_height', LABELS.drop_height, DROPS, (height) => this.#drop(height));
    this.root.append(this.fields.drop_height.root);
    this.method = /** @type {HTMLSelectElement} */ (this.root.querySelector('#choice-method'));
    this.cushions = make('div', { className: 'cushions', hidden: true });
    this.fields.law.root.append(this.cushions);
    this.note = make('p', { className: 'help' });
    this.fields.restitution.root.append(this.note);
    this.#hold();
  }
  /**
   * Takes every change that the visitor makes.
   * @param {string} name
   * @param {number | string} value
   */
  send(name, value) {
    this.page.opening.stay(() => this.page.send(name, value));
  }
  /** A link may say that controls are not shown, or stay as they are. */
  #hold() {
    for (const [name, { root }] of Object.entries(this.fields)) {
      root.classList.toggle('away', this.held.hidden.has(name));
      root.classList.toggle('fixed', this.held.fixed.has(name));
      if (!this.held.stays(name)) continue;
      for (const input of root.querySelectorAll('input, select, button'))
        /** @type {HTMLInputElement} */ (input).disabled = true;
    }
    this.root.classList.toggle('bodiless', this.held.hidden.has('bodies'));
  }
  /**
   * From so high: the speed with which it arrives is chosen.
   * @param {number} height  [m]
   */
  #drop(height) {
    const { fall } = /** @type {AxialFrame} */ (this.page.frame);
    if (fall) this.send('speed', Math.sqrt(2 * fall.gravity * height));
  }
  /** @param {string} name */
  #select(name) {
    const { title, options = {} } = LABELS[name];
    const id = `choice-${name}`;
    const input = make('select', { id });
    const all = this.spec[name].options ?? [];
    input.append(...all.map((value) => make('option', { value, textContent: options[value] ?? value })));
    input.onchange = () => this.send(name, input.value);
    const label = make('label', { htmlFor: id, textContent: title });
    label.dataset.term = name;
    const root = make('div', { className: `field field-${name}` }, label, input);
    const set = (/** @type {string} */ value) => {
      input.value = value;
      input.title = input.selectedOptions[0]?.textContent ?? '';
    };
    return { root, set };
  }
  /** @param {string} name */
  #slider(name) {
    return new Slider(name, LABELS[name], this.#boundsOf(name), (value) => this.send(name, value));
  }
  /** @param {string} name */
  #boundsOf(name) {
    const { high, low } = this.spec[name];
    const [least, most] = this.held.bounds.get(name) ?? [low, high];
    return { ...this.spec[name], low: least, high: most };
  }
  /**
   * Sliders that a step of a lesson bounds; all others reach as far as they can.
   * @param {Record<string, [low: number, high: number]>} bounds
   */
  bound(bounds) {
    const before = this.held.bounds;
    this.held.bounds = new Map(Object.entries(bounds));
    for (const name of new Set([...before.keys(), ...this.held.bounds.keys()])) {
      const field = this.fields[name];
      if (field instanceof Slider) field.reach(this.#boundsOf(name));
    }
  }
  /**
   * `refused`: back to this value, also where the hand still holds the slider.
   * @param {string} name
   * @param {any} value
   */
  show(name, value, refused = false) {
    this.fields[name]?.set(value, refused);
  }
  /** @param {string} name  of a slider, whether a hand is still on it */
  holds(name) {
    const field = this.fields[name];
    return field instanceof Slider && field.held;
  }
  /** @param {string[]} names  of those that are seen in the opening, the first of them first */
  lead(names) {
    for (const [name, { root }] of Object.entries(this.fields)) {
      root.classList.toggle('leading', names.includes(name));
      root.classList.toggle('foremost', names[0] === name);
    }
  }
  /**
   * Whether the choices that were refused are those of one field in view that has room to say so.
   * @param {string[]} names
   * @param {string} sentence
   */
  refused([name, ...others], sentence) {
    const field = this.fields[name];
    if (others.length || !field?.complain || !field.root.checkVisibility()) return false;
    field.complain(sentence);
    return true;
  }
  /**
   * The scene by its name, and whether it is still that one.
   * @param {Frame} frame
   */
  #entitle(frame) {
    const title = entryOf(String(frame.chosen.scene), frame.title || text('gallery.untitled'));
    this.scene.say(titleOf(frame, title));
  }
  /**
   * Sheets of rubber or wood between the two, each a linear spring.
   * @param {Frame} frame
   */
  #cushion(frame) {
    const all = 'cushions' in frame ? frame.cushions : [];
    const cushions = all.filter(({ settings }) => !Object.keys(settings).some((name) => this.held.stays(name)));
    this.cushions.hidden = !cushions.length;
    const on = (/** @type {Cushion} */ { settings }) =>
      Object.entries(settings).every(([name, value]) => frame.chosen[name] === value);
    const buttons = cushions.map((cushion) => {
      const act = () => {
        for (const [name, value] of Object.entries(cushion.settings)) {
          this.show(name, value);
          this.send(name, value);
        }
      };
      const name = text('controls.cushion', cushion);
      const button = make('button', { type: 'button', className: 'whole small', textContent: name, onclick: act });
      button.ariaPressed = String(on(cushion));
      return button;
    });
    const help = cushions.filter(on).map((cushion) => text('controls.cushion-about', cushion));
    this.cushions.replaceChildren(
      make('span', { textContent: text('controls.cushions') }),
      ...buttons,
      make('p', { className: 'help', textContent: help.join(' ') }),
    );
  }
  /**
   * Only what acts on this scene is shown; methods that cannot solve it say why.
   * @param {Frame} frame
   * @param {Kind} kind  of it
   */
  arrange(frame, kind) {
    for (const [name, value] of this.held.beyond(frame.chosen)) this.page.choose(name, value);
    this.#entitle(frame);
    this.#cushion(frame);
    for (const [name, { root }] of Object.entries(this.fields)) root.hidden = !frame.acting.includes(name);
    const fall = this.page.opening.teaching.on && 'fall' in frame ? frame.fall : null; // a setting of lessons
    this.fields.drop_height.root.hidden = !fall;
    if (fall) this.show('drop_height', fall.height);
    const seen = frame.acting.filter((name) => name !== 'scene' && !this.held.hidden.has(name)); // that is in the bar
    this.page.layout.bare(!seen.length);
    const onBeam = 'main' in frame;
    const label = this.fields.method.root.querySelector('label');
    if (label) label.textContent = onBeam ? LABELS.method.title : text('controls.compare-with');
    for (const option of this.method.options) {
      if (option.value === this.spec.method.exact) {
        const beside = frame.refusals.modal ? text('controls.nothing-beside') : METHODS.waves;
        option.textContent = onBeam ? text('controls.travelling-waves') : beside;
      }
      const reason = frame.refusals[option.value];
      option.disabled = Boolean(reason) && (onBeam || option.value !== this.spec.method.exact);
      option.title = reason ? said(reason) : '';
      option.hidden = reason?.code === 'refusals.no-mechanism'; // of all other scenes
    }
    const { note, predicts = false } = kind.restitution(frame, this.spec.method.exact);
    const restitution = this.fields.restitution.root.querySelector('label');
    if (restitution) restitution.textContent = predicts ? text('controls.predicted') : LABELS.restitution.title;
    this.note.textContent = note;
  }
}
