// What is compared of impulses between bodies in space, which take no time.
import { text } from '../text/catalogue.js';

/** @import { Figure } from '../compare/figure.js' */
/** @import { Compared } from '../compare/kinds.js' */
/** @import { SpaceFrame } from '../messages.js' */

const ALIKE = 0.01; // share by which two masses differ that count as one

/**
 * Of an impulse in space every figure that is one number, under its own name.
 * @param {SpaceFrame} frame
 * @returns {Figure[]}
 */
const figuresOf = ({ figures }) =>
  figures.flatMap(([name, value, unit]) =>
    Array.isArray(value) || name.endsWith('-error')
      ? []
      : [{ key: name, name: text(`space.row.${name}`), size: 'other', value, unit }],
  );

/**
 * What of a body is felt where it is struck.
 * @param {SpaceFrame} now
 * @param {SpaceFrame} kept
 */
function ofPlace(now, kept) {
  const felt = (/** @type {SpaceFrame} */ { figures }) => {
    const known = new Map(figures.map(([name, value]) => [name, Number(value)]));
    return [known.get('target-mass') ?? 0, known.get('target-felt-mass') ?? 0];
  };
  const [[mass, here], [, there]] = [felt(now), felt(kept)];
  if (!(here > 0) || Math.abs(there / mass - 1) > ALIKE || Math.abs(here / mass - 1) < ALIKE) return '';
  return text('compare.verdict.place', { mass, felt: here, parts: mass / here, more: mass / here - 1 });
}

/** @type {Compared} */
export const compared = {
  trips: false,
  figures: figuresOf,
  histories: () => null,
  contacts: () => [],
  law: () => ({ exponent: 1, rigid: false, yields: false }), // none acts
  peakForce: () => null,
  resolution: () => '',
  verdicts: { place: ofPlace },
};
