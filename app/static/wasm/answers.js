// The browser's own answers, by the library's kernels: exact at every picture while a slider moves. Fetched once the
// page stands; where it cannot be, the server answers alone.
import { placeOf } from '../place.js';
import { Kernels, kernelsOf } from './kernels.js';
import * as beams from './bending.js';
import * as chains from './chain.js';
import * as compacts from './compact.js';
import * as rods from './rod.js';
import * as sprung from './sprung.js';

export { COLUMNS } from './columns.js';
export { figuresAt } from './mapped.js'; // of maps

/** @import { Chosen, Frame } from '../messages.js' */

// ms for an answer, at every picture: with all that is done besides, no more than 50. Of 900 random beams on machines
// 4 and 8 times as slow as those of today it leaves 54 and 210 to the server, and all is over after 36 and 45 ms; with
// 30 a third more are left, with 40 one has taken 55.
const LONGEST = 35;
const REST = 5000; // ms without an answer, after which memory is given back

/**
 * @typedef {{ follows: (frame: any, name: string) => boolean, is: (frame: any) => boolean,
 *   made: (kernels: Kernels, frame: any, chosen: Chosen) => Frame | null }} Kind
 */
/**
 * Which choices are followed from which answers of the server, and how, by the kind of message.
 * @type {Record<string, Kind[]>}
 */
const KINDS = {
  axial: [
    { follows: rods.follows, is: rods.isRod, made: rods.rodWith },
    { follows: chains.follows, is: chains.isChain, made: chains.chainWith },
    { follows: compacts.follows, is: compacts.isCompact, made: compacts.compactWith },
    { follows: sprung.follows, is: sprung.isSprung, made: sprung.sprungWith },
  ],
  beam: [{ follows: beams.follows, is: beams.isBent, made: beams.beamWith }],
};

/**
 * None where weight acts, which the kernels do not have.
 * @param {Frame} frame
 */
const kindOf = (frame) => (frame.weight ? undefined : KINDS[frame.kind]?.find(({ is }) => is(frame)));

/**
 * Whether kernels can answer what these choices make of an answer of the server.
 * @param {Frame} frame
 * @param {string[]} changed
 */
export function coverable(frame, changed) {
  const kind = kindOf(frame);
  return Boolean(kind) && changed.every((name) => kind?.follows(frame, name));
}

export class Answers {
  rest = 0; // until memory is given back
  late = false; // whether the last answer was none, as it took too long

  /**
   * @param {Kernels} kernels
   * @param {number} longest  ms for an answer
   */
  constructor(kernels, longest) {
    this.kernels = kernels;
    this.longest = longest;
  }
  /**
   * Whether it can answer what these choices make of an answer of the server.
   * @param {Frame} frame
   * @param {string[]} changed
   */
  covers(frame, changed) {
    return coverable(frame, changed);
  }
  /** Give memory back once nothing has been asked for a while. */
  restLater() {
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.kernels.giveBack().catch(() => {}), REST); // or go on with what there is
  }
  /**
   * @param {Frame} frame  of the server, which it covers
   * @param {Chosen} chosen
   * @returns {Frame | null}
   */
  answer(frame, chosen) {
    this.restLater();
    const ask = () => kindOf(frame)?.made(this.kernels, frame, chosen) ?? null;
    const [found, late] = this.kernels.within(this.longest, ask);
    this.late = late;
    return found;
  }
}

/**
 * @param {BufferSource} bytes  of the module
 * @param {number} [longest]  ms for an answer; none where no server answers what takes longer
 */
export const answersOf = async (bytes, longest = Infinity) => new Answers(await kernelsOf(bytes), longest);

/**
 * By a module that is compiled.
 * @param {WebAssembly.Module} module
 */
export async function answersBy(module) {
  const kernels = new Kernels(module);
  await kernels.enter();
  return new Answers(kernels, Infinity);
}

/** @returns {Promise<Answers>} */
export async function ownAnswers() {
  const fetched = await fetch(placeOf('wasm/kernels.wasm'));
  if (!fetched.ok) throw new Error(`no module: ${fetched.status}`);
  return answersOf(await fetched.arrayBuffer(), LONGEST);
}
