// The browser's own answers, by the library's kernels: exact at every picture while a slider moves. Fetched once the
// page stands; where it cannot be, the server answers alone.
import { kernelsOf } from './kernels.js';
import { follows, isRod, rodWith } from './rod.js';

/** @import { Chosen, Frame } from '../messages.js' */
/** @import { Kernels } from './kernels.js' */

class Answers {
  /** @param {Kernels} kernels */
  constructor(kernels) {
    this.kernels = kernels;
  }
  /**
   * Whether it can answer what these choices make of an answer of the server.
   * @param {Frame} frame
   * @param {string[]} changed
   */
  covers(frame, changed) {
    return frame.kind === 'axial' && changed.every((name) => follows(frame, name)) && isRod(frame);
  }
  /**
   * @param {Frame} frame  of the server, which it covers
   * @param {Chosen} chosen
   * @returns {Frame | null}
   */
  answer(frame, chosen) {
    return frame.kind === 'axial' ? rodWith(this.kernels, frame, chosen) : null;
  }
}

/** @param {BufferSource} bytes  of the module */
export const answersOf = async (bytes) => new Answers(await kernelsOf(bytes));

/** @returns {Promise<Answers>} */
export async function ownAnswers() {
  const fetched = await fetch(new URL('kernels.wasm', import.meta.url));
  if (!fetched.ok) throw new Error(`no module: ${fetched.status}`);
  return answersOf(await fetched.arrayBuffer());
}
