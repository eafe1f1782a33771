// A message of the server: a header and arrays of numbers. app/messages/schema.py says what each field is.
import { ofScene } from '../text/catalogue.js';

/** @import { Frame, Numbers } from '../messages.js' */

const TEXTS = /** @type {const} */ (['title', 'note', 'source']); // of a scene, which languages may have

/**
 * @param {ArrayBuffer} buffer
 * @returns {Frame}
 */
export function decode(buffer) {
  const bytes = new Uint8Array(buffer);
  const length = new DataView(bytes.buffer, bytes.byteOffset, 4).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  /** @type {Record<string, Numbers>} */
  const data = {};
  /** @type {Record<string, number[]>} */
  const shapes = {};
  let offset = 4 + length;
  for (const [name, shape, unit] of header.arrays) {
    shapes[name] = shape;
    const size = shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b);
    const width = unit ? 2 : 4; // with a unit: whole numbers of two bytes
    const part = bytes.slice(offset, offset + width * size).buffer;
    data[name] = new Float64Array(unit ? new Int16Array(part) : new Float32Array(part));
    if (unit) for (let k = 0; k < size; k++) data[name][k] *= unit;
    offset += 4 * Math.ceil((width * size) / 4);
  }
  const contacts = data.contacts && { contacts: rowsOf(data.contacts, shapes.contacts[1]) };
  const { scene } = header.chosen ?? {}; // nothing is chosen outside the page
  for (const what of scene ? TEXTS : []) header[what] = ofScene(scene, what, header[what]);
  return { ...header, ...data, shapes, ...contacts };
}

/**
 * @param {Numbers} flat
 * @param {number} columns
 */
const rowsOf = (flat, columns) =>
  Array.from({ length: flat.length / columns }, (_, k) => [...flat.subarray(columns * k, columns * (k + 1))]);

/**
 * One of the arrays that stand in a message under a number, as the waves of each rod do.
 * @param {Frame} frame
 * @param {string} name
 * @returns {Numbers}
 */
export const arrayOf = (frame, name) => given(/** @type {any} */ (frame)[name], name);

/**
 * What this kind of message must hold. Raises an error where it does not.
 * @template Value
 * @param {Value | null | undefined} value
 * @param {string} name
 * @returns {Value}
 */
export function given(value, name) {
  if (value === null || value === undefined) throw new Error(`the message has no ${name}`);
  return value;
}
