// What the opening draws of a mechanism below its stage: impulses or force, the gap, the bending of a link, a pin.
import { boxOf } from '../charts/scale.js';
import { given } from '../wire/message.js';
import { byOf, called, errorsOf, jointOf, linkOf } from '../text/words.js';
import { text } from '../text/catalogue.js';
import { unitOfTime } from '../clock/times.js';
import { valuesOf } from './reactions.js';

/** @import { BeamField } from '../beam/field.js' */
/** @import { Series } from '../charts/chart.js' */
/** @import { Range } from '../charts/scale.js' */
/** @import { MechanismFrame, Numbers } from '../messages.js' */
/** @import { Tracked } from '../opening/section.js' */
/** @import { Track } from '../opening/tracks.js' */

const ROOM = 1.1; // about the largest value
const FLAT = 1.5; // of a mechanism, its width over its height, from which on it has more room above its tracks
const SHARES = { push: 1, gap: 0.8, bends: 1.4, pin: 1.2 };

/**
 * The largest value in a stretch of time.
 * @param {Numbers} x
 * @param {Numbers} y
 * @param {Range} stretch
 */
const mostOf = (x, y, [start, end]) =>
  y.reduce((most, value, k) => (x[k] >= start && x[k] <= end ? Math.max(most, value) : most), 0);

/**
 * @param {MechanismFrame} frame
 * @param {BeamField} field
 * @param {Series[]} forces
 * @param {Range} stretch  of time that is seen
 * @param {number} largest  end of the colours of its bending
 * @returns {Tracked}
 */
export function tracksOf(frame, field, forces, stretch, largest) {
  const { beam, contacts, duration, impactorPath, main, mechanism, struckPath, time } = frame;
  const [force] = forces;
  const [left, right, low, high] = boxOf(given(frame.linkPoints, 'linkPoints'));
  const sudden = !force?.x.length || (frame.moving ? frame.moving.restitution !== null : main.sudden);
  /** @type {Track[]} */
  const tracks = [sudden ? impulses(contacts) : pushes(force, stretch)];
  const gap = struckPath.map((place, k) => Math.max(place - impactorPath[k], 0));
  const until = contacts.length > 1 ? contacts[contacts.length - 1][0] : stretch[1];
  const widest = mostOf(time, gap, [stretch[0], Math.min(until, stretch[1])]);
  if (widest > 0)
    tracks.push({
      ...{ title: text('opening.track.gap'), share: SHARES.gap, range: [0, ROOM * widest], unit: 'm' },
      series: [{ x: time, y: gap, style: 'struck', name: '' }],
    });
  const struck = mechanism.links[mechanism.struck];
  if (struck.flexible && field.has('moment'))
    tracks.push({
      ...{ title: text('opening.track.bends', { link: linkOf(struck.name) }), share: SHARES.bends },
      ...{ range: [0, beam.length], unit: 'm', marks: [mechanism.at] },
      rows: { field, what: 'moment', largest, duration },
    });
  return {
    by: byOf(called(main), errorsOf(main)),
    clock: unitOfTime(stretch[1]),
    drawn: null,
    tall: right - left < FLAT * (high - low),
    tracks: [...tracks, ...pin(frame, stretch)],
  };
}

/**
 * @param {import('../messages.js').Contact[]} contacts
 * @returns {Track}
 */
function impulses(contacts) {
  const most = Math.max(...contacts.map(([, , impulse]) => impulse));
  const bars = contacts.map(([t, , value], k) => ({ t, value, words: String(k + 1) }));
  const title = text('opening.track.impulses');
  return { title, share: SHARES.push, range: [ROOM * 1.15 * most, 0], unit: 'N s', bars };
}

/**
 * @param {Series} force
 * @param {Range} stretch
 * @returns {Track}
 */
function pushes(force, stretch) {
  const most = mostOf(Float64Array.from(force.x), Float64Array.from(force.y), stretch) * (force.factor ?? 1);
  return {
    ...{ title: text('opening.track.force'), share: SHARES.push, range: [ROOM * most, 0], unit: 'N' },
    ...{ force: true, series: [{ ...force, style: 'exact' }] },
  };
}

/**
 * The joint that feels the most, where any does over time.
 * @param {MechanismFrame} frame
 * @param {Range} stretch
 * @returns {Track[]}
 */
function pin({ mechanism: { joints }, reactions, reactionTime: x }, stretch) {
  if (!reactions || !x) return [];
  const all = valuesOf(reactions, joints.length, 'force').map((y, n) => ({ y, n, most: mostOf(x, y, stretch) }));
  const { most, n, y } = all.reduce((a, b) => (b.most > a.most ? b : a));
  if (!(most > 0)) return [];
  const title = text('opening.track.pin', { joint: jointOf(joints[n].links) });
  return [
    {
      ...{ title, share: SHARES.pin, range: [0, ROOM * most], unit: 'N' },
      series: [{ x, y, style: 'joint2', name: '' }],
    },
  ];
}
