// One map of stability: what each run came to, in colours and in words.
import { make } from '../shell/dom.js';
import { decade, figures, share } from '../text/format.js';
import { named, said } from '../text/catalogue.js';

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
 * @property {number} [of]  runs in all, while they are under way
 * @property {number} [done]
 * @property {number[]} step  times the highest frequency [rad]
 * @property {{ name: string, values: number[], log: boolean }} across
 * @property {[step: number, across: number]} here
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
/** @type {Record<string, string>} */
export const WORDS = {
  ok: 'energy kept to 10⁻⁶',
  slight: 'to 1 %',
  error: 'wrong by more',
  chatter: 'chatters',
  stopped: 'stopped at its bound',
  lasting: 'never parts',
  failed: 'grows past reason',
};

/**
 * What tells kinds apart besides their colours: hatches of Bokeh.
 * @type {Record<string, string>}
 */
export const HATCHES = { error: '.', chatter: '/', stopped: '-', lasting: '+', failed: 'x' };

/**
 * What the step is set against: in the list, below the maps, and one value in words.
 * @typedef {{ title: string, axis: string, words: (value: string, law: string) => string }} Across
 * @type {Record<string, Across>}
 */
export const AXES = {
  contact_stiffness: {
    title: 'contact stiffness',
    axis: 'contact stiffness ÷ an element’s, or the law’s',
    words: (v, law) => `a contact ${v} times as stiff as ${law === 'rigid' ? 'an element' : 'its law'}`,
  },
  mass_ratio: {
    title: 'mass ratio',
    axis: 'mass ratio, target over impactor',
    words: (v) => `a target ${v} times as heavy as what strikes it`,
  },
  modes: { title: 'modes', axis: 'modes kept', words: (v) => `${v} modes` },
  restitution: {
    title: 'restitution',
    axis: 'restitution that the contact delivers',
    words: (v) => `a restitution of ${v}`,
  },
  speed: { title: 'speed', axis: 'speed of approach, m/s', words: (v) => `an approach at ${v} m/s` },
};
/** @type {Record<string, string>} */
const ENDINGS = { stopped: 'stopped at its bound of', lasting: 'never parts, in', failed: 'grows past reason after' };

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
  return error ? `${error < 0 ? 'lost' : 'gained'} ${share(Math.abs(error))}` : 'exact';
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
    const fail = failures ? `${failures} of ${count} runs fail` : `None of ${count} runs fails`;
    const size =
      worst === null || worst === 0 ? '0' : worst > 1e-3 ? share(worst) : decade(Math.ceil(Math.log10(worst)));
    const others = worst === null ? '' : ` Energy error of the others at most ${size}.`;
    const theory = named('integrator-limit', name);
    return `${fail}${chattering ? `, ${chattering} chatter` : ''}.${others} Theory: ${theory}.`;
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
    const words = (/** @type {Cell} */ cell) => WORDS[this.kind(map, cell)] ?? 'not run';
    return [
      ['step, rad', ...across.values.map((value) => figures(value, 3))],
      ...step.map((value, i) => [figures(value, 2), ...across.values.map((_, j) => words([i, j]))]),
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
    const { across, chosen, step } = this.found;
    const kind = this.kind(map, [i, j]);
    const what = AXES[across.name].words(figures(across.values[j], 3), chosen.law);
    const where = `A step of ${figures(step[i], 2)} rad and ${what}: `;
    if (kind === 'none') return `${where}not run.`;
    const energy = energyOf(map, [i, j]);
    const chatter = map.chatter[i][j];
    const ending = ENDINGS[kind];
    const limit = map.limit?.[j] ?? null;
    return [
      `${where}${ending ?? 'parts after'} ${map.steps[i][j]} steps`,
      ending ? '' : `, at ${figures(map.velocities[i][j] ?? NaN, 3)} of the speed`,
      energy === null ? '' : `, energy ${energy}`,
      chatter ? `, ${chatter} touches too many` : '',
      limit === null ? '.' : `. Theory allows ${figures(limit, 2)} rad.`,
    ].join('');
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
    [`${map.name}-kind`]: kinds.map((kind) => WORDS[kind] ?? 'not run'),
    [`${map.name}-colour`]: kinds.map((kind) => COLOURS[kind]),
    [`${map.name}-hatch`]: kinds.map((kind) => HATCHES[kind] ?? ' '),
    [`${map.name}-error`]: cells.map((cell) => energyOf(map, cell) ?? '–'),
    [`${map.name}-ending`]: cells.map(([i, j]) => map.steps[i][j]),
  };
}
