// Arrows and words on the stage for bodies in space.

/** @typedef {[x: number, y: number]} Point  in pixels */
/** @typedef {CanvasRenderingContext2D} Context */

/**
 * The line that was traced, with a pale edge by which it is seen on a body.
 * @param {Context} c
 * @param {number} wide
 */
export function edged(c, wide) {
  const { strokeStyle } = c;
  c.strokeStyle = PALE;
  c.lineWidth = wide + 2.4;
  c.stroke();
  c.strokeStyle = strokeStyle;
  c.lineWidth = wide;
  c.stroke();
}

/**
 * @param {Context} c
 * @param {Point} from
 * @param {Point} to
 * @param {number} wide
 */
export function arrow(c, from, to, wide) {
  const long = Math.hypot(to[0] - from[0], to[1] - from[1]);
  if (long < 2) return;
  /** @type {Point} */
  const way = [(to[0] - from[0]) / long, (to[1] - from[1]) / long];
  const tip = Math.min(10, long);
  c.beginPath();
  c.moveTo(...from);
  c.lineTo(to[0] - way[0] * tip * 0.7, to[1] - way[1] * tip * 0.7);
  edged(c, wide);
  head(c, to, way, tip);
}

/**
 * The head of an arrow.
 * @param {Context} c
 * @param {Point} tip
 * @param {Point} way  of length 1
 * @param {number} long
 */
export function head(c, [x, y], [dx, dy], long) {
  c.beginPath();
  c.moveTo(x, y);
  c.lineTo(x - dx * long - dy * long * 0.45, y - dy * long + dx * long * 0.45);
  c.lineTo(x - dx * long + dy * long * 0.45, y - dy * long - dx * long * 0.45);
  c.closePath();
  edged(c, 0.1);
  c.fill();
}

/** @typedef {[left: number, top: number, right: number, bottom: number]} Box  in pixels */
/** @type {WeakMap<Context, { words: Box[], drawn: Box[], wide: number }>} */
const taken = new WeakMap(); // of the picture that is being drawn
const EDGE = 6; // px between a label and the edge of the picture
const LINE = 13; // pixels
const ELSEWHERE = [0, 1, -1, 2, -2, 3, 4, 5]; // lines lower, where a label is in the way
const ASIDE = [0, 1, -1]; // and of its own width to the right
const PALE = '#ffffff';
const PLATE = 'rgba(255,255,255,.8)'; // on which what lies on a body is read

/**
 * Begin a picture without labels.
 * @param {Context} c
 * @param {Box[]} words  where none may lie
 * @param {Box[]} drawn  where none lies if there is room elsewhere
 * @param {number} wide  pixels of the picture; its canvas may be that of a file
 */
export const unlabelled = (c, words, drawn, wide) => taken.set(c, { words, drawn, wide });

/**
 * @param {Box} one
 * @param {Box} other
 */
const overlap = ([l, t, r, b], [left, top, right, bottom]) => r >= left && l <= right && b >= top && t <= bottom;

/**
 * Where a label is, so far up, down or aside that it lies on no other and within the picture, and on no body if it can.
 * @param {Context} c  its font and alignment set
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @returns {[x: number, y: number, box: Box, onBody: boolean]}
 */
function freed(c, text, x, y) {
  const { actualBoundingBoxLeft: left, actualBoundingBoxRight: right } = c.measureText(text);
  const { words, drawn, wide } = taken.get(c) ?? { words: [], drawn: [], wide: Infinity };
  const middle = c.textBaseline === 'top' ? y + LINE / 2 : c.textBaseline === 'bottom' ? y - LINE / 2 : y;
  const within = Math.max(Math.min(x, wide - right - EDGE), left + EDGE);
  const places = ASIDE.flatMap((aside) =>
    ELSEWHERE.map((lines) => {
      const [across, line] = [within + aside * (left + right + LINE), middle + lines * LINE];
      const box = /** @type {Box} */ ([across - left, line - LINE / 2, across + right, line + LINE / 2]);
      return { across, box, down: y + lines * LINE };
    }),
  );
  const seen = places.filter(
    ({ box: [l, t, r] }, k) => t >= 0 && (k < ELSEWHERE.length || (l >= EDGE && r <= wide - EDGE)),
  );
  const free = (/** @type {Box[]} */ others) => seen.find(({ box }) => others.every((other) => !overlap(box, other)));
  const clear = free([...words, ...drawn]);
  const { across, box, down } = clear ?? free(words) ?? places[0];
  words.push(box);
  return [across, down, box, !clear];
}

/**
 * Text beyond a point, on the side where `way` points; a white edge keeps it legible on lines, a plate on bodies.
 * @param {Context} c
 * @param {string} text
 * @param {Point} place
 * @param {Point} way
 */
export function label(c, text, [x, y], [dx, dy]) {
  const long = Math.hypot(dx, dy) || 1;
  c.textAlign = Math.abs(dx) < 0.4 * long ? 'center' : dx > 0 ? 'left' : 'right';
  c.textBaseline = Math.abs(dy) < 0.4 * long ? 'middle' : dy > 0 ? 'top' : 'bottom';
  c.save();
  c.lineWidth = 3;
  c.strokeStyle = PALE;
  const left = x + (6 * dx) / long;
  const [at, line, [l, t, r, b], onBody] = freed(c, text, left, y + (4 * dy) / long);
  if (onBody) {
    const ink = c.fillStyle;
    c.fillStyle = PLATE;
    c.fillRect(l - 3, t - 1, r - l + 6, b - t + 2);
    c.fillStyle = ink;
  }
  c.strokeText(text, at, line);
  c.fillText(text, at, line);
  c.restore();
}

/**
 * A length to measure by, at the lower right corner.
 * @param {Context} c
 * @param {number} right
 * @param {number} bottom
 * @param {number} long  in pixels
 * @param {string} text
 */
export function measure(c, right, bottom, long, text) {
  const left = right - long;
  c.lineWidth = 1.4;
  c.beginPath();
  c.moveTo(left, bottom - 4);
  c.lineTo(left, bottom);
  c.lineTo(right, bottom);
  c.lineTo(right, bottom - 4);
  c.stroke();
  c.textAlign = 'center';
  c.textBaseline = 'bottom';
  c.fillText(text, (left + right) / 2, bottom - 5);
}

/**
 * A wall, short, as a body may swing past the place where it was stopped.
 * @param {CanvasRenderingContext2D} c
 * @param {Point} place
 * @param {Point} normal
 * @param {number} reach  pixels to both sides
 */
export function stopAt(c, [x, y], [nx, ny], reach) {
  c.strokeStyle = '#55636f';
  c.lineCap = 'round'; // at the first picture, too
  c.lineWidth = 4;
  c.beginPath();
  c.moveTo(x - ny * reach, y - nx * reach);
  c.lineTo(x + ny * reach, y + nx * reach);
  c.stroke();
  c.lineWidth = 1;
  c.beginPath();
  for (let s = -reach; s < reach; s += 10) {
    const px = x + ny * s;
    const py = y + nx * s;
    c.moveTo(px, py);
    c.lineTo(px + nx * 12 + ny * 8, py - ny * 12 + nx * 8);
  }
  c.stroke();
}
