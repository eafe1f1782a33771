// What stands in the legend of a chart.
import { COLORS, STYLES } from './styles.js';

/** @typedef {'line' | 'dashes' | 'dots' | 'ring' | 'dot' | 'bar' | 'chip'} Mark */
/** @typedef {{ text: string, color: string, mark: Mark }} Key */

/**
 * @param {import('./styles.js').Style} style
 * @returns {Mark}
 */
function markOf({ mark = 'line', dash }) {
  if (mark !== 'line' || !dash) return mark;
  return dash[0] > 2 ? 'dashes' : 'dots';
}

/**
 * Names of series, each once, and of what else is drawn.
 * @param {import('./chart.js').Content} content
 * @returns {Key[]}
 */
export function keysOf({ series, bars, band, keys = [] }) {
  /** @type {Map<string, Key>} */
  const found = new Map();
  for (const { name, style } of series) {
    const look = STYLES[style];
    if (name && !found.has(name)) found.set(name, { text: name, color: look.color, mark: markOf(look) });
  }
  const others = [];
  if (bars) others.push({ text: bars.name, color: COLORS.ink, mark: /** @type {Mark} */ ('bar') });
  if (band) others.push({ text: band.name, color: band.color, mark: /** @type {Mark} */ ('chip') });
  return [...keys, ...found.values(), ...others];
}
