// The one question that an impact along an axis asks: it counts what happens, and turns as the sliders do.
import { text } from '../text/catalogue.js';
import { leavingOf } from './cradle_rows.js';
import { strikesBody } from './drawn.js';
import { SLOW } from './events.js';
import { barsOf } from './traces.js';

/** @import { AxialFrame } from '../messages.js' */

/**
 * How often a fixed rod pushes its striker harder at once: at first touch, and whenever the front is back or they
 * meet again. The force need not have fallen to zero before.
 * @param {AxialFrame} frame
 */
export const pushesOf = ({ exact: { contacts }, rigid }) =>
  contacts.reduce((sum, [from, to]) => sum + (rigid && from === 0 ? Math.max(Math.ceil(to - 1e-9), 1) : 1), 0);

/** @param {AxialFrame} frame */
export function questionOf(frame) {
  const { exact, impactor, rigid, rods, target } = frame;
  if (impactor.kind === 'pendulum')
    return text('opening.question.pendulum', { bends: Boolean(frame.exactBar), contacts: exact.contacts.length });
  if (target.row) return text('opening.question.row', leavingOf(frame));
  if (frame.turningBar) return text('opening.question.turning');
  if (!rods.length) return text('opening.question.compact', { sudden: exact.sudden });
  if (strikesBody(rods)) return text('opening.question.compact', { sudden: false });
  if (barsOf(frame)) return text('opening.question.specimen');
  if (impactor.kind === 'pulse' || rods.length > 1) return text('opening.question.rods');
  if (rods[0].mirror <= 0) return text('opening.question.free');
  const slow = !rigid && exact.contacts.length === 1 && exact.contacts[0][1] >= SLOW;
  const pushes = pushesOf(frame);
  return text('opening.question.fixed', { pushes, apart: pushes === exact.contacts.length, slow });
}
