// One map of stability: what each run came to, in colours and in words.
import { make } from '../browser/dom.js';
import { decade, figures, share } from '../text/format.js';
import { family, named, said, text } from '../text/catalogue.js';

/** @import { Range } from '../charts/scale.js' */

/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} OneMap  of one integrator; rows over the step, columns across
 * @property {string} name
 * @property {(number | null)[] | null} limit  largest stable step by theory
 * @property {Note | null} reason  why there is none
 * @property {string[]} runs  rows of numbers of kinds
 * @property {(number | null)[][]} errors
 * @property {(number | null)[][]} velocities
 * @property {number[][]} chatter
 * @property {number[][]} steps
 * @property {number} failures
 * @property {number} chattering
 * @property {number} count
 * @property {number | null} worst
 */
/**
 * @typedef {object} Maps
 * @property {Record<string, any>} chosen
 * @property {boolean} [cancelled]
 * @property {Note} [error]  why there are none
 * @property {number} [of]  runs in all, while they are under way
 * @property {number} [done]
 * @property {number[]} step  times the highest frequency [rad]
 * @property {{ name: string, values: number[], log: boolean }} across
 * @property {[step: number, across: number]} here
 * @property {boolean} rigid  whether nothing gives way at the contact
 * @property {string[]} kinds
 * @property {Note[]} notes
 * @property {OneMap[]} maps
 */
/** @typedef {[row: number, column: number]} Cell */

/** @type {Record<string, string>} */
export const COLOURS = {
  ok: '#cfe6d2',
  slight: '#f5eeb8',
  error: '#f3c58a',
  chatter: '#b9d2ea',
  stopped: '#dfe4e9',
  lasting: '#b99bd0',
  failed: '#c64a52',
  none: '#ffffff',
};
export const KINDS = Object.keys(COLOURS).filter((kind) => kind !== 'none');
/** @param {string} kind */
export const nameOf = (kind) => text(`stability.kind.${kind}`);

/**
 * What tells kinds apart besides their colours: markers of Bokeh.
 * @type {Record<string, string>}
 */
export const MARKERS = { error: 'dot', chatter: 'triangle', stopped: 'dash', lasting: 'cross', failed: 'x' };

/**
 * What the step is set against: in the list, and below the maps.
 * @typedef {{ title: string, axis: string }} Across
 * @param {string} name
 * @returns {Across}
 */
const axisOf = (name) => ({ title: text(`stability.across.${name}`), axis: text(`stability.axis.${name}`) });
/** @type {Record<string, Across>} */
export const AXES = Object.fromEntries(Object.keys(family('stability.across')).map((name) => [name, axisOf(name)]));

/**
 * Where the cells of these values begin and end.
 * @param {number[]} values
 * @param {boolean} log
 */
export function edges(values, log) {
  const halfway = (/** @type {number} */ a, /** @type {number} */ b) => (log ? Math.sqrt(a * b) : (a + b) / 2);
  const beyond = (/** @type {number} */ a, /** @type {number} */ b) => (log ? (a * a) / b : 2 * a - b);
  const inner = values.slice(1).map((value, k) => halfway(values[k], value));
  const last = inner.length - 1;
  return [beyond(values[0], inner[0]), ...inner, beyond(values[values.length - 1], inner[last])];
}

/** @param {number[]} values @returns {Range} */
export const spanOf = (values) => [values[0], values[values.length - 1]];

/**
 * What became of the energy of a run, or null.
 * @param {OneMap} map
 * @param {Cell} cell
 */
function energyOf(map, [i, j]) {
  const error = map.errors[i][j];
  if (error === null) return null;
  return text('stability.energy', { sign: Math.sign(error), error: share(Math.abs(error)) });
}

/** One map and what is said below it. */
export class Small {
  whole = ''; // what is said of all runs
  /** @type {Maps} */ found;
  /** @type {OneMap | null} */ map = null;

  constructor() {
    this.said = make('p', { className: 'help', ariaLive: 'polite' }); // of all runs, or of the one that is selected
  }
  /**
   * @param {Maps} found
   * @param {OneMap} map
   */
  load(found, map) {
    this.found = found;
    this.map = map;
    this.whole = map.reason ? said(map.reason) : this.#summary(map);
    this.read(null);
  }
  /** @param {OneMap} map */
  #summary({ name, failures, count, chattering, worst }) {
    const size =
      worst === null || worst === 0 ? '0' : worst > 1e-3 ? share(worst) : decade(Math.ceil(Math.log10(worst)));
    const others = { known: worst !== null, size };
    return text('stability.summary', {
      failures,
      count,
      chattering,
      ...others,
      theory: named('integrator-limit', name),
    });
  }
  /**
   * @param {OneMap} map
   * @param {Cell} cell
   */
  kind(map, [i, j]) {
    return this.found.kinds[Number(map.runs[i][j])];
  }
  /** Every run, steps downwards. */
  numbers() {
    const { map, found } = this;
    if (!map) return [[]];
    const { step, across } = found;
    return [
      [text('stability.step'), ...across.values.map((value) => figures(value, 3))],
      ...step.map((value, i) => [figures(value, 2), ...across.values.map((_, j) => nameOf(this.kind(map, [i, j])))]),
    ];
  }
  /** @param {Cell | null} cell */
  read(cell) {
    this.said.textContent = cell && this.map ? this.words(this.map, cell) : this.whole;
    this.said.classList.toggle('cell', Boolean(cell));
  }
  /**
   * @param {OneMap} map
   * @param {Cell} cell
   */
  words(map, [i, j]) {
    const { across, rigid, step } = this.found;
    const kind = this.kind(map, [i, j]);
    const value = figures(across.values[j], 3);
    const what = text('stability.one', { across: across.name, value, rigid });
    const limit = map.limit?.[j] ?? null;
    return text('stability.run', {
      ...{ step: figures(step[i], 2), what, kind, steps: map.steps[i][j], chatter: map.chatter[i][j] },
      speed: figures(map.velocities[i][j] ?? NaN, 3),
      energy: energyOf(map, [i, j]) ?? 'none',
      limit: limit === null ? 'none' : figures(limit, 2),
    });
  }
}

/**
 * What is drawn of one map, and said of each run under the pointer.
 * @param {Maps} found
 * @param {OneMap} map
 * @param {Cell[]} cells
 */
export function columnsOf(found, map, cells) {
  const kinds = cells.map(([i, j]) => found.kinds[Number(map.runs[i][j])]);
  return {
    [`${map.name}-kind`]: kinds.map(nameOf),
    [`${map.name}-colour`]: kinds.map((kind) => COLOURS[kind]),
    [`${map.name}-error`]: cells.map((cell) => energyOf(map, cell) ?? '–'),
    [`${map.name}-ending`]: cells.map(([i, j]) => map.steps[i][j]),
  };
}

/**
 * The marks of those cells of a map that have one, at their middles.
 * @param {Maps} found
 * @param {OneMap} map
 * @param {Cell[]} cells
 */
export function marksOf(found, map, cells) {
  const marked = cells
    .map(([i, j]) => ({ i, j, marker: MARKERS[found.kinds[Number(map.runs[i][j])]] }))
    .filter(({ marker }) => marker);
  return {
    step: marked.map(({ i }) => found.step[i]),
    across: marked.map(({ j }) => found.across.values[j]),
    marker: marked.map(({ marker }) => marker),
  };
}
