// Bodies of the stage that no wave runs through: strikers, walls, masses on springs. Where two press each other in they
// meet halfway, so that they never lie in one another.
import { letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { text } from '../text/catalogue.js';
import { length } from '../text/format.js';
import { barsOf } from './traces.js';

/** @import { AxialFrame, RodRecord } from '../messages.js' */

const LEAST_FOR_LENGTH = 50; // pixels of a specimen, where there is room to say how long it is

/** @typedef {CanvasRenderingContext2D} Context */
/**
 * Where a body is, in pixels.
 * @typedef {object} Place
 * @property {number} face  that touches
 * @property {number} middle
 * @property {number} size
 * @property {number} [meet]  where the bodies meet while they press each other in
 */

const EDGE = '#4a5968';
const WALL = '#55636f';
const EDGE_ROOM = 2; // pixels, of what is drawn from the edge of the picture
const TALL = 4000; // pixels, beyond any picture

/**
 * Draw on one side of where the bodies meet.
 * @param {Context} c
 * @param {number | undefined} meet
 * @param {-1 | 1} side
 * @param {() => void} draw
 */
function beside(c, meet, side, draw) {
  c.save();
  if (meet !== undefined) {
    c.beginPath();
    c.rect(side < 0 ? meet - TALL : meet, -TALL, TALL, 2 * TALL);
    c.clip();
  }
  draw();
  c.restore();
}

/**
 * The outline of a compact body, whose face looks to one side.
 * @param {Context} c
 * @param {boolean} round
 * @param {Place} place
 * @param {-1 | 1} side  of the face on which it lies
 */
function outline(c, round, { face, middle, size }, side) {
  c.beginPath();
  if (round) c.arc(face + (side * size) / 2, middle, size / 2, 0, 7);
  else c.roundRect(side < 0 ? face - size : face, middle - size / 2, size, size, 5);
}

/**
 * An arrow to what is beyond the left edge.
 * @param {Context} c
 * @param {number} middle
 */
function away(c, middle) {
  c.setLineDash([]);
  c.beginPath();
  c.moveTo(EDGE_ROOM + 5, middle - 5);
  c.lineTo(EDGE_ROOM, middle);
  c.lineTo(EDGE_ROOM + 5, middle + 5);
}

/**
 * The striker; dashed where rigid-body theory has it, or the way to there beyond the picture.
 * @param {Context} c
 * @param {AxialFrame} frame
 * @param {Place} place
 * @param {number | null} prediction  its face there
 */
export function striker(c, { impactor }, place, prediction) {
  const { middle, size } = place;
  const round = impactor.kind === 'sphere';
  if (prediction !== null && Math.abs(prediction - place.face) >= 1) {
    c.setLineDash([5, 4]);
    c.strokeStyle = COLORS.prediction;
    c.lineWidth = 1.5;
    if (prediction - size > EDGE_ROOM) outline(c, round, { ...place, face: prediction }, -1);
    else away(c, middle);
    c.stroke();
    c.setLineDash([]);
  }
  const fill = c.createLinearGradient(0, middle - size / 2, 0, middle + size / 2);
  fill.addColorStop(0, '#5d6c7b');
  fill.addColorStop(1, '#2b3846');
  beside(c, place.meet, -1, () => {
    outline(c, round, place, -1);
    c.fillStyle = fill;
    c.fill();
  });
}

/**
 * Signs of the masses whose ratio a slider has.
 * @param {Context} c
 * @param {[x: number, y: number]} middle  of the striker
 * @param {[x: number, y: number]} corner  at the lower right of what is struck
 */
export function masses(c, [x, y], [right, bottom]) {
  c.font = letters(15, '600 ');
  c.fillStyle = '#fff';
  c.textAlign = 'center';
  c.fillText('m₁', x, y + 5);
  c.fillStyle = COLORS.ink;
  c.textAlign = 'right';
  c.fillText('m₂', right - 8, bottom - 8);
}

/**
 * The axis about which a rod turns, and which way.
 * @param {Context} c
 * @param {number} x
 * @param {number} middle
 * @param {number} thick
 */
export function axis(c, x, middle, thick) {
  const radius = 0.42 * thick;
  c.strokeStyle = c.fillStyle = EDGE;
  c.lineWidth = 2;
  c.beginPath();
  c.arc(x, middle, 5, 0, 7);
  c.fill();
  c.beginPath();
  c.arc(x, middle, radius + 8, -1.1, 1.1);
  c.stroke();
  const [tipX, tipY] = [x + (radius + 8) * Math.cos(1.1), middle + (radius + 8) * Math.sin(1.1)];
  c.beginPath();
  c.moveTo(tipX - 5, tipY + 5);
  c.lineTo(tipX + 6, tipY);
  c.lineTo(tipX - 3, tipY - 7);
  c.fill();
  c.font = letters(13);
  c.textAlign = 'left';
  c.textBaseline = 'middle';
  c.fillText('Ω', x + radius + 13, middle);
}

/**
 * A struck body in which no wave runs.
 * @param {Context} c
 * @param {AxialFrame} frame
 * @param {Place} place
 * @param {number} width  of the picture
 */
export function struckBody(c, { target }, place, width) {
  const { face, middle, meet, size } = place;
  if (target.kind === 'stop') {
    wall(c, face, middle, size);
    return;
  }
  c.fillStyle = '#8fb4d6';
  c.strokeStyle = EDGE;
  c.lineWidth = 1.2;
  if (target.kind === 'half-space') {
    const tall = 1.2 * size;
    c.fillRect(face, middle - tall, width - face, 2 * tall);
    c.beginPath();
    c.moveTo(face, middle - tall);
    c.lineTo(face, middle + tall);
    c.stroke();
    return;
  }
  beside(c, meet, 1, () => {
    outline(c, target.shape === 'ball', place, 1);
    c.fill();
    c.stroke();
  });
  if (target.kind === 'spring-mass') spring(c, face + size, width - 30, middle, size);
}

/**
 * @param {Context} c
 * @param {number} from
 * @param {number} to
 * @param {number} middle
 * @param {number} size
 */
function spring(c, from, to, middle, size) {
  const turns = 14;
  c.beginPath();
  c.moveTo(from, middle);
  for (let k = 1; k < turns; k++) c.lineTo(from + (k / turns) * (to - from), middle + (k % 2 ? -9 : 9));
  c.lineTo(to, middle);
  c.stroke();
  wall(c, to, middle, 0.85 * size);
}

/**
 * @param {Context} c
 * @param {number} x
 * @param {number} middle
 * @param {number} thick
 */
export function wall(c, x, middle, thick) {
  const tall = thick * 0.95;
  c.fillStyle = WALL;
  c.fillRect(x, middle - tall, 5, 2 * tall);
  c.strokeStyle = '#8a97a3';
  c.lineWidth = 1; // whatever was drawn before
  c.beginPath();
  for (let y = middle - tall; y < middle + tall; y += 8) {
    c.moveTo(x + 5, y + 8);
    c.lineTo(x + 16, y);
  }
  c.stroke();
}

/**
 * A rod without end.
 * @param {Context} c
 * @param {number} x
 * @param {number} middle
 * @param {number} thick
 */
export function onward(c, x, middle, thick) {
  c.fillStyle = COLORS.faint;
  c.font = letters(14);
  c.textAlign = 'left';
  c.textBaseline = 'middle';
  c.fillText('⋯ ∞', x + 4, middle + thick * 0.02);
}

/**
 * A mass fixed to the far end.
 * @param {Context} c
 * @param {number} x
 * @param {number} middle
 * @param {number} thick
 */
export function endMass(c, x, middle, thick) {
  c.fillStyle = '#3b4a59';
  c.beginPath();
  c.roundRect(x, middle - thick * 0.7, thick * 0.8, thick * 1.4, 5);
  c.fill();
}

/**
 * The prescribed force, as an arrow on the end while it acts.
 * @param {Context} c
 * @param {number} at
 * @param {number} middle
 * @param {number} thick
 */
export function push(c, at, middle, thick) {
  c.strokeStyle = c.fillStyle = COLORS.cursor;
  c.lineWidth = 4;
  c.beginPath();
  c.moveTo(at - 70, middle);
  c.lineTo(at - 14, middle);
  c.stroke();
  c.beginPath();
  c.moveTo(at - 2, middle);
  c.lineTo(at - 18, middle - 9);
  c.lineTo(at - 18, middle + 9);
  c.fill();
  c.font = letters(13);
  c.textAlign = 'center';
  c.fillText(text('axial.stage.force'), at - 44, middle - thick * 0.3);
}

/**
 * Where a front is, and which way it runs.
 * @param {Context} c
 * @param {[number, number]} place
 * @param {1 | -1} way
 * @param {string} name
 * @param {[least: number, most: number]} between  what its name has to lie
 */
export function runs(c, [x, y], way, name, [least, most]) {
  c.fillStyle = COLORS.cursor;
  c.beginPath();
  c.moveTo(x, y + 6);
  c.lineTo(x - 5, y - 3);
  c.lineTo(x + 5, y - 3);
  c.fill();
  c.strokeStyle = COLORS.cursor;
  c.lineWidth = 1.6;
  c.beginPath();
  c.moveTo(x, y - 7);
  c.lineTo(x + 22 * way, y - 7);
  c.lineTo(x + 16 * way, y - 11);
  c.moveTo(x + 22 * way, y - 7);
  c.lineTo(x + 16 * way, y - 3);
  c.stroke();
  c.font = letters(13);
  const end = x - way * (8 + c.measureText(name).width);
  const room = end > least && end < most;
  c.textAlign = way > 0 === room ? 'right' : 'left';
  c.fillText(name, room ? x - 8 * way : x + 28 * way, y - 4); // beyond the arrow, where there is none behind it
}

/**
 * What is said of a specimen.
 * @param {Context} c
 * @param {import('./traces.js').Seam} seam
 * @param {(place: number) => number} place
 * @param {{ middle: number, thick: number }} size  of the bars beside it
 */
export function specimen(c, { from, to }, place, { middle, thick }) {
  const x = place((from + to) / 2);
  c.font = letters(13);
  c.textAlign = 'center';
  c.fillStyle = COLORS.ink;
  c.textBaseline = 'bottom';
  c.fillText(text('axial.stage.specimen'), x, middle - thick / 2 - 4);
  if (place(to) - place(from) < LEAST_FOR_LENGTH) return;
  c.fillStyle = COLORS.faint;
  c.textBaseline = 'top';
  c.fillText(text('axial.stage.wider', { length: length(to - from) }), x, middle + thick / 2 + 4);
}

/**
 * What the bars around a specimen are called, where they have room.
 * @param {CanvasRenderingContext2D} c
 * @param {AxialFrame} frame
 * @param {(x: number) => number} place
 * @param {{ middle: number, thick: number }} lies
 */
export function barNames(c, frame, place, { middle, thick }) {
  const { rods } = frame;
  const [before, after] = (barsOf(frame) ?? []).map((number) => rods[number]);
  const named = [
    [rods.find(({ from }) => from < 0), text('axial.stage.striker')],
    [before, text('axial.stage.first-bar')],
    [after, text('axial.stage.second-bar')],
  ];
  c.fillStyle = COLORS.faint;
  c.font = letters(13);
  c.textAlign = 'center';
  c.textBaseline = 'alphabetic';
  for (const [rod, words] of /** @type {[RodRecord | undefined, string][]} */ (named)) {
    if (!rod) continue;
    const [left, right] = [place(rod.from), place(rod.to)];
    if (c.measureText(words).width < right - left) c.fillText(words, (left + right) / 2, middle - thick / 2 - 8);
  }
}
