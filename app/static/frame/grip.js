// The edge of a dock, which a hand or the arrow keys move.
import { make } from '../browser/dom.js';

/** @type {Record<string, number>} */
const ARROWS = { ArrowLeft: -1, ArrowRight: 1 };
const STEP = 24; // pixels for one arrow key

/**
 * @typedef {object} Edge
 * @property {string} label
 * @property {'left' | 'right'} name  of the dock
 * @property {() => number} size  of it, in pixels
 * @property {(size: number) => void} resize
 * @property {() => void} rest  after a move
 */

/**
 * A dock at the left grows to the right, one at the right to the left.
 * @param {Edge} edge
 */
export function gripOf({ label, name, size, resize, rest }) {
  const sign = name === 'left' ? 1 : -1;
  const root = make('div', { className: `grip ${name}`, role: 'separator', tabIndex: 0, ariaLabel: label });
  root.ariaOrientation = 'vertical';
  const tell = () => (root.ariaValueNow = String(Math.round(size())));
  root.onpointerdown = (event) => {
    if (event.button !== 0) return;
    root.setPointerCapture(event.pointerId);
    const [from, before] = [event.clientX, size()];
    root.onpointermove = (moved) => resize(before + sign * (moved.clientX - from));
    root.onpointerup = root.onpointercancel = () => {
      root.onpointermove = root.onpointerup = root.onpointercancel = null;
      rest();
      tell();
    };
  };
  root.onkeydown = (event) => {
    const way = ARROWS[event.key];
    if (!way) return;
    event.preventDefault();
    resize(size() + sign * way * STEP);
    rest();
    tell();
  };
  root.onfocus = tell;
  tell();
  return root;
}
