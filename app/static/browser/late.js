// Modules that are fetched when they are wanted; where there is no server they came with the page.

/**
 * @param {string} name  from the folder of all modules
 * @returns {Promise<any>}
 */
export const late = async (name) =>
  /** @type {any} */ (globalThis).strikewaveModules?.[name] ?? import(new URL(`../${name}`, import.meta.url).href);
