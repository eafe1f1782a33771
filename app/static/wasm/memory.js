// What kernels work in: an instance of the module with its memory, which grows with the steps that they may take and is
// given back; and how many steps these are, by the pace of this device.
import { GROWS, MOST, OUT, ROOM } from './room.js';

const [PAGE, NUMBER, ALIGNED] = [65536, 8, 64]; // bytes
const SPARE = 2; // as in app/wasm/entry.py
// Work in a millisecond that any device does, a small part of what a laptop does, until it is known what this one
// does: steps of a march times what each takes, and stretches of waves.
const CAUTIOUS = { modes: 100_000, beam: 100_000, law: 30, chain: 30 };
const [KNOWN, LEAST] = [15, 5]; // answers that the pace is found of, and ms for each at least at the cautious one

/** @typedef {keyof typeof ROOM} Name  of a kernel */
/** @typedef {keyof typeof GROWS} Growing  of one whose room grows */

/**
 * Places of arrays one behind the other, and where they end.
 * @param {number} at
 * @param {Record<string, number>} sizes
 * @param {number} times
 * @returns {[places: Record<string, number>, end: number]}
 */
function laid(at, sizes, times = 1) {
  /** @type {Record<string, number>} */
  const places = {};
  for (const [array, size] of Object.entries(sizes)) {
    places[array] = at;
    at += Math.ceil((NUMBER * size * times) / ALIGNED) * ALIGNED;
  }
  return [places, at];
}

export class Memory {
  /** @type {Record<string, number[]>} */ paces = {}; // of the last answers, by kernel and law
  /** @type {WebAssembly.Memory} */ memory;
  /** @type {Record<Name, (...numbers: number[]) => number>} */ exports;
  /** @type {number} */ status; // where a kernel leaves what it returns
  /** @type {number} */ first; // bytes of memory
  /** @type {Record<string, Record<string, number>>} */
  places = {}; // of each kernel: they work one after the other, all in the same room
  /** @type {Record<string, number>} */
  ends = {}; // of that room, without what grows

  /**
   * @param {WebAssembly.Module} module
   * @param {WebAssembly.Instance} instance  of it
   * @param {number} longest  ms for a kernel: none takes on what takes longer
   */
  constructor(module, instance, longest) {
    this.module = module;
    this.longest = longest;
    this.#enter(instance);
    for (const [name, sizes] of Object.entries(ROOM))
      [this.places[name], this.ends[name]] = laid(this.status + ALIGNED, sizes);
  }
  /** @param {WebAssembly.Instance} instance */
  #enter({ exports }) {
    const { __heap_base: heap, memory } = /** @type {any} */ (exports);
    this.exports = /** @type {any} */ (exports);
    this.memory = memory;
    this.status = Math.ceil(heap.value / ALIGNED) * ALIGNED;
    this.first = memory.buffer.byteLength;
  }
  /** Take a new instance where the memory has grown: it never shrinks. */
  async giveBack() {
    if (this.memory.buffer.byteLength > this.first) this.#enter(await WebAssembly.instantiate(this.module));
  }
  /**
   * Memory up to there, made when it is first asked for; whether there is any.
   * @param {number} end
   */
  #reach(end) {
    const missing = end - this.memory.buffer.byteLength;
    if (missing <= 0) return true;
    try {
      this.memory.grow(Math.ceil(missing / PAGE));
    } catch {
      return false; // a small device: others go on
    }
    return true;
  }
  /**
   * Room for what a kernel is given and gives; whether there is any.
   * @param {Name} name
   */
  roomFor(name) {
    return this.#reach(this.ends[name]);
  }
  /**
   * @param {Name} name
   * @param {string} array
   * @param {number} size
   */
  array(name, array, size) {
    return new Float64Array(this.memory.buffer, this.places[name][array], size);
  }
  /**
   * Call a kernel; nothing where it has failed, or an impact has more contacts than there is room for.
   * @param {Name} name
   * @param {...number} numbers
   */
  call(name, ...numbers) {
    return this.roomFor(name) && this.#solved(name, numbers) ? this.#left(name) : null;
  }
  /**
   * Call one that takes as many steps as an impact needs; nothing either where these are more than are allowed.
   * @param {Growing} name
   * @param {string} law  through which bodies touch: some take twice as long
   * @param {number} work  that a step is
   * @param {number} parts  that take as many steps each
   * @param {...number} numbers
   */
  follow(name, law, work, parts, ...numbers) {
    const steps = Math.min(MOST[name], Math.floor((this.longest * this.pace(name, law)) / work));
    const [growing, end] = laid(this.ends[name], GROWS[name], parts * (steps + SPARE));
    if (!this.#reach(end)) return null;
    Object.assign(this.places[name], growing);
    const done = this.array(name, 'done', 1).fill(0);
    const begun = performance.now();
    const solved = this.#solved(name, [...numbers, steps]);
    const took = performance.now() - begun;
    const known = (this.paces[name + law] ??= []);
    const worked = done[0] * work;
    if (worked > LEAST * CAUTIOUS[name]) known.push(worked / took);
    if (known.length > KNOWN || (!solved && !done[0])) known.shift(); // what is refused at once is tried again in time
    return solved ? this.#left(name) : null;
  }
  /**
   * Work that a kernel does in a millisecond: the median of the last answers.
   * @param {Growing} name
   * @param {string} law
   */
  pace(name, law) {
    const all = [CAUTIOUS[name], ...(this.paces[name + law] ?? [])].sort((a, b) => a - b);
    return all[all.length >> 1];
  }
  /**
   * @param {Name} name
   * @param {number[]} numbers
   */
  #solved(name, numbers) {
    const { status } = this;
    const failed = this.exports[name](status, status + NUMBER, ...numbers, ...Object.values(this.places[name]));
    const [left] = new Int32Array(this.memory.buffer, status, 1);
    return !failed && !left;
  }
  /**
   * What it has left.
   * @param {Name} name
   */
  #left(name) {
    /** @type {Record<string, number>} */
    const sizes = ROOM[name];
    const out = this.array(name, 'out', sizes.out);
    const read = (/** @type {string} */ array, size = sizes[array]) => this.array(name, array, size).slice();
    /** @type {Record<string, number>} */
    const figures = Object.fromEntries(Object.entries(OUT[name]).map(([each, place]) => [each, out[place]]));
    return { figures, read };
  }
}
