// The scale of the colours of a beam.
import { letters, scale as larger } from '../charts/canvas.js';
import { COLORS, css } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { figures, prefixed } from '../text/format.js';

/** @import { BeamStage } from './stage.js' */

const UNITS = { moment: 'MPa', velocity: 'm/s', shear: 'N', deflection: 'mm' };
const WAYS = [text('beam.stage.back'), text('beam.stage.forward')];
const ENDS = {
  moment: [text('beam.stage.tension'), text('beam.stage.compression')],
  velocity: WAYS,
  shear: ['−', '+'],
  deflection: WAYS,
}; // of the scale
const [TALL, POINT] = [8, 8]; // pixels
const [AWAY, BRIEF] = [158, 140]; // pixels: of the words beside what has flown off; of both ends side by side

/**
 * The colours, pointed at both ends where some of the field lies beyond them.
 * @param {CanvasRenderingContext2D} c
 * @param {number} x
 * @param {number} y
 * @param {number} long
 * @param {number} point  how long the ends are
 */
function band(c, x, y, long, point) {
  c.beginPath();
  c.moveTo(x, y + 0.5 * TALL);
  for (const [dx, dy] of [
    [point, 0],
    [long - point, 0],
    [long, 0.5 * TALL],
    [long - point, TALL],
    [point, TALL],
  ])
    c.lineTo(x + dx, y + dy);
  c.fill();
}

/**
 * The scale, away from the impactor, which flies back over the struck place.
 * @param {CanvasRenderingContext2D} c
 * @param {BeamStage<any>} stage
 * @param {number} end  of what is written at the left
 */
export function legend(c, stage, end) {
  const { hit, narrow, right, stressUnit, struck, what, width } = stage;
  const beside = Math.max(end + 14, narrow ? 0 : 0.3 * width);
  const away = hit.flew ? AWAY * larger : 0.5 * hit.size;
  const room = right ? struck - away - 6 - beside : width - end - 28;
  const brief = narrow || room < BRIEF * larger; // has no room for more than its end
  const bar = Math.min((narrow ? 90 : 160) * larger, room);
  const unit = what === 'moment' ? stressUnit : what === 'deflection' ? 1e3 : 1;
  const largest = stage.usual[what] * unit;
  const [factor, prefix] = what === 'shear' ? prefixed(largest) : [1, ''];
  const most = `± ${figures(largest * factor)} ${prefix}${UNITS[what]}`;
  c.font = letters(13);
  const said = brief ? c.measureText(most).width : 0; // above the colours, up to their end
  const x = right ? beside + Math.max(said - bar, 0) : width - bar - 14;
  const y = stage.coloursAt(x);
  const colours = c.createLinearGradient(x, 0, x + bar, 0);
  for (let k = 0; k <= 6; k++) colours.addColorStop(k / 6, css(k / 3 - 1, 1));
  c.fillStyle = colours;
  band(c, x, y, bar, stage.beyond ? POINT : 0);
  c.fillStyle = COLORS.faint;
  const [low, high] = ENDS[what];
  c.textAlign = 'right';
  c.fillText(brief ? most : high, x + bar, y - 4);
  if (brief) return;
  c.fillText(most, x + bar, y + 20);
  c.textAlign = 'left';
  c.fillText(low, x, y - 4);
}
