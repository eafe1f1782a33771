// What happens in an impact on a mechanism, one event after the other, and what its joints have borne.
import { headOf, make, rowOf } from '../browser/dom.js';
import { headed } from '../frame/story.js';
import { family, text } from '../text/catalogue.js';
import { duration, engineering, figures, speed } from '../text/format.js';
import { jointOf, linkOf } from '../text/words.js';

/** @import { MechanismFrame } from '../messages.js' */
/** @import { Event } from '../frame/story.js' */

const LISTED = 4; // contacts that are described one by one

/**
 * A sentence on a mechanism, with its values.
 * @param {string} code
 * @param {MechanismFrame} frame
 * @param {Record<string, any>} [values]
 */
function tell(code, frame, values = {}) {
  const { links, struck } = frame.mechanism;
  return text(`beam.mechanism.${code}`, { striker: frame.impactor.kind, link: linkOf(links[struck].name), ...values });
}

/**
 * What happens to a mechanism, with its name in a few words.
 * @param {number} t
 * @param {string} code
 * @param {MechanismFrame} frame
 * @param {Record<string, any>} [values]
 * @returns {Event}
 */
const happens = (t, code, frame, values = {}) => [
  t,
  tell(code, frame, values),
  text(`beam.mechanism.named.${code}`, values),
];

/**
 * Velocities along the normal as a contact begins or ends, as far as they are known.
 * @param {MechanismFrame} frame
 * @param {number} k
 * @param {0 | 1} end
 */
function ratesAt({ rates }, k, end) {
  const [own, ahead] = [rates[4 * k + 2 * end], rates[4 * k + 2 * end + 1]];
  return { own: speed(own), ahead: speed(ahead), apart: speed(Math.abs(own - ahead)) };
}

/**
 * The events of the impact, in the order of time [s].
 * @param {MechanismFrame} frame
 * @returns {Event[]}
 */
export function mechanismEvents(frame) {
  const { contacts, main, speed: approach } = frame;
  const { links, struck } = frame.mechanism;
  const last = contacts.length - 1;
  const bends = links[struck].flexible;
  const leaves = speed(main.final ?? 0);
  const [first, over, impulse] = contacts[0];
  if (last === 0 && first === over) {
    const values = { approach: speed(approach), impulse: engineering(impulse, 'N s'), leaves };
    return [happens(first, 'impulse', frame, values)];
  }
  /** @type {Event[]} */
  const found = [happens(first, 'meets', frame, { approach: speed(approach), bends })];
  contacts.slice(0, LISTED).forEach(([start, end], k) => {
    if (k > 0) found.push(happens(start, 'meets-again', frame, { number: k + 1, ...ratesAt(frame, k, 0) }));
    const lasts = end > start ? duration(end - start) : text('beam.event.no-time');
    if (k < last) found.push(happens(end, 'parts', frame, { lasts, ...ratesAt(frame, k, 1) }));
  });
  if (last >= LISTED)
    found.push(happens(contacts[LISTED][0], 'repeated', frame, { first: LISTED + 1, last: main.contacts }));
  const [, end] = contacts[last];
  if (main.stillTouching) found.push([end, text('beam.event.still-touching'), text('beam.named.still-touching')]);
  else if (main.contacts <= contacts.length) found.push(happens(end, 'ends', frame, { leaves, last: last > 0 }));
  return found.sort((a, b) => a[0] - b[0]);
}

/**
 * Why so many contacts, or why only one.
 * @param {MechanismFrame} frame
 */
export function mechanismReasons(frame) {
  const { links } = frame.mechanism;
  const bends = !frame.main.sudden && links.some(({ flexible }) => flexible);
  return tell(!bends ? 'rigid' : frame.main.contacts > 1 ? 'many' : 'one', frame);
}

/** What the joints have borne, as a table. */
export class Joints {
  constructor() {
    this.table = make('table', { className: 'figures' });
    this.root = make('div', { hidden: true }, ...headed(text('beam.mechanism.joints'), this.table));
  }
  /** @param {MechanismFrame} frame */
  load({ main, mechanism }) {
    this.root.hidden = !main.joints?.length;
    if (!main.joints) return;
    const columns = family('beam.mechanism.column');
    const rows = main.joints.flatMap((joint, n) => {
      const name = jointOf(mechanism.joints[n].links);
      const row = (/** @type {string} */ what, /** @type {number[]} */ [x, y], /** @type {number} */ moment) =>
        rowOf([what, figures(x), figures(y), figures(moment)]);
      const { impulse, moment_impulse, impulse_to_parting, moment_impulse_to_parting = 0 } = joint;
      if (!impulse_to_parting) return [row(name, impulse, moment_impulse)];
      return [
        row(text('beam.mechanism.sudden', { joint: name }), impulse, moment_impulse),
        row(text('beam.mechanism.to-parting', { joint: name }), impulse_to_parting, moment_impulse_to_parting),
      ];
    });
    this.table.replaceChildren(headOf(['', columns.x, columns.y, columns.moment]), make('tbody', {}, ...rows));
  }
}
