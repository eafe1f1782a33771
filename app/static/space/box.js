// Faces and corners of a box, by the numbers of its axes.

/** @import { Vector } from '../messages.js' */

export const EDGES = [
  [0, 1, 2],
  [1, 2, 0],
  [2, 0, 1],
]; // normal of a face, and its two sides
export const CORNERS = [
  [1, 1],
  [1, -1],
  [-1, -1],
  [-1, 1],
];
/** @type {Vector[]} */
export const AXES = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
