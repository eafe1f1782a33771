// What the opening draws of a beam below its stage: place across, time down.
import { unitOfTime } from '../shell/times.js';
import { family, text } from '../text/catalogue.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { BendingFrame } from '../messages.js' */
/** @import { Scene } from '../opening/section.js' */
/** @import { BeamField, What } from './field.js' */
/** @import { BeamStage } from './stage.js' */

const SHOWN = ['exact', 'other']; // curves of the force that stand on one scale
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
  const forces = series.filter(({ style }) => SHOWN.includes(style)).map((one) => ({ ...one, cursor: one.name }));
  if (!field.has(what) || !forces[0]?.x.length) return null;
  const { contacts, duration } = frame;
  const way = what === 'shear' ? 'positive' : 'forward';
  return {
    title: text('opening.rows', { what: 'beam' }),
    about: what === 'moment' ? text('opening.bending') : text('beam.chart.red', { what: QUANTITIES[what], way }),
    clock: unitOfTime(duration),
    contacts,
    drawn: stage.drawn,
    duration,
    ends: null,
    field,
    forces,
    largest: stage.usual[what],
    scale: 0,
    strikes: false,
    what,
  };
}
