// A stretch of time that fills the views is sampled anew for that stretch by the server, for every kind of impact.
import { decode } from './message.js';

/** @import { Page } from '../page.js' */
/** @import { AxialFrame, BendingFrame, Frame, Numbers } from '../messages.js' */

const REST = 200; // ms without a zoom, after which it is asked for
const DIGITS = 9; // of its ends [s]

/** @type {Record<string, string[]>} by the array of their instants; each has as many rows */
const HISTORIES = {
  ...{ motionTime: ['exactMass', 'exactEnd', 'exactWhole', 'exactRow', 'exactRowVelocity', 'exactRowForce'] },
  ...{ momentTime: ['exactMoments', 'otherMoments'], exactTime: ['exactForce'], otherTime: ['otherForce'] },
  ...{ time: ['impactorPath', 'struckPath', 'impactorRate', 'struckRate'] },
  ...{ mainTime: ['mainForce'], referenceTime: ['referenceForce'] },
  ...{ reactionTime: ['reactions'], referenceReactionTime: ['referenceReactions'], energyTime: ['energies'] },
  ...{ fieldTime: ['fieldDeflection', 'fieldVelocity', 'fieldMoment', 'fieldShear'] },
};
HISTORIES.motionTime.push('otherMass', 'otherEnd');
HISTORIES.time.push('referenceImpactorPath', 'referenceStruckPath');

/**
 * Rows of a history, those of a stretch in place of its own there.
 * @param {Numbers} whole
 * @param {Numbers} part
 * @param {number} from  first row to be replaced
 * @param {number} to  and the first after these
 * @param {number} width  numbers in a row
 */
function joined(whole, part, from, to, width) {
  const found = new Float64Array(from * width + part.length + whole.length - to * width);
  found.set(whole.subarray(0, from * width));
  found.set(part, from * width);
  found.set(whole.subarray(to * width), from * width + part.length);
  return found;
}

/**
 * Histories of a frame with what another says of a stretch of time, by name.
 * @param {Record<string, Numbers>} whole
 * @param {Record<string, Numbers>} part
 * @param {[start: number, end: number]} stretch  in the unit of their times
 * @returns {Record<string, Numbers>}
 */
export function refined(whole, part, [start, end]) {
  /** @type {Record<string, Numbers>} */
  const found = {};
  const bent = Object.keys(part).filter((name) => name.startsWith('amountsOf'));
  for (const [instants, names] of Object.entries({ ...HISTORIES, bendTime: bent })) {
    const [time, fine] = [whole[instants], part[instants]];
    if (!fine) continue;
    if (!time) {
      for (const name of [instants, ...names]) if (part[name]) found[name] = part[name];
      continue;
    }
    const from = time.findIndex((t) => t >= start);
    const after = time.findLastIndex((t) => t <= end) + 1;
    const first = from < 0 ? time.length : from;
    found[instants] = joined(time, fine, first, Math.max(first, after), 1);
    for (const name of names)
      if (whole[name] && part[name])
        found[name] = joined(whole[name], part[name], first, Math.max(first, after), part[name].length / fine.length);
  }
  return found;
}

/**
 * Its arrays, by name, besides all else.
 * @param {Frame} frame
 */
const numbersOf = (frame) => /** @type {Record<string, Numbers>} */ (/** @type {unknown} */ (frame));

export class Closer {
  /** @type {Frame | null} */ frame = null; // whose histories are refined
  /** @type {Record<string, Numbers>} */ whole = {}; // as they came with it
  /** @type {ArrayBuffer | null} */ part = null; // by what
  /** @type {number | undefined} */ resting;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    page.model.on('closer', () => this.#take());
  }
  /** The stretch in view [s]; nothing where that is all. */
  get #stretch() {
    const { frame, view } = this.page;
    const { axis } = view;
    if (!axis?.zoomed || !('trip' in frame) || frame.draft) return null;
    return axis.view.map((t) => Number((t * frame.trip).toPrecision(DIGITS)));
  }
  /** After another stretch has come into view, or another answer. */
  later() {
    clearTimeout(this.resting);
    this.resting = window.setTimeout(() => {
      const { connection, model } = this.page;
      const wanted = this.#stretch?.join(' ');
      if (!wanted || connection?.lost || this.#take(wanted)) return;
      model.time_in_view = ''; // which asks anew where the same was asked of another answer
      model.time_in_view = wanted;
    }, REST);
  }
  /**
   * Refine what is shown, if what has come is of it.
   * @param {string} [wanted]
   */
  #take(wanted) {
    const { frame, model, names, view } = this.page;
    if (!model.closer?.byteLength || !frame || !('trip' in frame)) return false;
    const part = /** @type {AxialFrame | BendingFrame} */ (decode(model.closer));
    const { stretch } = part;
    if (!stretch || (wanted && stretch.join(' ') !== wanted)) return false;
    if (!names.every((name) => Object.is(part.chosen[name], frame.chosen[name]))) return false;
    if (this.part === model.closer && this.frame === frame) return true;
    const arrays = numbersOf(frame);
    if (this.frame !== frame) this.whole = { ...arrays };
    this.frame = frame;
    this.part = model.closer;
    const [first, last] = stretch;
    Object.assign(arrays, this.whole, refined(this.whole, numbersOf(part), [first / frame.trip, last / frame.trip]));
    view.refine?.();
    return true;
  }
}
