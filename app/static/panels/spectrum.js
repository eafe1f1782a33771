// How much of each frequency a history holds, beside the natural frequencies of what is struck.
import { Chart } from '../charts/chart.js';
import { contentOf, heldUpTo } from '../charts/spectrum.js';
import { make } from '../browser/dom.js';
import { family, said, text } from '../text/catalogue.js';
import { engineering } from '../text/format.js';
import { Panel } from './panel.js';
import { percentField } from './unit_field.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Found
 * @property {Record<string, any>} chosen
 * @property {Note} [error]  why there is nothing to show
 * @property {string} what
 * @property {string[]} kinds  that there are
 * @property {number | null} place  [m]
 * @property {'none' | 'hann'} window
 * @property {number} duration  [s]
 * @property {string} unit
 * @property {number[]} frequency  [Hz]
 * @property {{ name: string, modes: number | null, values: number[] }[]} lines
 * @property {number[]} natural  [Hz]
 */

const KINDS = family('spectrum.kind');
const BOTH_SIDES = 2; // widths of a line under the window

class Spectrum extends Panel {
  by = ['method', 'modes', 'elements'];
  of = ''; // what the chart is of

  /** @param {Page} page */
  constructor(page) {
    const asked = ['spectrum_of', 'spectrum_place'];
    super(page, 'spectrum', text('spectrum.button'), text('spectrum.title'), text('spectrum.heading'), asked);
    const ask = (/** @type {string} */ name, /** @type {string | number} */ value) => {
      page.model[name] = value;
      this.fill();
    };
    this.pick = make('select', { ariaLabel: text('spectrum.of') });
    this.pick.onchange = () => ask('spectrum_of', this.pick.value);
    this.place = percentField(text('spectrum.place'), 0, 1, (share) => ask('spectrum_place', share));
    this.place.root.title = text('spectrum.shares');
    this.chart = new Chart({
      ...{ title: text('spectrum.chart'), about: text('spectrum.about'), xName: text('spectrum.frequency') },
      ...{ xUnit: 'Hz', zero: true, pad: [0, 0.08] },
      caption: (unit, xUnit) => text('spectrum.axes', { unit, xUnit }),
    });
    this.said = make('p', { className: 'help', role: 'status' });
    this.result = make('div', { className: 'sides' }, this.chart.root);
    const form = make('div', { className: 'record-form' }, this.pick, this.place.root);
    this.root.append(form, this.said, this.result);
  }
  /** Of a mechanism whose links are rigid nothing rings. */
  get empty() {
    const { frame } = this.page;
    return 'mechanism' in frame && !frame.mechanism.links.some(({ flexible }) => flexible);
  }
  /**
   * @param {Found | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    this.root.ariaBusy = String(!fresh);
    this.result.hidden = !found || Boolean(found.error);
    this.place.set(this.page.model.spectrum_place);
    if (!found || found.error) {
      this.said.textContent = found?.error ? said(found.error) : text('spectrum.idle');
      return;
    }
    const { duration, kinds, place, what, window } = found;
    this.pick.replaceChildren(...kinds.map((value) => make('option', { value, textContent: KINDS[value] })));
    this.pick.value = fresh ? what : this.page.model.spectrum_of;
    this.place.root.hidden = place === null;
    this.said.textContent = text('spectrum.help', {
      window,
      duration,
      width: engineering(BOTH_SIDES / duration, 'Hz'),
    });
    this.chart.show(contentOf(found));
    const { axis, own } = this.chart;
    const [{ x, y }] = own.series;
    const end = x[x.length - 1];
    if (axis.whole[1] !== end || what !== this.of) axis.load(0, end, heldUpTo(x, y));
    this.of = what;
    this.draw();
  }
  draw() {
    if (!this.root.hidden && !this.result.hidden && this.chart.own.series.length) this.chart.draw();
  }
}

export const PANELS = { spectrum: Spectrum }; // by their names in the address
