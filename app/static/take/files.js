// What is seen as a file that the browser saves. All in this folder is fetched when a visitor wants it.
import { download } from '../browser/dom.js';
import { Clip, kindOf } from './clip.js';
import { pictureOf, svgOf } from './picture.js';

/** @import { Page } from '../page.js' */
/** @typedef {(extension: string) => string} Named  what a file is called */

const FINE = 2; // pixels of a picture for one of the page

/**
 * @param {Page} page
 * @param {Named} named
 */
export function savePng(page, named) {
  pictureOf(page, FINE).toBlob((blob) => blob && download(blob, named('png')));
}

/**
 * A part of the page as an address of its picture, and how wide it is there [px].
 * @param {Page} page
 * @param {Element} part
 */
export function printed(page, part) {
  const picture = pictureOf(page, FINE, part);
  return { src: picture.toDataURL(), width: picture.width / FINE };
}

/**
 * @param {Page} page
 * @param {Named} named
 */
export function saveSvg(page, named) {
  download(new Blob([svgOf(page)], { type: 'image/svg+xml' }), named('svg'));
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
