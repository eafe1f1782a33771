// The circle on which two smooth bodies touch, and the pressure there, at one instant.
import { between } from '../charts/scale.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';

/** @import { AxialFrame } from '../messages.js' */

/** @typedef {'cycleDepth' | 'cycleLoading' | 'cycleUnloading' | 'blowDepth' | 'blowForce'} OfLaw */
/** @typedef {'touchTime' | 'touchRadius' | 'touchPressure' | 'touchFlow'} OfTouch */
/** @typedef {'flowDepth' | 'flowPressure' | 'flowRadius' | 'flowElastic'} OfFlow */
/** @typedef {'testsDepth' | 'testsPressure' | 'testsForce'} OfTests */
/** @typedef {'chosen' | 'opens' | OfLaw | OfTouch | OfFlow | OfTests} Field */
/** @typedef {Pick<AxialFrame, Field>} CycleFrame  what a message has of the contact law and of its touch */

/**
 * In words; nothing while they are apart, or by laws that have no such circle.
 * @param {Pick<CycleFrame, OfTouch>} frame
 * @param {number} time  [s]
 */
export function touchAt({ touchFlow: flow, touchPressure: pressure, touchRadius: radius, touchTime: x }, time) {
  if (!x || !radius || !pressure || time > x[x.length - 1]) return '';
  const wide = between(x, radius, time);
  if (!(wide > 0)) return '';
  const share = flow ? figures(between(x, flow, time)) : 'none';
  return text('axial.chart.touch', { radius: wide, pressure: between(x, pressure, time), share });
}
