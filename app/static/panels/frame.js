// What every analysis has about it: a head with its name, and buttons that widen and close it.
import { make } from '../browser/dom.js';
import { text } from '../text/catalogue.js';

/** @import { View } from './panels.js' */

/**
 * Give a panel its head.
 * @param {View} view
 * @param {{ widen: () => void, close: () => void }} acts
 */
export function framed({ root, button }, { widen, close }) {
  const name = root.querySelector('h2') ?? make('h2', { textContent: button.textContent ?? '' });
  const sign = (/** @type {string} */ what, /** @type {string} */ textContent, /** @type {() => void} */ onclick) => {
    const ariaLabel = `${what}: ${name.textContent}`;
    return make('button', { type: 'button', className: 'sign', title: what, ariaLabel, textContent, onclick });
  };
  const head = make('header', { className: 'panel-head' }, name);
  const wider = sign(text('panel.wider'), '⤢', widen);
  wider.classList.add('wider');
  head.append(wider, sign(text('panel.close'), '✕', close));
  root.prepend(head);
  root.tabIndex = -1;
}
