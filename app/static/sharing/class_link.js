// A link for a class, made in a form: which controls stay as they are, which are not shown, and how far sliders go.
import { make, segments } from '../browser/dom.js';
import { commaOf, numberInput, refusalAt } from '../form/number_field.js';
import { shortOf } from '../form/settings.js';
import { linkOf, onlyHere } from '../frame/share.js';
import { text } from '../text/catalogue.js';
import { localised } from '../text/format.js';
import { typed } from '../text/units.js';
import { LABELS } from '../text/words.js';
import { CLOSER, endsOf, Held } from '../wire/held.js';

/** @import { Page } from '../page.js' */

const LARGE = 1e6; // from here on a number is written with its power of ten

/** @param {number} end */
const written = (end) => localised(end < LARGE ? String(end) : end.toExponential().replace('+', ''));

export class ClassLink {
  /** @param {Page} page */
  constructor(page) {
    const { model, changes } = page;
    this.page = page;
    this.spec = model.spec;
    this.held = new Held('', model.spec); // as that of the page, which stays as it is
    for (const name of changes.held.hidden) this.held.hidden.add(name);
    for (const name of changes.held.fixed) this.held.fixed.add(name);
    for (const [name, ends] of changes.held.bounds) this.held.bounds.set(name, ends);
    /** @type {Set<string>} */ this.wrong = new Set(); // whose ends cannot be
    this.rows = make('div', { className: 'link-rows' });
    this.seen = make('p', { role: 'status' });
    this.address = make('textarea', { rows: 2, readOnly: true, spellcheck: false });
    this.address.onfocus = () => this.address.select();
    this.copy = make('button', { type: 'button', className: 'whole', onclick: () => this.#copy() });
    const about = make('p', { className: 'help', textContent: text('class.link.about') });
    const label = make('label', {}, text('class.link.address'), this.address);
    const only = onlyHere();
    const note = make('p', { textContent: only, hidden: !only });
    const foot = make('footer', {}, this.seen, note, label, this.copy);
    this.root = make('dialog', { className: 'class-link' }, this.#head(), about, this.rows, foot);
    this.root.setAttribute('aria-labelledby', 'class-link');
    this.root.onkeydown = (event) => event.stopPropagation(); // to what is behind
    this.root.onclick = (event) => {
      if (event.target === this.root) this.root.close(); // beside it
    };
    page.root.append(this.root);
  }
  #head() {
    const title = make('h2', { id: 'class-link', textContent: text('class.link.title') });
    const close = make('button', { type: 'button', className: 'sign', textContent: '✕' });
    close.onclick = () => this.root.close();
    close.title = close.ariaLabel = text('layout.shut');
    return make('header', { className: 'panel-head' }, title, close);
  }
  async #copy() {
    try {
      await navigator.clipboard.writeText(this.address.value);
      this.copy.textContent = text('class.copied');
    } catch {
      this.address.focus();
      this.copy.textContent = text('class.link.selected'); // where a browser forbids it
    }
  }
  open() {
    this.wrong.clear();
    this.rows.replaceChildren(...this.names.map((name) => this.#row(name)));
    this.#follow();
    this.root.showModal();
  }
  /** Of the controls that are shown now, or would be if they were not hidden, and of the ways to see more. */
  get names() {
    return [...Object.keys(this.spec).filter((name) => this.page.frame.acting.includes(name)), CLOSER];
  }
  /** @param {string} name */
  #titleOf(name) {
    if (name === CLOSER) return text('class.link.closer');
    return this.page.controls.fields[name]?.root.querySelector('label')?.textContent || LABELS[name].title;
  }
  /** @param {string} name */
  #settings(name) {
    return name === CLOSER ? [] : [name];
  }
  /** @param {string} name */
  #row(name) {
    const { held, page } = this;
    const title = this.#titleOf(name);
    const now = name === 'scene' ? page.controls.scene.title.textContent : shortOf(this.#settings(name), page.frame);
    const ends = this.spec[name]?.low === undefined ? null : this.#ends(name, title);
    const ways = ['bodies', CLOSER].includes(name) ? ['free', 'hidden'] : ['free', 'fixed', 'hidden'];
    const pick = (/** @type {string} */ way) => {
      held.fixed.delete(name);
      held.hidden.delete(name);
      if (way === 'fixed') held.fixed.add(name);
      if (way === 'hidden') held.hidden.add(name);
      show(way);
      ends?.take(way === 'free');
      this.#follow();
    };
    const { root, show } = segments(title, ways, pick, (way) => text(`class.link.way.${way}`));
    show(held.hidden.has(name) ? 'hidden' : held.fixed.has(name) ? 'fixed' : 'free');
    ends?.take(!held.stays(name));
    const head = make('p', {}, make('b', { textContent: title }), ' ', make('small', { textContent: now }));
    return make('div', { className: 'link-row' }, head, root, ...(ends ? [ends.root] : []));
  }
  /**
   * Fields for both ends of a slider; `take` has them count, or not.
   * @param {string} name
   * @param {string} title
   */
  #ends(name, title) {
    const bounds = this.spec[name];
    const { unit = '', beside = unit } = LABELS[name];
    const inputs = (this.held.bounds.get(name) ?? [bounds.low, bounds.high]).map((end, k) => {
      const input = numberInput(bounds.whole);
      input.value = written(end);
      input.ariaLabel = text('class.link.end', { title, high: Boolean(k) });
      return input;
    });
    const [low, high] = inputs;
    const { wrong, complain } = refusalAt(low);
    high.setAttribute('aria-describedby', wrong.id);
    const take = (/** @type {boolean} */ counts) => {
      const { high: most, low: least, whole } = bounds;
      const ends = endsOf(
        inputs.map(({ value }) => String(typed(value, unit))),
        bounds,
      );
      const given = inputs.map(({ value }) => value.trim() || '–');
      const why =
        commaOf(low.value) || commaOf(high.value) || text('class.link.bad', { given, title, least, most, whole });
      root.hidden = !counts;
      complain(counts && !ends ? why : '');
      high.ariaInvalid = low.ariaInvalid;
      this.wrong[counts && !ends ? 'add' : 'delete'](name);
      if (!counts || !ends || (ends[0] === least && ends[1] === most)) this.held.bounds.delete(name);
      else this.held.bounds.set(name, ends);
    };
    for (const input of inputs) input.onchange = () => [take(true), this.#follow()];
    const parts = [text('class.link.from'), low, text('class.link.to'), high, beside];
    const root = make('div', { className: 'link-ends' }, ...parts, wrong);
    return { root, take };
  }
  /**
   * @param {Set<string>} all
   * @returns {string[] | null}  titles, in the order of the rows
   */
  #listed(all) {
    const found = this.names.filter((name) => all.has(name)).map((name) => this.#titleOf(name));
    return found.length ? found : null;
  }
  /** What is chosen, in a sentence. */
  get #sentence() {
    const { held, names } = this;
    const bounded = [...held.bounds].filter(([name]) => names.includes(name));
    const within = bounded.map(([name, [low, high]]) =>
      text('class.link.between', { title: this.#titleOf(name), low, high }),
    );
    const bodies = held.bodies && names.includes('bodies') && !held.hidden.has('bodies');
    const [hidden, fixed] = [this.#listed(held.hidden), this.#listed(held.fixed)];
    const taken = { hidden, fixed, bounded: within.length ? within : null };
    return text('class.link.seen', { ...taken, any: Object.values(taken).some(Boolean), bodies });
  }
  /** Link and sentence say what is chosen; there is no link while ends cannot be. */
  #follow() {
    const titles = this.#listed(this.wrong);
    this.seen.textContent = titles ? text('class.link.none', { titles }) : this.#sentence;
    this.address.value = titles ? '' : linkOf(this.page, this.held);
    this.copy.disabled = Boolean(titles);
    this.copy.textContent = text('class.copy'); // it may say that another was
  }
}
