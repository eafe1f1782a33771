// What happens in an impact on a beam, one event after the other, and why.
import { count, duration, figures, length, percent, speed } from '../text/format.js';

/** @import { BeamFrame, Support } from '../shell/message.js' */
/** @import { Event } from '../shell/story.js' */

const TOLD = 4; // contacts told one by one
/** @type {Record<string, string>} */
const STRIKERS = { sphere: 'ball', rod: 'rod', beam: 'other beam' };
/** @type {Record<Support, string[]>} */
const HOLDERS = {
  cantilever: ['clamp'],
  'pinned-pinned': ['pin', 'roller'],
  'clamped-clamped': ['clamp', 'clamp'],
  'free-free': [],
  'pinned-free': ['pin'],
};
const NEAR = 0.2; // of its length from a support
const HARD = 0.5; // movement of the struck place over that of the contact
/**
 * What methods without waves take the beam for.
 * @type {Record<string, string>}
 */
const WAVELESS = {
  rigid: 'For this method the beam is rigid: all of it answers at once, in no time.',
  'quasi-static': 'For this method the whole beam bends at once, as under a force at rest: no wave runs in it.',
};

/** @param {BeamFrame} frame */
export const strikerOf = ({ impactor }) => STRIKERS[impactor.kind] ?? 'mass';
/** @param {BeamFrame} frame */
export const struckOf = ({ beam }) =>
  beam.place > 0.999 * beam.length && beam.support !== 'free-free' ? 'tip' : 'struck place';

/**
 * The support next to the struck place, where that is so near that the contact gives way and not the beam; else null.
 * @param {BeamFrame} frame
 */
function holding({ beam, contacts, main, time, struckPath }) {
  const [first, last] = HOLDERS[beam.support];
  const [name, away] =
    first && (!last || beam.place < beam.length / 2) ? [first, beam.place] : [last, beam.length - beam.place];
  const pressed = main.peakIndentation ?? 0;
  if (!name || away > NEAR * beam.length || !(pressed > 0)) return null;
  let moved = 0;
  for (let k = 0; k < time.length && time[k] <= contacts[0][1]; k++) moved = Math.max(moved, struckPath[k]);
  return moved < HARD * pressed ? { name, away, moved, pressed } : null;
}

/**
 * The events of the impact, in the order of time [ms].
 * @param {BeamFrame} frame
 * @returns {Event[]}
 */
export function beamEvents(frame) {
  const { contacts, main } = frame;
  const last = contacts.length - 1;
  /** @type {Event[]} */
  const found = [[contacts[0][0], firstTouch(frame)]];
  contacts.slice(0, TOLD).forEach(([start, end], k) => {
    if (k > 0) found.push([start, meeting(frame, k)]);
    const parts = k === last || k === TOLD - 1 ? null : parting(frame, k);
    if (parts) found.push([end, parts]);
  });
  if (last === TOLD) found.push([contacts[TOLD][0], `Caught up again: contact ${TOLD + 1}.`]);
  else if (last > TOLD)
    found.push([
      contacts[TOLD][0],
      `The same again and again: contacts ${TOLD + 1} to ${main.contacts}. Each passes a little of the push on to a ` +
        'longer piece of the beam.',
    ]);
  const turn = turningPoint(frame);
  if (turn && turn[0] < contacts[last][1]) found.push(turn);
  if (main.contacts <= contacts.length) found.push([contacts[last][1], ending(frame)]);
  return found.sort((a, b) => a[0] - b[0]);
}

/**
 * Velocities of the impactor and of the struck place as a contact begins or ends, as far as they are told.
 * @param {BeamFrame} frame
 * @param {number} k
 * @param {0 | 1} end
 * @returns {[impactor: number, struck: number] | null}
 */
const ratesAt = ({ rates }, k, end) =>
  4 * k + 3 < rates.length ? [rates[4 * k + 2 * end], rates[4 * k + 2 * end + 1]] : null;

/** @param {BeamFrame} frame */
function firstTouch(frame) {
  const [mass, tip, held] = [strikerOf(frame), struckOf(frame), holding(frame)];
  const waveless = WAVELESS[frame.main.name];
  if (waveless) return `The ${mass} touches the ${tip}. ${waveless}`;
  if (held)
    return (
      `The ${mass} touches the ${tip}, only ${length(held.away)} from the ${held.name}, which holds it back almost ` +
      'at once: the contact has to give way, not the beam.'
    );
  const the = frame.law.name === 'rigid' ? 'The' : 'The contact gives way, the force grows, and the';
  return (
    `The ${mass} touches the ${tip}. ${the} ${tip} has to go along, but of the beam behind it only the short piece ` +
    `that the first waves have reached: at first the ${mass} pushes on next to nothing.`
  );
}

/**
 * How contact number k begins.
 * @param {BeamFrame} frame
 * @param {number} k
 */
function meeting(frame, k) {
  const [mass, tip] = [strikerOf(frame), struckOf(frame)];
  if ((ratesAt(frame, k, 0)?.[0] ?? 0) < 0)
    return `The ${tip} swings back and overtakes the ${mass}, which is on its way back: contact ${k + 1}.`;
  return k === 1
    ? `The rest of the beam holds the ${tip} back. The ${mass} catches up with it: contact 2.`
    : `Caught up again: contact ${k + 1}.`;
}

/**
 * How contact number k ends, where another follows; null where it is not told.
 * @param {BeamFrame} frame
 * @param {number} k
 */
function parting(frame, k) {
  const rates = ratesAt(frame, k, 1);
  if (!rates) return null;
  const [own, ahead] = rates;
  const [mass, tip] = [strikerOf(frame), struckOf(frame)];
  const [start, end] = frame.contacts[k];
  if (own < 0)
    return (
      `After ${duration(end - start)} they part: the ${mass} goes back at ${speed(-own)}, the ${tip} ` +
      `${ahead < 0 ? 'back' : 'on'} at ${speed(Math.abs(ahead))}.`
    );
  if (k > 0) return `Thrown ahead again: the ${tip} at ${speed(ahead)}, the ${mass} at ${speed(own)}.`;
  const given = percent(1 - own / frame.impactorRate[0]);
  return (
    `The ${tip} has been thrown ahead: it moves at ${speed(ahead)}, the ${mass} at ${speed(own)}. After ` +
    `${duration(end - start)} they part, and the ${mass} has given away ${given} of its speed.`
  );
}

/**
 * The impactor stands still for the first time.
 * @param {BeamFrame} frame
 * @returns {Event | null}
 */
function turningPoint(frame) {
  const { impactorPath, impactorRate, span, time } = frame;
  const k = impactorRate.findIndex((rate, i) => i > 0 && rate <= 0);
  if (k < 0) return null;
  const slow = span.apparent > 0.7 * (span.half ?? Infinity);
  const why = slow ? '; the beam is bent as a whole, and' : '. What has given way';
  const where = `${length(impactorPath[k])} from where it touched`;
  return [time[k], `The ${strikerOf(frame)} stands still, ${where}${why} drives it back from here.`];
}

/**
 * How the last contact ends.
 * @param {BeamFrame} frame
 */
function ending(frame) {
  const { contacts, main } = frame;
  if (main.stillTouching) return 'Here the time that was solved ends. They still touch.';
  const leaves = main.final ?? 0;
  const stands = Math.abs(leaves) < 5e-4 * frame.speed;
  const goes = stands ? 'is left standing' : `goes ${leaves < 0 ? 'back' : 'on'} at ${speed(Math.abs(leaves))}`;
  const which = contacts.length > 1 ? 'last ' : '';
  return `The ${which}contact is over: the ${strikerOf(frame)} ${goes}. They part for good.`;
}

/**
 * Why so many contacts, or why only one.
 * @param {BeamFrame} frame
 */
export function reasonsOf(frame) {
  const { main } = frame;
  const [mass, tip] = [strikerOf(frame), struckOf(frame)];
  const waveless = WAVELESS[main.name];
  const held = waveless ? null : holding(frame);
  if (held)
    return (
      `So near the ${held.name} (${length(held.away)}) the beam hardly gives way: during the first contact the ` +
      `${tip} moves ${length(held.moved)}, while the contact is pressed in by ${length(held.pressed)}. ` +
      `The ${mass} turns round as on a wall, and only a little of the impact runs along the beam.`
    );
  if (main.contacts > 1)
    return (
      'Bending does not run through a beam at one speed: short waves run ahead, long ones follow (see the picture of ' +
      `the beam against time). So the ${mass} meets a beam that is light at first and grows heavier. It throws the ` +
      `light piece ahead, the rest holds that piece back, the ${mass} catches up and throws it ahead once more, ` +
      'until the whole beam moves with it.'
    );
  if (waveless) return `${waveless} So it knows one contact only; choose “Modes” to see how many there are.`;
  return (
    `Here the force ends once and for all: the ${mass} has gone before the ${tip} can come back to it. A heavier ` +
    `${mass}, or a harder contact, is hit more than once.`
  );
}

/**
 * How long the whole takes, and how that compares with the beam.
 * @param {BeamFrame} frame
 */
export function spanOf(frame) {
  const { beam, main, span } = frame;
  const many = main.contacts > 1;
  const held = WAVELESS[main.name] ? null : holding(frame);
  const share = span.apparent > 0 ? span.real / span.apparent : 1;
  const said = [];
  if (span.real > 0 && many)
    said.push(
      `From the first touch to the last parting it takes ${duration(span.apparent)}, but they press on each other ` +
        `during only ${duration(span.real)} of it (${percent(share)}).`,
    );
  else if (span.real > 0) said.push(`They touch for ${duration(span.apparent)}.`);
  if (span.half && main.name !== 'rigid' && !held) said.push(ridingOf(frame, span.half));
  if (beam.endMass) said.push(`A mass of ${figures(beam.endMass)} kg is fixed to the tip.`);
  return said.join(' ');
}

/**
 * The impact against half a period of the beam with the impactor on it [ms].
 * @param {BeamFrame} frame
 * @param {number} half
 */
function ridingOf(frame, half) {
  const { main, span } = frame;
  const ratio = span.apparent / half;
  const riding = `With the ${strikerOf(frame)} riding on it this beam swings half a period in ${duration(half)}`;
  if (ratio <= 0.75)
    return `${riding}; the impact is over after ${figures(ratio)} of that, before the beam as a whole can answer.`;
  if (ratio < 1.3)
    return (
      `${riding}, and the impact lasts ${figures(ratio)} of that: seen from afar it is one slow push, by the beam as ` +
      `a spring, handed on in ${count(main.contacts, 'piece')}.`
    );
  const why = main.contacts > 1 ? ', as they meet again later' : ': the contact gives way more than the beam';
  return `${riding}; the impact lasts ${figures(ratio)} times as long${why}.`;
}
