// Sentences by code, from the catalogue that the server makes of solvers/text and app/text; their syntax is that of
// solvers/text/messages.py.
import { CATALOGUE } from './came.js';
import { engineering, localised, powered, raised, share, unbroken } from './format.js';
import { withSigns } from './typeset.js';

/** @typedef {{ code: string, severity: string, values: Record<string, any> }} Note */
/** @typedef {{ name: string, modes?: number, theory?: string, contact?: string }} Parts  of a model */
/** @typedef {Record<string, any>} Values */
/** @typedef {string | { term: string } | { name: string, format: string } | Choice} Piece */
/** @typedef {{ name: string, by: string, options: Record<string, Piece[]> }} Choice */

const { texts } = CATALOGUE;
/** Of all that is said here. */
export const language = CATALOGUE.language;
/** Languages that it could be said in instead: their own names. */
export const others = CATALOGUE.others ?? {};
const PLURALS = new Intl.PluralRules(language);
const SLIDER_END = 200; // modes or elements that a slider of the page reaches
const OPENING = /\{(@?[\w.-]+)(?:\}|:([^{}]+)\}|, (plural|select), )/y;
const OPTION = /\s*(=\d+|[\w.-]+)\s*\{/y;

/** @type {Map<string, Piece[]>} */
const PARSED = new Map();

/** @type {Map<string, Record<string, string>>} */
const FAMILIES = new Map(); // texts below each code, found once: some are asked for with every solve
for (const [name, message] of Object.entries(texts))
  for (let dot = name.indexOf('.'); dot > 0; dot = name.indexOf('.', dot + 1)) {
    const known = FAMILIES.get(name.slice(0, dot)) ?? {};
    known[name.slice(dot + 1)] = message;
    FAMILIES.set(name.slice(0, dot), known);
  }

/**
 * @param {string} message
 * @param {number} start
 * @returns {[pieces: Piece[], end: number]}
 */
function piecesOf(message, start) {
  /** @type {Piece[]} */
  const pieces = [];
  let at = start;
  while (at < message.length && message[at] !== '}') {
    const stop = message.slice(at).search(/[{}]/);
    if (stop) {
      pieces.push(stop < 0 ? message.slice(at) : message.slice(at, at + stop));
      at = stop < 0 ? message.length : at + stop;
      continue;
    }
    OPENING.lastIndex = at;
    const found = OPENING.exec(message);
    if (!found) throw new Error(`no value at ${at} in ${message}`);
    const [all, name, format = '', by] = found;
    at += all.length;
    if (by) {
      const [options, end] = optionsOf(message, at);
      pieces.push({ name, by, options });
      at = end;
    } else pieces.push(name[0] === '@' ? { term: name.slice(1) } : { name, format });
  }
  return [pieces, at];
}

/**
 * @param {string} message
 * @param {number} start
 * @returns {[options: Record<string, Piece[]>, end: number]}
 */
function optionsOf(message, start) {
  /** @type {Record<string, Piece[]>} */
  const options = {};
  let at = start;
  for (;;) {
    OPTION.lastIndex = at;
    const found = OPTION.exec(message);
    if (!found) return [options, at + 1];
    const [pieces, end] = piecesOf(message, at + found[0].length);
    options[found[1]] = pieces;
    at = end + 1;
  }
}

/** @param {string} message */
function parsed(message) {
  const known = PARSED.get(message);
  if (known) return known;
  const [pieces] = piecesOf(message, 0);
  PARSED.set(message, pieces);
  return pieces;
}

/**
 * A number by a format of Python: .3g, +.4g, .1e, .0f, .1%, d, g.
 * @param {number} value
 * @param {string} format
 */
export function numeral(value, format) {
  const [, plus, digits, kind] = /^(\+?)(?:\.(\d+))?([gefd%]?)$/.exec(format) ?? [];
  const places = digits === undefined ? 6 : Number(digits);
  const size = Math.abs(value);
  const sign = value < 0 ? '−' : plus && '+';
  if (!Number.isFinite(size)) return `${sign}${size}`;
  if (kind === '%') return `${sign}${(100 * size).toFixed(places)}%`;
  if (kind === 'f') return `${sign}${size.toFixed(places)}`;
  if (kind === 'e') return `${sign}${scientific(size, places, false)}`;
  if (kind === 'g') {
    const power = size ? Number(size.toExponential(Math.max(places, 1) - 1).split('e')[1]) : 0;
    const plain = power >= -4 && power < Math.max(places, 1);
    return sign + (plain ? String(Number(size.toPrecision(Math.max(places, 1)))) : scientific(size, places - 1, true));
  }
  return `${sign}${size}`;
}

/**
 * @param {number} size
 * @param {number} places
 * @param {boolean} trimmed  no zeros at the end
 */
function scientific(size, places, trimmed) {
  const [digits, power] = size.toExponential(Math.max(places, 0)).split('e');
  const kept = trimmed ? String(Number(digits)) : digits;
  return `${kept === '1' ? '' : `${kept}·`}10${raised(Number(power))}`;
}

/** @type {Record<string, (value: any) => string>} */
const FORMATS = {
  time: (seconds) => engineering(seconds, 's'),
  'rough-time': (seconds) => engineering(seconds, 's', 1),
  length: (metres) => engineering(metres, 'm'),
  force: (newtons) => engineering(newtons, 'N'),
  stress: (pascals) => engineering(pascals, 'Pa'),
  percent: (part) => `${localised(numeral(Number((100 * part).toPrecision(2)), 'g'))} %`,
  rough: (value) => localised(numeral(Number(value.toPrecision(1)), 'g')),
  method: (label) => described(label),
  law: (name) => named('law', name),
  kind: (name) => texts[`bodies.kind.${name}`] ?? name,
  link: (name) => named('link', name),
  links: (names) => names.map((/** @type {string} */ name) => named('link', name)).join(', '),
  model: (parts) => modelled(parts),
  figures: (names) => names.map((/** @type {string} */ name) => named('figure', name)).join(', ') || text('nothing'),
  error: (error) => (error === 0 ? text('nothing') : share(error)),
  integrators: (names) => names.map((/** @type {string} */ name) => named('integrator', name)).join(', '),
  list: (words) => words.join(', '),
  options: (words) => words.join(', '),
  note: (note) => saidOf(note),
  notes: (notes) => notes.map(saidOf).join(', '),
  refusals: (notes) =>
    Object.entries(notes)
      .map(([name, note]) => `${named('method', name)}: ${said(/** @type {Note} */ (note))}`)
      .join('; '),
};

/**
 * @param {any} value
 * @param {string} format
 */
function written(value, format) {
  if (format in FORMATS) return FORMATS[format](value);
  if (typeof value !== 'number') return String(value);
  const plain = format ? numeral(value, format) : powered(String(value)).replace('-', '−');
  return localised(plain);
}

/**
 * @param {Piece} piece
 * @param {Values} values
 * @returns {string}
 */
function shown(piece, values) {
  if (typeof piece === 'string') return piece;
  if ('term' in piece) return filled(`terms.${piece.term}`, values);
  const value = values[piece.name];
  if (value === undefined) throw new Error(`no value for ${piece.name}`);
  if ('format' in piece) return written(value, piece.format);
  const { by, options } = piece;
  const key = by === 'select' ? (value === null ? 'None' : String(value)) : pluralOf(value, options);
  return (options[key] ?? options.other).map((inner) => shown(inner, values)).join('');
}

/**
 * @param {number} value
 * @param {Record<string, Piece[]>} options
 */
const pluralOf = (value, options) => (`=${value}` in options ? `=${value}` : PLURALS.select(value));

/**
 * @param {string} code
 * @param {Values} values
 */
function filled(code, values) {
  const message = texts[code];
  if (message === undefined) throw new Error(`no text for ${code}`);
  return parsed(message)
    .map((piece) => shown(piece, values))
    .join('');
}

/**
 * The sentence of a code.
 * @param {string} code
 * @param {Values} [values]
 */
export const text = (code, values = {}) => unbroken(filled(code, values));

/**
 * The sentence of a note.
 * @param {Note} note
 */
export const said = ({ code, values }) =>
  text(code, 'needed' in values ? { ...values, offered: values.needed <= SLIDER_END, most: SLIDER_END } : values);

/**
 * Of a note or of a code; what is neither stands as it is.
 * @param {Note | string} note
 */
const saidOf = (note) => (typeof note !== 'string' ? said(note) : Object.hasOwn(texts, note) ? text(note) : note);

/**
 * A text of a scene that comes with the program, which its file has in one language, as it is written.
 * @param {string} scene
 * @param {'title' | 'note' | 'source'} what
 * @param {string} own
 */
export const ofScene = (scene, what, own) => withSigns(texts[`scene.${scene}.${what}`] ?? own);

/**
 * What a value of a choice is called; the value itself where it has no name.
 * @param {string} choice  method, law, support, …
 * @param {string} value
 */
export const named = (choice, value) => texts[`name.${choice}.${value}`] ?? value;

/**
 * A method; one that has two models is called by the model.
 * @param {string} name
 * @param {string} [model]
 * @param {'' | '-short'} [form]  for heads of columns
 */
export const methodOf = (name, model = '', form = '') =>
  texts[`name.model${form}.${model}`] ?? named(`method${form}`, name);

/**
 * What a model of a method or of a plan leaves out; nothing of models that are named by all they do.
 * @param {string} model
 */
export const leftOut = (model) => texts[`left-out.${model.replace('-quasi-static', '')}`] ?? '';

/**
 * All texts below a code, by the rest of theirs.
 * @param {string} code
 * @returns {Record<string, string>}
 */
export const family = (code) => FAMILIES.get(code) ?? {};

/**
 * A method with its resolution, "fe-nodal elements=12 scheme=central-difference", in the words of the page.
 * @param {string} label
 */
export function described(label) {
  const [name, ...given] = label.split(' ');
  /** @type {Record<string, string>} */
  const options = Object.fromEntries(given.map((option) => option.split('=')));
  const model = `name.model.${options.model}` in texts ? options.model : '';
  const counted = ['modes', 'elements'].find((key) => key in options && `method.${name}.${key}` in texts);
  const first = counted
    ? text(`method.${name}.${counted}`, { [counted]: Number(options[counted]) })
    : methodOf(name, model);
  const rest = Object.entries(options).filter(([key]) => key !== counted && !(key === 'model' && model));
  return [first, ...rest.map(([key, value]) => optionOf(key, value))].join(', ');
}

/**
 * A model of a plan.
 * @param {Parts} parts
 */
export const modelled = ({ name, modes, theory, contact }) =>
  [
    modes ? text('option.modes', { value: modes }) : named('model', name),
    ...(theory ? [named('theory', theory)] : []),
    ...(contact ? [named('contact', contact)] : []),
  ].join(', ');

/**
 * An option of a method, named by the catalogue or by its key.
 * @param {string} key
 * @param {string} value
 */
function optionOf(key, value) {
  const number = Number(value);
  if (`option.${key}` in texts) return text(`option.${key}`, { value: Number.isNaN(number) ? value : number });
  return named(key, value);
}
