// Which solution of an impact along an axis the picture shows, and the words with it.
import { byOf, called, errorsOf } from '../text/words.js';

/** @import { AxialFigures, AxialFrame } from '../messages.js' */

/**
 * Whether the pictures show the other method: where bodies have an inside that it can show, or fail to. Bodies that
 * move as wholes have none: there they show the solution that all else tells, and the charts have the other beside.
 * @param {AxialFrame} frame
 */
export const drawnFromOther = ({ chosen, exact, other, otherBar, rods }) =>
  Boolean(other && chosen.method === other.name && other.name !== exact.name && (rods.length || otherBar));

/**
 * Whether rods strike what has no waves: their last one ends where they touch.
 * @param {AxialFrame['rods']} rods
 */
export const strikesBody = (rods) => rods.at(-1)?.to === 0;

/**
 * Whether they show rods as rigid lines, by a method that tells no places apart.
 * @param {AxialFrame} frame
 */
export const drawnRigid = (frame) =>
  drawnFromOther(frame) && frame.rods.length > 0 && !frame.modalForce && !frame.fieldForce && !frame.fieldStress;

/**
 * The solution whose events are described: rods that are drawn rigid have no waves.
 * @param {AxialFrame} frame
 * @returns {AxialFigures}
 */
export const toldOf = (frame) => (drawnRigid(frame) && frame.other) || frame.exact;

/**
 * What the picture is drawn of, in words: beside another solution its errors are what it differs by.
 * @param {AxialFrame} frame
 */
export function drawnBy(frame) {
  const { exact, other } = frame;
  const errors = errorsOf(exact);
  if (!other || !drawnFromOther(frame)) return byOf(called(exact), errors);
  const away = other.final === null || exact.final === null ? null : Math.abs(other.final - exact.final);
  return byOf(called(other), {
    rebound: away === null ? errors.rebound : Math.max(away, errors.rebound ?? 0),
    peak: other.peakForce && exact.peakForce ? Math.abs(other.peakForce / exact.peakForce - 1) : null,
  });
}
