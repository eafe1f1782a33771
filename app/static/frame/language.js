// The languages of the page: the server has chosen this one, by the address, the switch, or what the browser accepts;
// where there is none, offline/start.js.
import { alone, carried } from '../browser/home.js';
import { make } from '../browser/dom.js';
import { keep } from '../browser/store.js';
import { others } from '../text/catalogue.js';
import { addressOf, queryOf } from './address.js';

/** @import { Page } from '../page.js' */

const KEPT = 'strikewave-language'; // the cookie; the server reads it, see app/serving/language.py
const YEAR = 31536000; // s

/**
 * A button for each other language, by its own name: what is shown is shown again in it.
 * @param {Page} page
 */
export function languagesOf(page) {
  const button = (/** @type {[code: string, name: string]} */ [code, name]) => {
    const found = make('button', { type: 'button', className: 'language', textContent: name, lang: code });
    found.dataset.code = code; // for which there is room on a phone
    found.title = name;
    found.ariaLabel = name;
    found.onclick = () => {
      if (carried)
        keep('language', code); // the disk has no cookies
      else document.cookie = `${KEPT}=${code}; max-age=${YEAR}; samesite=lax`;
      window.location.assign(addressOf(queryOf(page, true, code)));
    };
    return found;
  };
  return alone ? Object.entries(others).map(button) : [];
}
