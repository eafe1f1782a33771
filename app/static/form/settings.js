// Settings in which solutions differ, in the words of their controls.
import { wordsOf } from '../wire/body_values.js';
import { text } from '../text/catalogue.js';
import { pretty } from '../text/format.js';
import { LABELS } from '../text/words.js';

/** @import { Frame } from '../messages.js' */

/** @type {Set<string | undefined>} */
const UNITS = new Set(['N/m', 'N/m¹·⁵', 'N', 'm']); // that a value is written with
// settings of how a scene is solved, not of what it is
const HOW = ['method', 'modes', 'elements', 'shapes', 'floating_frame'];
const CLAIM = /(?<!\d): /; // in a title, behind what it is about: what happens; not behind the number of a figure
const MOTION = ['motion_seconds', 'motion_links']; // and of how far, by what model, it is followed

/**
 * Names of the settings that act in any of these solutions and are not the same in all, in the order of the controls.
 * @param {Frame[]} frames
 */
export function differing(frames) {
  const acting = new Set(frames.flatMap((frame) => frame.acting));
  const names = Object.keys(frames[0]?.chosen ?? {}); // which has them in the order of the controls
  return names.filter(
    (name) => acting.has(name) && frames.some(({ chosen }) => chosen[name] !== frames[0].chosen[name]),
  );
}

/**
 * Whether two solutions are of different impacts, and whether they are solved in different ways.
 * @param {Frame} one
 * @param {Frame} other
 */
export function kindsOf(one, other) {
  const names = differing([one, other]);
  const how = names.filter((name) => isHow(name, [one, other]));
  return { impact: how.length < names.length, how: how.length > 0 };
}

/**
 * Whether a setting says how a scene is solved, not what it is. Where nothing is lost in the contact, restitution
 * belongs to methods and to rigid-body theory.
 * @param {string} name
 * @param {Frame[]} frames
 */
const isHow = (name, frames) =>
  HOW.includes(name) ||
  (name === 'restitution' &&
    frames.every((frame) => 'damps' in frame && !frame.damps && !('exact' in frame && frame.exact.sudden)));

/**
 * Settings in which an impact is not that of its scene, values of bodies aside.
 * @param {Frame} frame
 */
const changedIn = (frame) =>
  differing([frame, { ...frame, chosen: frame.own }]).filter(
    (name) => !isHow(name, [frame]) && !MOTION.includes(name) && name !== 'bodies',
  );

/**
 * Whether an impact is not that of its scene, so that nothing that the scene says of itself holds for it.
 * @param {Frame} frame
 */
export const isChanged = (frame) => Boolean(frame.chosen.bodies) || changedIn(frame).length > 0;

/**
 * In what an impact is not that of its scene, in words; nothing where it is.
 * @param {Frame} frame
 */
export const changesOf = (frame) => [wordsOf(frame), lineOf(changedIn(frame), frame)].filter(Boolean).join(', ');

/**
 * What a scene is about, of its title, without what happens there.
 * @param {string} title
 */
export const aboutOf = (title) => title.split(CLAIM)[0];

/**
 * What an impact is called: a changed one by what its scene is about, without what happens there.
 * @param {Frame} frame
 * @param {string} [title]  of its scene
 */
export const titleOf = (frame, title = frame.title) =>
  isChanged(frame) ? text('controls.changed', { title: aboutOf(title) }) : title;

/**
 * The instant that a scene is opened at, and until when it is looked at [s]; those of a changed one are its own.
 * @param {Frame} frame
 */
export const timesOf = (frame) => (isChanged(frame) ? { time: null, until: null } : frame.opens);

/**
 * A setting in words: "Hertz", "2 m/s", "Modes 5".
 * @param {string} name
 * @param {Frame} frame
 */
function settingOf(name, frame) {
  const { chosen } = frame;
  const { options, title: control, unit } = LABELS[name];
  const value = chosen[name];
  if (name === 'scene') return titleOf(frame);
  if (name === 'bodies') return wordsOf(frame);
  if (typeof value !== 'number') return options?.[value] ?? value;
  return unit === 'm/s'
    ? `${pretty(value)} ${unit}`
    : `${control} ${pretty(value)}${UNITS.has(unit) ? ` ${unit}` : ''}`;
}

/**
 * The value alone of the only setting in which solutions differ, beside one that is named: "0.25", "Hertz".
 * @param {string[]} names
 * @param {Frame} frame
 */
export function shortOf(names, frame) {
  const value = frame.chosen[names[0]];
  if (names.length !== 1 || typeof value !== 'number' || LABELS[names[0]].unit === 'm/s') return lineOf(names, frame);
  return pretty(value);
}

/**
 * Settings of a solution as one line: "Mass ratio 0.25, Hertz".
 * @param {string[]} names
 * @param {Frame} frame
 */
export const lineOf = (names, frame) =>
  names
    .filter((name) => frame.acting.includes(name))
    .map((name) => settingOf(name, frame))
    .filter(Boolean)
    .join(', ');
