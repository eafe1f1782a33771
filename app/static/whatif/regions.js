// Parts of a map by what is found there: what they are called, and which are hatched.
import { text } from '../text/catalogue.js';
import { COLOR } from './ink.js';
import { MANY } from './lattice.js';

/** @import { Context } from './ink.js' */
/** @import { Raster } from './raster.js' */

/**
 * @typedef {object} Regions
 * @property {string} about
 * @property {(count: number, wide: boolean) => string} named
 * @property {(count: number) => boolean} [weak]
 * @property {boolean} [listed]  in a list beside, not on a bar
 */
/** @type {Regions} */
export const CONTACTS = {
  about: text('whatif.about'),
  named: (count, wide) => {
    const many = count === MANY;
    return wide ? text(many ? 'whatif.many-contacts' : 'whatif.contacts', { count }) : `${count}${many ? '+' : ''}`;
  },
};

/**
 * What is refused, or not to be trusted.
 * @param {Context} c
 * @param {Raster} raster
 * @param {{ w: number, h: number }} plot
 * @param {(count: number) => boolean} is
 * @param {1 | -1} way  of its lines
 */
export function hatch(c, { contacts, sheet, step }, { h, w }, is, way) {
  c.save();
  c.beginPath();
  let any = false;
  for (let j = 0; j < sheet.height; j++) {
    let from = -1;
    for (let i = 0; i <= sheet.width; i++) {
      const off = i < sheet.width && is(contacts[j * sheet.width + i]);
      if (off && from < 0) from = i;
      if (off || from < 0) continue;
      c.rect(from * step, j * step, (i - from) * step, step);
      any = true;
      from = -1;
    }
  }
  if (any) {
    c.clip();
    c.beginPath();
    for (let x = -h; x < w; x += 9) {
      c.moveTo(x, way > 0 ? h : 0);
      c.lineTo(x + h, way > 0 ? 0 : h);
    }
    c.strokeStyle = COLOR.hatch;
    c.lineWidth = 1.25;
    c.stroke();
  }
  c.restore();
}
