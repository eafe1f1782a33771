// The one question that a scene asks, and the one change that answers it best.
import { triesOf } from '../shell/first.js';
import { family, text } from '../text/catalogue.js';

/** @import { AxialFrame, Frame, Try } from '../messages.js' */

const SLOW = 4; // T that a push lasts at least for its rod to follow as a whole
const WHATS = family('opening.what-if');
/** Sliders that lead, of those that act. */
const LEADING = ['mass_ratio', 'law', 'restitution', 'modes', 'place', 'speed', 'friction', 'tilt', 'spin'];
const FOUR = 4;
/** @type {Record<string, number>} by which a question says that it changes */
const FACTORS = { mass_ratio: 0.25, speed: 2 };

/** @param {Frame} frame */
export const leadingOf = ({ acting }) => LEADING.filter((name) => acting.includes(name)).slice(0, FOUR);

/**
 * How often a rod that is fixed pushes its striker: at first touch, and whenever the front is back or they meet again.
 * @param {AxialFrame} frame
 */
export const pushesOf = ({ exact: { contacts }, rigid }) =>
  contacts.reduce((sum, [from, to]) => sum + (rigid && from === 0 ? Math.max(Math.ceil(to - 1e-9), 1) : 1), 0);

/** @param {AxialFrame} frame */
function axialQuestion(frame) {
  const { exact, impactor, rigid, rods, target } = frame;
  if (impactor.kind === 'pendulum') return text('opening.question.pendulum');
  if (target.row) return text('opening.question.row');
  if (frame.turningBar) return text('opening.question.turning');
  if (!rods.length) return text('opening.question.compact', { sudden: exact.sudden });
  if (impactor.kind === 'pulse' || rods.length > 1) return text('opening.question.rods');
  if (rods[0].mirror <= 0) return text('opening.question.free');
  const slow = !rigid && exact.contacts.length === 1 && exact.contacts[0][1] >= SLOW;
  return text('opening.question.fixed', { pushes: pushesOf(frame), slow });
}

/** @param {Frame} frame */
export function questionOf(frame) {
  if (frame.kind === 'axial') return axialQuestion(frame);
  if (frame.kind === 'bodies') return text('opening.question.bodies');
  const contacts = frame.contacts.length;
  if (frame.kind === 'mechanism') return text('opening.question.mechanism', { moving: Boolean(frame.moving) });
  return text('opening.question.beam', { contacts });
}

/**
 * What could be changed, of what a leading slider shows, where it is what the question says.
 * @param {Frame} frame
 * @returns {{ words: string, name: string, value: number | string }[]}
 */
export function changesOf(frame) {
  const { chosen } = frame;
  const leading = leadingOf(frame);
  const said = (/** @type {string} */ name, /** @type {number | string} */ value) =>
    name === 'law'
      ? chosen.law === 'rigid' && value === 'hertz'
      : !(name in FACTORS) || Math.abs(Number(value) / (FACTORS[name] * Number(chosen[name])) - 1) < 1e-6;
  const plain = (/** @type {Try} */ [, name, value]) => leading.includes(name) && said(name, value);
  return triesOf(frame)
    .filter(plain)
    .toSorted(([, a], [, b]) => leading.indexOf(a) - leading.indexOf(b))
    .map(([words, name, value]) => ({ words: WHATS[name] ?? words, name, value }));
}
