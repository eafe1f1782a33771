// What an address says of the view, which the browser reads itself; the choices, the server reads.
import { text } from '../text/catalogue.js';
import { keptOf } from './kept.js';
import { ALL } from './layout.js';
import { refusalIn } from '../wire/model.js';

/** @import { Page } from '../page.js' */
/** @import { Wanted } from './kept.js' */

const PLACE = /^-?\d{1,4}(\.\d{1,9})?$/; // [m]
const MAP = /^[\w.,:+-]{0,600}$/;
const WORDS = 60; // letters that are searched in the gallery
const TIME = /^\d{1,9}(\.\d{1,9})?(e[+-]?\d{1,2})?$/;

/**
 * @typedef {object} Link
 * @property {number | null} t
 * @property {boolean} playing
 * @property {[number, number] | null} view  the stretch of time
 * @property {string | null} colour
 * @property {number | null} gauge  its place [m]
 * @property {string | null} read  what the gauge reads
 * @property {string | null} tab  that is open
 * @property {Wanted[]} kept
 * @property {string | null} beside
 * @property {boolean} locked
 * @property {string | null} whatif  what the map shows, where it is open
 * @property {string | null} gallery  what is searched in it, where it is open
 * @property {string[]} bad  keys that say what cannot be
 */

/**
 * @param {string} search
 * @param {Page} page
 * @returns {Link}
 */
export function readLink(search, { model, view }) {
  const query = new URLSearchParams(search);
  /** @type {string[]} */
  const bad = [];
  /**
   * @template Value
   * @param {string} key
   * @param {(value: string) => Value | null} read  null where the value cannot be
   */
  const get = (key, read) => {
    const value = query.get(key);
    const found = value === null ? null : read(value);
    if (value !== null && found === null) bad.push(key);
    return found;
  };
  const { linkUnit = 1 } = view;
  const time = (/** @type {string} */ value) => (TIME.test(value) ? Number(value) * linkUnit : null);
  const yes = (/** @type {string} */ value) => (value === 'true' ? true : value === 'false' ? false : null);
  const kept = get('kept', (value) => keptOf(value, model.spec)) ?? [];
  return {
    t: get('t', time),
    playing: get('playing', yes) ?? false,
    view: get('view', (value) => stretchOf(value.split(',').map(time))),
    colour: get('colour', (value) => view.whats?.find((what) => what === value) ?? null),
    read: get('read', (value) => view.gauge?.whats.find((what) => what === value) ?? null),
    gauge: get('gauge', (value) => (PLACE.test(value) ? Number(value) : null)),
    tab: get('tab', (value) => ALL.find((name) => name === value) ?? null),
    kept,
    beside: get('beside', (value) => kept.find(({ letter }) => letter === value)?.letter ?? null),
    locked: get('locked', yes) ?? false,
    whatif: get('whatif', (value) => (MAP.test(value) ? value : null)),
    gallery: get('gallery', (value) => value.slice(0, WORDS)),
    bad,
  };
}

/**
 * @param {(number | null)[]} ends
 * @returns {[number, number] | null}
 */
function stretchOf([start, end, ...more]) {
  if (start === null || end === null || start === undefined || end === undefined || more.length) return null;
  return start < end ? [start, end] : null;
}

/**
 * Show what a link says.
 * @param {Page} page
 * @param {Link} link
 * @returns {boolean}  whether it says where the clock is
 */
export function follow(page, link) {
  const { bad, beside, colour, gallery, gauge, kept, locked, playing, read, t, tab, view: stretch, whatif } = link;
  const { changes, compare, frame, layout, player, view } = page;
  const wrong = changes.held.refusals(frame.acting);
  if (bad.length) wrong.push(text('page.bad-link', { keys: bad }));
  if (wrong.length) page.complain([refusalIn(page.model), ...wrong].filter(Boolean).join('\n'));
  if (colour) view.colour?.(colour);
  if (read) view.gauge?.read(read);
  if (gauge !== null) view.gaugeAt?.(gauge);
  if (stretch && view.axis) view.axis.show(stretch);
  if (gallery !== null) page.scenes.open(gallery);
  if (whatif !== null) page.opening.door.open(whatif);
  if (tab && layout.tabs.offers(tab)) {
    layout.tabs.select(tab);
    layout.place();
  }
  if (t !== null) player.seek(t);
  if (playing) player.toggle();
  const rest = () => {
    if (beside) compare.standBeside(compare.runs.find(({ letter }) => letter === beside) ?? null);
    if (locked && compare.lockable) compare.lock(true);
  };
  if (kept.length) compare.restore(kept).then(rest);
  else rest();
  return t !== null;
}
