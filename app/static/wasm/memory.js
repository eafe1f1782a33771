// What kernels work in: an instance of the module with its memory, which grows with what they are given room for and is
// given back; and the clock that they ask, by which none takes longer than is allowed.
import { OUT, ROOM } from './room.js';

const [PAGE, NUMBER, ALIGNED] = [65536, 8, 64]; // bytes
const LATE = new Error('time is over'); // by which a kernel is left

/** @typedef {keyof typeof ROOM} Name  of a kernel */

export class Memory {
  deadline = Infinity; // of an answer, as `performance.now()` has it
  /** @type {WebAssembly.Memory} */ memory;
  /** @type {Record<Name, (...numbers: number[]) => number>} */ exports;
  /** @type {WebAssembly.Global} */ stack;
  /** @type {number} */ top; // of that, where no kernel is at work
  /** @type {number} */ status; // where a kernel leaves what it returns
  /** @type {number} */ first; // bytes of memory
  /** @type {Record<string, Record<string, number>>} */
  places = {}; // of arrays, by kernel: they work one after the other, all in the same room
  /** @type {Record<string, number>} */
  ends = {}; // of that room

  /** @param {WebAssembly.Module} module */
  constructor(module) {
    this.module = module;
  }
  /** Take an instance of the module. */
  async enter() {
    const given = { strikewave: { check_time: () => this.#checkTime() } };
    const { exports } = await WebAssembly.instantiate(this.module, given);
    const { __heap_base: heap, __stack_pointer: stack, memory } = /** @type {any} */ (exports);
    this.exports = /** @type {any} */ (exports);
    this.memory = memory;
    this.stack = stack;
    this.top = stack.value;
    this.status = Math.ceil(heap.value / ALIGNED) * ALIGNED;
    this.first = memory.buffer.byteLength;
    for (const [name, sizes] of Object.entries(ROOM)) this.#lay(name, sizes);
  }
  /**
   * Give the arrays of a kernel their places, one behind the other.
   * @param {string} name
   * @param {Record<string, number>} sizes
   */
  #lay(name, sizes) {
    let at = this.status + ALIGNED;
    this.places[name] = {};
    for (const [array, size] of Object.entries(sizes)) {
      this.places[name][array] = at;
      at += Math.ceil((NUMBER * size) / ALIGNED) * ALIGNED;
    }
    this.ends[name] = at;
  }
  /** Take a new instance where the memory has grown: it never shrinks. */
  async giveBack() {
    if (this.memory.buffer.byteLength > this.first) await this.enter();
  }
  /**
   * What is asked of kernels, and whether they were left, as all of it took longer than that.
   * @template T
   * @param {number} longest  ms
   * @param {() => T} ask
   * @returns {[found: T | null, late: boolean]}
   */
  within(longest, ask) {
    this.deadline = performance.now() + longest;
    try {
      return [ask(), false];
    } catch (error) {
      if (error !== LATE) throw error;
      this.restore();
      return [null, true];
    } finally {
      this.deadline = Infinity;
    }
  }
  /** Begin anew after a kernel that was left, or has failed, in the middle. */
  restore() {
    this.stack.value = this.top;
  }
  #checkTime() {
    if (performance.now() > this.deadline) throw LATE;
  }
  /**
   * Room for what a kernel is given and gives, made when it is first asked for; whether there is any.
   * @param {Name} name
   */
  roomFor(name) {
    const missing = this.ends[name] - this.memory.buffer.byteLength;
    if (missing <= 0) return true;
    try {
      this.memory.grow(Math.ceil(missing / PAGE));
    } catch {
      return false; // a small device: others go on
    }
    return true;
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
   * Call a kernel; nothing where it has failed, or an impact takes more than there is room for.
   * @param {Name} name
   * @param {...number} numbers
   */
  call(name, ...numbers) {
    this.#checkTime();
    return this.roomFor(name) && this.#solved(name, numbers) ? this.#left(name) : null;
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
