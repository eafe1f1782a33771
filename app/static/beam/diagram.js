// Shear force and bending moment along a beam, below its picture.
import { letters, scale } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { figures, prefixed } from '../text/format.js';

/** @import { Out } from './field.js' */
/** @import { BeamStage } from './stage.js' */

/** @typedef {'shear' | 'moment'} Name */
/** @type {[Name, symbol: string, unit: string][]} */
const DIAGRAMS = [
  ['shear', 'V', 'N'],
  ['moment', 'M', 'N m'],
];
const TITLES = { shear: text('beam.stage.shear'), moment: text('beam.stage.moment') };
/** Colours above and below the line as in the picture over time, and where they begin. */
const SIGNS = /** @type {const} */ ([
  ['rgba(222,105,62,.38)', -1],
  ['rgba(66,133,200,.38)', 0],
]);
const SMALL = letters(13);
const HEAD = 17 * scale; // pixels of what is written above a diagram
const REACH = 0.72; // of the room to both sides that the end of the scale takes
const TICKS = 15 * scale; // pixels between the places of values at the side, below which they are in the title
const APART = 14; // pixels between a label and the largest value, whose place is left out where there are fewer

/**
 * Both, one below the other.
 * @param {CanvasRenderingContext2D} c
 * @param {BeamStage} stage
 * @param {number} t
 * @param {number} top
 * @param {number} height
 */
export function diagrams(c, stage, t, top, height) {
  DIAGRAMS.forEach(([name, symbol, unit], k) =>
    diagram(c, stage, t, name, symbol, unit, top + (k * height) / 2, height / 2),
  );
}

/**
 * Value along the beam on a scale that stays the same over the whole impact.
 * @param {CanvasRenderingContext2D} c
 * @param {BeamStage} stage
 * @param {number} t
 * @param {Name} name
 * @param {string} symbol  for its title, where there is no room for that
 * @param {string} unit
 * @param {number} top
 * @param {number} height
 */
function diagram(c, stage, t, name, symbol, unit, top, height) {
  const values = name === stage.what ? stage.values : stage.field.profile(t, name);
  const most = stage.scales[name];
  const room = (height - HEAD) / 2; // below the words, on which no curve may lie
  const zero = top + HEAD + room;
  const reach = (REACH * room) / most;
  curve(c, stage, values, zero, reach, room);
  const [factor, prefix] = prefixed(most);
  const { left, long, narrow } = stage;
  const ticks = !narrow && REACH * room > TICKS;
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
  for (const side of ticks ? [-1, 0, 1] : [])
    c.fillText(figures(-side * most * factor, 2), left - 8, zero + side * most * reach);
  c.textBaseline = 'top';
  c.textAlign = 'left';
  const ends = ticks ? '' : ` (± ${figures(most * factor, 2)})`;
  let peak = 0;
  for (let j = 0; j < values.length; j++) if (Math.abs(values[j]) > Math.abs(values[peak])) peak = j;
  const value = `${figures(values[peak] * factor)} ${prefix}${unit}`;
  const whole = text('beam.stage.peak', { value, place: figures(peak / (values.length - 1), 2) });
  const from = narrow ? 12 : left + 4;
  const fits = (/** @type {string} */ title, /** @type {string} */ said) =>
    from + c.measureText(title).width + APART + c.measureText(said).width <= left + long;
  const [title, short] = [TITLES[name], symbol].map((label) => `${label}, ${prefix}${unit}${ends}`);
  c.fillText(fits(title, value) ? title : short, from, top + 3);
  c.textAlign = 'right';
  c.fillStyle = COLORS.cursor;
  c.fillText(fits(title, whole) ? whole : value, left + long, top + 3);
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
