// Draws charts that can be seen at once, and the others when they come into view or once the page has come to rest.
import { sizeOf } from '../charts/canvas.js';

/** @import { Chart } from '../charts/chart.js' */

const REST = 250; // ms without a change
const NEAR = '120px'; // how near to the view counts as in it

/**
 * @template {{ chart: Chart }} Part
 */
export class InView {
  /** @type {Set<Part>} */ seen = new Set();
  /** @type {Set<Part>} */ owed = new Set();
  /** @type {number | undefined} */ resting;

  /**
   * @param {Part[]} parts
   * @param {(part: Part) => void} paint  draws one
   */
  constructor(parts, paint) {
    this.parts = parts;
    this.paint = paint;
    /** @type {Map<Element, Part>} */
    const partOf = new Map(parts.map((part) => [part.chart.root, part]));
    const observer = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries) {
          const part = partOf.get(target);
          if (!part) continue;
          this.seen[isIntersecting ? 'add' : 'delete'](part);
          if (isIntersecting) this.pay(part);
        }
      },
      { rootMargin: NEAR },
    );
    for (const root of partOf.keys()) observer.observe(root);
  }
  // All charts have changed. `all`: draw them now, wherever they are.
  draw(all = false) {
    clearTimeout(this.resting);
    for (const part of this.parts) {
      this.owed.add(part);
      if (all || this.seen.has(part)) this.pay(part);
    }
    if (this.owed.size) this.resting = window.setTimeout(() => this.parts.forEach((part) => this.pay(part)), REST);
  }
  /**
   * What has no size is owed until it has.
   * @param {Part} part
   */
  pay(part) {
    const [width] = sizeOf(part.chart.area);
    if (width && this.owed.delete(part)) this.paint(part);
  }
}
