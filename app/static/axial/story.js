// What happened, in words and figures: events, contact table, answers of both methods beside the classical one.
import { headOf, make, rowOf } from '../browser/dom.js';
import { booksOpen, showEnergy, showOpenBooks } from '../frame/energy.js';
import { contactHead, Warnings, Events, headed, heading, lookCloser, noteOf } from '../frame/story.js';
import { times, unitOfTime } from '../clock/times.js';
import { localised, percent, pretty, signed } from '../text/format.js';
import { family, numeral, said, text } from '../text/catalogue.js';
import { called, shortly } from '../text/words.js';
import { strikesBody, toldOf } from './drawn.js';
import { eventsOf } from './events.js';
import { questionOf } from './question.js';

/** @import { AxialFigures, AxialFrame, Rotation } from '../messages.js' */

const LISTED = 24; // events
const CONTACTS = 12; // of each solution, in the table
const ENERGIES = Object.entries(family('axial.energy'));
/** @type {[string, string][]} of a target without waves, such as a row of balls */
const WITHOUT_WAVES = ENERGIES.map(([key, name]) => [key, key === 'target_vibration' ? text('axial.within') : name]);
const RESTITUTIONS = /** @type {const} */ (['newton', 'poisson', 'newton_at_contact']);

/** @param {number | null} value */
const kilo = (value) => (value === null ? '–' : pretty(value / 1e3));
/** @param {number | null} value */
const micro = (value, none = '–') => (value === null ? none : pretty(value * 1e6));
/** @param {number | null} value */
const velocity = (value) => (value === null ? '–' : signed(value, 4));
/** @param {number | null} error */
const estimated = (error) => (error === null ? '–' : error < 1e-9 ? '< 1e-9' : error.toExponential(0));
/** @param {number} error */
const residual = (error) => (error === 0 ? text('axial.nothing') : numeral(Math.abs(error), '.0e'));
/** @param {number} t */
const when = (t) =>
  times.inSeconds ? times.written(t, 3) : `${localised(String(Number(t.toFixed(t < 0.995 ? 2 : t < 10 ? 3 : 1))))} T`;

/**
 * What its rotation does to a rod.
 * @param {Rotation} rotation
 */
function turning({ speed, critical, stretch, strain, axial, bending, simplified }) {
  const shown = (/** @type {number | null} */ each) => (each === null ? text('axial.unstable') : pretty(each));
  const listed = (/** @type {(number | null)[]} */ list) => list.map(shown).join(', ');
  const along = text('axial.rotation', {
    speed: pretty(speed),
    critical: pretty(critical),
    stretch: pretty(stretch * 1e6),
    strain: pretty(strain * 100),
    axial: listed(axial),
  });
  if (!bending.length) return along;
  return `${along} ${text('axial.across', { bending: listed(bending), simplified: listed(simplified) })}`;
}

/**
 * What T is.
 * @param {AxialFrame} frame
 */
export function unitsOf({ exact, exactBar, impactor, rods, target, trip }) {
  const [factor, unit] = unitOfTime(trip);
  const rigid = exact.sudden ? 'impulse' : 'contact';
  const bent = target.rotation ? 'turning' : rigid;
  const alone = exactBar ? 'pendulum' : bent;
  const single = target.support === 'anechoic' ? 'endless' : 'one';
  const chain = target.kind === 'rods' || strikesBody(rods);
  const what = !rods.length ? alone : chain && rods.length > 1 ? 'chain' : rods.length > 1 ? 'struck' : single;
  const units = text('axial.units', { trip: `${pretty(trip * factor)} ${unit}`, what });
  const { mass: felt, ownMass: own } = impactor;
  const { rotation } = target;
  if (rotation) return `${units} ${turning(rotation)}`;
  return own === undefined ? units : `${text('axial.pendulum', { own, felt })} ${units}`;
}

export class Story {
  question = questionOf;

  /** @type {AxialFrame} */ frame;

  /**
   * @param {(t: number) => void} go
   * @param {(start: number, end: number) => void} zoom
   */
  constructor(go, zoom) {
    this.zoom = zoom;
    this.events = new Events(go, when, 1e-6);
    this.units = make('p', { className: 'symbols' });
    this.match = make('p', { className: 'match' });
    this.table = make('table', { className: 'contacts' });
    this.figures = make('table', { className: 'figures' });
    this.energy = make('div', { className: 'energy' });
    this.trust = make('p', { className: 'trust' });
    this.warnings = new Warnings();
    const { heading: warningsHeading, list: warnings } = this.warnings;
    this.root = make('div', { className: 'story' }, heading(text('story.events')), this.units, this.events.root);
    this.asks = heading();
    this.root.append(warningsHeading, warnings, this.asks, this.match);
    this.root.append(heading(text('story.energy')), this.energy);
    this.numbers = make('div', { className: 'story' }, ...headed(text('story.contacts'), this.table));
    this.numbers.append(...headed(text('story.after'), this.figures), this.trust);
  }
  /** @param {AxialFrame} frame */
  load(frame) {
    this.frame = frame;
    this.events.load(eventsOf(frame), LISTED);
    this.units.textContent = unitsOf(frame);
    this.contacts();
    this.answers();
    const asks = text('axial.one-number', { waves: frame.rods.length > 0 });
    this.asks.textContent = frame.exact.sudden ? text('axial.one-impulse') : asks;
    this.match.replaceChildren(...this.#match());
    const found = toldOf(frame);
    if (booksOpen(found)) showOpenBooks(this.energy, found);
    else showEnergy(this.energy, found.energy, frame.rods.length ? ENERGIES : WITHOUT_WAVES);
    this.warn();
    this.tell();
  }
  contacts() {
    const { exact, other } = this.frame;
    /** @type {['exact' | 'other', AxialFigures][]} */
    const both = other
      ? [
          ['exact', exact],
          ['other', other],
        ]
      : [['exact', exact]];
    const [perTrip, unit] = times.shown;
    const rows = both.flatMap(([kind, solution]) =>
      solution.contacts.slice(0, CONTACTS).map(([start, end, impulse, peak], k) => {
        const look = lookCloser(`${shortly(solution)} ${k + 1}`, () => this.zoom(start, end), kind);
        return rowOf([look, signed(start * perTrip, 4), signed(end * perTrip, 4), pretty(impulse), kilo(peak)]);
      }),
    );
    this.table.replaceChildren(contactHead(['', unit, unit, 'N s', 'kN']), make('tbody', {}, ...rows));
  }
  answers() {
    const { chosen, exact, impactor, prediction, modalForce, other, speed } = this.frame;
    const both = other ? [exact, other] : [exact];
    /** @type {string[][]} */
    const rows = [];
    const row = (/** @type {string} */ name, /** @type {(s: AxialFigures) => string} */ show, last = '–') =>
      rows.push([name, ...both.map(show), last]);
    row('impactor', (s) => velocity(s.final), prediction ? signed(prediction.impactor) : '');
    row('target', (s) => velocity(s.targetFinal), prediction ? signed(prediction.target) : '');
    const arm = impactor.place ?? 0;
    const predicted = prediction && arm ? signed((prediction.impactor * speed) / arm) : '';
    if (exact.spins[0] !== null) row('spin', (s) => velocity(s.spins[0]), predicted);
    if (exact.spins[1] !== null) row('target-spin', (s) => velocity(s.spins[1]), '');
    for (const name of RESTITUTIONS) {
      const last = name === 'newton' ? signed(Number(chosen.restitution)) : '';
      row(name, (s) => velocity(s.restitution[name]), last);
    }
    row('peak-force', (s) => kilo(s.peakForce));
    row('indentation', (s) => micro(s.peakIndentation, text('axial.none')));
    if (both.some((s) => s.residualIndentation)) row('dent', (s) => micro(s.residualIndentation));
    const away = (/** @type {number | null} */ v) => percent(Math.abs((v ?? 0) - (exact.final ?? 0)));
    const errors = [...(other ? [away(other.final)] : []), prediction ? away(prediction.impactor) : '–'];
    rows.push(['error', estimated(exact.diagnostics.estimated_error), ...errors]);
    if (both.some((s) => s.diagnostics.pivot_moment !== undefined)) {
      row('pivot-moment', (s) => pretty(s.diagnostics.pivot_moment ?? 0));
      row('contact-moment', (s) => pretty(s.diagnostics.contact_moment ?? 0));
    }
    row('solved', (s) => pretty(s.diagnostics.wall_time * 1e3));
    const column = (/** @type {AxialFigures} */ s) =>
      s === other && modalForce ? called({ ...s, modes: Number(chosen.modes) }) : shortly(s);
    const meaning = family('axial.meaning');
    const lines = rows.map(([name, ...cells]) =>
      rowOf([text(`axial.row.${name}`), ...cells], { title: meaning[name] ?? '' }),
    );
    const head = headOf(['', ...both.map(column), text('axial.prediction')]);
    this.figures.replaceChildren(head, make('tbody', {}, ...lines));
  }
  // Which restitution would have matched, and what it would have left out.
  #match() {
    const { chosen, exact, prediction, match, target } = this.frame;
    if (target.row) return [text('axial.match.row')];
    if (!prediction) return [text('axial.match.nothing-strikes')];
    if (exact.sudden) return [text('axial.match.no-waves', { restitution: Number(chosen.restitution) })];
    const says = text('axial.match.says', {
      restitution: Number(chosen.restitution),
      predicted: signed(prediction.impactor),
      waves: exact.travelling,
      found: signed(exact.final ?? 0),
    });
    if (match === null) return [says, text('axial.match.none')];
    const needed = make('b', { textContent: text('axial.match.needed', { restitution: match }) });
    const verdict = text('axial.match.misses', { contacts: exact.contacts.length });
    const { newton, newton_at_contact: faces } = exact.restitution;
    if (newton === null || faces === null || Math.abs(newton - faces) <= 0.01) return [says, needed, verdict];
    return [says, needed, verdict, text('axial.match.faces', { faces: signed(faces), whole: signed(newton) })];
  }
  warn() {
    const { exact, other } = this.frame;
    const known = exact.notes.map(said);
    const own = (other?.notes ?? []).filter((note) => !known.includes(said(note)));
    const method = other ? shortly(other) : '';
    this.warnings.load([...known, ...own.map((note) => text('story.beside', { method, note }))]);
  }
  tell() {
    const { frame } = this;
    const { exact, other } = frame;
    const parts = [exact, ...(other ? [other] : [])].map(
      (solution) => `${shortly(solution)} ${residual(solution.diagnostics.energy_error)}`,
    );
    const words = [text('axial.trust', { parts: parts.join(', ') })];
    const { resolved_time: time, raw_contacts: touches = 0 } = other?.diagnostics ?? {};
    if (time) words.push(text('axial.resolution', { time, touches }));
    this.trust.textContent = [...words, noteOf(frame, text('story.source', frame))].join(' ');
  }
  /** @param {number} t */
  at(t) {
    this.events.at(t);
  }
}
