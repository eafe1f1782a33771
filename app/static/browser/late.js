// Modules and style sheets that are fetched when they are wanted; modules of a packed page may have come with it.
import { placeOf } from '../place.js';
import { make } from './dom.js';

/**
 * @param {string} name  from the folder of all modules
 * @returns {Promise<any>}
 */
export const late = async (name) => /** @type {any} */ (globalThis).strikewaveModules?.[name] ?? import(placeOf(name));

/**
 * Have a style sheet of the folder of all modules before an element.
 * @param {string} name
 * @param {HTMLElement} root
 */
export const lateSheet = (name, root) =>
  new Promise((onload) => {
    root.before(make('link', { rel: 'stylesheet', href: placeOf(name), onload, onerror: onload }));
  });
