// What happens to a struck beam, in words and figures, tied to the moment shown.
import { between } from '../charts/scale.js';
import { headOf, make, rowOf } from '../browser/dom.js';
import { booksOpen, showEnergy, showOpenBooks } from '../frame/energy.js';
import { contactHead, Warnings, Events, headed, heading, lookCloser, noteOf } from '../frame/story.js';
import { unitOfTime } from '../clock/times.js';
import { duration, figures, prefixed, signed, speed } from '../text/format.js';
import { family, said, text } from '../text/catalogue.js';
import { called, METHODS } from '../text/words.js';
import { beamEvents, reasonsOf, spanOf, tell } from './events.js';

/** @import { Page } from '../page.js' */
/** @import { BeamFigures, BendingFrame } from '../messages.js' */

/** @typedef {[name: string, show: (s: BeamFigures) => string | number]} Row  of the table of figures */

const LISTED = 16; // contacts in the table
/** @param {number | null | undefined} value */
const given = (value) => (value === null || value === undefined ? '–' : figures(value, 4));
/** @param {number | null} value */
const micro = (value) => (value === null ? text('beam.table.none') : figures(value * 1e6));
/** @param {number} t */
const when = (t) => (t ? duration(t) : '0');

/** @template {BendingFrame} [Shown=BendingFrame] */
export class BeamStory {
  /** @type {Shown} */ frame;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.now = make('p', { className: 'now' });
    this.events = new Events((t) => page.player.seek(t + 1e-9), when, 1e-12);
    this.why = make('p', { className: 'match' });
    this.span = make('p', { className: 'match span' });
    this.table = make('table', { className: 'contacts' });
    this.answers = make('table', { className: 'figures' });
    this.beside = make('p', { className: 'help' });
    this.energy = make('div', { className: 'energy' });
    this.source = make('p', { className: 'trust' });
    this.warnings = new Warnings();
    this.whyHeading = heading();
    this.root = make('div', { className: 'story' }, heading(text('story.events')), this.now, this.events.root);
    this.root.append(this.whyHeading, this.why, this.span, this.warnings.heading, this.warnings.list);
    this.went = heading();
    this.root.append(this.went, this.energy);
    this.numbers = make('div', { className: 'story' }, ...headed(text('story.contacts'), this.table));
    this.numbers.append(...headed(text('story.after'), this.answers), this.beside, this.source);
  }
  /** @param {Shown} frame */
  question({ contacts }) {
    return text('opening.question.beam', { contacts: contacts.length });
  }
  /** @param {Shown} frame */
  load(frame) {
    this.frame = frame;
    this.narrate();
    this.warnings.load(this.#notes());
    this.contactTable();
    this.figures();
    this.shares();
    const { keptModes = 0, drawnModes = 0, source, title } = frame;
    const words = [noteOf(frame, text('beam.note.source', { title, source: source || 'none' }))];
    if (keptModes > drawnModes) words.push(text('beam.note.drawn', { drawn: drawnModes, kept: keptModes }));
    this.source.textContent = words.filter(Boolean).join(' ');
  }
  /** Its events, and why there are so many contacts. */
  narrate() {
    const { frame } = this;
    const { contacts } = frame.main;
    this.events.load(beamEvents(frame));
    this.whyHeading.textContent = text('beam.why.title', { contacts });
    this.why.textContent = reasonsOf(frame);
    this.span.textContent = spanOf(frame);
  }
  // Notes of both solutions, and where they differ.
  #notes() {
    const { chosen, main, reference, refused } = this.frame;
    const notes = [];
    if (reference && reference.contacts !== main.contacts) {
      const names = { other: called(reference), method: called(main) };
      const numbers = { contacts: reference.contacts, found: main.contacts };
      notes.push(text('beam.note.other-contacts', { ...names, ...numbers }));
    }
    const values = { method: METHODS[chosen.method], note: refused, instead: main.name };
    if (refused) notes.push(text('beam.note.refused', values));
    const known = main.notes.map(said);
    if (!reference || reference.name === main.name) return [...notes, ...known]; // of modes, those chosen alone
    const own = reference.notes.filter((note) => !known.includes(said(note)));
    const method = called(reference);
    return [...notes, ...known, ...own.map((note) => text('beam.note.to-compare', { method, note }))];
  }
  contactTable() {
    this.table.classList.remove('wraps');
    const { contacts, duration: whole, main } = this.frame;
    const [perSecond, unit] = unitOfTime(whole);
    const [factor, prefix] = prefixed(main.peakForce ?? 0);
    const digits = Math.min(Math.max(5 - Math.floor(Math.log10(whole * perSecond)) - 1, 0), 4); // as many as fit
    const rows = contacts.slice(0, LISTED).map(([start, end, impulse, peak], k) => {
      const look = lookCloser(text('beam.table.contact', { number: k + 1 }), () => this.page.zoom(start, end));
      const most = peak ? figures(peak * factor) : '–';
      return rowOf([look, signed(start * perSecond, digits), signed(end * perSecond, digits), figures(impulse), most]);
    });
    const more = text('beam.table.more', { count: main.contacts - LISTED });
    if (main.contacts > LISTED) rows.push(make('tr', {}, make('td', { colSpan: 5, textContent: more })));
    this.table.replaceChildren(contactHead(['', unit, unit, 'N s', `${prefix}N`]), make('tbody', {}, ...rows));
  }
  figures() {
    const { main, reference } = this.frame;
    const both = reference ? [main, reference] : [main];
    const unit = `${prefixed(main.peakForce ?? 0)[1]}N`;
    this.beside.textContent = reference ? text(this.about, { method: called(reference) }) : '';
    const lines = this.rows(both).map(([name, show]) => rowOf([text(`beam.row.${name}`, { unit }), ...both.map(show)]));
    this.answers.replaceChildren(headOf(['', ...both.map(called)]), make('tbody', {}, ...lines));
  }
  /** Code of what is said of the solution beside it. */
  get about() {
    return 'beam.note.beside';
  }
  /**
   * The table of figures: the impact as a whole, its contacts, how well it is solved.
   * @param {BeamFigures[]} both
   * @returns {Row[]}
   */
  rows(both) {
    const { beam, main, span } = this.frame;
    const [factor] = prefixed(main.peakForce ?? 0);
    return [
      ...this.leaving(both, beam.held ? ['impactor'] : ['impactor', 'target']),
      ['peak-force', (s) => (s.peakForce === null ? '–' : figures(s.peakForce * factor))],
      ['indentation', (s) => micro(s.peakIndentation)],
      ...this.deflection(),
      ...this.dents(both),
      ['apparent', (s) => (s === main ? duration(span.apparent) : '')],
      ['real', (s) => (s === main ? duration(span.real) : '')],
      ...this.solved(),
    ];
  }
  /**
   * Contacts, what the bodies do at the end, and by what impulse.
   * @param {BeamFigures[]} both
   * @param {string[]} names  of the rows of the velocities
   * @returns {Row[]}
   */
  leaving(both, [impactor, target]) {
    /** @type {Row[]} */
    const balances = both.some(({ diagnostics }) => diagnostics.balances !== undefined)
      ? [['balances', ({ diagnostics }) => diagnostics.balances ?? '–']]
      : [];
    /** @type {Row[]} */
    const struck = target ? [[target, (s) => given(s.targetFinal)]] : [];
    /** @type {Row} */
    const restitution =
      this.frame.main.restitution.newton === null
        ? ['restitution-at-contact', (s) => given(s.restitution.newton_at_contact)]
        : ['restitution', (s) => given(s.restitution.newton)];
    return [
      ['contacts', (s) => s.contacts],
      ...balances,
      [impactor, (s) => given(s.final)],
      ...struck,
      restitution,
      ['impulse', (s) => given(s.impulse)],
    ];
  }
  /** @returns {Row[]} */
  deflection() {
    const { beam, main, stretch, struckPath } = this.frame;
    if (!beam.held || main.sudden || stretch) return []; // of a stretch it may be another one
    const most = struckPath.reduce((found, moved) => Math.max(found, Math.abs(moved)), 0);
    return [['deflection', (s) => (s === main ? figures(1e3 * most) : '')]];
  }
  /**
   * @param {BeamFigures[]} both
   * @returns {Row[]}
   */
  dents(both) {
    return both.some((s) => s.residualIndentation) ? [['dent', (s) => micro(s.residualIndentation)]] : [];
  }
  /** @returns {Row[]} */
  solved() {
    return [
      ['unaccounted', (s) => Math.abs(s.diagnostics.energy_error).toExponential(0)],
      ['solved', (s) => figures(s.diagnostics.wall_time * 1e3)],
    ];
  }
  shares() {
    this.went.textContent = text('story.energy');
    const { law, main } = this.frame;
    if (booksOpen(main)) return showOpenBooks(this.energy, main);
    const split = 'target_kinetic' in main.energy && 'target_strain' in main.energy;
    const yields = law.yields && main.byLaw;
    const inside = split ? ['target_kinetic', 'target_strain'] : ['target_vibration'];
    const names = this.parts();
    if (yields) names.dissipated = names.yielding;
    const parts = ['impactor', 'target_rigid', ...inside, 'local', 'dissipated', 'drives', 'weight'].filter(
      (part) => names[part],
    );
    showEnergy(
      this.energy,
      main.energy,
      parts.map((part) => [part, names[part]]),
      Boolean(main.energy.drives),
    );
  }
  /** @returns {Record<string, string>} names of the parts of the energy */
  parts() {
    return { ...family('beam.energy') };
  }
  /**
   * Mark the latest event at the instant t, and say what goes on.
   * @param {number} t
   */
  at(t) {
    const { frame } = this;
    if (!frame) return; // there is nothing yet
    this.events.at(t);
    const here = frame.contacts.findIndex(([start, end]) => t >= start && t <= end);
    const now = this.sentence(t, here);
    const { played, playing } = this.page.player;
    this.now.textContent = played || playing ? now : `${now} ${text('beam.now.play')}`;
    this.now.classList.toggle('touching', here >= 0);
  }
  /**
   * @param {number} t
   * @param {number} here  the contact that lasts, if any
   */
  sentence(t, here) {
    const { contacts, main } = this.frame;
    const [own, ahead] = this.rates(t);
    const values = this.values(t);
    const last = contacts.length - 1;
    const many = main.contacts > contacts.length; // of which those before the last are not known one by one
    if (here >= 0)
      return tell('beam.now.touching', this.frame, { ...values, number: here === last ? main.contacts : here + 1 });
    const before = contacts.findLastIndex(([, end]) => end < t);
    if (before === last) return tell('beam.now.parted', this.frame, values);
    if (many && before === last - 1) return tell('beam.now.among', this.frame, { ...values, number: last });
    const away = own < 0 ? 'apart' : 'ahead';
    const next = ahead > own ? away : own < 0 ? 'struck' : 'striker';
    return tell('beam.now.apart', this.frame, { ...values, number: before + 1, next });
  }
  /**
   * Velocity of the impactor and of the struck place.
   * @param {number} t
   */
  rates(t) {
    const { impactorRate, struckRate, time } = this.frame;
    return [between(time, impactorRate, t), between(time, struckRate, t)];
  }
  /**
   * The same in words, and how many contacts there are.
   * @param {number} t
   */
  values(t) {
    const [own, ahead] = this.rates(t);
    return { contacts: this.frame.main.contacts, own: speed(own), ahead: speed(ahead) };
  }
}
