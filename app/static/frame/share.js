// What a visitor takes away: the link to what is shown, and its histories.
import { text } from '../text/catalogue.js';
import { addressOf, queryOf } from './address.js';
import { download } from '../browser/dom.js';
import { fileOf } from '../wire/own.js';
import { alone } from '../browser/home.js';

/** @import { Page } from '../page.js' */

const DIGITS = 6; // behind the first one, of saved values

/**
 * @param {Page} page
 * @param {import('../wire/held.js').Held} [taught]  what a link for a class takes from the controls
 */
export function linkOf(page, taught) {
  const { href, pathname } = window.location;
  if (!alone) return href;
  const [bare] = href.split(/[?#]/); // a page from the disk has no origin
  return `${bare}${addressOf(queryOf(page, true, undefined, taught)).replace(pathname, '')}`;
}

/**
 * Why a link leads nobody else here, and what to do: its host is what each machine calls itself.
 * Nothing where it does.
 * @param {{ hostname: string, port: string }} [address]
 */
export function onlyHere({ hostname, port } = window.location) {
  if (!/^((.+\.)?localhost|127(\.\d+){3}|\[::1\])$/.test(hostname)) return '';
  return text('class.only-here', { port: port && `:${port}` });
}

/** @param {Page} page */
export async function copyLink(page) {
  const link = linkOf(page);
  try {
    await navigator.clipboard.writeText(link);
    page.complain(text('page.link-copied'));
  } catch {
    page.complain(text('page.link', { link }));
  }
}

/**
 * A scene and a link as lines above a table, which its readers skip.
 * @param {string} scene  in TOML, with table `saved` at the end
 * @param {string} link
 */
export const headed = (scene, link) =>
  `${scene}\nlink = ${JSON.stringify(link)}`
    .trimStart()
    .split('\n')
    .map((line) => `# ${line}`);

/**
 * Histories as comma-separated values, below the scene that they are of, as `impact solve` reads it: readers of tables
 * skip lines that begin with #.
 * @param {string} scene  in TOML, with table `saved` at the end
 * @param {string} link  to the same
 * @param {{ names: string[], values: number[][] }} table
 */
export function written(scene, link, { names, values }) {
  const rows = values.map((row) => row.map((value) => value.toExponential(DIGITS)).join(','));
  return [...headed(scene, link), names.join(','), ...rows, ''].join('\n');
}

/** @param {Page} page */
export function saveData(page) {
  const { frame, view } = page;
  const table = view.rows?.();
  if (!table) return page.complain(text('page.no-history'));
  if (page.own.made.has(frame)) {
    // its head says what the server has solved
    if (!page.connection?.miss('files')) page.complain(text('page.not-yet'));
    return undefined;
  }
  const name = `strikewave-${fileOf(frame.chosen.scene)}.csv`;
  return download(new Blob([written(frame.head, linkOf(page), table)], { type: 'text/csv' }), name);
}
