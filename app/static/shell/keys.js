// What keys mean to the element that has the focus.

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
export const taken = (event) =>
  event.key === ' ' ? TAKE_SPACE.includes(from(event)?.tagName ?? '') : among(event, TAKE_LETTERS);

/** @param {KeyboardEvent} event */
export const hasUndo = (event) => among(event, HAVE_UNDO);
