// Shear force and bending moment along a beam, below its picture.
import { letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { figures, prefixed } from '../text/format.js';

/** @import { Out } from './field.js' */
/** @import { BeamStage } from './stage.js' */

/** @typedef {'shear' | 'moment'} Name */
/** @type {[Name, label: string, unit: string][]} */
const DIAGRAMS = [
  ['shear', text('beam.stage.shear'), 'N'],
  ['moment', text('beam.stage.moment'), 'N m'],
];
/** Colours above and below the line as in the picture over time, and where they begin. */
const SIGNS = /** @type {const} */ ([
  ['rgba(222,105,62,.38)', -1],
  ['rgba(66,133,200,.38)', 0],
]);
const SMALL = letters(11);
const LEAST_FOR_PLACE = 260; // pixels of length, below which the place of the largest value is left out

/**
 * Both, one below the other.
 * @param {CanvasRenderingContext2D} c
 * @param {BeamStage} stage
 * @param {number} t
 * @param {number} top
 * @param {number} height
 */
export function diagrams(c, stage, t, top, height) {
  DIAGRAMS.forEach(([name, label, unit], k) =>
    diagram(c, stage, t, name, label, unit, top + (k * height) / 2, height / 2),
  );
}

/**
 * Value along the beam on a scale that stays the same over the whole impact.
 * @param {CanvasRenderingContext2D} c
 * @param {BeamStage} stage
 * @param {number} t
 * @param {Name} name
 * @param {string} label
 * @param {string} unit
 * @param {number} top
 * @param {number} height
 */
function diagram(c, stage, t, name, label, unit, top, height) {
  const values = name === stage.what ? stage.values : stage.field.profile(t, name);
  const most = stage.scales[name];
  const zero = top + 0.54 * height;
  const reach = (0.32 * height) / most;
  curve(c, stage, values, zero, reach, 0.42 * height);
  const [factor, prefix] = prefixed(most);
  const { left, long, narrow } = stage;
  c.strokeStyle = COLORS.edge;
  c.lineWidth = 1;
  c.beginPath();
  c.moveTo(left, zero);
  c.lineTo(left + long, zero);
  for (const side of [-1, 1]) {
    c.moveTo(left - 4, zero + side * most * reach);
    c.lineTo(left, zero + side * most * reach);
  }
  c.stroke();
  c.fillStyle = COLORS.faint;
  c.font = SMALL;
  c.textBaseline = 'middle';
  c.textAlign = 'right';
  for (const side of narrow ? [] : [-1, 0, 1])
    c.fillText(figures(-side * most * factor, 2), left - 8, zero + side * most * reach);
  c.textBaseline = 'top';
  c.textAlign = 'left';
  const scale = narrow ? ` (± ${figures(most * factor, 2)})` : '';
  c.fillText(`${label}, ${prefix}${unit}${scale}`, narrow ? 12 : left + 4, top + 3);
  let peak = 0;
  for (let j = 0; j < values.length; j++) if (Math.abs(values[j]) > Math.abs(values[peak])) peak = j;
  c.textAlign = 'right';
  c.fillStyle = COLORS.cursor;
  const place = figures(peak / (values.length - 1), 2);
  const value = `${figures(values[peak] * factor)} ${prefix}${unit}`;
  const room = long >= LEAST_FOR_PLACE || narrow; // else it would lie on the label
  c.fillText(room ? text('beam.stage.peak', { value, place }) : value, left + long, top + 3);
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {BeamStage} stage
 * @param {Out} values
 * @param {number} zero
 * @param {number} reach  pixels for a unit
 * @param {number} room  pixels to both sides
 */
function curve(c, stage, values, zero, reach, room) {
  const last = values.length - 1;
  const at = (/** @type {number} */ j) => zero - Math.min(Math.max(values[j] * reach, -room), room);
  for (const [colour, top] of SIGNS) {
    c.save();
    c.beginPath();
    c.rect(stage.px(0), zero + top * room, stage.px(last) - stage.px(0), room);
    c.clip();
    c.fillStyle = colour;
    c.beginPath();
    c.moveTo(stage.px(0), zero);
    for (let j = 0; j <= last; j++) c.lineTo(stage.px(j), at(j));
    c.lineTo(stage.px(last), zero);
    c.fill();
    c.restore();
  }
  c.strokeStyle = COLORS.waves;
  c.lineWidth = 1.6;
  c.beginPath();
  for (let j = 0; j <= last; j++) c.lineTo(stage.px(j), at(j));
  c.stroke();
}
