// Drawings that follow the same hand, one in a frame: two in one would take longer than it lasts.

/** @type {Set<() => void>} */ const waiting = new Set(); // the one that waits longest first
let due = 0;

function next() {
  const [draw] = waiting;
  waiting.delete(draw);
  due = waiting.size && requestAnimationFrame(next);
  draw();
}

/**
 * @param {() => void} draw  once, however often it is asked for until then
 * @returns {true}  it is due
 */
export function inTurn(draw) {
  waiting.add(draw);
  due ||= requestAnimationFrame(next);
  return true;
}
