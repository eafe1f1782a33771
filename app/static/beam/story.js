// What happens to a struck beam, in words and figures, tied to the moment shown.
import { between } from '../charts/scale.js';
import { headOf, make, rowOf } from '../shell/dom.js';
import { contactHead, Warnings, Events, heading, lookCloser, scrolled, showEnergy } from '../shell/story.js';
import { count, duration, figures, prefixed, speed } from '../text/format.js';
import { said, text } from '../text/catalogue.js';
import { called, METHODS, noteOf } from '../text/words.js';
import { beamEvents, reasonsOf, spanOf, strikerOf, struckOf } from './events.js';

/** @import { Page } from '../page.js' */
/** @import { BeamFigures, BeamFrame } from '../shell/message.js' */

const LISTED = 16; // contacts in the table
/** @type {Record<'whole' | 'split', [key: string, name: string][]>} */
const ENERGIES = {
  whole: [['target_vibration', 'waves left in it']],
  split: [
    ['target_kinetic', 'beam, moving'],
    ['target_strain', 'beam, bent'],
  ],
};

/** @param {number | null | undefined} value */
const given = (value) => (value === null || value === undefined ? '–' : figures(value, 4));
/** @param {number | null} value */
const micro = (value) => (value === null ? 'none' : figures(value * 1e6));
/** @param {number} t */
const when = (t) => duration(t).replace('no time', '0');

export class BeamStory {
  /** @type {BeamFrame} */ frame;

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    this.now = make('p', { className: 'now' });
    this.events = new Events((t) => page.player.seek(t + 1e-6), when, 1e-9);
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
    this.root.append(heading(text('story.energy')), this.energy);
    this.numbers = make('div', { className: 'story' }, heading(text('story.contacts')), scrolled(this.table));
    this.numbers.append(heading(text('story.after')), scrolled(this.answers), this.beside, this.source);
  }
  /** @param {BeamFrame} frame */
  load(frame) {
    this.frame = frame;
    const { contacts } = frame.main;
    this.events.load(beamEvents(frame));
    this.whyHeading.textContent = contacts > 1 ? `Why one impact is ${contacts} contacts` : 'One contact, and why';
    this.why.textContent = reasonsOf(frame);
    this.span.textContent = spanOf(frame);
    this.warnings.load(this.#notes());
    this.contactTable();
    this.figures();
    this.shares();
    const { keptModes = 0, drawnModes = 0, source, title } = frame;
    const drawn = `The pictures are drawn from the lowest ${drawnModes} of ${keptModes} modes.`;
    const told = `${title}.${source ? ` Source: ${source}.` : ''}`;
    this.source.textContent = [told, noteOf(frame), keptModes > drawnModes ? drawn : ''].filter(Boolean).join(' ');
  }
  // Notes of both solutions, and where they differ.
  #notes() {
    const { chosen, main, reference, refused } = this.frame;
    const notes = [];
    if (reference && reference.contacts !== main.contacts)
      notes.push(
        `By ${called(reference)} instead of ${called(main)} the impact has ${count(reference.contacts, 'contact')}, ` +
          `not ${main.contacts}: do not trust single contacts. “Sensitivity” shows what can be trusted.`,
      );
    if (refused) notes.push(`${METHODS[chosen.method]}: ${said(refused)}. Modes are shown instead.`);
    const known = main.notes.map(said);
    const own = reference?.notes.filter((note) => !known.includes(said(note))) ?? [];
    const method = reference && called(reference);
    return [...notes, ...known, ...own.map((note) => text('story.beside', { method, note }))];
  }
  contactTable() {
    const { contacts, duration: whole, main } = this.frame;
    const [factor, prefix] = prefixed(main.peakForce ?? 0);
    const digits = Math.min(Math.max(5 - Math.floor(Math.log10(whole)) - 1, 0), 4); // as many as fit
    const rows = contacts.slice(0, LISTED).map(([start, end, impulse, peak], k) => {
      const look = lookCloser(`contact ${k + 1}`, () => this.page.zoom(start, end));
      const most = peak ? figures(peak * factor) : '–';
      return rowOf([look, start.toFixed(digits), end.toFixed(digits), figures(impulse), most]);
    });
    const more = `and ${main.contacts - LISTED} more`;
    if (main.contacts > LISTED) rows.push(make('tr', {}, make('td', { colSpan: 5, textContent: more })));
    this.table.replaceChildren(contactHead(['', 'ms', 'ms', 'N s', `${prefix}N`]), make('tbody', {}, ...rows));
  }
  figures() {
    const { beam, main, reference, span } = this.frame;
    const both = reference ? [main, reference] : [main];
    const [factor, prefix] = prefixed(main.peakForce ?? 0);
    /** @type {[name: string, show: (s: BeamFigures) => string | number][]} */
    const rows = [
      ['contacts', (s) => s.contacts],
      ['rebound velocity, m/s', (s) => given(s.final)],
    ];
    if (!beam.held) rows.push(['beam velocity, m/s', (s) => given(s.targetFinal)]);
    rows.push(
      ['restitution e', (s) => given(s.restitution.newton)],
      ['impulse, N s', (s) => given(s.impulse)],
      [`peak force, ${prefix}N`, (s) => (s.peakForce === null ? '–' : figures(s.peakForce * factor))],
      ['indentation, µm', (s) => micro(s.peakIndentation)],
    );
    if (both.some((s) => s.residualIndentation)) rows.push(['crater left, µm', (s) => micro(s.residualIndentation)]);
    rows.push(
      ['apparent contact, ms', (s) => (s === main ? figures(span.apparent) : '')],
      ['true contact, ms', (s) => (s === main ? figures(span.real) : '')],
      ['energy unaccounted for', (s) => Math.abs(s.diagnostics.energy_error).toExponential(0)],
      ['solved in, ms', (s) => figures(s.diagnostics.wall_time * 1e3)],
    );
    const beside = 'the same impact solved once more, to see what depends on their number.';
    this.beside.textContent = reference ? `${called(reference)}: ${beside}` : '';
    const lines = rows.map(([name, show]) => rowOf([name, ...both.map(show)]));
    this.answers.replaceChildren(headOf(['', ...both.map(called)]), make('tbody', {}, ...lines));
  }
  shares() {
    const { law, main } = this.frame;
    const split = 'target_kinetic' in main.energy && 'target_strain' in main.energy;
    const yields = law.yields && !['balance', 'rigid'].includes(main.name);
    showEnergy(this.energy, main.energy, [
      ['impactor', 'impactor'],
      ['target_rigid', 'beam as a whole'],
      ...ENERGIES[split ? 'split' : 'whole'],
      ['local', 'in the contact'],
      ['dissipated', yields ? 'lost by yielding' : 'lost'],
    ]);
  }
  /**
   * Mark the latest event at the instant t, and say what goes on.
   * @param {number} t
   */
  at(t) {
    const { frame } = this;
    if (!frame) return; // nothing is told yet
    this.events.at(t);
    const here = frame.contacts.findIndex(([start, end]) => t >= start && t <= end);
    const play = this.page.player.played ? '' : ' “Play” shows what follows.';
    this.now.textContent = `Now: ${this.#now(t, here)}.${play}`;
    this.now.classList.toggle('touching', here >= 0);
  }
  /**
   * @param {number} t
   * @param {number} here  the contact that lasts, if any
   */
  #now(t, here) {
    const { contacts, impactorRate, main, struckRate, time } = this.frame;
    const [own, ahead] = [between(time, impactorRate, t), between(time, struckRate, t)];
    const [mass, tip] = [`the ${strikerOf(this.frame)}`, `the ${struckOf(this.frame)}`];
    if (here >= 0) return `contact ${here + 1} of ${main.contacts}; ${mass} at ${speed(own)}`;
    const before = contacts.findLastIndex(([, end]) => end < t);
    if (before === contacts.length - 1) return `parted. ${capital(mass)} at ${speed(own)}, ${tip} at ${speed(ahead)}`;
    const away = own < 0 ? 'they draw apart' : 'it runs ahead';
    const towards = `${own < 0 ? tip : mass} catches up`;
    const next = ahead > own ? away : towards;
    const which = `apart, after contact ${before + 1} of ${main.contacts}`;
    return `${which}. ${capital(tip)} at ${speed(ahead)}, ${mass} at ${speed(own)}: ${next}`;
  }
}

/** @param {string} words */
const capital = (words) => words[0].toUpperCase() + words.slice(1);
