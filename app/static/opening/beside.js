// What lies over the rows: forces, the striker's face, the struck place, and what is said of the end.
import { letters, scale as zoom } from '../charts/canvas.js';
import { COLORS, STYLES } from '../charts/styles.js';
import { thinned } from '../charts/thinned.js';
import { text } from '../text/catalogue.js';

/** @import { Series } from '../charts/chart.js' */
/** @import { Section, Woven } from './section.js' */
/** @typedef {CanvasRenderingContext2D} Context */

export const NARROW = 560; // of width [px]
const MARK = { wide: 5, least: 2 }; // pixels of a contact at the struck place
const LINE = 17; // pixels

/**
 * A force over time.
 * @param {Context} c
 * @param {Section} section
 * @param {Series} series
 */
export function curve(c, section, { factor = 1, style, x, y }) {
  const { color, dash = [], mark, width = 1.6 } = STYLES[style];
  c.strokeStyle = c.fillStyle = color;
  c.lineWidth = width;
  c.setLineDash(dash);
  c.beginPath();
  if (mark) {
    for (let k = 0; k < x.length; k++) c.rect(section.x(y[k] * factor) - 1.5, section.y(x[k]) - 1.5, 3, 3);
    c.fill();
  } else {
    const [down, across] = [section.y(0), section.x(0)];
    const [later, more] = [section.y(1) - down, section.x(factor) - across];
    thinned({ x, y }, [0, x.length], [down, later], [across, more], (at, off) => c.lineTo(off, at));
    c.stroke();
  }
  c.setLineDash([]);
}

/**
 * The face of the striker.
 * @param {Context} c
 * @param {Section} section
 * @param {Woven} scene
 */
export function striker(c, section, { drawn, duration, ends, prediction = null, scale, strikes }) {
  const [start, end] = section.stretch;
  const { base, tall, top, width } = section.box;
  if (!strikes || !ends) return;
  c.save();
  c.beginPath();
  c.rect(base, top, width, tall); // beside the force
  c.clip();
  const path = (/** @type {(t: number) => number} */ moved) => {
    c.beginPath();
    for (let k = 0; k <= tall; k++) {
      const t = start + (k / tall) * (end - start);
      if (t <= duration) c.lineTo(drawn.left + moved(t) * scale, section.y(t));
    }
    c.stroke();
  };
  c.strokeStyle = COLORS.ink;
  c.lineWidth = 1.4;
  path((t) => ends.mass(t));
  c.strokeStyle = COLORS.prediction;
  c.setLineDash([5, 4]);
  if (prediction !== null) path((t) => prediction * t);
  c.restore();
  const gone = prediction === null ? 0 : (base - drawn.left) / (prediction * scale); // when it is at the force
  if (width >= NARROW && gone > start && gone < end)
    section.words.say(
      text('opening.predicted'),
      base + 6,
      Math.min(section.y(gone) + 16 * zoom, top + tall - 6),
      COLORS.faint,
    );
}

/**
 * A dashed line down through all of the time.
 * @param {Context} c
 * @param {number} x
 * @param {Section} section
 */
function dashed(c, x, { box: { tall, top } }) {
  c.lineWidth = 1;
  c.strokeStyle = COLORS.faint;
  c.setLineDash([3, 4]);
  c.beginPath();
  c.moveTo(x, top);
  c.lineTo(x, top + tall);
  c.stroke();
  c.setLineDash([]);
}

/**
 * The struck place of what is bent across, and when it is touched.
 * @param {Context} c
 * @param {Section} section
 * @param {Woven} scene
 */
export function struck(c, section, { contacts, drawn: { left, rest } }) {
  dashed(c, rest, section);
  for (const [from, to] of contacts) {
    const [y, high] = [section.y(from), Math.max(section.y(to) - section.y(from), MARK.least)];
    c.fillStyle = COLORS.contact;
    c.fillRect(0, y, left, high);
    c.fillStyle = COLORS.ink;
    c.fillRect(rest - MARK.wide / 2, y, MARK.wide, high);
  }
}

/**
 * @param {Section} section
 * @param {Woven} scene
 */
export function feet(section, { feet: said }) {
  const { base, tall, top } = section.box;
  const y = top + tall - 8;
  if (!said) return;
  for (const { x, words } of said.all.toReversed()) section.words.say(words, x, y, COLORS.ink, letters(13), 'center');
  section.words.say(said.about, base + 6, y - LINE * zoom, COLORS.faint);
}

/**
 * What gauges would tell, each where it is glued on.
 * @param {Context} c
 * @param {Section} section
 * @param {Woven} scene
 */
export function traces(c, section, { traces: all = [] }) {
  const { top } = section.box;
  for (const { at, moved, name, x } of all) {
    dashed(c, at, section);
    for (const [color, width] of /** @type {[string, number][]} */ ([
      [COLORS.panel, 4],
      [COLORS.ink, 1.6],
    ])) {
      c.strokeStyle = color;
      c.lineWidth = width;
      c.beginPath();
      moved.forEach((far, k) => c.lineTo(at + far, section.y(x[k])));
      c.stroke();
    }
    section.words.say(name, at + 6, top + LINE * zoom, COLORS.ink, letters(13, '600 '));
  }
}
