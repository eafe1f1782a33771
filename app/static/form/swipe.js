// Sliders under a finger: a swipe that scrolls the page begins as a drag does, and must not move what it begins on.

const SLOP = 8; // pixels across, from which on a finger drags

/**
 * Have a slider moved by hand; by a finger once it goes across, or is lifted where it came down.
 * @param {HTMLInputElement} range
 * @param {() => void} moved
 */
export function slides(range, moved) {
  /** @type {{ x: number, y: number, value: string } | null} */
  let waits = null; // a finger of which nobody knows yet
  const settle = () => {
    const before = waits?.value;
    waits = null;
    if (before !== undefined && before !== range.value) moved();
  };
  range.oninput = () => {
    if (!waits) moved();
  };
  range.onpointerdown = ({ clientX, clientY, pointerType }) => {
    if (pointerType !== 'mouse') waits = { x: clientX, y: clientY, value: range.value };
  };
  range.onpointermove = ({ clientX, clientY }) => {
    const across = waits && Math.abs(clientX - waits.x);
    if (waits && across && across > Math.max(SLOP, Math.abs(clientY - waits.y))) settle();
  };
  range.onpointerup = settle;
  range.onpointercancel = () => {
    if (waits) range.value = waits.value;
    waits = null;
  };
}
