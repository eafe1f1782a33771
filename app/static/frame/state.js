// What the page shows besides what its address says, to come back with: clock, zoom, tab, choices not yet answered.
import { alone } from '../browser/home.js';
import { keep, kept } from '../browser/store.js';

/** @import { Page } from '../page.js' */

const NAME = 'resume'; // under which it is kept from one page to the next
const FRESH = 120_000; // ms for which it is gone on with

/** @param {Page} page */
function stateOf(page) {
  const { bodies, controls, frame, layout, model, names, player, waiting } = page;
  const unanswered = names.filter((name) => frame && model[name] !== frame.chosen[name]);
  return {
    search: window.location.search,
    t: player.t,
    playing: player.playing,
    looping: player.looping,
    pace: player.pace.value,
    range: page.range(),
    tab: layout.tabs.selected,
    colour: page.view.what ?? null,
    values: bodies.unanswered,
    wanted: { ...Object.fromEntries(unanswered.map((name) => [name, model[name]])), ...waiting },
    scrolled: controls.root.parentElement?.parentElement?.scrollTop ?? 0,
  };
}

/**
 * What is shown, for when this page is come back to.
 * @param {Page} page
 */
export function keepState(page) {
  if (alone) keep(NAME, { ...stateOf(page), at: Date.now() }, true);
}

/**
 * The state with which the page has come back, once.
 * @returns {Record<string, any> | null}
 */
export function cameBack() {
  if (!alone) return null;
  const state = kept(NAME, /** @type {Record<string, any> | null} */ (null), true);
  keep(NAME, undefined, true);
  const [how] = performance.getEntriesByType('navigation');
  const again = 'type' in how && how.type !== 'navigate'; // the same page, not another visit
  return state && again && Date.now() - state.at < FRESH ? state : null;
}

/**
 * Go on with it.
 * @param {Page} page
 * @param {Record<string, any>} state
 */
export function goOn(page, state) {
  const { bodies, layout, model, player, view } = page;
  if (state.search !== window.location.search) return; // another page of the same browser
  player.looping = state.looping;
  player.pace.value = state.pace;
  layout.tabs.select(state.tab);
  if (view.whats?.includes(state.colour)) view.colour?.(state.colour);
  const [start, end] = state.range;
  if (view.axis && (start > view.axis.whole[0] || end < view.axis.whole[1])) view.axis.show([start, end]);
  player.go(state.t);
  if (state.playing) player.toggle();
  const wanted = Object.entries(state.wanted).filter(([name]) => name in model.spec);
  for (const [name, value] of wanted) page.controls.show(name, value);
  Object.assign(page.waiting, Object.fromEntries(wanted)); // at once: values of bodies are answered by what is chosen
  page.changes.flush();
  for (const [key, value] of state.values ?? []) bodies.set(key, value ?? undefined);
}
