// A second solution of a step, with other settings, whose curves lie beside those of the one that is shown. It is
// solved out of sight, once.
import { drawnOf } from '../compare/overlay.js';
import { Run } from '../compare/run.js';
import { called } from '../text/words.js';
import { differing, kindsOf, lineOf } from '../form/settings.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Page } from '../page.js' */

const LETTER = 'A'; // whose colour it has

export class Second {
  /** @type {Map<string, ArrayBuffer>} */ known = new Map();
  /** @type {Partial<Chosen> | null} */ wanted = null;
  /** @type {Run | null} */ run = null;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
  }
  /**
   * Another step: what it has beside it, or nothing.
   * @param {Partial<Chosen> | null} settings
   */
  want(settings) {
    const { changes, root } = this.page;
    this.wanted = settings;
    if (changes.quiet) {
      changes.quiet = root.inert = false; // what was beside the step before is not waited for
      this.page.take(changes.bytes); // what has been answered last is where one goes on from
    }
    if (!this.run) return;
    this.run = null;
    this.show(false);
  }
  /**
   * Have it solved, and come back to what is shown.
   * @param {Partial<Chosen>} shown
   */
  async solve(shown) {
    const { known, page, wanted } = this;
    if (!wanted) return;
    const key = JSON.stringify(wanted);
    if (!known.has(key)) {
      const { changes, root } = page;
      const focused = document.activeElement;
      changes.quiet = root.inert = true;
      const reached = (/** @type {Partial<Chosen>} */ settings) =>
        new Promise((done) => changes.go(settings, (frame) => done(frame !== null)));
      if (await reached(wanted)) known.set(key, changes.bytes);
      if (this.wanted === wanted) await reached(shown);
      if (this.wanted !== wanted) return; // another step is on its way, which has the page
      changes.quiet = root.inert = false;
      if (focused instanceof HTMLElement) focused.focus({ preventScroll: true });
    }
    const bytes = known.get(key);
    this.run = bytes ? new Run(LETTER, bytes) : null;
  }
  /**
   * Lay it beside what is shown, or take it away.
   * @param {boolean} seen
   */
  show(seen) {
    const { compare, frame, view } = this.page;
    this.lay(seen);
    compare.lay(frame);
    view.load(frame);
    this.page.redraw();
  }
  /**
   * Have it beside what is shown from now on.
   * @param {boolean} seen
   */
  lay(seen) {
    const { compare, frame, opening } = this.page;
    const run = seen ? this.run : null;
    compare.runs = run ? [run] : [];
    if (run) run.called = this.#called(run.frame);
    opening.section.besides = run ? this.#forces(run) : [];
    const other = run && (!('exact' in frame) || kindsOf(frame, run.frame).impact); // else it is exact, and says so
    opening.section.called = other ? this.#called(frame, run.frame) : '';
    opening.draw();
  }
  /**
   * In what it differs from the other, in words; of the same impact, how it is solved.
   * @param {Frame} frame
   * @param {Frame} [other]
   */
  #called(frame, other = this.page.frame) {
    if (kindsOf(frame, other).impact) return lineOf(differing([frame, other]), frame);
    if ('main' in frame) return called(frame.main);
    const { acting, chosen } = frame;
    const [modes, elements] = ['modes', 'elements'].map((name) =>
      acting.includes(name) ? Number(chosen[name]) : null,
    );
    return 'other' in frame && frame.other ? called({ ...frame.other, modes, elements }) : '';
  }
  /**
   * Its force on the clock of what is shown: of another method, where it is the same impact.
   * @param {Run} run
   * @returns {Series[]}
   */
  #forces(run) {
    const { frame } = this.page;
    const force = drawnOf(frame, run).map((which) => run.histories(which)?.force)[0];
    if (!force || !('trip' in frame)) return [];
    const x = Array.from(force.x, (t) => t / frame.trip);
    return [{ x, y: force.y, style: `kept${LETTER}`, cursor: run.called }];
  }
}
