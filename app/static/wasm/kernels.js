// The library's own kernels, compiled for browsers: the module, and the room that they work in.
import { OUT, ROOM } from './room.js';

const [PAGE, NUMBER, ALIGNED] = [65536, 8, 64]; // bytes
const CONTACT = 7; // numbers of a contact: as in solvers/numerics/waves/rigid.py

/**
 * @typedef {object} Contact
 * @property {number} start  [T], as is the end
 * @property {number} end
 * @property {number} before  velocity of the mass [v], and after
 * @property {number} after
 * @property {number} peak  force [Z v]
 * @property {number} face  velocity of the struck end just after [v]
 */
/**
 * An impact of a rigid mass on a uniform rod, in units T, v and Z v; of the rod's energy Z v v T.
 * @typedef {object} Impact
 * @property {number} duration
 * @property {number} impulse
 * @property {number} target  velocity of its centre
 * @property {number} compressing  impulse up to the end of compression
 * @property {number} energy  of the rod
 * @property {Contact[]} contacts
 * @property {Record<'waveTime' | 'wave' | 'forceTime' | 'force' | 'mass' | 'end' | 'whole', Float64Array>} histories
 */

export class Kernels {
  /** @param {WebAssembly.Exports} exports */
  constructor(exports) {
    const { __heap_base: heap, memory, rod } = /** @type {any} */ (exports);
    this.memory = /** @type {WebAssembly.Memory} */ (memory);
    this.solve = /** @type {(...numbers: number[]) => number} */ (rod);
    /** @type {Record<string, number>} */
    this.places = {};
    let at = Math.ceil(heap.value / ALIGNED) * ALIGNED;
    this.status = at; // where a kernel leaves what it returns, and why it has failed
    at += ALIGNED;
    for (const [name, size] of Object.entries(ROOM)) {
      this.places[name] = at;
      at += Math.ceil((NUMBER * size) / ALIGNED) * ALIGNED;
    }
    const missing = at - this.memory.buffer.byteLength;
    if (missing > 0) this.memory.grow(Math.ceil(missing / PAGE));
  }
  /**
   * @param {keyof typeof ROOM} name
   * @param {number} [size]
   */
  array(name, size = ROOM[name]) {
    return new Float64Array(this.memory.buffer, this.places[name], size);
  }
  /**
   * @param {number} beta  mass of the rod over that of the striker
   * @param {1 | -1} reflection  of a fixed or a free far end
   * @returns {Impact | null}  nothing where the impact has more contacts than there is room for
   */
  rod(beta, reflection) {
    const { status } = this;
    const failed = this.solve(status, status + NUMBER, beta, reflection, ...Object.values(this.places));
    const [left] = new Int32Array(this.memory.buffer, status, 1);
    if (failed || left) return null;
    const out = this.array('out');
    const rows = this.array('contacts', CONTACT * out[OUT.contacts]);
    const contacts = Array.from({ length: out[OUT.contacts] }, (_, k) => {
      const [start, end, before, after, peak, , face] = rows.subarray(CONTACT * k, CONTACT * (k + 1));
      return { start, end, before, after, peak, face };
    });
    const read = (/** @type {keyof typeof ROOM} */ name, /** @type {number} */ size = ROOM[name]) =>
      this.array(name, size).slice();
    const [wave, force] = [out[OUT.wavePoints], out[OUT.forcePoints]];
    return {
      duration: out[OUT.duration],
      impulse: out[OUT.impulse],
      target: out[OUT.target],
      compressing: out[OUT.compressing],
      energy: out[OUT.energy],
      contacts,
      histories: {
        ...{ waveTime: read('waveTime', wave), wave: read('wave', wave) },
        ...{ forceTime: read('forceTime', force), force: read('force', force) },
        ...{ mass: read('mass'), end: read('end'), whole: read('whole') },
      },
    };
  }
}

/**
 * @param {BufferSource} bytes
 * @returns {Promise<Kernels>}
 */
export async function kernelsOf(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes);
  return new Kernels(instance.exports);
}
