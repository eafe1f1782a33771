// What a result is where values are known only to some percent: how often which, and what matters most.
import { cleared, scale, sized, wiped } from '../charts/canvas.js';
import { make, write } from '../browser/dom.js';
import { grouped } from '../text/format.js';
import { text } from '../text/catalogue.js';
import { drawBars, drawHistogram, percentOf, rangeOf, toneOf } from './histogram.js';
import { shownOf, titleOf, written } from './results.js';
import { MOST_INPUTS, binsOf, mattersOf, quantilesOf } from './spread.js';
import { ToleranceRow } from './tolerance_row.js';
import { ToleranceJobs, clips } from './tolerance_jobs.js';

/** @import { Axis } from './axes.js' */
/** @import { Domain } from './plane.js' */
/** @import { Result } from './results.js' */
/** @import { Input, Samples } from './tolerance_jobs.js' */
/** @import { WhatIf } from './whatif.js' */

const NARROW = 560; // pixels of the whole
const TOTAL = { quick: 4000, slow: 1000 }; // impacts
const USUAL = { stiffness: 0.2, mass_ratio: 0.02, speed: 0.03, restitution: 0.05, length: 0.005, other: 0.02 };
const LENGTHS = ['m', 'cm', 'mm', 'µm'];
const FAINT = 0.005; // of all values: what an input changes by less is not written
const TILE = { width: 128, height: 88, bins: 24 };

/** @param {Axis} axis  What is usually known of it. */
function usualOf({ name, unit }) {
  if (name.endsWith('stiffness')) return USUAL.stiffness;
  if (LENGTHS.includes(unit)) return USUAL.length;
  return USUAL[/** @type {'mass_ratio' | 'speed' | 'restitution'} */ (name)] ?? USUAL.other;
}

export class Tolerance {
  canvas = make('canvas', { role: 'img' });
  box = make('div', { className: 'whatif-spread' }, this.canvas);
  list = make('div', { className: 'whatif-inputs', role: 'list' });
  notes = make('p', { className: 'whatif-notes' });
  said = make('p', { className: 'unseen', id: 'whatif-tolerance-said' });
  /** @type {Map<string, number>} */ parts = new Map(); // as somebody set them, by axis
  /** @type {Map<string, ToleranceRow>} */ rows = new Map();
  /** @type {Domain | null} */ domain = null;
  most = { name: '', share: 0 }; // what matters most
  tiled = '';

  /** @param {WhatIf} whatif */
  constructor(whatif) {
    this.whatif = whatif;
    this.jobs = new ToleranceJobs(() => whatif.came());
    const title = make('h3', { textContent: text('whatif.matters') });
    const about = make('span', { textContent: text('whatif.matters-about') });
    this.head = make('div', { className: 'whatif-matters' }, title, about);
    this.root = make('div', { className: 'whatif-tolerance' }, this.box, this.head, this.list, this.notes, this.said);
    this.canvas.setAttribute('aria-describedby', this.said.id);
    this.list.ariaLabel = text('whatif.matters');
  }
  forget() {
    this.jobs.ask(null);
    this.parts.clear();
  }
  /** Measure its room; whether there is any. */
  measure() {
    return cleared(this.canvas, this.box);
  }
  /** All that can be known to some percent only. */
  get inputs() {
    const { axes, points } = this.whatif;
    const can = axes.filter((axis) => !axis.whole && this.whatif.value(axis) && points.covers(axis.name));
    return can.map((axis, k) => {
      const part = this.parts.get(axis.name) ?? (k < MOST_INPUTS ? usualOf(axis) : 0);
      return /** @type {Input} */ ({ axis, value: this.whatif.value(axis), part });
    });
  }
  /** @param {Result[]} results  that there are */
  draw(results) {
    const { points, result } = this.whatif;
    const inputs = this.inputs;
    const some = inputs.filter(({ part }) => part > 0).slice(0, MOST_INPUTS);
    const total = points.quick || points.source === points.own ? TOTAL.quick : TOTAL.slow;
    const known = some.map(({ axis, part, value }) => [axis.name, axis.low, axis.high, value, part]);
    const { chosen } = this.whatif;
    const key = JSON.stringify([known, chosen, total]);
    this.jobs.ask(some.length ? { key, inputs: some, chosen, total } : null);
    this.#offer(inputs);
    const found = this.measure();
    const samples = this.jobs.shown;
    this.#note(inputs, samples);
    if (!samples) for (const row of this.rows.values()) row.rest();
    if (!found || !samples) return;
    const narrow = found.width < NARROW * scale;
    const wanted = this.whatif.wanted[result] ?? null;
    const here = this.whatif.here(result);
    drawHistogram(found.c, found.width, found.height, { samples, result, here, wanted, narrow });
    const { sorted } = samples.column(result);
    if (sorted.length) this.#domain(result, sorted);
    this.#rank(samples);
    this.#say(samples);
    this.#tile(samples, results);
  }
  /**
   * @param {Result} result
   * @param {Float64Array} sorted
   */
  #domain(result, sorted) {
    const ends = [sorted[0], sorted[sorted.length - 1]];
    const [low, high] = shownOf(result).log ? ends.map(Math.log10) : ends;
    this.domain = [low, high];
  }
  /** @param {Input[]} inputs */
  #offer(inputs) {
    const names = inputs.map(({ axis }) => axis.name);
    const titles = JSON.stringify(inputs.map(({ axis }) => [axis.name, axis.title, axis.of]));
    if (this.list.dataset.known !== titles) {
      this.list.dataset.known = titles;
      const set = (/** @type {string} */ name, /** @type {number} */ part) => {
        this.parts.set(name, part);
        this.whatif.schedule();
      };
      this.rows = new Map(
        inputs.map(({ axis }) => [axis.name, new ToleranceRow(axis, (part) => set(axis.name, part))]),
      );
      this.list.replaceChildren(...[...this.rows.values()].map(({ root }) => root));
    }
    names.forEach((name, k) => this.rows.get(name)?.set(inputs[k].part));
  }
  /** @param {Samples} samples  What matters, the most first, unless somebody is at the rows. */
  #rank(samples) {
    const { result } = this.whatif;
    const { at, contacts, sorted, values } = samples.column(result);
    const found = samples.asked.inputs.map(({ axis }, k) => ({
      row: this.rows.get(axis.name),
      ...{ k, ...mattersOf(values, (n) => samples.unit(at[n], k)) },
    }));
    const most = Math.max(0.02, ...found.map(({ share }) => share));
    const ends = /** @type {[number, number]} */ ([sorted[0], sorted[sorted.length - 1]]);
    const named = new Set(found.map(({ row }) => row));
    for (const row of this.rows.values()) if (!named.has(row)) row.rest();
    const least = FAINT * (ends[1] - ends[0]);
    for (const { effect, k, row, share } of found) {
      const faint = shownOf(result).whole || Math.abs(effect) <= least;
      const gained = faint ? '' : (effect < 0 ? '−' : '+') + written(result, Math.abs(effect));
      row?.show(`${percentOf(share)} %`, share / most, gained);
      row?.dots(
        (n) => samples.unit(at[n], k),
        values,
        ends,
        (n) => toneOf(contacts[n]),
      );
    }
    const top = found.reduce((best, each) => (each.share > best.share ? each : best), found[0]);
    this.most = { name: top.row?.axis.title ?? '', share: top.share };
    if (this.list.matches(':hover, :focus-within')) return;
    const ranked = found.sort((a, b) => b.share - a.share).flatMap(({ row }) => (row ? [row.root] : []));
    const order = [
      ...ranked,
      ...[...this.rows.values()].map(({ root }) => root).filter((root) => !ranked.includes(root)),
    ];
    if (order.some((root, k) => this.list.children[k] !== root)) this.list.replaceChildren(...order);
  }
  /**
   * How many impacts, what is refused, what is cut off.
   * @param {Input[]} inputs
   * @param {Samples | null} samples
   */
  #note(inputs, samples) {
    const some = inputs.filter(({ part }) => part > 0);
    const cut = some.filter(clips).map(({ axis }) => axis.title);
    const notes = [
      samples && text('whatif.impacts', { count: grouped(samples.count) }),
      samples?.refused && text('whatif.refusals', { count: samples.refused }),
      cut.length && text('whatif.clipped', { names: cut.join(', ') }),
      some.length > MOST_INPUTS && text('whatif.most-inputs', { count: MOST_INPUTS }),
      !some.length && text('whatif.no-tolerance'),
    ];
    write(this.notes, notes.filter(Boolean).join(' '));
  }
  /** @param {Samples} samples  In words, once all are there. */
  #say(samples) {
    const { result, wanted } = this.whatif;
    this.canvas.ariaLabel = text('whatif.tolerance-about', { result: titleOf(result) });
    const { sorted } = samples.column(result);
    if (!samples.whole || !sorted.length) return;
    const [low, median, high] = quantilesOf(sorted, [0.05, 0.5, 0.95]).map((value) => written(result, value));
    const { name, share } = this.most;
    const most = share > 0 ? text('whatif.matters-said', { name, share: percentOf(share) }) : '';
    const goal = wanted[result];
    const above = goal === undefined ? '' : this.#above(sorted, goal);
    write(
      this.said,
      `${text('whatif.tolerance-said', { result: titleOf(result), low, median, high })} ${most} ${above}`.trim(),
    );
  }
  /**
   * @param {Float64Array} sorted
   * @param {number} goal
   */
  #above(sorted, goal) {
    const share = sorted.filter((value) => value > goal).length / sorted.length;
    return text('whatif.above', { share: percentOf(share), value: written(this.whatif.result, goal) });
  }
  /**
   * Small histograms of all results.
   * @param {Samples} samples
   * @param {Result[]} results
   */
  #tile(samples, results) {
    const tiled = [samples.asked.key, samples.count, results.join()].join();
    const { all } = this.whatif.tiles;
    const [fresh] = [...all.values()];
    if (tiled === this.tiled && fresh?.canvas.width === TILE.width) return;
    this.tiled = tiled;
    for (const [name, { canvas }] of all) {
      const { contacts, sorted, values } = samples.column(name);
      const { height, width } = TILE;
      sized(canvas, width / (window.devicePixelRatio || 1), height / (window.devicePixelRatio || 1));
      const c = wiped(canvas, width, height, 1);
      if (!sorted.length) continue;
      const whole = Boolean(shownOf(name).whole);
      const range = rangeOf(sorted, whole);
      const bins = binsOf(values, contacts, range, whole ? Math.round(range[1] - range[0]) : TILE.bins);
      const counts = [...new Set(contacts)].sort((a, b) => a - b);
      drawBars(c, bins, counts, [10, width - 10], [10, height - 8]);
    }
  }
}
