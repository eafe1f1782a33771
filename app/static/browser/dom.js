// Elements of the page, made in one call; files given to the visitor.
import { unbroken } from '../text/format.js';

/**
 * Properties of an element; numbers may stand for strings.
 * @template {keyof HTMLElementTagNameMap} Tag
 * @typedef {{ [Key in keyof HTMLElementTagNameMap[Tag]]?: HTMLElementTagNameMap[Tag][Key] extends string
 *   ? string | number : HTMLElementTagNameMap[Tag][Key] }} PropertiesOf
 */

/**
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {PropertiesOf<Tag>} [properties]
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  Object.assign(element, properties);
  element.append(...children);
  return element;
}

/**
 * Write where it says something else: what is written is laid out anew, as it was or not.
 * @param {Node} node
 * @param {string} words
 */
export function write(node, words) {
  if (node.textContent !== words) node.textContent = words;
}

/**
 * The head of a table.
 * @param {string[]} texts
 */
export const headOf = (texts) => make('thead', {}, make('tr', {}, ...texts.map(columnHead)));

/**
 * The head of a column; none where it has no name, which would be read aloud as one.
 * @param {string} textContent
 */
export const columnHead = (textContent) => (textContent ? make('th', { scope: 'col', textContent }) : make('td'));

/**
 * A row of a table.
 * @param {(string | number | Node)[]} cells
 * @param {PropertiesOf<'tr'>} [properties]
 */
export const rowOf = (cells, properties = {}) =>
  make('tr', properties, ...cells.map((cell) => make('td', {}, cell instanceof Node ? cell : unbroken(String(cell)))));

/**
 * What may be wider than its room; where it is, keys scroll it, too.
 * @param {HTMLElement} element
 * @param {string} ariaLabel
 */
export function scrolled(element, ariaLabel) {
  const root = make('div', { className: 'scroll', role: 'group', ariaLabel }, element);
  const sized = new ResizeObserver(() => {
    if (root.scrollWidth > root.clientWidth) root.tabIndex = 0;
    else root.removeAttribute('tabindex');
  });
  for (const each of [root, element]) sized.observe(each);
  return root;
}

/**
 * Buttons of which one is pressed, as a group.
 * @param {string} ariaLabel
 * @param {string[]} names
 * @param {(name: string) => void} press
 * @param {(name: string) => string} [written]  what a button says
 */
export function segments(ariaLabel, names, press, written = (name) => name) {
  const root = make('div', { className: 'segments', role: 'group', ariaLabel });
  const buttons = names.map((name) => {
    const button = make('button', { type: 'button', textContent: written(name), onclick: () => press(name) });
    button.dataset.kind = name;
    return button;
  });
  root.append(...buttons);
  const show = (/** @type {string} */ pressed) => {
    for (const button of buttons) button.ariaPressed = String(button.dataset.kind === pressed);
  };
  return { root, show };
}

/**
 * Have the browser save a file.
 * @param {Blob} blob
 * @param {string} name
 */
export function download(blob, name) {
  const link = make('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
