// What an engineer asks first of a contact force, in a line above its curve: the peak, when, and for how long.
import { make, write } from '../browser/dom.js';
import { times } from '../clock/times.js';
import { text } from '../text/catalogue.js';
import { engineering } from '../text/format.js';

/** @import { Samples } from './scale.js' */
/** @import { Contact } from '../messages.js' */

const SAME = 1e-6; // share of a time by which two are no longer one

/**
 * When a history is at its largest: for the first time, where it stays there.
 * @param {Samples} history
 */
export function whenLargest({ x, y }) {
  let most = 0;
  for (let k = 1; k < y.length; k++) if (y[k] > y[most] * (1 + 1e-9)) most = k;
  return x[most];
}

/**
 * From the first touch to the last parting, and in contact, which is less where bodies part in between.
 * @param {[start: number, end: number][] | Contact[]} contacts
 * @returns {[span: number, touching: number]}
 */
export function timesOf(contacts) {
  if (!contacts.length) return [0, 0];
  const touching = contacts.reduce((sum, [start, end]) => sum + end - start, 0);
  const span = contacts[contacts.length - 1][1] - contacts[0][0];
  return Math.abs(span - touching) < SAME * span ? [span, span] : [span, touching];
}

/**
 * What is to be said: the peak [N], and times in the unit of the chart.
 * @typedef {{ force: number, at: number, span: number, touching: number, open: boolean }} Shown
 */

export class Peak {
  /** @type {Shown | null} */ shown = null;

  /**
   * @param {HTMLElement} head  of the chart, below which it stands
   * @param {(t: number) => string} written
   */
  constructor(head, written) {
    this.written = written;
    this.said = document.createTextNode('');
    this.spread = make('span');
    this.root = make('p', { className: 'peak', hidden: true }, this.said, this.spread);
    head.after(this.root);
    times.watch(() => this.#write());
  }
  /** @param {Shown | null} shown  nothing of an impulse without duration */
  load(shown) {
    this.shown = shown;
    this.#write();
  }
  #write() {
    const { root, shown, written } = this;
    root.hidden = !shown;
    if (!shown) return;
    const { at, force, open, span, touching } = shown;
    const parts = [text('chart.peak', { force: engineering(force, 'N', 4), time: written(at) })];
    if (touching > 0) parts.push(text('chart.contact-time', { time: written(touching), open }));
    write(this.said, parts.join(' · '));
    write(this.spread, 0 < touching && touching < span ? text('chart.contact-span', { span: written(span) }) : '');
  }
}
