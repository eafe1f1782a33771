// Whether a map follows a hand: one that is at it, or at a slider whose every move makes another map.
const REST = 200; // ms without a move, after which the map is as fine as it can be

export class Grip {
  hand = false; // is at the map
  moved = -Infinity; // when another map was last asked for
  /** @type {number | undefined} */ timer;

  /** @param {() => void} rested */
  constructor(rested) {
    this.rested = rested;
  }
  get holds() {
    return this.hand || performance.now() - this.moved < REST;
  }
  /** Another map is asked for. */
  move() {
    this.moved = performance.now();
    clearTimeout(this.timer);
    this.timer = window.setTimeout(this.rested, REST + 1);
  }
}
