// What is fetched of this room: the map in the place of the picture, and that of a lesson.
export { TaughtMap } from './taught.js';
export { WhatIf } from './whatif.js';
