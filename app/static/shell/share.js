// What a visitor takes away: the link to what is shown, and its histories.
import { text } from '../text/catalogue.js';
import { addressOf, queryOf } from './address.js';
import { download } from './dom.js';

/** @import { Page } from '../page.js' */

/** @param {Page} page */
export async function copyLink(page) {
  const { origin, pathname } = window.location;
  const link = `${origin}${pathname}${addressOf(queryOf(page, true)).replace(pathname, '')}`;
  try {
    await navigator.clipboard.writeText(link);
    page.complain(text('page.link-copied'));
  } catch {
    page.complain(text('page.link', { link }));
  }
}

/** @param {Page} page */
export function saveData(page) {
  const { frame, view } = page;
  const rows = view.rows?.();
  if (rows) download(new Blob([`${rows.join('\n')}\n`], { type: 'text/csv' }), `strikewave-${frame.chosen.scene}.csv`);
  else page.complain(text('page.no-history'));
}
