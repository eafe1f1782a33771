// A chart as a file: PNG at twice the pixels of the page, or SVG, with its title and its legend.
import { download, make } from '../browser/dom.js';
import { contextOf } from './canvas.js';
import { keysOf } from './legend.js';
import { FONT } from './plot.js';
import { COLORS } from './styles.js';
import { svgContext } from './svg.js';

/** @typedef {import('./chart.js').Chart} Chart */

export const FINE = 2;
const LINE = 18; // pixels of a line of the head
const EDGE = 10;

/** @param {Chart} chart */
export function savePng(chart) {
  pictureOf(chart).toBlob((blob) => blob && download(blob, `${nameOf(chart)}.png`));
}

/**
 * With `FINE` pixels for one of the page.
 * @param {Chart} chart
 */
export function pictureOf(chart) {
  const head = heads(chart);
  const image = make('canvas', { width: FINE * chart.width, height: FINE * (chart.height + head.height) });
  const c = contextOf(image);
  c.scale(FINE, FINE);
  c.fillStyle = COLORS.panel;
  c.fillRect(0, 0, chart.width, chart.height + head.height);
  compose(chart, c, head);
  return image;
}

/** @param {Chart} chart */
export function saveSvg(chart) {
  download(new Blob([svgOf(chart)], { type: 'image/svg+xml' }), `${nameOf(chart)}.svg`);
}

/** @param {Chart} chart */
function svgOf(chart) {
  const head = heads(chart);
  const c = svgContext(chart.width, chart.height + head.height);
  c.fillStyle = COLORS.panel;
  c.fillRect(0, 0, chart.width, chart.height + head.height);
  compose(chart, c, head);
  return c.get_serialized_svg();
}

/** @param {Chart} chart */
const nameOf = (chart) => `strikewave-${(chart.title.textContent ?? '').toLowerCase().replaceAll(/\W+/g, '-')}`;

/**
 * Where title and legend are written, line by line as there is room, and how high that is.
 * @param {Chart} chart
 */
function heads(chart) {
  const ruler = contextOf(make('canvas'));
  ruler.font = FONT;
  const words = [
    { text: chart.title.textContent ?? '', key: null, font: `bold ${FONT}` },
    { text: chart.unit.textContent ?? '', key: null, font: FONT },
    ...keysOf(chart.content).map((key) => ({ text: key.text, key, font: FONT })),
  ];
  let [x, y] = [EDGE, LINE];
  const placed = words.map((word) => {
    ruler.font = word.font;
    const wide = ruler.measureText(word.text).width + (word.key ? 22 : 0);
    if (x + wide > chart.width - EDGE && x > EDGE) [x, y] = [EDGE, y + LINE];
    const place = { ...word, x, y };
    x += wide + 14;
    return place;
  });
  return { placed, height: y + 8 };
}

/**
 * @param {Chart} chart
 * @param {CanvasRenderingContext2D} c
 * @param {ReturnType<typeof heads>} head
 */
function compose(chart, c, { placed, height }) {
  c.textAlign = 'left';
  c.textBaseline = 'alphabetic';
  for (const { text, key, font, x, y } of placed) {
    if (key) sign(c, key, x, y - 4);
    c.font = font;
    c.fillStyle = key || font === FONT ? COLORS.faint : COLORS.ink;
    c.fillText(text, key ? x + 22 : x, y);
  }
  c.save();
  c.translate(0, height);
  chart.paint(c);
  c.restore();
}

/**
 * The mark of a legend.
 * @param {CanvasRenderingContext2D} c
 * @param {import('./legend.js').Key} key
 * @param {number} x
 * @param {number} y
 */
function sign(c, { color, mark }, x, y) {
  c.strokeStyle = c.fillStyle = color;
  c.lineWidth = mark === 'bar' ? 4 : 2;
  c.setLineDash(mark === 'dashes' ? [5, 3] : mark === 'dots' ? [2, 2] : []);
  c.beginPath();
  if (mark === 'ring' || mark === 'dot') c.arc(x + 8, y, 3, 0, 2 * Math.PI);
  else if (mark === 'chip') c.rect(x + 3, y - 5, 10, 10);
  else {
    c.moveTo(x, y);
    c.lineTo(x + 16, y);
  }
  if (mark === 'dot' || mark === 'chip') c.fill();
  else c.stroke();
  c.setLineDash([]);
}
