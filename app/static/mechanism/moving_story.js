// What happens as a mechanism moves on: its impacts, one after the other, and what each gives to its joints.
import { headOf, make, rowOf } from '../browser/dom.js';
import { given } from '../wire/message.js';
import { booksOpen, showEnergy, showOpenBooks } from '../frame/energy.js';
import { unitOfTime } from '../clock/times.js';
import { family, said, text } from '../text/catalogue.js';
import { duration, figures, speed } from '../text/format.js';
import { jointOf, linkOf } from '../text/words.js';

/** @import { MechanismFrame } from '../messages.js' */
/** @import { Event } from '../frame/story.js' */

const SLOW = 0.1; // s of a solve, from which it is said why
/** @type {Record<string, string>} */
const OF_COLOURS = { links: 'target_rigid' }; // parts that have the colour of another

/**
 * A sentence on it, with its values.
 * @param {string} code
 * @param {MechanismFrame} frame
 * @param {Record<string, any>} [values]
 */
function tell(code, frame, values = {}) {
  const { links, struck } = frame.mechanism;
  return text(`motion.${code}`, {
    ...{ striker: frame.impactor.kind, link: linkOf(links[struck].name), contacts: frame.main.contacts },
    ...{ time: duration(frame.duration), ...values },
  });
}

/**
 * Every impact, as far as they are listed one by one.
 * @param {MechanismFrame} frame
 * @returns {Event[]}
 */
export const movingEvents = (frame) =>
  frame.contacts.map(([start, , impulse], k) => [
    start,
    tell('event', frame, { number: k + 1, impulse: figures(impulse, 4), approach: speed(frame.speed) }),
    tell('named', frame, { number: k + 1 }),
  ]);

/** @param {MechanismFrame} frame  whether contacts last, by a law */
const byLaw = ({ moving }) => moving?.restitution === null;

/** @param {MechanismFrame} frame  whether any link does */
const bends = (frame) => frame.mechanism.links.some(({ flexible }) => flexible);

/** @param {MechanismFrame} frame */
export const movingReasons = (frame) =>
  tell('why', frame, {
    law: byLaw(frame),
    bends: bends(frame),
  });

/**
 * How well it is followed, and for how long.
 * @param {MechanismFrame} frame
 */
export function keptOf(frame) {
  const { cut, restitution, rigid } = given(frame.moving, 'moving');
  const { constraint_error: gap, energy_drift: drift, estimated_error: error, steps } = frame.main.diagnostics;
  const { wall_time: took } = frame.main.diagnostics;
  const law = { law: byLaw(frame), restitution: restitution ?? 1 };
  const joined = frame.mechanism.joints.length > 0;
  const words = [tell('impacts', frame, law), text('motion.kept', { drift, gap, joined })];
  if (rigid) words.push(text('motion.rigid', { why: said(rigid) }));
  if (took > SLOW) words.push(text('motion.slow', { took, steps, bends: bends(frame) }));
  if (cut) words.push(tell('cut', frame));
  if (error) words.push(text('motion.uncertain', { error }));
  return words.join(' ');
}

/**
 * What goes on at an instant.
 * @param {MechanismFrame} frame
 * @param {number} t
 * @param {{ own: string, ahead: string }} values  velocities along the first normal
 */
export const movingNow = (frame, t, values) =>
  tell('now', frame, {
    touching: frame.contacts.findIndex(([start, end]) => start <= t && t < end) + 1,
    before: frame.contacts.filter(([, end]) => end <= t).length,
    ...values,
  });

/**
 * Every impact with what the joints get of it.
 * @param {HTMLElement} table
 * @param {MechanismFrame} frame
 * @param {(t: number) => void} go
 */
export function impactTable(table, frame, go) {
  const { joints } = frame.mechanism;
  const { jolts } = given(frame.moving, 'moving');
  const [perSecond, unit] = unitOfTime(frame.duration);
  const columns = ['number', 'time', 'impulse'].map((name) => text(`motion.column.${name}`, { unit }));
  const names = joints.map(({ links }) => text('motion.column.joint', { joint: jointOf(links) }));
  const rows = jolts.map((jolt, k) => {
    const [start, , impulse] = frame.contacts[k];
    const when = make('button', { type: 'button', className: 'when', textContent: figures(start * perSecond, 4) });
    when.onclick = () => go(start);
    return rowOf([k + 1, when, figures(impulse, 4), ...jolt.map((size) => figures(size))]);
  });
  const left = frame.main.contacts - jolts.length;
  const more = make('td', { colSpan: 3 + joints.length, textContent: text('beam.table.more', { count: left }) });
  if (left > 0) rows.push(make('tr', {}, more));
  table.classList.add('wraps');
  table.replaceChildren(headOf([...columns, ...names]), make('tbody', {}, ...rows));
}

/**
 * Where the energy is in the end.
 * @param {HTMLElement} root
 * @param {MechanismFrame} frame
 */
export function movingShares(root, frame) {
  if (booksOpen(frame.main)) return showOpenBooks(root, frame.main);
  const energies = given(frame.energies, 'energies');
  const { energies: names } = given(frame.moving, 'moving');
  const last = names.map((name, k) => [OF_COLOURS[name] ?? name, energies[energies.length - names.length + k]]);
  const words = family('motion.energy');
  /** @type {[string, string][]} */
  const parts = names.map((name) => [OF_COLOURS[name] ?? name, words[name]]);
  showEnergy(root, { initial: frame.main.energy.initial, ...Object.fromEntries(last) }, parts, true);
}
