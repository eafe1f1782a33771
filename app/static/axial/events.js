// What happens in an impact along an axis, one event after the other.
import { family, text } from '../text/catalogue.js';
import { engineering, figures, pretty, signed } from '../text/format.js';
import { endsOf } from '../frame/falls.js';
import { drawnRigid, toldOf } from './drawn.js';

/** @import { AxialFigures, AxialFrame, Contact } from '../messages.js' */
/** @import { Event } from '../frame/story.js' */

const JUMPS = 6; // of the force in one contact that are listed; later ones are small
const GAPS = 4; // times that they close, that are listed
export const SLOW = 4; // T that a contact lasts at least for its rod to follow as a whole
const STANDS = 5e-4; // of the impact speed; what is slower stands
const NAMED = family('axial.named');

/**
 * An event by the code of its sentence, with its name in a few words where it has one.
 * @param {number} t
 * @param {string} code
 * @param {Record<string, any>} [values]
 * @returns {Event}
 */
const happens = (t, code, values = {}) => {
  const named = code.replace('event', 'named');
  const name = named.replace('axial.named.', '') in NAMED ? text(named, values) : undefined;
  return [t, text(code, values), name];
};

/**
 * The events of an impact, in the order of time [T].
 * @param {AxialFrame} frame
 * @returns {Event[]}
 */
export function eventsOf(frame) {
  const waves = frame.rods.length === 1 && frame.rods[0].mirror && !drawnRigid(frame);
  const found = waves ? eventsOnOneRod(frame) : plainEvents(frame);
  return found.filter(([t]) => t <= frame.duration + 1e-9).sort((a, b) => a[0] - b[0]);
}

/**
 * Where something goes, and how fast.
 * @param {number} velocity  [v]
 */
const going = (velocity) => ({
  way: Math.abs(velocity) < STANDS ? 'stands' : velocity < 0 ? 'back' : 'on',
  speed: signed(Math.abs(velocity)),
});

/**
 * Whether a contact is the last, see `endsOf`.
 * @param {AxialFrame} frame
 * @param {number} velocity  [v]
 * @param {boolean} last
 */
const endOf = ({ speed, target, weight = 0 }, velocity, last) =>
  last ? endsOf(weight, target.held, velocity * speed) : { last };

/**
 * For bodies of any other kind: the contacts, and what the impactor does after each.
 * @param {AxialFrame} frame
 * @returns {Event[]}
 */
function plainEvents(frame) {
  const { rods, impactor, target } = frame;
  const { contacts, left, stillTouching } = toldOf(frame);
  if (impactor.kind === 'pulse') return pulseEvents(contacts);
  const striker = impactor.kind;
  const ball = target.kind === 'mass' && target.shape === 'ball' ? 'sphere' : target.kind;
  const struck = ball === striker && ball === 'mass' ? 'other' : ball;
  const run = target.support === 'anechoic' ? 'endless' : rods.length === 1 ? 'uniform' : true;
  const waves = rods.length > 0 && !drawnRigid(frame) && run;
  const found = contacts.flatMap(([start, end], k) => {
    const touches = k
      ? happens(start, 'axial.event.meets-again', { number: k + 1 })
      : happens(start, 'axial.event.touches', { striker, target: struck, waves });
    const last = k === contacts.length - 1;
    const gone = { striker, ...endOf(frame, left[k], last), ...going(left[k]) };
    const parts = happens(end, end > start ? 'axial.event.parts' : 'axial.event.one-impulse', gone);
    return [touches, last && stillTouching ? happens(end, 'axial.event.still-touching') : parts];
  });
  return waves ? [...found, ...ofGaps(frame), ...ofEndMass(frame)] : [...found, ...ofLastBall(frame)];
}

/**
 * Gaps between rods that close, and open again.
 * @param {AxialFrame} frame
 * @returns {Event[]}
 */
const ofGaps = ({ duration, gaps }) =>
  gaps.slice(0, GAPS).flatMap(([rod, closes, opens]) => {
    const rods = { first: rod - 1, second: rod };
    const both = [happens(closes, 'axial.event.gap-closes', rods), happens(opens, 'axial.event.gap-opens', rods)];
    return opens < duration ? both : both.slice(0, 1);
  });

/**
 * The wave at a mass on the far end of a rod, and back.
 * @param {AxialFrame} frame
 * @returns {Event[]}
 */
function ofEndMass({ exact, impactor, rigid, rods, target }) {
  if (!target.endMass || rods.length !== 1 || target.support !== 'free') return [];
  /** @type {Event[]} */
  const found = [happens(0.5, 'axial.event.end-mass', { rigid })];
  if (exact.contacts[0][1] > 1 + 1e-9)
    found.push(happens(1, 'axial.event.end-mass-back', { rigid, striker: impactor.kind }));
  return found;
}

/**
 * @param {AxialFrame} frame
 * @returns {Event[]}
 */
const ofLastBall = ({ lastBall }) =>
  lastBall ? [happens(lastBall[0], 'axial.event.last-ball', { speed: signed(lastBall[1]) })] : [];

/**
 * @param {Contact[]} contacts
 * @returns {Event[]}
 */
const pulseEvents = (contacts) => [
  happens(0, 'axial.event.pulse'),
  happens(contacts[contacts.length - 1][1], 'axial.event.pulse-over'),
];

/**
 * A mass on a uniform rod, fixed or free at its far end.
 * @param {AxialFrame} frame
 * @returns {Event[]}
 */
function eventsOnOneRod(frame) {
  const { exact, duration, rigid } = frame;
  const fixed = frame.rods[0].mirror > 0;
  const pressure = pretty(frame.stressUnit / 1e6);
  const said = { striker: frame.impactor.kind, pressure };
  const [[, parts]] = exact.contacts;
  const slow = !rigid && parts >= SLOW;
  /** @type {Event[]} */
  const found = [happens(0, rigid ? 'axial.event.first-rigid' : 'axial.event.first-soft', said)];
  if (slow) found.push(happens(1, 'axial.event.slow-push', { fixed, trips: figures(parts, 2) }));
  else if (duration > 0.5)
    found.push(happens(0.5, fixed ? 'axial.event.fixed-end' : 'axial.event.free-end', { rigid }));
  if (!slow && parts > 1 + 1e-9)
    found.push(happens(1, `axial.event.${fixed && rigid ? 'front' : 'wave'}-back`, { spread: spreadOf(frame) }));
  if (fixed && rigid) {
    const again = Math.ceil(parts - 1e-9) - 1;
    for (let t = 2; t <= Math.min(again, JUMPS); t++)
      found.push(happens(t, 'axial.event.front-again', { more: t === JUMPS && again > t ? again - t : 'none' }));
  }
  exact.contacts.forEach(([start, end], k) => {
    if (k > 0) found.push(happens(start, 'axial.event.recontact', { number: k + 1 }));
    const last = k === exact.contacts.length - 1;
    found.push(last && exact.stillTouching ? happens(end, 'axial.event.still-touching') : parting(frame, k, fixed));
  });
  return found;
}

/**
 * Over how long the modes beside draw a jump of the force; none where no modes are shown.
 * @param {AxialFrame} frame
 */
const spreadOf = ({ modalForce, other }) => {
  const time = modalForce && other?.diagnostics.resolved_time;
  return time ? engineering(time, 's') : 'none';
};

/**
 * How a contact on a rod ends.
 * @param {AxialFrame} frame
 * @param {number} k  its number
 * @param {boolean} fixed  the far end
 */
function parting(frame, k, fixed) {
  const { contacts, cutOff, left } = frame.exact;
  return happens(contacts[k][1], 'axial.event.ends', {
    pulled: cutOff[k] && !fixed,
    ...endOf(frame, left[k], k === contacts.length - 1),
    ...going(left[k]),
  });
}
