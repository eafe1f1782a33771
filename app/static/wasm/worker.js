// A worker that finds figures of impacts, many at a time: it is given a module of kernels, then a scene, then points.
import { answersBy } from './answers.js';
import { COLUMNS } from './columns.js';
import { figuresAt } from './mapped.js';

/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Answers } from './answers.js' */

/** @typedef {{ kind: 'module', module: WebAssembly.Module }} GivenModule */
/**
 * @typedef {{ kind: 'scene', frame: Frame }} GivenScene
 * @typedef {object} Points
 * @property {'points'} kind
 * @property {number} job
 * @property {Chosen} chosen  all other choices that differ from those of the scene
 * @property {string[]} names
 * @property {Float64Array} rows  (points, names): values of these choices
 * @property {number} [tolerance]  as `figuresAt` takes it
 */
/** @typedef {GivenModule | GivenScene | Points} Given */

const own = /** @type {{ onmessage: unknown, postMessage: (message: any, sent?: Transferable[]) => void }} */ (
  /** @type {any} */ (globalThis)
);

/** @type {Answers | null} */
let answers = null; // none where the module cannot be used: then there is no answer to any point
/** @type {GivenScene | null} */
let scene = null;

/**
 * Of one point: none where anything fails, which leaves those after it as they are.
 * @param {Chosen} chosen
 * @param {number} [tolerance]
 */
function figures(chosen, tolerance) {
  try {
    if (answers && scene) return figuresAt(answers, scene.frame, { ...scene.frame.chosen, ...chosen }, tolerance);
  } catch {
    answers?.kernels.restore(); // a trap or an odd message: what is asked next starts anew
  }
  return Float64Array.from(COLUMNS, (_, k) => (k ? NaN : 1));
}

/** @param {Points} points */
function solve({ chosen, job, names, rows, tolerance }) {
  const begun = performance.now();
  const count = names.length ? Math.floor(rows.length / names.length) : 0;
  const found = new Float64Array(count * COLUMNS.length);
  for (let n = 0; n < count; n++) {
    const varied = Object.fromEntries(names.map((name, k) => [name, rows[n * names.length + k]]));
    found.set(figures({ ...chosen, ...varied }, tolerance), n * COLUMNS.length);
  }
  own.postMessage({ job, found, spent: performance.now() - begun }, [found.buffer]);
}

/** @param {{ data: Given }} event */
own.onmessage = async ({ data }) => {
  if (data.kind === 'scene') scene = data;
  if (data.kind === 'points') solve(data);
  if (data.kind !== 'module') return;
  answers = await answersBy(data.module).catch(() => null); // a small device
  own.postMessage({ ready: Boolean(answers) });
};
