// The bodies: what each is and what follows from it, with a field for every value that can be set.
import { family, named, text } from '../text/catalogue.js';
import { pretty } from '../text/format.js';
import { typeset } from '../browser/typeset.js';
import { spoken } from '../text/typeset.js';
import { inUnit, isCoordinate, placeOf, read, unitOf, unitsFor, written } from '../wire/body_values.js';
import { make } from '../browser/dom.js';
import { commaOf, numberInput, refusalAt } from './number_field.js';
import { slides } from './swipe.js';

/** @import { Page } from '../page.js' */
/** @import { Frame, PartRecord, ValueRecord } from '../messages.js' */

const NAMES = family('body.value');
const DERIVED = family('body.derived');
const MATERIALS = family('name.material');
const KINDS = family('bodies.kind');
const PATIENCE = 3000; // ms without an answer, after which a value is asked for again; then twice as many
const MAX_TRIES = 5;
const MANY = 2; // bodies, beyond which they are opened one by one
const STEPS = 200;
let made = 0;

/**
 * A field for one value.
 * @typedef {object} Field
 * @property {HTMLElement} root
 * @property {(value: ValueRecord) => void} show
 * @property {(sentence: string) => void} complain  at the field; an empty sentence when all is well
 */

export class Bodies {
  made = ''; // for which bodies the fields are
  /** @type {Map<string, Field>} */ fields = new Map(); // by key
  /** @type {Map<string, (part: PartRecord) => void>} */ heads = new Map();
  /** @type {Map<string, string | number | undefined>} */ waiting = new Map(); // by key: the value to be asked for
  tries = 0; // of the value that is asked for
  /** @type {number | undefined} */ patience;
  asked = ''; // the key that is being answered
  /** @type {string | number | undefined} */ value; // that is asked for it

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.list = make('div', { className: 'body-list' });
    this.root = make('section', { className: 'bodies', hidden: true });
    this.root.append(make('h2', { textContent: text('bodies.title') }), this.list);
    page.model.on('body_value', () => {
      if (!page.model.body_value) this.#answered();
    });
  }
  /** @param {Frame} frame */
  load(frame) {
    const { parts } = frame;
    this.root.hidden = !parts.length;
    const kind = JSON.stringify(parts.map(({ key, kind: each, values }) => [key, each, values.map((v) => v.quantity)]));
    if (kind !== this.made) this.#make(parts);
    this.made = kind;
    for (const part of parts) {
      this.heads.get(part.key)?.(part);
      for (const value of part.values) this.fields.get(`${part.key}.${value.quantity}`)?.show(value);
    }
  }
  /**
   * Whether the value that is being asked was refused, which is then said at its field.
   * @param {string} sentence
   */
  refused(sentence) {
    const field = this.fields.get(this.asked);
    if (!this.asked || !field) return false;
    field.complain(sentence);
    return true;
  }
  /**
   * Have a value set, or with none go back to that of the scene.
   * @param {string} key
   * @param {string | number} [value]
   */
  set(key, value) {
    this.waiting.set(key, value);
    this.tries = 0;
    this.#ask();
  }
  #answered() {
    clearTimeout(this.patience);
    if (this.asked) this.tries = 0; // else it is asked for again
    this.asked = '';
    this.#ask();
  }
  /** What a server says before the page is drawn may be lost: the same is asked again. */
  #again() {
    const { asked, page, value } = this;
    if (!asked) return;
    this.tries += 1;
    if (this.tries < MAX_TRIES && !this.waiting.has(asked)) this.waiting = new Map([[asked, value], ...this.waiting]);
    this.asked = '';
    page.model.body_value = ''; // which the page hears of, as of any change
    this.#ask();
  }
  /**
   * Whether a value has no answer yet.
   * @param {string} key
   */
  #awaited(key) {
    return this.asked === key || this.waiting.has(key);
  }
  /** Keys and values that have no answer yet. */
  get unanswered() {
    return [...(this.asked ? [[this.asked, this.value]] : []), ...this.waiting];
  }
  /** One at a time: each is answered by what the bodies are then. */
  #ask() {
    const { changes, model, player } = this.page;
    const [next] = this.waiting;
    if (!next || this.asked || changes.server.lost()) return;
    const [key, value] = next;
    this.waiting.delete(key);
    this.asked = key;
    this.value = value;
    player.rest();
    changes.leave();
    this.patience = window.setTimeout(() => this.#again(), PATIENCE * 2 ** this.tries);
    model.body_value = value === undefined ? key : `${key}=${value}`;
  }
  /** @param {PartRecord[]} parts */
  #make(parts) {
    this.fields.clear();
    this.heads.clear();
    this.list.replaceChildren(...parts.map((part) => this.#part(part, parts)));
    typeset(this.list);
    if (!this.page.changes.held.bodies) return;
    for (const input of this.list.querySelectorAll('input, select, button'))
      /** @type {HTMLInputElement} */ (input).disabled = true;
  }
  /**
   * @param {PartRecord} part
   * @param {PartRecord[]} parts  all of them
   */
  #part({ derived: follows, key, kind, strikes, values }, parts) {
    const [body, group = body] = key.split('.');
    const name = text(`bodies.head.${group}`, { ...placeOf(key, parts), body, kind: KINDS[kind] ?? kind, strikes });
    if (!values.length && !follows.length)
      return make('div', { className: 'body bare' }, make('b', { textContent: name }), text('bodies.nothing'));
    const open = parts.length <= MANY;
    const facts = make('span', { className: 'facts' });
    const derived = make('dl', { className: 'derived' });
    const title = text('bodies.reset-about', { name });
    const reset = make('button', { type: 'button', className: 'when', textContent: text('bodies.reset'), title });
    reset.ariaLabel = title;
    reset.onclick = () => this.set(key);
    const fields = values.map((value) => {
      const whole = `${key}.${value.quantity}`;
      const field =
        value.quantity === 'material' ? this.#material(whole, name) : this.#number(whole, value, name, parts);
      this.fields.set(whole, field);
      return field.root;
    });
    const root = make('details', { className: 'body', open });
    root.append(make('summary', {}, make('b', { textContent: name }), facts), ...fields, derived, reset);
    this.heads.set(key, (part) => {
      facts.textContent = factsOf(part);
      reset.hidden = part.values.every(({ value, own }) => same(value, own));
      derived.replaceChildren(
        ...part.derived.flatMap(([each, value]) => [
          make('dt', { textContent: DERIVED[each] ?? each }),
          make('dd', { textContent: written(each, value) }),
        ]),
      );
    });
    return root;
  }
  /**
   * @param {string} key
   * @param {string} body
   * @returns {Field}
   */
  #material(key, body) {
    made += 1;
    const input = make('select', { id: `body-${made}` });
    input.append(...Object.entries(MATERIALS).map(([value, textContent]) => make('option', { value, textContent })));
    const own = make('option', { value: '', textContent: text('bodies.own-material') });
    own.disabled = true;
    input.append(own);
    input.onchange = () => this.set(key, input.value);
    input.ariaLabel = text('bodies.field', { name: NAMES.material, unit: 'choice', body });
    const label = make('label', { htmlFor: input.id, textContent: NAMES.material });
    const row = rowOf(label, input);
    return {
      root: row.root,
      complain: row.complain,
      show: ({ value, own: scenes }) => {
        row.complain('');
        input.value = String(value ?? '');
        row.mark(same(value, scenes), named('material', String(scenes)) || text('bodies.own-material'));
      },
    };
  }
  /**
   * @param {string} key
   * @param {ValueRecord} record
   * @param {string} body
   * @param {PartRecord[]} parts  all bodies
   * @returns {Field}
   */
  #number(key, { quantity, own, low, high }, body, parts) {
    made += 1;
    const input = Object.assign(numberInput(), { id: `body-${made}`, placeholder: text('bodies.unknown') });
    let unit = unitOf(quantity, Number(own ?? 0));
    let last = '';
    let entered = ''; // until it is answered
    let typing = false;
    const label = make('label', { htmlFor: input.id, textContent: NAMES[quantity] });
    const sign = make('span', { className: 'unit', textContent: unit.sign });
    const scale = scaleOf(quantity, Number(own), parts);
    const tried = (/** @type {number} */ value) => {
      entered = '';
      this.set(key, value);
    };
    const slider = scale && sliderOf(scale, tried);
    const row = rowOf(label, input, sign, ...(slider ? [slider.root] : []));
    input.oninput = () => {
      typing = input.value.trim() !== last;
      if (!typing) row.complain(''); // what was refused is undone
    };
    input.onchange = () => {
      const given = input.value.trim();
      typing = given !== last;
      if (!typing) return row.complain('');
      if (!given) {
        typing = false;
        entered = '';
        return this.set(key);
      }
      const value = read(given, quantity, unit);
      const refused = refusalOf(value, given, unit, { quantity, low, high });
      row.complain(refused);
      if (refused) return undefined;
      typing = false;
      entered = input.value = inUnit(value, unit); // not as it was typed
      return this.set(key, value);
    };
    return {
      root: row.root,
      complain: (sentence) => {
        row.complain(sentence);
        typing = false;
        if (sentence) input.value = entered || last;
        if (sentence) slider?.show();
      },
      show: ({ value, own: scenes }) => {
        unit = unitOf(quantity, Number(scenes ?? value ?? 0));
        sign.textContent = unit.sign;
        input.ariaLabel = text('bodies.field', { name: spoken(NAMES[quantity]), unit: unit.sign || 'none', body });
        const shown = value === null ? '' : inUnit(Number(value), unit);
        if (shown !== (entered || last)) row.complain('');
        last = shown;
        if (!this.#awaited(key)) entered = '';
        if (!typing) input.value = entered || last;
        const about = text('bodies.slider', { name: spoken(NAMES[quantity]), body });
        slider?.show(Number(value), `${last} ${unit.sign}`, about);
        row.mark(same(value, scenes), scenes === null ? text('bodies.unknown') : written(quantity, Number(scenes)));
      },
    };
  }
}

/**
 * Why what was typed cannot be, or nothing.
 * @param {number} value  in SI units
 * @param {string} given
 * @param {import('../text/units.js').Unit} unit
 * @param {{ quantity: string, low: number | null, high: number | null }} bounds
 */
function refusalOf(value, given, unit, { quantity, low, high }) {
  const end = (/** @type {number | null} */ bound) => `${pretty(Number(bound) / unit.factor)} ${unit.sign}`.trim();
  const said = { given: given.slice(0, 24), unit: unit.sign || 'none', units: unitsFor(quantity) };
  if (Number.isNaN(value)) return commaOf(given) || text('bodies.not-number', said);
  const within = low === null || high === null || (value >= low && value <= high);
  return within ? '' : text('bodies.not-within', { ...said, low: end(low), high: end(high) });
}

/**
 * A label with its field, and room for what is wrong with it.
 * @param {HTMLElement} label
 * @param {HTMLInputElement | HTMLSelectElement} input
 * @param {...HTMLElement} more
 */
function rowOf(label, input, ...more) {
  const { wrong, complain } = refusalAt(input);
  const root = make('div', { className: 'body-value' }, label, input, ...more, wrong);
  const mark = (/** @type {boolean} */ own, /** @type {string} */ scenes) => {
    root.classList.toggle('changed', !own);
    input.title = own ? '' : text('bodies.own', { value: scenes });
  };
  return { root, complain, mark };
}

/**
 * Of a size that is tried by hand, values along a slider from 0 to 1, that of the scene in the middle: lengths from
 * half to twice, places of joints as far as these are apart.
 * @typedef {{ at: (share: number) => number, share: (value: number) => number }} Scale
 * @param {string} quantity
 * @param {number} own
 * @param {PartRecord[]} parts  all bodies
 * @returns {Scale | null}
 */
function scaleOf(quantity, own, parts) {
  if (quantity === 'length' && own > 0)
    return { at: (share) => own * 2 ** (2 * share - 1), share: (value) => (Math.log2(value / own) + 1) / 2 };
  if (!isCoordinate(quantity)) return null;
  const places = parts.flatMap(({ values }) => values.filter((each) => isCoordinate(each.quantity)));
  const all = places.map((each) => Number(each.own));
  const reach = Math.max(...all) - Math.min(...all);
  return { at: (share) => own + reach * (share - 0.5), share: (value) => (value - own) / reach + 0.5 };
}

/**
 * A slider, which shows what the server holds unless a hand holds it.
 * @param {Scale} scale
 * @param {(value: number) => void} send
 */
function sliderOf(scale, send) {
  const root = make('input', { type: 'range', min: 0, max: STEPS, step: 1 });
  let held = false;
  let share = 0.5;
  slides(root, () => {
    held = true;
    const value = scale.at(Number(root.value) / STEPS);
    send(Number(root.value) === STEPS / 2 ? value : Number(value.toPrecision(3)));
  });
  root.onchange = () => {
    held = false;
  };
  return {
    root,
    /** Where a value is refused, the last one again. */
    show: (value = NaN, said = root.ariaValueText ?? '', title = root.ariaLabel ?? '') => {
      if (!Number.isNaN(value)) share = Math.min(Math.max(scale.share(value), 0), 1);
      root.ariaValueText = said;
      root.ariaLabel = title;
      root.style.setProperty('--fill', `${100 * share}%`);
      if (!held || Number.isNaN(value)) root.value = String(Math.round(STEPS * share));
    },
  };
}

/**
 * Whether two values are the same but for rounding.
 * @param {number | string | null} a
 * @param {number | string | null} b
 */
const same = (a, b) =>
  typeof a === 'number' && typeof b === 'number' ? Math.abs(a - b) <= 1e-9 * Math.abs(b) : a === b;

/**
 * What is said of a body where its fields are folded: material, size and mass.
 * @param {PartRecord} part
 */
function factsOf({ derived, values }) {
  /** @type {Record<string, number | string | null>} */
  const known = Object.fromEntries([...derived, ...values.map(({ quantity, value }) => [quantity, value])]);
  const material = known.material ? named('material', String(known.material)) : '';
  const sizes = ['length', 'mass'].filter((quantity) => typeof known[quantity] === 'number');
  return [material, ...sizes.map((quantity) => written(quantity, Number(known[quantity])))].filter(Boolean).join(' · ');
}
