// The contact law over the indentation, and the path of this impact on it: the force, and of a contact that flows by
// Tabor's tests the mean pressure and the radius of the circle, too.
import { Chart } from '../charts/chart.js';
import { between, pair } from '../charts/scale.js';
import { make, segments } from '../browser/dom.js';
import { given } from '../wire/message.js';
import { family, text } from '../text/catalogue.js';
import { figures, scaled } from '../text/format.js';
import { touchAt } from './touch.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Samples } from '../charts/scale.js' */
/** @import { Numbers } from '../messages.js' */
/** @import { CycleFrame } from './touch.js' */

/** @typedef {'force' | 'pressure' | 'radius'} What */
/** @typedef {Omit<Series, 'x' | 'y'>} Look */

const UNITS = { force: 'N', pressure: 'σ_Y', radius: 'm' };
const WHATS = /** @type {What[]} */ (Object.keys(UNITS));

/** @param {ArrayLike<number>} values */
const most = (values) => Array.from(values).reduce((a, b) => Math.max(a, b), 0);

/**
 * What an impact did, over its indentations; nothing of one whose message does not have it.
 * @param {CycleFrame} frame
 * @param {What} what
 */
const pathOf = ({ blowDepth, blowForce, touchFlow, touchRadius }, what) =>
  pair(blowDepth, { force: blowForce, pressure: touchFlow, radius: touchRadius }[what]);

/**
 * What the law says of it, each curve with its look.
 * @param {CycleFrame} frame
 * @param {What} what
 * @returns {[Samples | null, Look][]}
 */
export function curvesOf(frame, what) {
  const { flowDepth: slowly, flowElastic: elastic, testsDepth, testsForce, testsPressure } = frame;
  const [loading, unloading] = [text('axial.chart.loading'), text('axial.chart.unloading')];
  /** @type {(y?: Numbers) => [Samples | null, Look]} */
  const tests = (y) => [pair(testsDepth, y), { name: text('axial.chart.tests'), style: 'other', reach: 0 }];
  if (what === 'pressure')
    return [[pair(slowly, frame.flowPressure), { name: loading, style: 'prediction' }], tests(testsPressure)];
  if (what === 'radius')
    return [
      [pair(slowly, frame.flowRadius), { name: loading, style: 'prediction' }],
      [pair(slowly, elastic), { name: 'a² = αR', style: 'dots' }],
      [
        pair(
          slowly,
          elastic?.map((a) => Math.SQRT2 * a),
        ),
        { name: 'a² = 2αR', style: 'limit' },
      ],
    ];
  const [there, back] = [given(frame.cycleLoading, 'law'), given(frame.cycleUnloading, 'law')];
  const same = there.every((each, k) => Math.abs(each - back[k]) <= 1e-6 * most(there));
  return [
    [pair(frame.cycleDepth, there), { name: loading, style: 'prediction' }],
    [same ? null : pair(frame.cycleDepth, back), { name: unloading, style: 'dots' }],
    tests(testsForce),
  ];
}

export class Cycle {
  /** @type {[factor: number, unit: string]} */ across = [1e6, 'µm']; // how the indentation is shown
  /** @type {{ frame: CycleFrame, name: string, style: Series['style'] }[]} */ kept = [];
  /** @type {CycleFrame} */ frame;
  /** @type {What} */ what = 'force'; // that is shown, where there is more
  /** @type {[depth: number, force: number, time: number]} */ now = [0, 0, 0];
  touch = make('output', { className: 'readout touch', ariaLive: 'off' }); // a line of its own
  reach = 0; // indentation that the axis is to reach, in any case [m]

  constructor() {
    this.chart = new Chart({
      title: text('axial.chart.law'),
      about: text('axial.chart.law-about'),
      xName: text('axial.chart.indentation'),
      xUnit: 'µm',
      zero: 'whole',
      pad: [0, 0.08],
      caption: (unit, xUnit) => text('axial.chart.law-axes', { unit, xUnit }),
      points: true,
    });
    const names = family('axial.of-law');
    this.switch = segments(
      text('axial.chart.of-law'),
      WHATS,
      (what) => this.#turn(/** @type {What} */ (what)),
      (what) => names[what],
    );
    this.switch.root.classList.add('small');
    this.chart.value.before(this.switch.root);
    this.chart.root.classList.add('cycle');
    this.chart.head.append(this.touch);
  }
  /** What there is to show of what was chosen. */
  get shown() {
    return this.frame.flowDepth ? this.what : 'force';
  }
  /** @param {What} what */
  #turn(what) {
    this.what = what;
    this.#show();
    this.draw();
    this.mark(...this.now);
  }
  /** @param {CycleFrame} frame */
  load(frame) {
    const { chosen, cycleDepth, flowDepth, opens, touchTime } = frame;
    if (chosen.scene !== this.frame?.chosen.scene) this.what = WHATS.find((what) => what === opens.read) ?? 'force';
    this.frame = frame;
    this.touch.hidden = !touchTime;
    this.switch.root.hidden = !flowDepth;
    this.chart.root.hidden = !cycleDepth;
    if (cycleDepth) this.#show();
  }
  #show() {
    const { frame, kept, shown } = this;
    const path = given(pathOf(frame, shown), 'path');
    const others = kept.flatMap(({ frame: other, name, style }) => {
      const found = pathOf(other, shown);
      return found ? [{ ...found, path: true, name, style }] : [];
    });
    const depths = [given(frame.cycleDepth, 'law'), path.x, ...others.map(({ x }) => x)];
    if (shown !== 'force') depths.push(given(frame.flowDepth, 'law'));
    const deep = Math.max(this.reach, ...depths.map(most));
    this.across = scaled(deep, 'm');
    const [factor, xUnit] = this.across;
    /** @type {Series[]} */
    const series = [{ ...path, path: true, name: text('axial.chart.this-impact'), style: 'exact' }];
    for (const [curve, look] of curvesOf(frame, shown)) if (curve) series.push({ ...curve, ...look });
    const drawn = [...series, ...others].map((each) => ({ ...each, x: Array.from(each.x, (a) => a * factor) }));
    this.switch.show(shown);
    this.chart.axis.load(0, 1.04 * deep * factor);
    this.chart.show({ series: drawn, unit: UNITS[shown], xUnit });
  }
  draw() {
    this.chart.draw();
  }
  /**
   * This impact at one instant: depth [m] and force [N].
   * @param {number} depth
   * @param {number} force
   * @param {number} time  [s]
   */
  mark(depth, force, time) {
    const { chart, frame, shown } = this;
    const [factor, unit] = this.across;
    this.now = [depth, force, time];
    const { touchFlow, touchRadius, touchTime } = frame;
    const circle = pair(touchTime, shown === 'pressure' ? touchFlow : touchRadius);
    const value = shown === 'force' || !circle ? force : between(circle.x, circle.y, time);
    const deep = `${figures(Math.max(depth, 0) * factor)} ${unit}`;
    chart.mark(depth * factor, value, `${deep}   ${figures(value * chart.factor)} ${chart.unitShown}`);
    this.touch.textContent = touchAt(frame, time);
  }
}
