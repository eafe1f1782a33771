// What the joint between two links does to waves that meet it, over their frequency.
import { Figure } from '../charts/figure.js';
import { make } from '../browser/dom.js';
import { family, said, text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { linkOf } from '../text/words.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Joint
 * @property {Record<string, any>} chosen
 * @property {Note} [error]  why there is nothing to show
 * @property {string} kind
 * @property {[string, string]} links
 * @property {number} bend  by which the second link goes on turned [degrees]
 * @property {number[]} frequency  [kHz]
 * @property {Record<string, number[]>} axial  shares of the power [%], by where it goes
 * @property {Record<string, number[]>} bending
 */

const INCOMING = /** @type {const} */ (['axial', 'bending']);
const OUT = family('joints.out');
const EVERY = 6; // row of the table
const TOP = 102; // %

class Joints extends Panel {
  /** @type {Joint | null} */ drawn = null;

  /** @param {Page} page */
  constructor(page) {
    super(page, 'joints', text('joints.button'), text('joints.title'), text('joints.heading'));
    this.said = make('p', { className: 'help', role: 'status' });
    const parts = INCOMING.map((name) => ({
      ...{ name: `joints-${name}`, title: text(`joints.plot.${name}`), about: text(`joints.about.${name}`) },
      numbers: () => this.#numbers(name),
    }));
    this.figure = new Figure('joints', parts);
    this.root.append(this.said, this.figure.root);
  }
  get empty() {
    const { frame } = this.page;
    return 'mechanism' in frame && !frame.mechanism.joints.some(({ scatters }) => scatters);
  }
  /**
   * @param {Joint | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    this.root.ariaBusy = String(!fresh);
    if (!found) this.said.textContent = text('joints.idle');
    if (!found || !this.figure || found === this.drawn) return;
    this.drawn = found;
    this.figure.root.hidden = Boolean(found.error);
    this.said.textContent = found.error ? said(found.error) : text('joints.said', this.#sentence(found));
    if (found.error) return;
    const { frequency } = found;
    const shares = INCOMING.flatMap((name) =>
      Object.entries(found[name]).map(([out, values]) => [`${name}-${out}`, values]),
    );
    this.figure.fill('joints', { frequency, ...Object.fromEntries(shares) });
    this.figure.range('joints-axial-x', [frequency[0], frequency[frequency.length - 1]]);
    for (const name of INCOMING) this.figure.range(`joints-${name}-y`, [0, TOP]);
  }
  /** @param {Joint} found */
  #sentence({ bend, kind, links, axial }) {
    const [first, second] = links.map(linkOf);
    const turned = Math.abs(axial.transmitted_bending[0]);
    return { first, second, kind, bend: Math.abs(bend), turned };
  }
  /** @param {'axial' | 'bending'} name */
  #numbers(name) {
    const found = /** @type {Joint | null} */ (this.answer);
    if (!found || found.error) return [[]];
    const rows = found.frequency.flatMap((value, k) =>
      k % EVERY ? [] : [[value, ...Object.keys(OUT).map((out) => found[name][out][k])]],
    );
    return [
      [text('joints.frequency'), ...Object.values(OUT).map((out) => `${out}, %`)],
      ...rows.map((row) => row.map((value) => figures(value, 4))),
    ];
  }
}

export const PANELS = { joints: Joints }; // by their names in the address
