// Kept solutions on the charts of the one that is shown, each in its colour; times and units are those of the charts.
import { KEPT } from '../charts/styles.js';
import { called } from '../text/words.js';
import { kindsOf } from '../form/settings.js';
import { comparable } from './kinds.js';

/** @import { Series, Stretches } from '../charts/chart.js' */
/** @import { Source } from '../charts/gauge.js' */
/** @import { Samples } from '../charts/scale.js' */
/** @import { View } from '../frame/view.js' */
/** @import { AxialFrame, BendingFrame, Frame } from '../messages.js' */
/** @import { Run } from './run.js' */

/** @typedef {{ force: Series[], moved: Series[], stretches: Stretches[] }} Laid */

/**
 * Which solutions of a kept run are drawn: the exact one where the impact differs, the other method where that does.
 * @param {Frame} now
 * @param {Run} run
 * @returns {('exact' | 'other')[]}
 */
export function drawnOf(now, { frame }) {
  const { impact, how } = kindsOf(now, frame);
  const other = how && 'other' in frame && Boolean(frame.other);
  return [
    ...(impact || !other ? [/** @type {const} */ ('exact')] : []),
    ...(other ? [/** @type {const} */ ('other')] : []),
  ];
}

/** @param {Frame} frame */
const otherOf = (frame) => ('other' in frame && frame.other ? called(frame.other) : '');

/**
 * @param {Samples | null} samples
 * @param {number} unit  of time in the chart [s]
 * @param {Omit<Series, 'x' | 'y'>} how
 * @returns {Series[]}
 */
const lineOf = (samples, unit, how) =>
  samples ? [{ x: Array.from(samples.x, (t) => t / unit), y: samples.y, ...how }] : [];

/**
 * How curves of a kept run are called and drawn.
 * @param {Run} run
 * @param {'exact' | 'other'} which
 * @returns {{ name: string, style: Series['style'] }}
 */
function dressOf({ called: name, frame, letter }, which) {
  return which === 'exact'
    ? { name: name || letter, style: `kept${letter}` }
    : { name: name || `${letter}, ${otherOf(frame)}`, style: `kept${letter}Dashed` };
}

/** @type {WeakMap<Frame, Source[]>} */
const read = new WeakMap(); // of what is kept, whose fields are made once
/**
 * What a gauge tells of it.
 * @param {View} view
 * @param {Frame} now
 * @param {Run} run
 * @returns {Source[]}
 */
function sourcesOf(view, now, run) {
  const { frame, letter } = run;
  const known = read.get(frame) ?? view.read?.(frame, `read ${letter}`) ?? [];
  read.set(frame, known);
  const thin = /** @type {const} */ (`kept${letter}Thin`);
  const both = /** @type {const} */ (['exact', 'other']);
  return drawnOf(now, run).flatMap((which) => {
    const source = known[both.indexOf(which)];
    return source ? [{ ...source, ...dressOf(run, which), second: thin }] : [];
  });
}

/**
 * @param {AxialFrame | BendingFrame} now
 * @param {Run[]} runs
 * @returns {Laid}
 */
function laidOf(now, runs) {
  /** @type {Laid} */
  const laid = { force: [], moved: [], stretches: [] };
  for (const run of runs)
    for (const which of drawnOf(now, run)) {
      const found = run.histories(which);
      if (!found) continue;
      const { name, style } = dressOf(run, which);
      const thin = /** @type {const} */ (`kept${run.letter}Thin`);
      laid.force.push(...lineOf(found.force, now.trip, { name, style }));
      laid.moved.push(...lineOf(found.impactor, now.trip, { name, style, unit: 'm' }));
      laid.moved.push(...lineOf(found.struck, now.trip, { name, style: thin, unit: 'm' }));
      laid.moved.push(...lineOf(found.impactorRate, now.trip, { name, style, unit: 'm/s' }));
      laid.moved.push(...lineOf(found.struckRate, now.trip, { name, style: thin, unit: 'm/s' }));
      const spans = found.contacts.map(([start, end]) => /** @type {const} */ ([start / now.trip, end / now.trip]));
      laid.stretches.push({ spans, color: KEPT[run.letter] });
    }
  return laid;
}

/**
 * Lay kept runs over the charts of a view; what is loaded next is drawn with them.
 * @param {View} view
 * @param {Frame} now
 * @param {Run[]} all  those that are not comparable are left out
 */
export function layOver(view, now, all) {
  if (!view.stack || !view.cycle || !('trip' in now)) return;
  const runs = all.filter(({ frame }) => comparable(now, frame));
  const { force, moved, stretches } = laidOf(now, runs);
  const charts = Object.fromEntries(view.stack.charts);
  charts.force.lay(force);
  charts.moved.lay(moved);
  charts.waves.lay([], stretches);
  view.cycle.kept = runs.flatMap(({ called: name, frame, letter }) =>
    'blowDepth' in frame ? [{ frame, name: name || letter, style: /** @type {const} */ (`kept${letter}`) }] : [],
  );
  view.reactions?.keep(runs);
  for (const each of [view.gauge, view.supports])
    if (each) each.kept = () => runs.flatMap((run) => sourcesOf(view, now, run));
  view.dispersion?.chart.lay(runs.flatMap((run) => dispersionOf(run)));
}

/**
 * @param {Run} run
 * @returns {Series[]}
 */
function dispersionOf({ called: name, frame, letter }) {
  if (!('wavenumbers' in frame) || !frame.wavenumbers || !frame.lower) return [];
  const dressed = /** @type {const} */ ({ name: name || letter, style: `kept${letter}` });
  return [{ x: frame.wavenumbers, y: frame.lower, factor: 0.5 / Math.PI, reach: 0, ...dressed }];
}
