// A row of balls that another strikes, on strings as in a cradle: what is drawn of it, and its curves over time. Balls
// stand as far apart as they are pressed together at most, so that they never lie in one another.
import { letters, scale as zoom } from '../charts/canvas.js';
import { between } from '../charts/scale.js';
import { COLORS } from '../charts/styles.js';
import { given } from '../wire/message.js';
import { text } from '../text/catalogue.js';
import { figures } from '../text/format.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { AxialFrame, Numbers } from '../messages.js' */

const TOP = 12; // pixels of the beam from the edge
const MIDDLE = 0.45; // of the picture, where balls hang
const LIFT = 0.55; // of a string, that a ball swings at most
const COLOURS = 7; // of lines, after which they begin anew

/**
 * One column of a table that lies flat.
 * @param {Numbers} table
 * @param {number} count  of its columns
 * @param {number} k
 */
const column = (table, count, k) => table.filter((_, i) => i % count === k);

/** @param {AxialFrame} frame */
const countOf = ({ target }) => given(target.row, 'row').length;

/**
 * Displacement of every body over time, the striker first [v T].
 * @param {AxialFrame} frame
 * @returns {Numbers[]}
 */
const pathsOf = (frame) => [
  frame.exactMass,
  ...given(frame.target.row, 'row').map((_, k) => column(given(frame.exactRow, 'row'), countOf(frame), k)),
];

/** @param {number} k */
const styleOf = (k) => /** @type {Series['style']} */ (`joint${k % COLOURS}`);

/**
 * How all balls move.
 * @param {AxialFrame} frame
 * @returns {Series[]}
 */
export const movementsOf = (frame) =>
  pathsOf(frame).map((y, k) => {
    const name = text('axial.cradle.ball', { number: k + 1 });
    return { x: frame.motionTime, y, factor: frame.speed * frame.trip, name, cursor: name, style: styleOf(k) };
  });

/**
 * What the force between two balls is called, in the legend and at the cursor.
 * @param {{ first: number, second: number }} pair
 */
export const betweenOf = (pair) => ({
  name: text('axial.cradle.between', pair),
  cursor: text('axial.cradle.at-cursor', pair),
});

/**
 * The forces between them, but for that of the striker.
 * @param {AxialFrame} frame
 * @returns {Series[]}
 */
export function forcesOf(frame) {
  const count = countOf(frame);
  return given(frame.target.row, 'row')
    .slice(1)
    .map((_, k) => {
      const y = column(given(frame.exactRowForce, 'row'), count, k + 1);
      const pair = { first: k + 2, second: k + 3 };
      return { x: frame.motionTime, y, factor: frame.forceUnit, ...betweenOf(pair), style: styleOf(k + 1) };
    });
}

/**
 * @typedef {object} Row  of a frame, as it is drawn at any size
 * @property {Numbers} time  of the frame, which becomes finer where one looks closely
 * @property {number[]} radii
 * @property {Numbers[]} paths
 * @property {Numbers[]} velocities
 * @property {Numbers[]} forces  of the contacts
 * @property {number[]} deepest  that neighbours press each other in [v T]
 * @property {number} strongest  force [Z v]
 */

/** @type {Row | null} */
let known = null;

/**
 * @param {AxialFrame} frame
 * @returns {Row}
 */
export function rowOf(frame) {
  if (known?.time === frame.motionTime) return known;
  const row = given(frame.target.row, 'row');
  const paths = pathsOf(frame);
  const deepest = row.map((_, k) => paths[k].reduce((most, moved, i) => Math.max(most, moved - paths[k + 1][i]), 0));
  const all = given(frame.exactRowForce, 'row');
  const strongest = all.reduce((most, force) => Math.max(most, force), 0);
  const forces = row.map((_, k) => column(all, row.length, k));
  const velocities = paths.map((_, k) => column(given(frame.exactRowVelocity, 'row'), paths.length, k));
  const radii = [frame.impactor.radius ?? row[0], ...row];
  known = { time: frame.motionTime, radii, paths, velocities, forces, deepest, strongest };
  return known;
}

/**
 * Pixels of a string, of which a share is the most that a ball may swing.
 * @param {number} height  of the picture
 */
export const swing = (height) => LIFT * (MIDDLE * height - TOP);

/**
 * @param {CanvasRenderingContext2D} c
 * @param {AxialFrame} frame
 * @param {number} t
 * @param {{ rest: number, width: number, height: number, scale: number, size: number }} place  the first face at rest
 * @returns {Hung[]}  the striker first
 */
export function cradle(c, frame, t, { rest, width, height, scale, size }) {
  const { deepest, forces, paths, radii, strongest, velocities } = rowOf(frame);
  const middle = MIDDLE * height;
  const at = (/** @type {Numbers} */ values) => between(frame.motionTime, values, t);
  const sizes = radii.map((radius) => (size * radius) / radii[0]);
  let hung = rest - sizes[0] / 2;
  const balls = paths.map((path, k) => {
    if (k) hung += (sizes[k - 1] + sizes[k]) / 2 + deepest[k - 1] * scale;
    const moved = at(path) * scale;
    const long = middle - TOP;
    const x = hung + moved;
    return { hung, x, y: TOP + Math.sqrt(Math.max(long ** 2 - moved ** 2, 0)), size: sizes[k] };
  });
  const [first, last] = [balls[0].hung - sizes[0] / 2, hung + sizes[sizes.length - 1] / 2];
  c.strokeStyle = '#4a5968';
  c.lineWidth = 3;
  line(c, [first, TOP], [last, TOP]);
  c.lineWidth = 1;
  for (const { hung: from, x, y } of balls) line(c, [from, TOP], [x, y]);
  balls.forEach(({ x, y, size: across }, k) => {
    c.beginPath();
    c.arc(x, y, across / 2, 0, 7);
    c.fillStyle = k ? '#8fb4d6' : '#3f4e5d';
    c.fill();
    c.lineWidth = 1.2;
    c.stroke();
  });
  forces.forEach((force, k) => {
    const share = at(force) / strongest;
    if (share > 1e-3) pressed(c, balls[k], balls[k + 1], share);
  });
  speeds(
    c,
    balls,
    velocities.map((velocity) => at(velocity) * frame.speed),
    frame.speed,
  );
  c.fillStyle = COLORS.faint;
  c.font = letters(13);
  c.textAlign = 'right';
  c.fillText(text('axial.cradle.drawn'), width - 12, height - 10);
  return balls;
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {[number, number]} from
 * @param {[number, number]} to
 */
function line(c, from, to) {
  c.beginPath();
  c.moveTo(...from);
  c.lineTo(...to);
  c.stroke();
}

/** @typedef {{ x: number, y: number, size: number }} Ball */
/** @typedef {Ball & { hung: number }} Hung  and where its string is fixed */

/**
 * That two press each other, and how much of the most it is.
 * @param {CanvasRenderingContext2D} c
 * @param {Ball} one
 * @param {Ball} next
 * @param {number} share
 */
function pressed(c, one, next, share) {
  const x = (one.x + one.size / 2 + next.x - next.size / 2) / 2;
  const tall = (0.25 + 0.75 * share) * Math.min(one.size, next.size);
  c.fillStyle = COLORS.cursor;
  c.fillRect(x - 1.5, (one.y + next.y - tall) / 2, 3, tall);
}

/**
 * Below each ball its velocity, with an arrow.
 * @param {CanvasRenderingContext2D} c
 * @param {Ball[]} balls
 * @param {number[]} velocities  [m/s]
 * @param {number} most
 */
function speeds(c, balls, velocities, most) {
  c.font = letters(13);
  c.textAlign = 'center';
  c.textBaseline = 'alphabetic';
  c.strokeStyle = c.fillStyle = COLORS.ink;
  c.lineWidth = 1.5;
  balls.forEach(({ x, y, size }, k) => {
    const below = y + size / 2;
    const share = velocities[k] / most;
    const [half, head] = [0.3 * size * share, 4 * Math.sign(share)];
    if (Math.abs(share) > 0.05) {
      line(c, [x - half, below + 6], [x + half, below + 6]);
      line(c, [x + half - head, below + 3], [x + half, below + 6]);
      line(c, [x + half - head, below + 9], [x + half, below + 6]);
    }
    c.fillText(Math.abs(share) < 5e-4 ? '0' : figures(velocities[k], 2), x, below + 10 + 14 * zoom);
  });
}
