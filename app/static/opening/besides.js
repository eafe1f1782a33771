// A lesson's own choice of what stands beside the force: not the other solutions that the page has, but one of its own.

/** @import { Series } from '../charts/chart.js' */
/** @import { Frame } from '../messages.js' */
/** @import { Scene } from './section.js' */
/** @import { Track } from './tracks.js' */

const ROOM = 1.1; // about the largest value

/** @param {Series} series */
const most = ({ factor = 1, y }) => Array.from(y).reduce((a, b) => Math.max(a, b * factor), 0);

/**
 * On the clock of a frame, in which T may be longer.
 * @param {Series & { trip?: number }} series  `trip`: its own T [s]
 * @param {Frame} frame
 * @returns {Series}
 */
function onClock({ trip, ...series }, frame) {
  if (!trip || !('trip' in frame) || trip === frame.trip) return series;
  return { ...series, x: Array.from(series.x, (t) => (t * trip) / frame.trip) };
}

/**
 * What is drawn with the first force alone, and these beside it.
 * @param {Scene} scene
 * @param {(Series & { trip?: number })[]} others
 * @param {string} called  what the first is then called, if not as usual
 * @param {Frame} frame  that is drawn
 * @returns {Scene}
 */
export function withBesides(scene, others, called, frame) {
  const besides = others.map((each) => onClock(each, frame));
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
