// The contact force of the solution that counts, as lines are drawn through it.

/** @import { AxialFrame } from '../messages.js' */

/** @typedef {import('../charts/scale.js').Samples} Samples */

/**
 * A force that is constant over each of its steps, through the middles of these; what rests stays as long as it does.
 * @param {Samples} stairs
 * @returns {{ x: number[], y: number[] }}
 */
export function throughMiddles({ x, y }) {
  /** @type {{ x: number[], y: number[] }} */
  const line = { x: [], y: [] };
  const add = (/** @type {number} */ at, /** @type {number} */ value) => [line.x.push(at), line.y.push(value)];
  for (let first = 0, last = 0; first < x.length; first = last + 1) {
    last = first;
    while (last + 1 < x.length && y[last + 1] === y[first]) last += 1;
    const [from, to, value] = [x[first], x[last], y[first]];
    if (value === 0 || first === 0 || last === x.length - 1) add(from, value);
    if (value !== 0) add(0.5 * (from + to), value);
    if (to > from && (value === 0 || last === x.length - 1)) add(to, value);
  }
  return line;
}

/**
 * Waves jump where their force does; what gives way follows its law.
 * @param {AxialFrame} frame
 * @returns {Samples}
 */
export function forceOf({ exact, exactForce: y, exactTime: x }) {
  return exact.byLaw && !exact.travelling ? throughMiddles({ x, y }) : { x, y };
}
