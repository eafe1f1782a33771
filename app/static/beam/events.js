// What happens in an impact on a beam, one event after the other, and why.
import { family, text } from '../text/catalogue.js';
import { endsOf } from '../frame/falls.js';
import { duration, figures, length, percent, speed } from '../text/format.js';

/** @import { BendingFrame, Support } from '../messages.js' */
/** @import { Event } from '../frame/story.js' */

const LISTED = 4; // contacts, one by one
/** @type {Record<Support, string[]>} */
const HOLDERS = {
  joined: [],
  cantilever: ['clamp'],
  'pinned-pinned': ['pin', 'roller'],
  'clamped-clamped': ['clamp', 'clamp'],
  'free-free': [],
  'pinned-free': ['pin'],
};
const NEAR = 0.2; // of its length from a support
const HARD = 0.5; // movement of the struck place over that of the contact
const NAMED = family('beam.named');

/**
 * A sentence of the beam's catalogue, which takes what strikes and what is struck besides its values.
 * @param {string} code
 * @param {BendingFrame} frame
 * @param {Record<string, any>} [values]
 */
export const tell = (code, frame, values = {}) => {
  const { beam, impactor, main } = frame;
  const struck = beam.place > 0.999 * beam.length && beam.support !== 'free-free' ? 'tip' : 'place';
  return text(code, { striker: impactor.kind, struck, method: main.name, ...values });
};

/**
 * An event by the code of its sentence, with its name in a few words where it has one.
 * @param {number} t
 * @param {string} code
 * @param {BendingFrame} frame
 * @param {Record<string, any>} [values]
 * @returns {Event}
 */
const happens = (t, code, frame, values = {}) => {
  const name = code in NAMED ? tell(`beam.named.${code}`, frame, values) : undefined;
  return [t, tell(`beam.event.${code}`, frame, values), name];
};

/**
 * The support next to the struck place, where that is so near that the contact gives way and not the beam; else null.
 * @param {BendingFrame} frame
 */
function holding({ beam, contacts, main, time, struckPath }) {
  const [first, last] = HOLDERS[beam.support];
  const [name, away] =
    first && (!last || beam.place < beam.length / 2) ? [first, beam.place] : [last, beam.length - beam.place];
  const pressed = main.peakIndentation ?? 0;
  if (!name || away > NEAR * beam.length || !(pressed > 0)) return null;
  let moved = 0;
  for (let k = 0; k < time.length && time[k] <= contacts[0][1]; k++) moved = Math.max(moved, struckPath[k]);
  return moved < HARD * pressed
    ? { holder: name, away: length(away), moved: length(moved), pressed: length(pressed) }
    : null;
}

/**
 * The events of the impact, in the order of time [s].
 * @param {BendingFrame} frame
 * @returns {Event[]}
 */
export function beamEvents(frame) {
  const { contacts, main } = frame;
  const last = contacts.length - 1;
  /** @type {Event[]} */
  const found = [firstTouch(frame)];
  contacts.slice(0, LISTED).forEach((_, k) => {
    if (k > 0) found.push(meeting(frame, k));
    const parts = k === last || k === LISTED - 1 ? null : parting(frame, k);
    if (parts) found.push(parts);
  });
  const numbers = { first: LISTED + 1, last: main.contacts, number: LISTED + 1 };
  if (last >= LISTED)
    found.push(happens(contacts[LISTED][0], last === LISTED ? 'caught-up' : 'repeated', frame, numbers));
  const turn = turningPoint(frame);
  if (turn && turn[0] < contacts[last][1]) found.push(turn);
  found.push(ending(frame));
  return found.sort((a, b) => a[0] - b[0]);
}

/**
 * Velocities of the impactor and of the struck place as a contact begins or ends, as far as they are known.
 * @param {BendingFrame} frame
 * @param {number} k
 * @param {0 | 1} end
 * @returns {[impactor: number, struck: number] | null}
 */
const ratesAt = ({ rates }, k, end) =>
  4 * k + 3 < rates.length ? [rates[4 * k + 2 * end], rates[4 * k + 2 * end + 1]] : null;

/** @param {BendingFrame} frame */
function firstTouch(frame) {
  const [[start]] = frame.contacts;
  if (!frame.main.waves) return happens(start, 'touches-waveless', frame);
  const held = holding(frame);
  if (held) return happens(start, 'touches-held', frame, held);
  return happens(start, 'touches', frame, { rigid: frame.law.rigid });
}

/**
 * How contact number k begins.
 * @param {BendingFrame} frame
 * @param {number} k
 */
function meeting(frame, k) {
  const number = k + 1;
  const [start] = frame.contacts[k];
  if ((ratesAt(frame, k, 0)?.[0] ?? 0) < 0) return happens(start, 'overtaken', frame, { number });
  return happens(start, k === 1 ? 'caught-up-first' : 'caught-up', frame, { number });
}

/**
 * How contact number k ends, where another follows; null where it is not listed.
 * @param {BendingFrame} frame
 * @param {number} k
 */
function parting(frame, k) {
  const rates = ratesAt(frame, k, 1);
  if (!rates) return null;
  const [own, ahead] = rates;
  const [start, end] = frame.contacts[k];
  const lasts = end > start ? duration(end - start) : text('beam.event.no-time');
  if (own < 0) {
    const values = { lasts, own: speed(-own), back: ahead < 0, ahead: speed(Math.abs(ahead)) };
    return happens(end, 'parts-back', frame, values);
  }
  const given = percent(1 - own / frame.impactorRate[0]);
  const values = { lasts, given, own: speed(own), ahead: speed(ahead) };
  return happens(end, k > 0 ? 'parts-again' : 'parts-first', frame, values);
}

/**
 * The impactor stands still for the first time.
 * @param {BendingFrame} frame
 * @returns {Event | null}
 */
function turningPoint(frame) {
  const { impactorPath, impactorRate, span, time } = frame;
  const k = impactorRate.findIndex((rate, i) => i > 0 && rate <= 0);
  if (k < 0) return null;
  const bent = span.apparent > 0.7 * (span.half ?? Infinity);
  return happens(time[k], 'turns', frame, { bent, moved: length(impactorPath[k]) });
}

/**
 * How the last contact ends.
 * @param {BendingFrame} frame
 */
function ending(frame) {
  const { contacts, main } = frame;
  const [, end] = contacts[contacts.length - 1];
  if (main.stillTouching) return happens(end, 'still-touching', frame);
  const leaves = main.final ?? 0;
  const way = Math.abs(leaves) < 5e-4 * frame.speed ? 'stands' : leaves < 0 ? 'back' : 'on';
  const falls = endsOf(frame.weight ?? 0, frame.beam.held, leaves);
  const values = { several: contacts.length > 1, ...falls, way, speed: speed(Math.abs(leaves)) };
  return happens(end, 'ends', frame, values);
}

/**
 * Why so many contacts, or why only one.
 * @param {BendingFrame} frame
 */
export function reasonsOf(frame) {
  const { main } = frame;
  const waveless = !main.waves;
  const held = waveless ? null : holding(frame);
  if (held) return tell('beam.why.held', frame, held);
  if (main.contacts > 1) return tell('beam.why.many', frame);
  const values = endsOf(frame.weight ?? 0, frame.beam.held, main.final ?? 0);
  return tell(waveless ? 'beam.why.waveless' : 'beam.why.one', frame, values);
}

/**
 * How long the whole takes, and how that compares with the beam.
 * @param {BendingFrame} frame
 */
export function spanOf(frame) {
  const { beam, main, span } = frame;
  const held = !main.waves ? null : holding(frame);
  const share = percent(span.apparent > 0 ? span.real / span.apparent : 1);
  const lasts = { apparent: duration(span.apparent), real: duration(span.real), share };
  const said = [];
  if (span.real > 0) said.push(tell(main.contacts > 1 ? 'beam.span.many' : 'beam.span.one', frame, lasts));
  if (span.half && !main.sudden && !held) said.push(ridingOf(frame, span.half));
  if (beam.endMass) said.push(tell('beam.span.end-mass', frame, { mass: figures(beam.endMass) }));
  return said.join(' ');
}

/**
 * The impact against half a period of the beam with the impactor on it [s].
 * @param {BendingFrame} frame
 * @param {number} half
 */
function ridingOf(frame, half) {
  const { main, span } = frame;
  const ratio = span.apparent / half;
  const values = { half: duration(half), ratio: figures(ratio), contacts: main.contacts };
  if (ratio <= 0.75) return tell('beam.span.short', frame, values);
  return tell(ratio < 1.3 ? 'beam.span.alike' : 'beam.span.long', frame, values);
}
