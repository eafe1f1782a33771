// What the opening draws of a beam below its stage: place across, time down.
import { unitOfTime } from '../clock/times.js';
import { family, text } from '../text/catalogue.js';
import { byOf, called, errorsOf } from '../text/words.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { BeamFigures, BendingFrame } from '../messages.js' */
/** @import { Scene } from '../opening/section.js' */
/** @import { BeamField, What } from './field.js' */
/** @import { BeamStage } from './stage.js' */

const QUANTITIES = family('beam.colour');

/**
 * Whether anything of it has a force over time: it has not if all impacts are impulses without duration.
 * @param {BendingFrame} frame
 */
export const hasForce = ({ halfForce, main, reference }) => !main.sudden || Boolean(reference ?? halfForce);

/**
 * @param {BendingFrame} frame
 * @param {BeamField} field
 * @param {What} what
 * @param {BeamStage} stage
 * @param {Series[]} series  of the chart of the force
 * @returns {Scene | null}
 */
export function sectionOf(frame, field, what, stage, series) {
  /** @type {Record<string, BeamFigures | null | undefined>} */
  const named = { exact: frame.main, other: frame.reference }; // of others the force would leave the scale
  const forces = series.flatMap((one) => {
    const figures = named[one.style];
    return figures ? [{ ...one, cursor: called(figures) }] : [];
  });
  if (!field.has(what) || !forces[0]?.x.length) return null;
  const { contacts, duration } = frame;
  const way = what === 'shear' ? 'positive' : 'forward';
  return {
    title: text('opening.rows', { what: 'beam' }),
    about: what === 'moment' ? text('opening.bending') : text('beam.chart.red', { what: QUANTITIES[what], way }),
    clock: unitOfTime(duration),
    by: byOf(called(frame.main), errorsOf(frame.main)),
    contacts,
    drawn: stage.drawn,
    duration,
    ends: null,
    field,
    forces,
    largest: stage.usual[what],
    peak: frame.main.peakForce,
    scale: 0,
    strikes: false,
    what,
  };
}
