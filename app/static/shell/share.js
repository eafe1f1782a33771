// What a visitor takes away: the link to what is shown, and its histories.
import { text } from '../text/catalogue.js';
import { download } from './dom.js';

/** @import { Page } from '../page.js' */

/** @param {Page} page */
export async function copyLink(page) {
  try {
    await navigator.clipboard.writeText(location.href);
    page.complain(text('page.link-copied'));
  } catch {
    page.complain(text('page.link', { link: location.href }));
  }
}

/** @param {Page} page */
export function saveData(page) {
  const { frame, view } = page;
  const rows = view.rows?.();
  if (rows) download(new Blob([`${rows.join('\n')}\n`], { type: 'text/csv' }), `strikewave-${frame.chosen.scene}.csv`);
  else page.complain(text('page.no-history'));
}
