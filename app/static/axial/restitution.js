// What the restitution does in an impact along an axis.
import { said, text } from '../text/catalogue.js';

/** @import { AxialFrame } from '../messages.js' */

/**
 * Whether the chosen method is one of repeated balances.
 * @param {AxialFrame} frame
 */
const balances = ({ chosen, exact, other }) =>
  [exact, other].some((one) => one?.name === chosen.method && !one.byLaw && !one.sudden);

/**
 * Whether it sets nothing but the prediction of rigid bodies.
 * @param {AxialFrame} frame
 */
export const predicts = (frame) => !frame.damps && !balances(frame) && !frame.exact.sudden;

/**
 * @param {AxialFrame} frame
 * @param {string} [exact]  method that is beside all others
 */
export function noteOf(frame, exact) {
  const { chosen, damps, leastRestitution: least, match, nominal, yields } = frame;
  const method = String(chosen.method);
  const raised = Number(chosen.restitution) < least;
  if (frame.exact.sudden) return text('controls.of-contact');
  const acts = damps
    ? text('controls.of-contact-and-prediction', { least, nominal, raised })
    : balances(frame)
      ? text('controls.of-balances-and-prediction')
      : text('controls.of-prediction', { yields });
  const refused = method === exact ? null : frame.refusals[method];
  const matched = match === null ? '' : text('controls.match', { restitution: match });
  return [acts, matched, refused ? said(refused) : ''].filter(Boolean).join(' ');
}
