// A mechanism that moves on after the impact: its picture by a clock of its own, impacts, reactions, energies.
import { Reactions } from '../beam/reactions.js';
import { Axis } from '../charts/axis.js';
import { Chart } from '../charts/chart.js';
import { headOf, make, rowOf } from '../shell/dom.js';
import { taken } from '../shell/keys.js';
import { Player } from '../shell/player.js';
import { scrolled } from '../shell/story.js';
import { family, said, text } from '../text/catalogue.js';
import { figures } from '../text/format.js';
import { called } from '../text/words.js';
import { Picture } from './motion_picture.js';
import { Panel } from './panel.js';
import { unitField } from './unit_field.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Page } from '../page.js' */
/** @import { BeamFrame, MechanismTold } from '../shell/message.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Found  times in ms, else SI units
 * @property {Record<string, any>} chosen
 * @property {string} [error]
 * @property {Note} [refused]  why it cannot be followed
 * @property {Note | null} rigid  why links that bend are followed as rigid ones
 * @property {boolean} cut  it would be followed for longer, if that took fewer steps
 * @property {MechanismTold} mechanism
 * @property {{ kind: string, mass: number }} impactor
 * @property {number | null} restitution  none: by the contact law
 * @property {number} duration
 * @property {number} contacts  how many
 * @property {[start: number, end: number, impulse: number][]} impacts  the first of them
 * @property {number[][]} jolts  impulses at the joints in the first impacts
 * @property {{ impulse: number, velocity: number, contacts: number, all: boolean }} parting  after one, or all
 * @property {{ energy_drift: number, constraint_error: number, estimated_error: number | null }} figures
 * @property {Note[]} notes
 * @property {number[]} time
 * @property {number[]} places  (instant, link, end, x and y), flat
 * @property {number[]} mass_places  (instant, x and y), flat
 * @property {{ time: number[], angle: number[] }} normals  of the struck link, as contacts begin and end [rad]
 * @property {number[]} history_time
 * @property {number[]} reactions  (instant, joint, x and y and moment), flat
 * @property {Record<string, number[]>} energies
 */

const LEAST_SECONDS = 8; // of playback; longer motions take the time that they take
const LONGEST = 20; // s that can be asked for, as app/views/motion.py
const ASKED = ['motion_seconds', 'motion_links'];
/** @type {Record<string, Series['style']>} */
const LOOKS = {
  ...{ impactor: 'exact', links: 'other', weight: 'struck', springs: 'record', drives: 'halfSpace' },
  ...{ dissipated: 'limit', sum: 'prediction' },
};

class Motion extends Panel {
  /** @type {Found | null} */ drawn = null;
  picture = new Picture();
  axis = new Axis();

  /** @param {Page} page */
  constructor(page) {
    super(page, 'motion', text('motion.button'), text('motion.title'), text('motion.heading'), ASKED);
    const complain = (/** @type {string} */ sentence) => page.complain(sentence);
    const restore = (/** @type {number} */ value) => page.choose('restitution', value);
    const follow = (/** @type {number} */ seconds) => (page.model.motion_seconds = seconds);
    const none = { sign: '', many: text('motion.none'), times: 1 };
    const seconds = { sign: 's', many: text('motion.in-seconds'), times: 1 };
    this.restitution = unitField(text('motion.restitution'), none, 0, 1, restore, complain);
    this.seconds = unitField(text('motion.seconds'), seconds, 1e-6, LONGEST, follow, complain);
    const as = Object.entries(family('motion.as')).map(([value, textContent]) =>
      make('option', { value, textContent }),
    );
    this.links = make('select', {}, ...as);
    this.links.onchange = () => (page.model.motion_links = this.links.value);
    this.linked = make('label', { className: 'part' }, text('motion.links'), this.links);
    const fields = [this.restitution.root, this.seconds.root, this.linked];
    const form = make('div', { className: 'record-form' }, ...fields);
    this.said = make('p', { className: 'verdict', role: 'status' });
    this.notes = make('ul', { className: 'help' });
    this.player = new Player((t) => this.#at(t), {
      events: () => this.#events(),
      range: () => this.axis.view,
      taken: () => {},
      hold: () => {},
    });
    const go = (/** @type {number} */ t) => this.player.seek(t);
    this.reactions = new Reactions(this.axis, go, text('motion.chart.reactions-about'));
    this.energy = new Chart({
      ...{ title: text('motion.chart.energy'), about: text('motion.chart.energy-about'), axis: this.axis },
      ...{ xUnit: 'ms', unit: 'J', pad: [0.06, 0.1], go },
    });
    this.axis.watch(() => this.draw());
    this.beside = make('table', { className: 'figures' });
    this.impacts = make('table', { className: 'figures' });
    const tables = make('div', { className: 'tables' }, scrolled(this.beside), scrolled(this.impacts));
    const charts = [this.reactions.chart.root, this.energy.root];
    this.result = make('div', { hidden: true }, this.picture.root, this.player.root, ...charts, tables);
    this.root.append(form, this.said, this.notes, this.result);
    this.root.onkeydown = (event) => {
      if (event.altKey || event.ctrlKey || event.metaKey || event.defaultPrevented || taken(event)) return;
      if (this.player.key(event)) event.preventDefault();
    };
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(this.picture.root);
  }
  get away() {
    const { frame } = this.page;
    return frame.kind !== 'beam' || !frame.mechanism;
  }
  take() {
    super.take();
    if (this.root.hidden && this.player.playing) this.player.toggle();
  }
  /**
   * @param {Found | null} found
   * @param {boolean} fresh
   */
  told(found, fresh) {
    const { frame } = this.page;
    this.root.ariaBusy = String(!fresh);
    this.restitution.root.hidden = !frame.acting.includes('restitution');
    this.restitution.set(Number(frame.chosen.restitution));
    this.linked.hidden = frame.kind !== 'beam' || !frame.mechanism?.links.some(({ flexible }) => flexible);
    this.links.value = this.page.model.motion_links;
    if (!found) this.said.textContent = text('motion.idle');
    if (!found || !fresh) return;
    const why = found.refused ? said(found.refused) : found.error;
    this.result.hidden = this.notes.hidden = Boolean(why);
    if (why) this.said.textContent = why;
    else this.#tell(found);
  }
  /** @param {Found} found */
  #tell(found) {
    this.#tables(found);
    if (found === this.drawn) return;
    const first = !this.drawn;
    this.drawn = found;
    const { contacts: count, duration, figures: known, restitution, rigid } = found;
    this.seconds.set(duration / 1e3);
    const [drift, gap, error] = [known.energy_drift, known.constraint_error, known.estimated_error];
    const law = restitution === null;
    const words = [text('motion.impacts', { time: duration / 1e3, count, law, restitution: restitution ?? 1 })];
    words.push(text('motion.kept', { drift, gap }));
    if (found.cut) words.push(text('motion.cut', { time: duration / 1e3 }));
    if (error) words.push(text('motion.uncertain', { error }));
    this.said.textContent = words.join(' ');
    const notes = [...(rigid ? [text('motion.rigid', { why: rigid })] : []), ...found.notes.map(said)];
    this.notes.replaceChildren(...notes.map((textContent) => make('li', { textContent })));
    this.axis.load(0, duration);
    this.picture.load(found);
    this.#histories(found);
    const clocked = { kind: /** @type {const} */ ('beam'), trip: 1e-3, duration, chosen: found.chosen };
    this.player.load({ ...clocked, contacts: [[0, 0, 0, 0]] }, Math.max(LEAST_SECONDS, duration / 1e3));
    this.player.mark();
    this.draw();
    if (first && !window.matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.toggle();
  }
  /** @param {Found} found */
  #histories({ energies, history_time: time, impacts, mechanism, reactions }) {
    const x = Float64Array.from(time);
    const shades = impacts.map(([start, end]) => /** @type {[number, number]} */ ([start, end]));
    const told = { contacts: shades, mechanism, reactionTime: x, reactions: Float64Array.from(reactions) };
    this.reactions.load(/** @type {any} */ (told));
    const sum = time.map((_, k) => Object.values(energies).reduce((all, part) => all + part[k], 0));
    const names = family('motion.energy');
    const series = Object.entries({ ...energies, sum }).map(([key, y]) => ({
      x,
      y,
      name: names[key],
      style: LOOKS[key],
    }));
    this.energy.show({ series, shades });
  }
  /**
   * The first impact, of links that bend all of them, beside what the stage shows of it; and each.
   * @param {Found} found
   */
  #tables({ contacts, impacts, jolts, mechanism, parting }) {
    const { main, reference } = /** @type {BeamFrame} */ (this.page.frame);
    const rows = family('motion.row');
    const beside = [main, ...(reference ? [reference] : [])];
    const write = (/** @type {any} */ value) => (Number.isFinite(value) ? figures(value, 4) : '–');
    const lines = [
      rowOf([rows.impulse, write(parting.impulse), ...beside.map(({ impulse }) => write(impulse))]),
      rowOf([rows.velocity, write(parting.velocity), ...beside.map(({ final }) => write(final))]),
      rowOf([rows.contacts, String(parting.contacts), ...beside.map((solved) => String(solved.contacts))]),
    ];
    const caption = make('caption', { textContent: text('motion.beside', { all: parting.all }) });
    const head = headOf(['', text('motion.first'), ...beside.map(called)]);
    this.beside.replaceChildren(caption, head, make('tbody', {}, ...lines));
    const columns = ['number', 'time', 'impulse'].map((name) => text(`motion.column.${name}`));
    const joints = mechanism.joints.map(({ links }) => text('motion.column.joint', { joint: links.join(' – ') }));
    const all = jolts.map((jolt, k) => {
      const [start, , impulse] = impacts[k];
      const when = make('button', { type: 'button', className: 'when', textContent: figures(start, 4) });
      when.onclick = () => this.player.seek(start);
      return rowOf([k + 1, when, figures(impulse, 4), ...jolt.map((size) => figures(size))]);
    });
    const left = contacts - all.length;
    const more = make('td', { colSpan: 3 + joints.length, textContent: text('beam.table.more', { count: left }) });
    if (left > 0) all.push(make('tr', {}, more));
    this.impacts.replaceChildren(headOf([...columns, ...joints]), make('tbody', {}, ...all));
  }
  /** @returns {[t: number, sentence: string][]} */
  #events() {
    return (this.drawn?.impacts ?? []).map(([start, , impulse], k) => [
      start,
      text('motion.event', { number: k + 1, impulse: figures(impulse, 4) }),
    ]);
  }
  /** @param {number} t */
  #at(t) {
    if (this.root.hidden || !this.drawn) return;
    this.picture.draw(t);
    this.reactions.cursor(t);
    this.energy.cursor(t);
  }
  draw() {
    if (this.root.hidden || this.result.hidden || !this.drawn) return;
    if (!this.reactions.chart.root.hidden) this.reactions.draw();
    this.energy.draw();
    this.#at(this.player.t);
  }
}

export const PANELS = { motion: Motion }; // by their names in the address
