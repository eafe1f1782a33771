// A lesson's own choice of what stands beside the force: not the other solutions that the page has, but one of its own.

/** @import { Series } from '../charts/chart.js' */
/** @import { Scene } from './section.js' */
/** @import { Track } from './tracks.js' */

const ROOM = 1.1; // about the largest value

/** @param {Series} series */
const most = ({ factor = 1, y }) => Array.from(y).reduce((a, b) => Math.max(a, b * factor), 0);

/**
 * What is drawn with the first force alone, and these beside it.
 * @param {Scene} scene
 * @param {Series[]} besides
 * @param {string} called  what the first is then called, if not as usual
 * @returns {Scene}
 */
export function withBesides(scene, besides, called) {
  const named = (/** @type {Series} */ first) => (called ? { ...first, cursor: called } : first);
  if (scene.drawn) {
    const [first] = scene.forces;
    return { ...scene, forces: [named(first), ...besides] };
  }
  const tracks = scene.tracks.map((track) => (track.force && track.series ? beside(track, besides, named) : track));
  return { ...scene, tracks };
}

/**
 * @param {Track} track
 * @param {Series[]} besides
 * @param {(first: Series) => Series} named
 * @returns {Track}
 */
function beside({ range: [high, low], series: [first] = [], ...track }, besides, named) {
  return {
    ...track,
    range: [Math.max(high, ...besides.map((each) => ROOM * most(each))), low],
    series: first ? [named(first), ...besides] : [],
  };
}
