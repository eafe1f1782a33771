// Of a step with a slider: the force as it was before a hand moved it stays beside that of now, on the same axes.
import { text } from '../text/catalogue.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Page } from '../page.js' */

/** @typedef {Series & { trip: number }} Kept  `trip`: its T [s] */

export class First {
  /** @type {Map<number, Kept[]>} */ known = new Map(); // by step

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
  }
  /**
   * Lay it beside the force of a step that is shown, at first that one itself; nothing where no slider is moved.
   * @param {number} step
   * @param {boolean} moves
   */
  lay(step, moves) {
    const { section } = this.page.opening;
    if (moves && !this.known.has(step)) this.known.set(step, this.#taken());
    section.first = (moves && this.known.get(step)) || [];
  }
  /** @returns {Kept[]} the force that is shown */
  #taken() {
    const { frame, opening } = this.page;
    const { shown } = opening.section;
    const [force] = (shown?.drawn ? shown.forces : shown?.tracks?.find((track) => track.force)?.series) ?? [];
    if (!force) return [];
    const [x, y] = [Array.from(force.x), Array.from(force.y)];
    const trip = 'trip' in frame ? frame.trip : 1;
    return [{ ...force, x, y, trip, style: 'prediction', cursor: text('lesson.at-first') }];
  }
}
