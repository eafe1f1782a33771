// Tracks beside the rows, on the same clock: one quantity each, its values across and time down.
import { letters, scale as zoom } from '../charts/canvas.js';
import { between } from '../charts/scale.js';
import { COLORS, css, STYLES } from '../charts/styles.js';
import { thinned } from '../charts/thinned.js';
import { localised, scaled } from '../text/format.js';
import { weave } from './rows.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Range } from '../charts/scale.js' */
/** @import { Rows } from './rows.js' */
/** @import { Words } from './words.js' */

/**
 * @typedef {object} Track
 * @property {string} title
 * @property {number} share  of the room, beside those of others
 * @property {Range} range  values at its left and right edge
 * @property {string} [unit]  of values
 * @property {[left: string, right: string]} [ends]  what stands there in place of values
 * @property {Bar[]} [bars]  that grow from zero
 * @property {Series[]} [series]  the first one filled from zero
 * @property {{ field: Rows, what: string, largest: number, duration: number }} [rows]  of a body that is laid flat
 * @property {Bar[]} [said]  words beside a curve from an instant on
 * @property {boolean} [force]  of the contact
 * @property {number[]} [marks]  shares of its width that are marked
 */
/** @typedef {{ t: number, value: number, words: string }} Bar */
/**
 * @typedef {{ left: number, right: number, top: number, tall: number, room: number }} Place  [px]; room: of its title
 */
/**
 * The clock that all share.
 * @typedef {object} Clock
 * @property {(t: number) => number} y
 * @property {Range} stretch
 */

const LEAST = 92 * zoom; // pixels of a track, below which the last ones are left out
const GAP = 30 * zoom;
const BAR = 4; // pixels of an impulse
const LINE = 15 * zoom; // pixels between two numbers of impulses
const FILL = 0.16; // of the ink of a curve

/**
 * Where tracks lie: as many as have room, by their shares.
 * @param {Track[]} tracks
 * @param {number} left
 * @param {number} right
 * @param {{ top: number, tall: number }} box
 * @returns {{ track: Track, place: Place }[]}
 */
export function placed(tracks, left, right, { top, tall }) {
  const count = Math.min(tracks.length, Math.max(Math.floor((right - left + GAP) / (LEAST + GAP)), 1));
  const shown = tracks.slice(0, count);
  const room = right - left - (count - 1) * GAP;
  const all = shown.reduce((sum, { share }) => sum + share, 0);
  let from = left;
  return shown.map((track, k) => {
    const to = from + (room * track.share) / all;
    const beyond = k < count - 1 ? GAP - 8 : 0; // beside the last one the picture ends
    const place = { left: from, right: to, top, tall, room: to - from + beyond };
    from = to + GAP;
    return { track, place };
  });
}

/**
 * @param {Track} track
 * @param {Place} place
 * @param {number} value
 */
const across = ({ range: [low, high] }, { left, right }, value) =>
  left + ((value - low) / (high - low)) * (right - left);

/**
 * Its title, and what its edges are.
 * @param {CanvasRenderingContext2D} c
 * @param {Track} track
 * @param {Place} place
 */
function head(c, track, { left, right, room, top }) {
  const { ends, range, title, unit = '' } = track;
  const [factor, sign] = scaled(Math.max(...range.map(Math.abs)), unit);
  const value = (/** @type {number} */ end) => localised(String(Number((range[end] * factor).toPrecision(2))));
  const [first, last] = ends ?? [value(0), value(1)].map((words) => words.replace('-', '−'));
  const named = ends || !sign ? title : `${title}, ${sign}`;
  c.textBaseline = 'alphabetic';
  c.textAlign = 'left';
  c.font = letters(13, '600 ');
  c.fillStyle = COLORS.ink;
  c.fillText(named, left, top - 25 * zoom, room);
  c.font = letters(13);
  c.fillStyle = COLORS.faint;
  c.fillText(first, left, top - 6);
  c.textAlign = 'right';
  c.fillText(last, right, top - 6);
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {Track} track
 * @param {Place} place
 * @param {Clock} clock
 * @param {Words} words
 */
export function drawTrack(c, track, place, clock, words) {
  const { left, right, top, tall } = place;
  head(c, track, place);
  c.save();
  c.beginPath();
  c.rect(left - GAP, top, right - left + 2 * GAP, tall);
  c.clip();
  if (track.rows) laid(c, track.rows, place, clock);
  for (const value of track.rows ? [] : [...track.range, 0]) {
    const x = Math.round(across(track, place, value)) + 0.5;
    c.strokeStyle = value ? COLORS.grid : COLORS.edge;
    line(c, [x, top], [x, top + tall]);
  }
  c.strokeStyle = COLORS.faint;
  c.setLineDash([3, 4]);
  for (const mark of track.marks ?? [])
    line(c, [left + mark * (right - left), top], [left + mark * (right - left), top + tall]);
  c.setLineDash([]);
  c.save();
  c.beginPath();
  c.rect(left - 2, top, right - left + 4, tall); // what leaves the range ends there, and not in the next track
  c.clip();
  (track.series ?? []).toReversed().forEach((series) => curve(c, track, place, series, clock));
  c.restore();
  bars(c, track, place, clock, words);
  names(track, place, words);
  for (const { t, value, words: note } of track.said ?? [])
    words.say(note, across(track, place, value) + 6, Math.min(clock.y(t) + LINE + 4, top + tall - 6), COLORS.ink);
  c.restore();
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {[number, number]} from
 * @param {[number, number]} to
 */
function line(c, from, to) {
  c.lineWidth = 1;
  c.beginPath();
  c.moveTo(...from);
  c.lineTo(...to);
  c.stroke();
}

const image = globalThis.document?.createElement('canvas');
/**
 * @param {CanvasRenderingContext2D} c
 * @param {NonNullable<Track['rows']>} rows
 * @param {Place} place
 * @param {Clock} clock
 */
function laid(c, rows, { left, right, top, tall }, { stretch }) {
  const wide = Math.round(right - left);
  weave(image, { ...rows, drawn: { left: 0, right: wide, rest: 0 }, scale: 0 }, stretch, wide, Math.round(tall));
  c.drawImage(image, left, top, wide, tall);
}

/**
 * @param {CanvasRenderingContext2D} c
 * @param {Track} track
 * @param {Place} place
 * @param {Series} series
 * @param {Clock} clock
 */
function curve(c, track, place, { factor = 1, style, x, y }, { stretch, y: at }) {
  const { color, dash = [], width = 1.6 } = STYLES[style];
  const filled = track.series?.[0]?.style === style;
  const zero = across(track, place, 0);
  c.strokeStyle = c.fillStyle = color;
  c.lineWidth = width;
  c.setLineDash(dash);
  c.beginPath();
  let [from, to] = [0, x.length];
  while (from < to && (x[from + 1] ?? x[from]) < stretch[0]) from++;
  while (to > from && (x[to - 2] ?? x[to - 1]) > stretch[1]) to--;
  const scale = across(track, place, factor) - zero;
  thinned({ x, y }, [from, to], [at(0), at(1) - at(0)], [zero, scale], (down, right) => c.lineTo(right, down));
  c.stroke();
  c.setLineDash([]);
  if (!filled) return;
  c.lineTo(zero, at(x[to - 1]));
  c.lineTo(zero, at(x[from]));
  c.globalAlpha = FILL;
  c.fill();
  c.globalAlpha = 1;
}

/**
 * Impulses, from zero, and their numbers where these have room.
 * @param {CanvasRenderingContext2D} c
 * @param {Track} track
 * @param {Place} place
 * @param {Clock} clock
 * @param {Words} words
 */
function bars(c, track, place, { stretch: [start, end], y }, words) {
  const zero = across(track, place, 0);
  const most = Math.max(...track.range.map(Math.abs));
  let below = -Infinity;
  for (const { t, value, words: said } of track.bars ?? []) {
    if (t < start || t > end) continue;
    const [x, middle] = [across(track, place, value), y(t)];
    c.fillStyle = css(Math.abs(value), most);
    c.strokeStyle = COLORS.edge;
    c.lineWidth = 0.5;
    c.beginPath();
    c.rect(Math.min(x, zero), middle - BAR / 2, Math.abs(x - zero), BAR);
    c.fill();
    c.stroke();
    if (middle - below < LINE) continue;
    below = middle;
    const outward = x < zero ? 'right' : 'left';
    words.say(said, x + (x < zero ? -6 : 6), middle + 4.5 * zoom, COLORS.ink, letters(13), outward);
  }
}

/**
 * What its curves are, where there are several.
 * @param {Track} track
 * @param {Place} place
 * @param {Words} words
 */
function names({ series = [] }, { left, top, tall }, words) {
  if (series.length < 2) return;
  series.forEach(({ cursor = '', style }, k) => {
    const y = top + tall - 8 - (series.length - 1 - k) * LINE;
    words.say(cursor, left + 4, y, STYLES[style].color, letters(13, '600 '));
  });
}

/**
 * What a track says of one instant, on its first curve.
 * @param {CanvasRenderingContext2D} c
 * @param {Track} track
 * @param {Place} place
 * @param {number} t
 * @param {number} y
 */
export function dot(c, track, place, t, y) {
  const [first] = track.series ?? [];
  if (!first) return;
  c.fillStyle = COLORS.cursor;
  c.beginPath();
  c.arc(across(track, place, between(first.x, first.y, t) * (first.factor ?? 1)), y, 4.5, 0, 7);
  c.fill();
}
