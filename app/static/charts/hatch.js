// Lines over what is negative, tension or motion backward: the sign is seen without colours, too.

export const HATCHED = 0.04; // of the largest value, below which nothing is hatched
const STEP = 6; // pixels between two lines
const COLOR = 'rgba(8,40,90,.38)';

/**
 * Whether a value is hatched.
 * @param {number} value
 * @param {number} largest
 */
export const isHatched = (value, largest) => value < -HATCHED * largest;

/**
 * Hatch stretches of a bar.
 * @param {CanvasRenderingContext2D} c
 * @param {[from: number, to: number][]} stretches  across, in order
 * @param {number} top
 * @param {number} tall
 */
export function hatch(c, stretches, top, tall) {
  if (!stretches.length) return;
  c.save();
  c.beginPath();
  for (const [from, to] of stretches) c.rect(from, top, to - from, tall);
  c.clip();
  c.strokeStyle = COLOR;
  c.lineWidth = 1;
  c.beginPath();
  for (const [from, to] of stretches)
    for (let x = Math.floor((from - tall) / STEP) * STEP; x < to; x += STEP) {
      c.moveTo(x, top + tall);
      c.lineTo(x + tall, top);
    }
  c.stroke();
  c.restore();
}

/**
 * The stretches of neighbours that are hatched.
 * @param {number} count  of slices
 * @param {(k: number) => boolean} chosen
 * @param {(k: number) => number} edge  where a slice begins; that of `count` is the end of the last
 */
export function stretchesOf(count, chosen, edge) {
  /** @type {[number, number][]} */
  const found = [];
  for (let k = 0; k < count; k++) {
    if (!chosen(k)) continue;
    let end = k + 1;
    while (end < count && chosen(end)) end++;
    found.push([edge(k), edge(end)]);
    k = end;
  }
  return found;
}
