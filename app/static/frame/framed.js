// In a frame, in the page of another site: a way out of it, and how high it should be, which it says to that page.
import { wanted as scale } from '../charts/canvas.js';
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';
import { addressOf, queryOf } from './address.js';

/** @import { Page } from '../page.js' */

const FORM = 1; // of what is said
const PAUSE = 150; // ms between two measurements
const LEAST = 480; // pixels of height where nobody wants letters larger
/** Of a picture with its rows: those of a phone have heights of their own, and the page is as high as they need. */
const PICTURE = { desk: 720, tablet: 960, phone: LEAST };
const DRAWN = 560; // of them, what picture and rows of a lesson have beside bar and clock

/**
 * A link that opens the same as a page of its own.
 * @param {Page} page
 */
export function wayOut(page) {
  const link = make('a', { className: 'way-out', target: '_blank', rel: 'noopener', textContent: text('frame.open') });
  const lead = () => link.setAttribute('href', addressOf(page.frame ? queryOf(page) : ''));
  link.onpointerenter = link.onpointerdown = link.onfocus = link.onclick = lead;
  lead();
  return link;
}

/**
 * How high it needs to be at its width, however high it is now.
 * @param {Page} page
 */
function heightOf({ opening, root }) {
  const across = root.classList.contains('across'); // a tablet that is too low as yet
  const size = /** @type {keyof typeof PICTURE} */ (across ? 'tablet' : root.dataset.size);
  const { lesson } = opening.teaching;
  if (!lesson && size !== 'phone') return PICTURE[size] * scale;
  const { height } = root.style;
  root.style.height = '0'; // nothing is drawn so: what has no room of its own takes none
  const rows = getComputedStyle(root).gridTemplateRows.matchAll(/[\d.]+/g); // a chart may still reach beyond its row
  const needed = [...rows].reduce((sum, [pixels]) => sum + Number(pixels), 0);
  const beside = lesson && size === 'desk' ? Math.max(lesson.root.scrollHeight, DRAWN * scale) : 0;
  root.style.height = height;
  return Math.max(needed + beside, LEAST * scale);
}

/**
 * Say it to the page around whenever it is another one.
 * @param {Page} page
 */
export function tellHeight(page) {
  if (window.parent === window) return;
  let said = 0;
  let due = 0;
  const tell = () => {
    due = 0;
    const height = Math.ceil(heightOf(page));
    if (height === said) return;
    said = height;
    window.parent.postMessage({ strikewave: FORM, height }, '*'); // whoever it is: a number says nothing of anybody
  };
  const later = () => {
    due ||= window.setTimeout(tell, PAUSE);
  };
  const attributeFilter = ['class', 'hidden', 'data-size'];
  new MutationObserver(later).observe(page.root, { attributeFilter, childList: true, subtree: true });
  new ResizeObserver(later).observe(page.root);
}
