// The picture of a kept solution, beside that of the one that is shown, by the same clock.
import { KEPT } from '../charts/styles.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/** @import { Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */
/** @import { Picture } from '../frame/view.js' */
/** @import { Run } from './run.js' */
/** @import { Scaled } from './scales.js' */

/**
 * A solution in a picture of its own, as the view of its kind makes it.
 * @typedef {object} Second
 * @property {Scaled & Picture} stage
 * @property {(what: string) => number} [end]  of the colours by themselves [SI]; 0 of what they cannot show
 * @property {(what: string, end: number) => void} load  colours show it as far as they can, and end there [SI]
 * @property {(now: Frame, t: number) => void} draw  the instant at which another solution is
 */

/**
 * The time of a solution at which another one is that is shown; its start where that is an impulse without duration.
 * @param {{ duration: number, trip: number }} frame
 * @param {Frame} now
 * @param {number} t
 */
export const instantIn = ({ duration, trip }, now, t) =>
  'trip' in now ? Math.min((t * now.trip) / trip, duration) : 0;

export class Beside {
  /** @type {Run | null} */ run = null;
  /** @type {Second | null} */ picture = null;
  tag = make('span', { className: 'tag' });
  root = make('div', { className: 'beside', hidden: true }, this.tag);

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
  }
  get stage() {
    return this.picture?.stage ?? null;
  }
  /** @param {Run | null} run */
  choose(run) {
    if (run === this.run) return;
    this.run = run;
    this.root.hidden = !run;
    this.root.parentElement?.classList.toggle('two', Boolean(run));
    this.stage?.root.remove();
    this.picture = null;
    if (!run) return;
    const { frame, letter } = run;
    this.picture = this.page.views[frame.kind].beside(frame);
    this.root.append(this.picture.stage.root);
    this.tag.textContent = text('compare.tag', { name: letter });
    this.tag.style.background = KEPT[letter];
  }
}
