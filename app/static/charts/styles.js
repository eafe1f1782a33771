// Colours of fields, and what the lines of a chart look like.

export const COLORS = {
  ink: '#1c2733',
  faint: '#66788a',
  grid: '#e3e9ef',
  edge: '#b9c4cf',
  panel: '#ffffff',
  waves: '#0b4f8a',
  modal: '#d9730d',
  prediction: '#8b95a1',
  cursor: '#c81e4a',
  contact: 'rgba(11,79,138,.09)',
  record: '#2e7d4f',
  struck: '#7a8f1f',
  halfSpace: '#7a5ea8',
};

/**
 * What stands for methods or quantities that are set side by side, by their rank among them: the marker is one of
 * Bokeh's, and as large as the others by a factor.
 * @typedef {{ color: string, marker: string, size: number }} Sign
 * @type {Sign[]}
 */
const SIGNS = [
  { color: COLORS.waves, marker: 'circle', size: 1 },
  { color: COLORS.modal, marker: 'square', size: 0.9 },
  { color: '#a4243b', marker: 'diamond', size: 1.5 },
  { color: '#2e7d4f', marker: 'triangle', size: 1.15 },
  { color: '#7c9a54', marker: 'inverted_triangle', size: 1.15 },
  { color: '#b08900', marker: 'star', size: 1.6 },
  { color: '#7a5ea8', marker: 'hex', size: 1.1 },
  { color: '#6b7785', marker: 'plus', size: 1.1 },
  { color: '#4f9bd8', marker: 'circle_x', size: 1 },
  { color: '#33475b', marker: 'square_x', size: 1 },
];
/**
 * The sign of a rank; more than there are begin again.
 * @param {number} rank
 */
export const signOf = (rank) => SIGNS[rank % SIGNS.length];

/**
 * @typedef {object} Style
 * @property {string} color
 * @property {number} [width]  of the line, in pixels
 * @property {number[]} [dash]
 * @property {'line' | 'ring' | 'dot'} [mark]  rings and dots stand alone; a line by default
 * @property {boolean} [over]  drawn after all others
 */

/** @typedef {'A' | 'B' | 'C' | 'D' | 'E' | 'F' | 'G' | 'H'} Letter  of a solution that is kept */
/** @type {Record<Letter, string>} */
export const KEPT = {
  ...{ A: '#1f8a4c', B: '#8a3fb5', C: '#8d5524', D: '#00838f' },
  ...{ E: '#b3246b', F: '#5460c0', G: '#7d7a10', H: '#4d5a66' },
};

/**
 * Lines of a kept solution: its own, by the other method, and of the struck place.
 * @template {Letter} Name
 * @param {Name} letter
 * @returns {Record<`kept${Name}` | `kept${Name}Dashed` | `kept${Name}Thin`, Style>}
 */
const keptAs = (letter) =>
  /** @type {any} */ ({
    [`kept${letter}`]: { color: KEPT[letter], width: 1.7 },
    [`kept${letter}Dashed`]: { color: KEPT[letter], width: 2, dash: [6, 3], over: true },
    [`kept${letter}Thin`]: { color: KEPT[letter], width: 1, dash: [2, 2] },
  });

const JOINTS = [COLORS.waves, COLORS.modal, COLORS.halfSpace, COLORS.struck, COLORS.record, '#8d5524', COLORS.ink];
/**
 * Of the joints of a mechanism, and of the same with rigid links.
 * @type {Record<`joint${0 | 1 | 2 | 3 | 4 | 5 | 6}${'' | 'rigid'}`, Style>}
 */
const OF_JOINTS = /** @type {any} */ (
  Object.fromEntries(
    JOINTS.flatMap((color, n) => [
      [`joint${n}`, { color, width: 1.7 }],
      [`joint${n}rigid`, { color, width: 1.2, dash: [4, 3] }],
    ]),
  )
);

/** @satisfies {Record<string, Style>} */
const KNOWN = {
  ...OF_JOINTS,
  ...keptAs('A'),
  ...keptAs('B'),
  ...keptAs('C'),
  ...keptAs('D'),
  ...keptAs('E'),
  ...keptAs('F'),
  ...keptAs('G'),
  ...keptAs('H'),
  exact: { color: COLORS.waves, width: 2 },
  wide: { color: COLORS.waves, width: 3.4 }, // to be seen beneath what is laid over it
  other: { color: COLORS.modal, width: 1.5 },
  thinOther: { color: COLORS.modal, width: 1 },
  dashedOther: { color: COLORS.modal, width: 1, dash: [3, 2] },
  impulses: { color: COLORS.modal, mark: 'ring', over: true },
  raw: { color: 'rgba(217,115,13,.30)', width: 1 },
  rawExact: { color: 'rgba(11,79,138,.28)', width: 1 },
  record: { color: COLORS.record, width: 1.4, over: true },
  struck: { color: COLORS.struck, width: 1.8 },
  halfSpace: { color: COLORS.halfSpace, width: 1.3 },
  prediction: { color: COLORS.prediction, width: 1.6, dash: [6, 4] },
  dots: { color: COLORS.prediction, width: 1.6, dash: [2, 3] },
  whole: { color: COLORS.record, width: 1.4, dash: [7, 3] },
  limit: { color: COLORS.ink, width: 1.2, dash: [5, 4] },
  mode: { color: COLORS.waves, mark: 'dot' },
  fastMode: { color: COLORS.cursor, mark: 'dot' },
};
/** @type {Record<keyof typeof KNOWN, Style>} */
export const STYLES = KNOWN;

// Diverging colours: tension blue, rest almost white, compression red.
const STOPS = [
  [12, 58, 120],
  [66, 133, 200],
  [186, 215, 236],
  [246, 247, 248],
  [250, 205, 176],
  [222, 105, 62],
  [138, 24, 30],
];
/** Whether the page is turned over: what is pale is then next to black, and less pale if it is to be seen. */
export const dark = Boolean(globalThis.matchMedia?.('(prefers-color-scheme: dark)').matches);
const DEPTH = dark ? 0.7 : 1; // power of a value that has its colour
export const palette = new Uint8ClampedArray(3 * 257);
for (let i = 0; i <= 256; i++) {
  const value = i / 128 - 1;
  const place = ((1 + Math.sign(value) * Math.abs(value) ** DEPTH) / 2) * (STOPS.length - 1);
  const k = Math.min(Math.floor(place), STOPS.length - 2);
  for (let c = 0; c < 3; c++) palette[3 * i + c] = STOPS[k][c] + (place - k) * (STOPS[k + 1][c] - STOPS[k][c]);
}

/**
 * Where the colour of a value begins in the palette, the largest value at its end.
 * @param {number} value
 * @param {number} largest
 */
export function shade(value, largest) {
  return 3 * Math.round(128 + 128 * Math.min(Math.max(value / largest, -1), 1));
}

/**
 * That colour for a style sheet or a canvas.
 * @param {number} value
 * @param {number} largest
 */
export const css = (value, largest) => {
  const k = shade(value, largest);
  return `rgb(${palette[k]},${palette[k + 1]},${palette[k + 2]})`;
};
