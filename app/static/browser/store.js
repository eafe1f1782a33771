// What the browser keeps for this page between visits. Where nothing may be kept, or there is no room, it forgets.

const PREFIX = 'strikewave.';

/**
 * What was kept under a name; the other value where there is none, or none that can be read.
 * @template Value
 * @param {string} name
 * @param {Value} other
 * @param {boolean} [visit]  of this visit alone
 * @returns {Value}
 */
export function kept(name, other, visit = false) {
  try {
    const text = storeOf(visit).getItem(PREFIX + name);
    return text === null ? other : JSON.parse(text);
  } catch {
    return other;
  }
}

/**
 * Keep a value under a name; nothing at all forgets it.
 * @param {string} name
 * @param {unknown} value
 * @param {boolean} [visit]  for this visit alone
 */
export function keep(name, value, visit = false) {
  try {
    if (value === undefined) storeOf(visit).removeItem(PREFIX + name);
    else storeOf(visit).setItem(PREFIX + name, JSON.stringify(value));
  } catch {
    // forbidden or full: the page works without it
  }
}

/**
 * Raises an error where the browser forbids it.
 * @param {boolean} visit
 */
const storeOf = (visit) => (visit ? window.sessionStorage : window.localStorage);
