// Modules and style sheets that are fetched when they are wanted; where there is no server they came with the page.
import { make } from './dom.js';

/**
 * @param {string} name  from the folder of all modules
 * @returns {Promise<any>}
 */
export const late = async (name) =>
  /** @type {any} */ (globalThis).strikewaveModules?.[name] ?? import(new URL(`../${name}`, import.meta.url).href);

/**
 * Have a style sheet of the folder of all modules before an element.
 * @param {string} name
 * @param {HTMLElement} root
 */
export const lateSheet = (name, root) =>
  new Promise((onload) => {
    const href = new URL(`../${name}`, import.meta.url).href;
    root.before(make('link', { rel: 'stylesheet', href, onload, onerror: onload }));
  });
