// Canvases as large as the elements that hold them, and letters on them as large as those around.

const ROOT_PIXELS = 16; // of a letter where nobody wants them larger
const NARROW = 260; // pixels of a window in which words of the usual size find room on a picture
const LARGER = 1.3; // times, before a projector
/** How much larger letters are than where nobody wants them larger; no larger on pictures than these have room for. */
export const wanted = globalThis.document
  ? Math.min(
      parseFloat(getComputedStyle(document.documentElement).fontSize) / ROOT_PIXELS,
      Math.max(window.innerWidth / NARROW, 1),
    )
  : 1;
/** Whether a lesson is before a projector, as its address says. */
export const projected = ['lesson', 'projector'].every((name) =>
  new URLSearchParams(globalThis.location?.search).has(name),
);
/** The same, of pictures. */
export const scale = wanted * (projected ? LARGER : 1);

/**
 * A font for a canvas.
 * @param {number} pixels  where nobody wants letters larger
 */
export const letters = (pixels, weight = '') => `${weight}${pixels * scale}px system-ui, sans-serif`;

/** @type {WeakMap<Element, [number, number] | null>} */
const sizes = new WeakMap();
/** @type {ResizeObserver | undefined} */
let resized;
const RESIZED = new EventTarget();

/**
 * Have something done whenever an element that was to be drawn on has another size, as when a chart above it is hidden,
 * or has one at last.
 * @param {() => void} act
 * @returns {() => void}  what ends it
 */
export function whenResized(act) {
  RESIZED.addEventListener('resize', act);
  return () => RESIZED.removeEventListener('resize', act);
}

/**
 * Width and height of an element, read anew only once it has changed: to read them the browser must lay out the page.
 * @param {Element} root
 * @returns {[width: number, height: number]}
 */
export function sizeOf(root) {
  resized ??= new ResizeObserver((entries) => {
    let other = false;
    for (const { target } of entries) {
      const [width, height] = sizes.get(target) ?? [0, 0];
      other ||= width !== target.clientWidth || height !== target.clientHeight;
      sizes.set(target, null);
    }
    if (other) RESIZED.dispatchEvent(new Event('resize'));
  });
  if (!sizes.has(root)) resized.observe(root);
  const known = sizes.get(root);
  if (known) return known;
  /** @type {[number, number]} */
  const size = [root.clientWidth, root.clientHeight];
  sizes.set(root, size[0] && size[1] ? size : null);
  return size;
}

/**
 * What to draw on a canvas with.
 * @param {HTMLCanvasElement} canvas
 */
export function contextOf(canvas) {
  const c = canvas.getContext('2d');
  if (!c) throw new Error('this browser gives no canvas to draw on');
  return c;
}

/** @type {WeakMap<HTMLCanvasElement, CanvasRenderingContext2D>} */
const elsewhere = new WeakMap();

/**
 * Have what is drawn on a canvas drawn by something else, which makes a file of it, or on the canvas again.
 * @param {HTMLCanvasElement} canvas
 * @param {CanvasRenderingContext2D | null} c
 */
export function divert(canvas, c) {
  if (c) elsewhere.set(canvas, c);
  else elsewhere.delete(canvas);
}

/**
 * Make a canvas so large, in pixels of the page; returns how many of its own stand for one of these.
 * @param {HTMLCanvasElement} canvas
 * @param {number} width
 * @param {number} height
 */
export function sized(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== across || canvas.height !== down) Object.assign(canvas, { width: across, height: down });
  return ratio;
}

/**
 * Wipe a canvas, to be drawn on in pixels of the page.
 * @param {HTMLCanvasElement} canvas
 * @param {number} width
 * @param {number} height
 * @param {number} ratio
 */
export function wiped(canvas, width, height, ratio) {
  const other = elsewhere.get(canvas);
  if (other) return other;
  const c = contextOf(canvas);
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, width, height);
  return c;
}

/**
 * A canvas as large as its element, wiped: what to draw with, and the size in pixels of the page; null while hidden.
 * @param {HTMLCanvasElement} canvas
 * @param {Element} root
 */
export function cleared(canvas, root) {
  const [width, height] = sizeOf(root);
  if (!width || !height) return null;
  return { c: wiped(canvas, width, height, sized(canvas, width, height)), width, height };
}
