// One figure of a solution, as kinds of impacts hand them out.
import { givenOf } from '../frame/energy.js';
import { text } from '../text/catalogue.js';

/** @import { Energies } from '../messages.js' */

/**
 * @typedef {'count' | 'time' | 'force' | 'stress' | 'impulse' | 'velocity' | 'length' | 'share' | 'number' | 'other'
 * } Size
 */
/** @typedef {{ key: string, name: string, size: Size, value: number | null, unit?: string }} Figure */

/**
 * @param {string} key
 * @param {Size} size
 * @param {number | null | undefined} value
 * @returns {Figure}
 */
export const figure = (key, size, value) => ({ key, name: text(`compare.figure.${key}`), size, value: value ?? null });

/**
 * @param {Energies} energy
 * @returns {Figure[]}
 */
export const energies = (energy) => {
  const { whole } = givenOf(energy);
  return [
    figure('waves', 'share', (energy.target_vibration ?? 0) / whole),
    figure('lost', 'share', (energy.dissipated ?? 0) / whole),
  ];
};
