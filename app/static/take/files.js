// What is seen as a file that the browser saves. All in this folder is fetched when a visitor wants it.
import { download } from '../browser/dom.js';
import { Clip, kindOf } from './clip.js';
import { pictureOf, scopeOf, svgOf } from './picture.js';

/** @import { Page } from '../page.js' */
/** @import { Scope } from './picture.js' */
/** @typedef {(extension: string) => string} Named  what a file is called */

const FINE = 2; // pixels of a picture for one of the page

/**
 * @param {Page} page
 * @param {Named} named
 * @param {Scope} [scope]  another than what is usual
 */
export function savePng(page, named, scope) {
  pictureOf(page, FINE, scope).toBlob((blob) => blob && download(blob, named('png')));
}

/**
 * A part of the page as an address of its picture, and how wide it is there [px].
 * @param {Page} page
 * @param {Element} part
 */
export function printed(page, part) {
  const picture = pictureOf(page, FINE, scopeOf(page, part));
  return { src: picture.toDataURL(), width: picture.width / FINE };
}

/**
 * @param {Page} page
 * @param {Named} named
 * @param {Scope} [scope]  another than what is usual
 */
export function saveSvg(page, named, scope) {
  download(new Blob([svgOf(page, scope)], { type: 'image/svg+xml' }), named('svg'));
}

/**
 * Begin to record; nothing where the browser cannot.
 * @param {Page} page
 * @param {Named} named
 * @param {() => void} ended
 */
export function record(page, named, ended) {
  const kind = kindOf();
  if (!kind) return null;
  const clip = new Clip(page, kind, (blob, extension) => {
    ended();
    download(blob, named(extension));
  });
  clip.start();
  return clip;
}
