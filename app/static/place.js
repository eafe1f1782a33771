// Where the files of the page are: beside this module, also where it is part of a packed one.

/**
 * The address of a file.
 * @param {string} name  from the folder of all modules
 */
export const placeOf = (name) => new URL(name, import.meta.url).href;
