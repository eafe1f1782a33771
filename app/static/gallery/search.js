// Which scenes the typed words find: each word somewhere in what is known of it, a number such as 7.6 as it stands.
import { entryOf } from '../form/scenes.js';
import { family, named, said } from '../text/catalogue.js';

/** @import { Note } from '../text/catalogue.js' */
/** @typedef {{ method: string, law: string, bodies: string[] }} Found  by which it is found besides */
/** @typedef {{ scene: string, title: string, number: string, words: string }} Entry */

const NUMBER = /^\d+\.\d*$/;
const KINDS = family('bodies.kind');

/** @param {string} words */
export const plain = (words) =>
  words
    .toLowerCase()
    .normalize('NFD')
    .replace(/[\u0300-\u036f]/g, '')
    .replaceAll('-', ' ');

/**
 * A scene of the list, with all it is found by.
 * @param {string} scene
 * @param {string} title
 * @param {Found} found
 * @param {Note} heading
 * @param {string} [question]
 * @returns {Entry}
 */
export function entry(scene, title, { bodies, law, method }, heading, question = '') {
  const [, number = ''] = /^(?:figure|table)-(\d+\.\d+)$/.exec(scene) ?? [];
  const shown = entryOf(scene, title);
  const others = [named('law', law), law, method && named('method', method), method];
  const kinds = bodies.flatMap((kind) => [kind, KINDS[kind] ?? '']);
  const words = plain([shown, scene, said(heading), question, ...others, ...kinds].join(' '));
  return { scene, title: shown, number, words };
}

/**
 * Whether it is found by what is typed.
 * @param {string} typed
 * @param {Entry} known
 */
export const matches = (typed, { number, words }) =>
  plain(typed)
    .split(/\s+/)
    .filter(Boolean)
    .every((word) =>
      NUMBER.test(word)
        ? number === word || (word.endsWith('.') && number.startsWith(word)) || (!number && words.includes(word))
        : words.includes(word),
    );
