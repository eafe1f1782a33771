// A mass joins a link of finite elements on a node: what projections make of it, from its modes to those of both.
import { headOf, make, rowOf, scrolled, segments } from '../browser/dom.js';
import { brief, figures } from '../text/format.js';
import { family, said, text } from '../text/catalogue.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/** @typedef {Record<string, Record<string, number[]>>} Fields  by projection and part, at every node */
/**
 * @typedef {object} Change
 * @property {Record<string, any>} chosen
 * @property {Note} [error]  why there is nothing to show
 * @property {number[]} nodes  from the first end on [mm]
 * @property {number} struck  node, from 1 on
 * @property {number} modes
 * @property {number} lost  of the energy [%]
 * @property {number} speed  of the mass before [m/s]
 * @property {'velocities' | 'coordinates'} first  what the scene is named after
 * @property {Fields} velocities  [m/s, rad/s]
 * @property {Fields} coordinates  [m, rad]
 */

const WAYS = family('mode_change.way');
const WHERE = family('mode_change.part');
// The most telling first
const PARTS = { velocities: ['across', 'turn', 'along'], coordinates: ['along', 'across', 'turn'] };
const UNITS = { velocities: 'm/s', coordinates: 'm' };
const TURNS = { velocities: 'rad/s', coordinates: 'rad' };
const LOST = 1e-6; // %, below which it is none
const SAME = 0.01; // of the largest of its kind, by which a projection may miss

class ModeChange extends Panel {
  /** @type {'velocities' | 'coordinates'} */ what = 'velocities';
  scene = ''; // of the answer that is shown
  by = ['modes'];

  /** @param {Page} page */
  constructor(page) {
    super(page, 'mode_change', text('mode_change.button'), text('mode_change.title'), text('mode_change.heading'));
    this.said = make('p', { className: 'help', role: 'status' });
    this.pick = segments(
      text('mode_change.which'),
      ['velocities', 'coordinates'],
      (name) => this.#turn(name),
      (name) => text(name === 'velocities' ? 'mode_change.velocities' : 'mode_change.coordinates'),
    );
    this.table = make('table', { className: 'methods' });
    this.result = make('div', {}, this.pick.root, scrolled(this.table, text('mode_change.heading')));
    this.root.append(this.said, this.result, make('p', { className: 'help', textContent: text('mode_change.help') }));
  }
  get empty() {
    const { frame } = this.page;
    return 'mechanism' in frame && !frame.mechanism.links[frame.mechanism.struck].nodes.length;
  }
  /** @param {string} name */
  #turn(name) {
    this.what = name === 'velocities' ? name : 'coordinates';
    this.fill();
  }
  /**
   * @param {Change | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    this.root.ariaBusy = String(!fresh);
    this.result.hidden = !found || Boolean(found.error);
    if (!found) this.said.textContent = text('mode_change.idle');
    if (!found) return;
    this.said.textContent = found.error ? said(found.error) : this.#sentence(found);
    if (found.error) return;
    if (found.chosen.scene !== this.scene) this.what = found.first;
    this.scene = found.chosen.scene;
    this.pick.show(this.what);
    const fields = found[this.what];
    const rows = PARTS[this.what].flatMap((part) => {
      const most = Math.max(...fields.before[part].map(Math.abs));
      const title = make('th', { colSpan: 2 + Object.keys(WAYS).length, scope: 'rowgroup' });
      title.textContent = `${WHERE[part]}, ${(part === 'turn' ? TURNS : UNITS)[this.what]}`;
      const values = found.nodes.map((place, node) => this.#row(fields, part, node, place, most, found.struck));
      return [make('tr', {}, title), ...values];
    });
    const head = headOf([text('mode_change.node'), text('mode_change.place'), ...Object.values(WAYS)]);
    this.table.replaceChildren(head, make('tbody', {}, ...rows));
  }
  /**
   * @param {Fields} fields
   * @param {string} part
   * @param {number} node
   * @param {number} place
   * @param {number} most  of the part, before
   * @param {number} struck
   */
  #row(fields, part, node, place, most, struck) {
    const values = Object.keys(WAYS).map((by) => fields[by][part][node]);
    const row = rowOf([node + 1, figures(place, 4), ...values.map(brief)]);
    const cells = [...row.children].slice(2);
    cells.forEach((cell, k) => cell.classList.toggle('missed', Math.abs(values[k] - values[0]) > SAME * most));
    if (node + 1 === struck) row.ariaCurrent = 'true';
    return row;
  }
  /** @param {Change} found */
  #sentence({ lost, modes, nodes, speed, struck, velocities }) {
    const at = (/** @type {string} */ by) => figures(Math.abs(velocities[by].across[struck - 1]), 4);
    return text('mode_change.said', {
      ...{ all: 3 * nodes.length, modes, struck, place: figures(nodes[struck - 1], 4), speed: figures(speed, 3) },
      ...{
        before: at('before'),
        both: at('by_mass'),
        alone: at('by_mass_of_bar'),
        lost: figures(lost, 2),
        loses: lost > LOST,
      },
    });
  }
}

export const PANELS = { mode_change: ModeChange }; // by their names in the address
