// How far turning stretches a rod: along it, and its end by its speed.
import { Figure } from '../charts/figure.js';
import { make } from '../browser/dom.js';
import { said, text } from '../text/catalogue.js';
import { figures, localised } from '../text/format.js';
import { Panel } from './panel.js';

/** @import { Page } from '../page.js' */
/** @import { Note } from '../text/catalogue.js' */

/**
 * @typedef {object} Stretch
 * @property {Record<string, any>} chosen
 * @property {Note} [error]  why there is nothing to show
 * @property {number[]} place  from the axis [mm]
 * @property {number[]} moved  displacement there [mm]
 * @property {number[]} speed  [rad/s]
 * @property {number[]} end  stretch of the end over the length [%]
 * @property {[speed: number, end: number]} own
 * @property {number} critical  [rad/s]
 * @property {number} half  displacement half way over that of the end
 * @property {number} root  its strain [%]
 */

const EVERY = 4; // row of the tables
const ROOM = 1.05; // above what is drawn

class Turning extends Panel {
  /** @type {Stretch | null} */ drawn = null;

  /** @param {Page} page */
  constructor(page) {
    super(page, 'stretch', text('stretch.button'), text('stretch.title'), text('stretch.heading'));
    this.said = make('p', { className: 'help', role: 'status' });
    const part = (/** @type {'along' | 'speed'} */ name) => ({
      ...{ name: `stretch-${name}`, title: text(`stretch.plot.${name}`), about: text(`stretch.about.${name}`) },
      numbers: () => this.#numbers(name),
    });
    this.figure = new Figure('stretch', [part('along'), part('speed')]);
    this.root.append(this.said, this.figure.root);
  }
  get empty() {
    const { frame } = this.page;
    return !('rods' in frame) || !frame.target.rotation || Boolean(frame.turningBar);
  }
  /**
   * @param {Stretch | null} found
   * @param {boolean} fresh
   */
  render(found, fresh) {
    this.root.ariaBusy = String(!fresh);
    if (!found) this.said.textContent = text('stretch.idle');
    if (!found || !this.figure || found === this.drawn) return;
    this.drawn = found;
    this.figure.root.hidden = Boolean(found.error);
    this.said.textContent = found.error ? said(found.error) : this.#sentence(found);
    if (found.error) return;
    const { place, moved, speed, end, own } = found;
    this.figure.fill('along', { place, moved });
    this.figure.fill('speeds', { speed, end });
    this.figure.fill('own', { speed: [own[0]], end: [own[1]] });
    this.figure.range('stretch-along-x', [0, place[place.length - 1]]);
    this.figure.range('stretch-along-y', [0, ROOM * moved[moved.length - 1] || 1]);
    this.figure.range('stretch-speed-x', [0, Math.max(speed[speed.length - 1], ROOM * own[0])]);
    this.figure.range('stretch-speed-y', [0, ROOM * Math.max(end[end.length - 1], own[1])]);
  }
  /** @param {Stretch} found */
  #sentence({ own: [speed, end], critical, half, root }) {
    return text('stretch.said', {
      ...{ speed: figures(speed, 4), share: figures((100 * speed) / critical, 3), critical: figures(critical, 4) },
      ...{ stretch: figures(end, 4), half: localised(half.toFixed(4)), root: figures(root, 3) },
    });
  }
  /** @param {'along' | 'speed'} name */
  #numbers(name) {
    const found = /** @type {Stretch | null} */ (this.answer);
    if (!found || found.error) return [[]];
    const columns =
      name === 'along' ? /** @type {const} */ (['place', 'moved']) : /** @type {const} */ (['speed', 'end']);
    const [x, y] = columns.map((column) => found[column]);
    const rows = x.flatMap((value, k) => (k % EVERY ? [] : [[value, y[k]].map((each) => figures(each, 4))]));
    return [columns.map((column) => text(`stretch.${column}`)), ...rows];
  }
}

export const PANELS = { stretch: Turning }; // by their names in the address
