// The natural modes of what is struck: shapes, frequencies and masses, and which of them rings after the impact.
import { Figure } from '../charts/figure.js';
import { signOf } from '../charts/styles.js';
import { headOf, make, rowOf, scrolled, segments } from '../browser/dom.js';
import { shownIn } from '../clock/times.js';
import { family, named, said, text } from '../text/catalogue.js';
import { engineering, figures, percent } from '../text/format.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Modes  one set, mode by mode
 * @property {number[]} number  among all of the body
 * @property {number[]} frequency  [Hz]
 * @property {number[]} mass  where it is struck [kg]
 * @property {number[][]} shape  1 where it is largest
 */
/**
 * @typedef {object} Found
 * @property {Record<string, any>} chosen
 * @property {Note} [error]  why there is nothing to show
 * @property {number[]} place  [mm]
 * @property {number} struck  [mm]
 * @property {{ alone: Modes, together: Modes | null }} sets
 * @property {{ theory: string, frequency: number[], shape: number[][] } | null} beside  of those alone, otherwise
 * @property {number} kept  how many there are
 * @property {number | null} contact  from the first touch to the last parting [s]
 * @property {number[]} share  of the vibration after the impact [%]
 * @property {number} ringing  that vibration over the first energy [%]
 * @property {number[]} time
 * @property {string} unit  of time
 * @property {number[][]} amplitude  of every mode where its shape is largest [µm]
 */

const SETS = /** @type {const} */ (['alone', 'together']);
const COUNTS = ['2', '4', '8'];
const COLUMNS = family('modes.column');
const EVERY = 10; // place or instant of the tables
const ROOM = 1.08; // beyond what is drawn
const LEAST = 1e-6; // % of the energy, below which nothing rings
const NONE = '–';

/** @param {{ theory: string }} found */
const byTheory = ({ theory }) => text('modes.by', { theory: named('theory', theory) });
/** @param {number} value */
const hertz = (value) => engineering(value, 'Hz', 4);

class ModeShapes extends Panel {
  /** @type {typeof SETS[number]} */ of = 'alone';
  count = 4; // that are drawn
  factor = 1; // of times, for the unit shown
  by = ['modes'];

  /** @param {Page} page */
  constructor(page) {
    super(page, 'ringing', text('modes.button'), text('modes.title'), text('modes.heading'));
    this.said = make('p', { className: 'help', role: 'status' });
    const names = family('modes.set');
    this.pick = segments(
      text('modes.which'),
      [...SETS],
      (name) => this.#turn({ of: name === 'together' ? name : 'alone' }),
      (name) => names[name],
    );
    this.many = segments(
      text('modes.count'),
      COUNTS,
      (count) => this.#turn({ count: Number(count) }),
      (count) => text('modes.many', { count }),
    );
    this.table = make('table', { className: 'methods' });
    const part = (/** @type {'shapes' | 'amplitudes'} */ name) => ({
      ...{ name: `modes-${name}`, title: text(`modes.plot.${name}`), about: text(`modes.about.${name}`) },
      numbers: () => this.#numbers(name),
    });
    this.figure = new Figure('ringing', [part('shapes'), part('amplitudes')]);
    const scroll = scrolled(this.table, text('modes.heading'));
    const choices = make('div', { className: 'picks' }, this.pick.root, this.many.root);
    const help = make('p', { className: 'help', textContent: text('modes.help') });
    const sides = make('div', { className: 'sides' }, this.figure.root, make('div', {}, scroll, help));
    this.result = make('div', {}, choices, sides);
    this.root.append(this.said, this.result);
  }
  get empty() {
    const { frame } = this.page;
    return 'rods' in frame && frame.target.kind !== 'rod' && !frame.target.rotation;
  }
  /** @param {{ of?: typeof SETS[number], count?: number }} chosen */
  #turn(chosen) {
    Object.assign(this, chosen);
    this.fill();
  }
  /** @param {Found} found */
  #set({ sets }) {
    return (this.of === 'together' && sets.together) || sets.alone;
  }
  /**
   * The other theory, of which a lesson does not speak.
   * @param {Found} found
   * @param {Modes} set
   */
  #beside({ beside, sets }, set) {
    return set === sets.alone && !this.page.opening.teaching.on ? beside : null;
  }
  /**
   * @param {Found | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    this.root.ariaBusy = String(!fresh);
    this.result.hidden = !found || Boolean(found.error);
    if (!found) this.said.textContent = text('modes.idle');
    if (!found) return;
    const set = found.error ? null : this.#set(found);
    this.said.textContent = found.error ? said(found.error) : this.#sentence(found);
    if (!set) return;
    const alone = set === found.sets.alone;
    this.pick.root.hidden = !found.sets.together;
    this.pick.show(alone ? 'alone' : 'together');
    this.many.show(String(this.count));
    this.#draw(found, set);
    const beside = this.#beside(found, set);
    const columns = ['number', 'frequency', 'period', 'mass', ...(alone ? ['share'] : [])].map((name) => COLUMNS[name]);
    if (beside) columns.splice(2, 0, byTheory(beside));
    const most = found.share.indexOf(Math.max(...found.share));
    const rows = set.number.map((number, k) => {
      const period = found.contact ? figures(1 / (set.frequency[k] * found.contact)) : NONE;
      const share = alone ? [percent(0.01 * found.share[k])] : [];
      const other = beside ? [hertz(beside.frequency[k])] : [];
      const cells = [number, hertz(set.frequency[k]), ...other, period, engineering(1e3 * set.mass[k], 'g'), ...share];
      return rowOf(cells, alone && k === most && found.ringing > LEAST ? { ariaCurrent: 'true' } : {});
    });
    this.table.replaceChildren(headOf(columns), make('tbody', {}, ...rows));
  }
  /**
   * @param {Found} found
   * @param {Modes} set
   */
  #draw(found, set) {
    const { amplitude, place, struck, sets, time: given, unit: own } = found;
    const end = given[given.length - 1];
    const [factor, unit] = shownIn(own, end);
    const time = given.map((t) => factor * t);
    this.factor = factor;
    this.#fill('shapes', place, set, set.shape);
    const other = this.#beside(found, set);
    this.#fill('beside', place, set, other ? other.shape : [], other ? byTheory(other) : undefined);
    this.figure?.range('modes-shapes-x', [0, place[place.length - 1]]);
    this.figure?.range('modes-shapes-y', [-ROOM, ROOM]);
    this.figure?.cursor('modes-shapes-cursor', struck);
    const most = Math.max(...amplitude.slice(0, this.count).flatMap((values) => values.map(Math.abs)), LEAST);
    this.#fill('amplitudes', time, sets.alone, amplitude);
    this.figure?.range('modes-amplitudes-x', [0, factor * end]);
    this.figure?.range('modes-amplitudes-y', [-ROOM * most, ROOM * most]);
    this.figure?.set('modes-amplitudes-across', { axis_label: text('panel.time-in', { unit }) });
    this.show(this.page.player.t);
  }
  /**
   * @param {string} name  of the source
   * @param {number[]} x
   * @param {Modes} set
   * @param {number[][]} lines
   * @param {string} [key]  of all of them
   */
  #fill(name, x, { number, frequency }, lines, key) {
    const drawn = lines.slice(0, this.count);
    this.figure?.fill(name, {
      x: drawn.map(() => x),
      y: drawn,
      colour: drawn.map((_, k) => signOf(k).color),
      key: drawn.map((_, k) => key ?? text('modes.key', { number: number[k], frequency: hertz(frequency[k]) })),
      mode: drawn.map((_, k) => number[k]),
    });
  }
  /** @param {Found} found */
  #sentence({ sets, share, ringing, kept }) {
    if (this.of === 'together' && sets.together) return text('modes.touching');
    if (ringing <= LEAST) return text('modes.still');
    const most = share.indexOf(Math.max(...share));
    const { number, frequency } = sets.alone;
    return text('modes.said', {
      ...{ ringing: figures(ringing), number: number[most], frequency: hertz(frequency[most]) },
      ...{ share: figures(share[most]), shown: number.length, kept },
      listed: figures(share.reduce((sum, each) => sum + each, 0)),
    });
  }
  /** @param {'shapes' | 'amplitudes'} name */
  #numbers(name) {
    const found = /** @type {Found | null} */ (this.answer);
    if (!found || found.error) return [[]];
    const shapes = name === 'shapes';
    const { number, shape } = shapes ? this.#set(found) : found.sets.alone;
    const lines = (shapes ? shape : found.amplitude).slice(0, this.count);
    const [factor, unit] = shownIn(found.unit, found.time[found.time.length - 1]);
    const across = shapes ? found.place : found.time.map((t) => factor * t);
    const rows = across.flatMap((at, i) => (i % EVERY ? [] : [[at, ...lines.map((line) => line[i])]]));
    const first = shapes ? text('modes.place') : text('panel.time-in', { unit });
    return [
      [first, ...lines.map((_, k) => `${text('modes.number')} ${number[k]}`)],
      ...rows.map((row) => row.map((value) => figures(value, 4))),
    ];
  }
  /** @param {number} t */
  show(t) {
    this.figure?.cursor('modes-amplitudes-cursor', t * this.factor);
    const found = /** @type {Found | null} */ (this.answer);
    if (found && !found.error) this.figure?.cursor('modes-shapes-cursor', found.struck);
  }
}

export const PANELS = { modes: ModeShapes }; // by their names in the address
