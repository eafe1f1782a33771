// What keys do on the page, and what they mean to the element that has the focus.

import { alone } from '../browser/home.js';

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
const taken = (event) => among(event, event.key === ' ' ? TAKE_SPACE : TAKE_LETTERS);

/** @param {Event} event */
const fieldOf = (event) => /** @type {HTMLInputElement} */ (event.composedPath()[0]);

/** @param {Event} event */
const isHistory = (event) => /^history(Undo|Redo)$/.test(/** @type {InputEvent} */ (event).inputType);

/** What is being written in a field, which its own undo takes back; what is chosen by it is the page's to undo. */
export class Writing {
  /** @type {HTMLInputElement | null} */ field = null;
  before = ''; // what stood in it

  /** @param {EventTarget} root */
  constructor(root) {
    root.addEventListener('beforeinput', (event) => {
      const field = fieldOf(event);
      if (this.field === field || isHistory(event)) return;
      this.field = field;
      this.before = field.value;
    });
    root.addEventListener('change', (event) => {
      if (fieldOf(event).ariaInvalid !== 'true') this.field = null; // what is refused still stands there
    });
    // Undone from the menu of the browser: what the field shows then is chosen.
    root.addEventListener('input', (event) => {
      if (isHistory(event) && this.field !== fieldOf(event)) fieldOf(event).dispatchEvent(new Event('change'));
    });
  }
  /**
   * Whether a key that undoes is for the field that has the focus.
   * @param {KeyboardEvent} event
   */
  takes(event) {
    return among(event, HAVE_UNDO) && this.field === fieldOf(event) && this.field.value !== this.before;
  }
}

/**
 * Have keys do what they do on the page. Returns what ends it.
 * @param {Page} page
 */
export function listenToKeys(page) {
  const key = (/** @type {KeyboardEvent} */ event) => {
    if (event.altKey || event.defaultPrevented) return;
    if (page.help.key(event, taken(event))) return;
    const { lesson, on } = page.opening.teaching;
    if (on) {
      if (page.scenes.searched !== null) return;
      const bare = lesson && !taken(event) && !event.ctrlKey && !event.metaKey;
      if (bare && (lesson.bar.projector?.key(event) || page.player.key(event))) event.preventDefault();
      return; // all else would lead out of the lesson
    }
    if (page.scenes.key(event, taken(event))) return;
    if (event.ctrlKey || event.metaKey) {
      if (page.history.key(event)) event.preventDefault();
      return;
    }
    if (taken(event)) return;
    if (page.player.key(event) || page.compare.key(event) || page.opening.key(event)) event.preventDefault();
  };
  const place = alone ? document : page.root;
  place.addEventListener('keydown', /** @type {EventListener} */ (key));
  return () => place.removeEventListener('keydown', /** @type {EventListener} */ (key));
}
