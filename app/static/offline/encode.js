// A message as the server would send it, of an answer that was found here.

/** @import { Frame, Numbers } from '../messages.js' */

/**
 * @param {Frame} frame
 * @returns {ArrayBuffer}
 */
export function encode({ shapes, ...fields }) {
  /** @type {Record<string, unknown>} */
  const header = {};
  /** @type {[name: string, values: Numbers][]} */
  const arrays = [];
  for (const [name, value] of Object.entries(fields))
    if (value instanceof Float64Array) arrays.push([name, value]);
    else header[name] = value;
  header.arrays = arrays.map(([name, { length }]) => [name, shapeOf(shapes[name], length)]);
  const text = new TextEncoder().encode(JSON.stringify(header));
  const start = 4 + 4 * Math.ceil(text.length / 4);
  const size = arrays.reduce((sum, [, { length }]) => sum + length, 0);
  const message = new Uint8Array(start + 4 * size).fill(' '.charCodeAt(0), 4, start);
  new DataView(message.buffer).setUint32(0, start - 4, true);
  message.set(text, 4);
  const numbers = new Float32Array(message.buffer, start);
  let at = 0;
  for (const [, values] of arrays) {
    numbers.set(values, at);
    at += values.length;
  }
  return message.buffer;
}

/**
 * The shape that an array had, where it still has as many numbers.
 * @param {number[] | undefined} shape
 * @param {number} length
 */
const shapeOf = (shape = [NaN], length) => (shape.reduce((a, b) => a * b) === length ? shape : [length]);
