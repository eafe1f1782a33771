// What keys do on the page, and what they mean to the element that has the focus.

/** @import { Page } from '../page.js' */

const TAKE_LETTERS = ['INPUT', 'SELECT', 'TEXTAREA']; // what keys mean something else in
const HAVE_UNDO = ['INPUT', 'TEXTAREA']; // of their own
const TAKE_SPACE = [...TAKE_LETTERS, 'BUTTON', 'SUMMARY'];

/** @param {KeyboardEvent} event */
const from = (event) => /** @type {Element | undefined} */ (event.composedPath()[0]);

/**
 * Whether it is one of these, and no slider, to which letters mean nothing.
 * @param {KeyboardEvent} event
 * @param {string[]} tags
 */
const among = (event, tags) =>
  tags.includes(from(event)?.tagName ?? '') && from(event)?.getAttribute('type') !== 'range';

/**
 * Whether a key is for the element itself.
 * @param {KeyboardEvent} event
 */
const taken = (event) =>
  event.key === ' ' ? TAKE_SPACE.includes(from(event)?.tagName ?? '') : among(event, TAKE_LETTERS);

/** @param {KeyboardEvent} event */
const hasUndo = (event) => among(event, HAVE_UNDO);

/**
 * Have keys do what they do on the page. Returns what ends it.
 * @param {Page} page
 */
export function listenToKeys(page) {
  const key = (/** @type {KeyboardEvent} */ event) => {
    if (event.altKey || event.defaultPrevented) return;
    if (page.help.key(event, taken(event))) return;
    if (event.ctrlKey || event.metaKey) {
      if (!hasUndo(event) && page.history.key(event)) event.preventDefault();
      return;
    }
    if (taken(event)) return;
    if (page.player.key(event) || page.compare.key(event)) event.preventDefault();
  };
  document.addEventListener('keydown', key);
  return () => document.removeEventListener('keydown', key);
}
