// What the joints of a mechanism bear over time: forces or moments, with those of rigid links.
import { Chart } from '../charts/chart.js';
import { segments } from '../browser/dom.js';
import { SECONDS } from '../clock/times.js';
import { family, text } from '../text/catalogue.js';
import { jointOf } from '../text/words.js';

/** @import { Axis } from '../charts/axis.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { MechanismFrame, Numbers } from '../messages.js' */
/** @import { Run } from '../compare/run.js' */

/** @typedef {'force' | 'moment'} Kind */

const KINDS = ['force', 'moment'];
const JOINTS = 7; // that have a line of their own
const OVER = 2; // times the height of these curves, which those of rigid links may take

/**
 * Size of the force of every joint, or its moment, (joint, instant).
 * @param {Numbers} reactions  (instant, joint, force along x and y and moment), flat
 * @param {number} joints
 * @param {Kind} kind
 */
export const valuesOf = (reactions, joints, kind) =>
  Array.from({ length: joints }, (_, n) =>
    Float64Array.from({ length: reactions.length / (3 * joints) }, (_row, k) => {
      const [x, y, moment] = reactions.subarray(3 * (k * joints + n));
      return kind === 'moment' ? moment : Math.hypot(x, y);
    }),
  );

/**
 * @param {number} n
 * @param {boolean} rigid
 * @returns {Series['style']}
 */
const styleOf = (n, rigid) => /** @type {Series['style']} */ (`joint${n}${rigid ? 'rigid' : ''}`);

/** @param {Numbers} values */
const some = (values) => values.some((value) => value !== 0);

export class Reactions {
  /** @type {Kind} */ kind = 'force';
  /** @type {MechanismFrame} */ frame;
  /** @type {Run[]} */ kept = [];

  /**
   * @param {Axis} axis
   * @param {(t: number) => void} go
   */
  constructor(axis, go) {
    const [title, about] = [text('beam.chart.reactions'), text('beam.chart.reactions-about')];
    this.chart = new Chart({ title, about, axis, xUnit: SECONDS, unit: 'N', zero: true, pad: [0.04, 0.12], go });
    const press = (/** @type {string} */ kind) => {
      this.kind = /** @type {Kind} */ (kind);
      this.#show();
      this.chart.redraw();
    };
    const names = family('beam.reaction');
    this.switch = segments(text('beam.chart.shown'), KINDS, press, (kind) => names[kind]);
    this.switch.root.classList.add('small');
    this.chart.value.before(this.switch.root);
  }
  /** @param {MechanismFrame} frame */
  load(frame) {
    this.frame = frame;
    const { mechanism, reactions } = frame;
    const there = Boolean(reactions && some(reactions)); // else all is over at once
    this.chart.root.hidden = !there;
    if (!reactions || !there) return;
    const turns = valuesOf(reactions, mechanism.joints.length, 'moment').some(some);
    this.switch.root.hidden = !turns; // pins that nothing drives bear no moment
    if (!turns) this.kind = 'force';
    this.#show();
  }
  #show() {
    const { frame, kind } = this;
    const { contacts, mechanism, reactionTime, reactions, referenceReactions, referenceReactionTime } = frame;
    if (!reactions || !reactionTime) return;
    this.switch.show(kind);
    /** @type {Series[]} */
    const series = [];
    const add = (/** @type {Numbers} */ x, /** @type {Numbers} */ given, /** @type {boolean} */ rigid) =>
      valuesOf(given, mechanism.joints.length, kind).forEach((y, n) => {
        if (n >= JOINTS || !some(y)) return;
        const joint = jointOf(mechanism.joints[n].links);
        const name = rigid ? text('beam.chart.reactions-rigid') : joint;
        const reach = series.some((each) => each.name === name) ? 0 : OVER; // or each would widen it anew
        series.push({ x, y, name, style: styleOf(n, rigid), ...(rigid ? { reach } : {}) });
      });
    add(reactionTime, reactions, false);
    if (referenceReactions && referenceReactionTime) add(referenceReactionTime, referenceReactions, true);
    this.chart.show({ series, unit: kind === 'moment' ? 'N m' : 'N', shades: contacts });
    this.chart.lay(this.kept.flatMap((run) => this.#laid(run)));
  }
  /** @param {Run[]} runs  of which the same is shown */
  keep(runs) {
    this.kept = runs;
    if (this.frame && !this.chart.root.hidden) this.#show();
  }
  /**
   * The same of a kept run, of as many joints.
   * @param {Run} run
   * @returns {Series[]}
   */
  #laid({ frame, letter }) {
    const joints = this.frame.mechanism.joints.length;
    if (frame.kind !== 'mechanism' || frame.mechanism.joints.length !== joints) return [];
    const { reactionTime: x, reactions } = frame;
    if (!x || !reactions) return [];
    const borne = valuesOf(reactions, joints, this.kind).filter(some).slice(0, JOINTS);
    return borne.map((y, n) => ({ x, y, name: letter, style: n ? `kept${letter}Thin` : `kept${letter}` }));
  }
  draw() {
    this.chart.draw();
  }
  /** @param {number} t */
  cursor(t) {
    this.chart.cursor(t);
  }
}
