// The address of the page says what is shown, and what is open and asked; of the choices only what differs from the
// scene's own values.
import { entriesOf } from '../wire/body_values.js';
import { alone, framed } from '../browser/home.js';
import { language } from '../text/catalogue.js';
import { keptText } from './kept.js';

/** @import { Page } from '../page.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Model } from '../wire/model.js' */

/** What an address says of the language, if this one does. */
const SPOKEN = alone && new URLSearchParams(location.search).has('language') ? language : '';
const PASSING = ['t', 'playing', 'tab']; // of what is seen, which a link for a class does not say
const PLAIN = { '%2C': ',', '%3A': ':', '%3B': ';' }; // what a query need not encode

/**
 * Choices that differ from the scene's own, of those that act; the scene itself where it is not the first.
 * @param {Model} model
 * @param {Frame} frame
 * @returns {[name: string, value: string][]}
 */
function choicesOf({ spec }, { acting, chosen, own }) {
  const { scene } = chosen;
  const changed = Object.keys(spec).filter((name) => acting.includes(name) && chosen[name] !== own[name]);
  const first = scene === spec.scene.default ? [] : [/** @type {[string, string]} */ (['scene', String(scene)])];
  const bodies = acting.includes('bodies') ? entriesOf(chosen.bodies) : []; // by keys of their own
  const rest = changed.filter((name) => name !== 'bodies');
  return [...first, ...bodies, ...rest.map((name) => /** @type {[string, string]} */ ([name, String(chosen[name])]))];
}

/**
 * @param {Model} model
 * @returns {[key: string, value: string][]}  open panels, and what is asked in them
 */
function panelsOf(model) {
  const { panels, asked } = model.shared;
  const open = Object.keys(panels).filter((name) => model[panels[name]]);
  const questions = Object.entries(asked).filter(
    ([, [, panel, within]]) => open.includes(panel) && (!within || model.auto_within === within),
  );
  return [
    ...(open.length ? [/** @type {[string, string]} */ (['panel', open.join(',')])] : []),
    ...questions.map(([key, [name]]) => /** @type {[string, string]} */ ([key, String(model[name])])),
  ];
}

/**
 * What is seen of it, and what is kept beside it.
 * @param {Page} page
 * @param {boolean} moment  with the instant of the clock, also while it runs
 * @returns {[key: string, value: string][]}
 */
function viewOf({ compare, frame, layout, opening, player, scenes, view }, moment) {
  /** @type {[string, string][]} */
  const found = [];
  const add = (/** @type {string} */ key, /** @type {unknown} */ value) => found.push([key, String(value)]);
  const { axis, gauge, linkUnit = 1, usual, what } = view;
  const written = (/** @type {number} */ t, /** @type {number} */ digits) => Number((t / linkUnit).toPrecision(digits));
  if (moment || (player.played && !player.playing)) add('t', written(player.t, 4));
  if (moment && player.playing) add('playing', true);
  if (axis?.moved) add('view', axis.view.map((t) => written(t, 5)).join(','));
  if (what && what !== usual) add('colour', what);
  if (gauge?.there && gauge.asked !== null && gauge.asked !== gauge.usual)
    add('gauge', Number(gauge.asked.toPrecision(5)));
  if (gauge?.there && gauge.what !== gauge.first) add('read', gauge.what);
  const { selected } = layout.tabs;
  if (opening.docked || (!layout.tabbed && selected === 'numbers')) add('tab', selected);
  if (compare.runs.length) add('kept', keptText(compare.runs, frame));
  if (compare.beside) add('beside', compare.beside.letter);
  if (compare.locked) add('locked', true);
  if (scenes.searched !== null) add('gallery', scenes.searched);
  if (opening.door.said !== null) add('whatif', opening.door.said);
  return found;
}

/**
 * @param {Page} page
 * @param {boolean} [moment]  with the instant of the clock, also while it runs
 * @param {string} [spoken]  the language that it asks for
 * @param {import('../wire/held.js').Held} [taught]  what a link for a class takes from the controls
 */
export function queryOf(page, moment = false, spoken = SPOKEN, taught) {
  const { frame, model } = page;
  const { lesson } = page.opening.teaching;
  const asked = spoken ? [['language', spoken]] : [];
  if (lesson) return [lesson.query, ...asked.map((each) => each.join('='))].join('&');
  const panels = page.opening.leads && !page.opening.docked ? [] : panelsOf(model); // where they are seen
  const taken = (taught ?? page.changes.held).said;
  const seen = viewOf(page, moment).filter(([key]) => !taught || !PASSING.includes(key));
  const said = [...choicesOf(model, frame), ...taken, ...panels, ...seen];
  const query = new URLSearchParams([...said, ...page.opening.said, ...asked]);
  return query.toString().replace(/%2C|%3A|%3B/g, (code) => PLAIN[/** @type {keyof typeof PLAIN} */ (code)]);
}

/**
 * Choices alone: two states of the page with the same are one step of its history.
 * @param {Page} page
 */
export const choicesText = ({ frame, model }) => new URLSearchParams(choicesOf(model, frame)).toString();

/**
 * Of a lesson, or of the page as it begins, in the same language; what is in a frame stays there.
 * @param {string} [name]
 */
export const lessonAt = (name) => here([name ? `lesson=${name}` : '', SPOKEN && `language=${SPOKEN}`]);

/**
 * Of the page as it is, which the browser has.
 * @param {Page} page
 */
export const ownAddress = (page) => here([queryOf(page)]);

/** @param {string[]} said */
const here = (said) => addressOf([framed ? 'embed' : '', ...said].filter(Boolean).join('&'));

/** @param {string} query */
export const addressOf = (query) => (query ? `?${query}` : location.pathname);
