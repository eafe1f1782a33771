// Scales that two pictures share, or that are locked: axes, colours, how much movement is exaggerated.

/** @import { Range } from '../charts/scale.js' */
/** @import { View } from '../frame/view.js' */
/** @import { Frame } from '../messages.js' */

/** @typedef {Record<string, number>} Ranges  of a picture, SI units; the larger, the more it shows */
/** @typedef {{ ranges: () => Ranges, adopt: (ranges: Ranges) => void }} Scaled */

const PALE = 6; // a scale so many times as long as what is shown needs would leave it without colour
const COLOURED = 'usual '; // begins the names of ranges that are ends of colours

/**
 * The larger of each.
 * @param {Ranges} one
 * @param {Ranges} other
 */
const larger = (one, other) =>
  Object.fromEntries(Object.entries(one).map(([name, value]) => [name, Math.max(value, other[name] ?? 0)]));

export class Scales {
  locked = false;
  seconds = 0; // that the charts show while they are locked
  /** @type {Ranges | null} */ #picture = null;
  /** @type {Record<string, number>} */ #ends = {}; // of colours
  /** @type {Record<string, number>} */ least = {}; // ends of the colours of a lesson: one scale for all its steps
  /** @type {Record<string, number>} */ #own = {}; // where those of what is shown end by themselves

  /**
   * Lock the scales as a view has them, or let them follow again.
   * @param {View} view
   * @param {Frame} frame
   * @param {boolean} locked
   */
  lock(view, frame, locked) {
    this.locked = locked;
    this.seconds = locked && view.axis && 'trip' in frame ? view.axis.whole[1] * frame.trip : 0;
    this.#picture = locked ? view.stage.ranges() : null;
    this.#ends = {};
    for (const chart of chartsOf(view)) chart.held = locked ? chart.ranges() : null;
  }
  /**
   * Where colours end: as locked, else where they end by themselves, or later where a lesson has had more.
   * @param {string} what
   * @param {number} end
   */
  end(what, end) {
    this.#own[what] = end;
    if (this.locked) return (this.#ends[what] ??= end);
    const { [what]: least = 0 } = this.least;
    return least > end && least <= PALE * end ? least : end;
  }
  /**
   * From now on colours end no earlier than those of what is shown.
   * @param {Record<string, number>} [least]  those before, which are added to
   */
  keep(least = {}) {
    for (const [what, end] of Object.entries(this.#own)) least[what] = Math.max(least[what] ?? 0, end);
    this.least = least;
  }
  /**
   * Have a picture, and another beside it, drawn to one scale.
   * @param {Scaled} stage
   * @param {Scaled | null} second
   */
  share(stage, second) {
    const own = this.#picture ?? stage.ranges();
    const common = second && !this.locked ? larger(own, second.ranges()) : { ...own };
    for (const name of Object.keys(common).filter((each) => each.startsWith(COLOURED)))
      common[name] = this.end(name, common[name]);
    for (const each of second ? [stage, second] : [stage]) each.adopt(common);
  }
}

/** @param {View} view */
const chartsOf = ({ cycle, stack }) => [
  ...(stack?.charts.map(([, chart]) => chart) ?? []),
  ...(cycle ? [cycle.chart] : []),
];
