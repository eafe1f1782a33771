// Contacts, their times and the rebound for all mass ratios, and the scene's place on them.
import { Figure } from '../charts/figure.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */

/**
 * @typedef {object} Ratios  columns over the mass ratio, null where there is none; `start_1`, `end_1` ... of contacts
 * @property {Record<string, any>} chosen
 * @property {string | null} support
 * @property {number[]} ratio
 * @property {number[]} rebound
 * @property {number[]} restitution
 * @property {number[]} contacts
 */

const EARLIEST = 0.5; // [T] where the logarithmic axis of time begins; the first contact begins at 0
const LATEST = 100;
const EVERY = 10; // row of the table
const PLOTS = ['rebound', 'periods', 'contacts'];

class MassRatios extends Panel {
  /** @type {Ratios | null} */ drawn = null;

  /** @param {Page} page */
  constructor(page) {
    super(page, 'ratios', text('ratios.button'), '', text('ratios.heading'));
    this.said = make('p', { className: 'help', role: 'status' });
    const parts = PLOTS.map((name, k) => ({
      ...{ name, title: text(`ratios.plot.${name}`), about: text(`ratios.about.${name}`) },
      ...(k ? {} : { numbers: () => this.#numbers() }),
    }));
    this.figure = new Figure('ratios', parts);
    this.root.append(this.said, this.figure.root);
  }
  /** @param {Frame} frame */
  #refusal(frame) {
    const one =
      'target' in frame &&
      ['mass', 'sphere'].includes(frame.impactor.kind) &&
      frame.target.kind === 'rod' &&
      !frame.target.endMass;
    if (!one) return text('ratios.one-rod-only');
    if (!frame.rigid || !['fixed', 'free'].includes(frame.target.support ?? '')) return text('ratios.rigid-only');
    return '';
  }
  get away() {
    return Boolean(this.#refusal(this.page.frame));
  }
  take() {
    super.take();
    const { frame } = this.page;
    const refusal = this.#refusal(frame);
    this.button.hidden = 'main' in frame;
    this.button.disabled = this.away;
    this.button.title = refusal || text('ratios.title');
    this.button.ariaPressed = String(this.open && !this.away);
    if (!this.root.hidden) this.show();
  }
  /** @param {Ratios | null} found */
  render(found) {
    const { frame } = this.page;
    const support = 'target' in frame ? frame.target.support : null;
    const there = found?.support === support;
    this.root.ariaBusy = String(!there);
    this.said.textContent = text(`ratios.said.${there ? support : 'idle'}`);
    if (!found?.support || !this.figure || found === this.drawn) return;
    this.drawn = found;
    const { ratio } = found;
    const half = Math.sqrt(ratio[1] / ratio[0]);
    const none = ratio.map(() => null);
    const columns = /** @type {Record<string, any>} */ (found);
    const times = [1, 2].flatMap((number) => {
      const starts = /** @type {(number | null)[]} */ (columns[`start_${number}`] ?? none);
      return [
        [`start_${number}`, starts.map((start) => (start === null ? null : Math.max(start, EARLIEST)))],
        [`end_${number}`, columns[`end_${number}`] ?? none],
      ];
    });
    const { rebound, restitution, contacts } = found;
    const edges = { low: ratio.map((each) => each / half), high: ratio.map((each) => each * half) };
    this.figure.fill('ratios', { ratio, rebound, restitution, contacts, ...edges, ...Object.fromEntries(times) });
    this.figure.range('rebound-x', [ratio[0], ratio[ratio.length - 1]]);
    this.figure.range('rebound-y', [-1.05, 1.1]);
    this.figure.range('periods-y', [EARLIEST, LATEST]);
    this.figure.range('contacts-y', [0.5, 2.5]);
    this.show();
  }
  /** The present scene on the figures. */
  show() {
    const { frame } = this.page;
    if (!('target' in frame)) return;
    for (const name of PLOTS) this.figure?.cursor(`ratio-cursor-${name}`, frame.target.mass / frame.impactor.mass);
  }
  #numbers() {
    const found = /** @type {Ratios | null} */ (this.answer);
    if (!found?.support) return [[]];
    const { ratio, rebound, restitution, contacts } = found;
    const rows = ratio.flatMap((value, k) => (k % EVERY ? [] : [[value, rebound[k], restitution[k], contacts[k]]]));
    return [
      ['ratio', 'rebound', 'restitution', 'contacts'].map((name) => text(`ratios.column.${name}`)),
      ...rows.map((row) => row.map((value) => figures(value, 4))),
    ];
  }
}

export const PANELS = { ratios: MassRatios }; // by their names in the address
