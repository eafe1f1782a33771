// Modes of a free rod by a frame fixed to its struck end and the shapes of a rod clamped there: coupled by mass, and
// taken apart the motion of the mean and as many oscillators. Units are those of the message.

const HALVINGS = 50; // of an interval in which there is one frequency

/** @typedef {{ cosines: Float64Array, sines: Float64Array }} Rows  of modes at places */
/**
 * @typedef {object} Attached
 * @property {Float64Array} omega
 * @property {Float64Array} felt
 * @property {(shares: Float64Array) => Rows} rows
 * @property {Map<number, Rows>} shapes  by the number of places
 */

/** @type {{ count: number, modes: Attached } | null} */ let last = null;

/**
 * The same as long as their number is.
 * @param {number} count
 */
export function attachedModes(count) {
  if (last?.count !== count) last = { count, modes: solved(count) };
  return last.modes;
}

/**
 * Frequencies, how strongly each is felt at the struck end (2 in a free rod by its own modes), and shapes, 1 there.
 * @param {number} count
 * @returns {Attached}
 */
function solved(count) {
  const wavenumber = Float64Array.from({ length: count }, (_, k) => Math.PI * (k + 0.5)); // times the length
  // 1 + sum 2 w^2 / k^2 / (4 k^2 - w^2) = 0 has one root between each two frequencies of the clamped rod, and one above
  const squares = wavenumber.map((k) => k * k);
  const balance = (/** @type {number} */ square) => {
    let sum = 1;
    for (let k = 0; k < count; k++) sum += (2 * square) / (squares[k] * (4 * squares[k] - square));
    return sum;
  };
  const omega = wavenumber.map((k, i) => {
    let [low, high] = [2 * k, 2 * (wavenumber[i + 1] ?? 2 * k)];
    while (i === count - 1 && balance(high * high) < 0) high *= 2;
    for (let n = 0; n < HALVINGS; n++) {
      const middle = 0.5 * (low + high);
      if (balance(middle * middle) < 0) low = middle;
      else high = middle;
    }
    return 0.5 * (low + high);
  });
  const parts = Array.from(omega, (w) => wavenumber.map((k) => (2 * w * w) / k / (4 * k * k - w * w)));
  const felt = Float64Array.from(parts, (part) => 1 / (0.5 * part.reduce((sum, v) => sum + v * v, 0) - 1));

  /**
   * Every mode at every place: its shape, and its stress over its frequency.
   * @param {Float64Array} shares  of the length
   */
  const rows = (shares) => {
    const cosines = new Float64Array(count * shares.length);
    const sines = new Float64Array(count * shares.length);
    shares.forEach((share, j) => {
      const shape = wavenumber.map((k) => Math.sin(k * share) - 1 / k);
      const slope = wavenumber.map((k) => -2 * k * Math.cos(k * share));
      parts.forEach((part, i) => {
        let [moved, pressed] = [0, 0];
        for (let k = 0; k < count; k++) {
          moved += part[k] * shape[k];
          pressed += part[k] * slope[k];
        }
        cosines[i * shares.length + j] = moved;
        sines[i * shares.length + j] = pressed / omega[i];
      });
    });
    return { cosines, sines };
  };
  return { omega, felt, rows, shapes: new Map() };
}
