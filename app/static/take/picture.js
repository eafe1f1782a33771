// What is seen of an impact, as a file: bodies, rows and force with the words beside them, as PNG, SVG or a clip.
import { contextOf, divert, letters } from '../charts/canvas.js';
import { COLORS } from '../charts/styles.js';
import { svgContext } from '../charts/svg.js';
import { make } from '../browser/dom.js';

/** @import { Page } from '../page.js' */
/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {{ canvas: HTMLCanvasElement, box: DOMRect }} Layer */

const PARTS = '.ask, .caption, .stages, .section, .strip, .happens, .lens';
const SILENT = '.unseen, .tools, .stepper > button, .whatif-work > button, [role="tooltip"]';
const EDGE = 16; // pixels around
const LINE = 20; // below, where it says whose it is

/**
 * @typedef {object} Scope  what is taken along
 * @property {Element[]} all  parts of the page
 * @property {boolean} signed  with room around it, and a word of whose it is
 * @property {(diverted: boolean) => void} redraw  all its canvases
 * @property {(c: Context) => void} [more]  what is neither words nor on a canvas
 */

/**
 * @param {Page} page
 * @param {Element} [one]  of its parts, alone: with nothing around it, and no word of whose it is
 * @returns {Scope}
 */
export const scopeOf = (page, one) => ({
  ...{ all: one ? [one] : [...page.root.querySelectorAll(PARTS)], signed: !one },
  redraw: () => page.redraw(),
});

/** @param {Scope} scope */
function partsOf({ all, more, redraw, signed }) {
  const parts = all.filter((part) => part.checkVisibility() && part.clientHeight);
  const [edge, line] = signed ? [EDGE, LINE] : [0, 0];
  const boxes = parts.map((part) => part.getBoundingClientRect());
  const [left, top] = [Math.min(...boxes.map((box) => box.left)), Math.min(...boxes.map((box) => box.top))];
  const width = Math.max(...boxes.map(({ right }) => right)) - left + 2 * edge;
  const height = Math.max(...boxes.map(({ bottom }) => bottom)) - top + 2 * edge + line;
  const canvases = parts.flatMap(canvasesIn);
  const layers = canvases.map((canvas) => ({ canvas, box: canvas.getBoundingClientRect() }));
  const seen = layers.filter(({ canvas, box }) => canvas.checkVisibility() && box.width && box.height);
  return { parts, layers: seen, left: left - edge, top: top - edge, width, height, more, redraw, signed };
}

/**
 * Also those of figures, which have roots of their own.
 * @param {Element | ShadowRoot} part
 * @returns {HTMLCanvasElement[]}
 */
const canvasesIn = (part) =>
  [...part.querySelectorAll('*')].flatMap((each) =>
    each.shadowRoot ? canvasesIn(each.shadowRoot) : each.matches('canvas') ? /** @type {any} */ (each) : [],
  );

/**
 * A colour that is mixed in a style sheet, as anything reads it.
 * @param {string} color
 */
function plain(color) {
  const [, ...parts] = /^color\(srgb ([\d.]+) ([\d.]+) ([\d.]+)/.exec(color) ?? [];
  return parts.length ? `rgb(${parts.map((part) => Math.round(255 * Number(part))).join(',')})` : color;
}

/**
 * Letters as those of an element.
 * @param {Context} c
 * @param {Element} around
 */
function letter(c, around) {
  const { color, fontFamily, fontSize, fontWeight } = getComputedStyle(around);
  c.font = `${100 * Math.round(Number(fontWeight) / 100)} ${fontSize} ${fontFamily}`;
  c.fillStyle = plain(color);
}

/**
 * Where words are cut off that have no room.
 * @param {Element} around
 */
const endOf = (around) =>
  getComputedStyle(around).textOverflow === 'ellipsis' ? around.getBoundingClientRect().right + 1 : Infinity;

/**
 * What is chosen or typed in a field, which is no text of the page.
 * @param {Context} c
 * @param {HTMLInputElement | HTMLSelectElement} field
 */
function writeField(c, field) {
  if (!field.checkVisibility() || field.closest(SILENT) || ['range', 'checkbox', 'radio'].includes(field.type)) return;
  const box = field.getBoundingClientRect();
  const words = ('selectedOptions' in field ? field.selectedOptions[0]?.textContent : field.value) ?? '';
  letter(c, field);
  const { paddingLeft, paddingRight, textAlign } = getComputedStyle(field);
  const { fontBoundingBoxAscent: up, fontBoundingBoxDescent: down, width } = c.measureText(words);
  const spare = box.width - width;
  const right = spare - (parseFloat(paddingRight) || 0);
  const from = { right, end: right, center: spare / 2 }[textAlign] ?? (parseFloat(paddingLeft) || 0);
  c.fillText(words, box.left + from, box.top + 0.5 * (box.height + up - down));
}

/**
 * The words of a part of the page, each where it stands, also those of figures.
 * @param {Context} c
 * @param {Element | ShadowRoot} part
 * @param {{ bottom: number, top: number }} box  of what is seen of it
 */
function write(c, part, { bottom, top }) {
  for (const { shadowRoot } of part.querySelectorAll('*')) if (shadowRoot) write(c, shadowRoot, { bottom, top });
  const texts = document.createTreeWalker(part, NodeFilter.SHOW_TEXT + NodeFilter.SHOW_ELEMENT);
  const range = document.createRange();
  c.textAlign = 'left';
  c.textBaseline = 'alphabetic';
  for (let node = texts.nextNode(); node; node = texts.nextNode()) {
    const { parentElement: around, textContent } = node;
    if (node instanceof Element) {
      if (node.matches('input, select')) writeField(c, /** @type {HTMLInputElement} */ (node));
      continue;
    }
    if (!around?.checkVisibility() || around.closest(SILENT) || around.closest('option')) continue;
    letter(c, around);
    const end = endOf(around);
    for (const { 0: word, index } of (textContent ?? '').matchAll(/\S+/g)) {
      range.setStart(node, index);
      range.setEnd(node, index + word.length);
      const box = range.getBoundingClientRect();
      if (!box.width || box.top < top - 1 || box.bottom > bottom + 1) continue; // it is scrolled away
      const { fontBoundingBoxAscent: up, fontBoundingBoxDescent: down } = c.measureText(word);
      const base = box.top + 0.5 * (box.height + up - down);
      if (box.right > end) {
        c.fillText('…', Math.min(box.left, end - c.measureText('…').width), base);
        break;
      }
      c.fillText(word, box.left, base);
    }
  }
}

/**
 * All of it.
 * @param {Context} c
 * @param {Page} page
 * @param {ReturnType<typeof partsOf>} seen
 * @param {(layer: Layer) => void} draw  what a canvas shows, in its place
 */
function compose(c, page, { height, layers, left, more, parts, signed, top, width }, draw) {
  c.fillStyle = COLORS.panel;
  c.fillRect(0, 0, width, height);
  c.save();
  c.translate(-left, -top);
  for (const layer of layers) draw(layer);
  more?.(c);
  for (const part of parts) write(c, part, part.getBoundingClientRect());
  c.restore();
  if (!signed) return;
  c.font = letters(13);
  c.fillStyle = COLORS.faint;
  c.textAlign = 'right';
  c.fillText(`${page.controls.scene.title.textContent} · Strikewave`, width - EDGE, height - EDGE);
}

/**
 * Every canvas drawn once more, by something else.
 * @template {Context} C
 * @param {Page} page
 * @param {ReturnType<typeof partsOf>} seen
 * @param {(box: DOMRect) => C} made
 */
function redrawn(page, { layers, redraw }, made) {
  const here = page.root.getRootNode();
  const own = layers.filter(({ canvas }) => canvas.getRootNode() === here); // a figure is drawn by others
  const drawn = new Map(own.map(({ box, canvas }) => [canvas, made(box)]));
  try {
    for (const [canvas, c] of drawn) divert(canvas, c);
    redraw(true);
  } finally {
    for (const canvas of drawn.keys()) divert(canvas, null);
    redraw(false);
  }
  return drawn;
}

/**
 * A canvas for all of it.
 * @param {Page} page
 * @param {number} fine  pixels of the canvas for one of the page
 * @param {{ width: number, height: number }} [seen]
 */
export function canvasOf(page, fine, { height, width } = partsOf(scopeOf(page))) {
  const even = (/** @type {number} */ size) => 2 * Math.ceil((fine * size) / 2); // as films must be
  const canvas = make('canvas', { width: even(width), height: even(height) });
  const c = contextOf(canvas);
  c.scale(fine, fine);
  return { canvas, c };
}

/**
 * What is seen just now, as the page has drawn it.
 * @param {Page} page
 * @param {Context} c
 */
export function copy(page, c) {
  c.save();
  c.resetTransform();
  c.fillStyle = COLORS.panel;
  c.fillRect(0, 0, c.canvas.width, c.canvas.height); // the page may have grown narrower
  c.restore();
  const draw = (/** @type {Layer} */ { box, canvas }) => c.drawImage(canvas, box.left, box.top, box.width, box.height);
  compose(c, page, partsOf(scopeOf(page)), draw);
}

/**
 * What is seen just now, drawn with more pixels than the page has.
 * @param {Page} page
 * @param {number} fine
 * @param {Scope} [scope]
 */
export function pictureOf(page, fine, scope = scopeOf(page)) {
  const seen = partsOf(scope);
  const drawn = redrawn(page, seen, ({ height, width }) => {
    const c = contextOf(make('canvas', { width: fine * width, height: fine * height }));
    c.scale(fine, fine);
    return c;
  });
  const { c, canvas: picture } = canvasOf(page, fine, seen);
  compose(c, page, seen, ({ box, canvas }) => {
    c.drawImage(drawn.get(canvas)?.canvas ?? canvas, box.left, box.top, box.width, box.height);
  });
  return picture;
}

/**
 * What is seen just now as SVG.
 * @param {Page} page
 * @param {Scope} [scope]
 */
export function svgOf(page, scope = scopeOf(page)) {
  const seen = partsOf(scope);
  const drawn = redrawn(page, seen, ({ height, width }) => svgContext(width, height));
  const c = svgContext(seen.width, seen.height);
  compose(c, page, seen, ({ box, canvas }) => {
    const image = drawn.get(canvas)?.canvas; // which is itself
    if (image) c.drawImage(image, box.left, box.top);
  });
  return c.get_serialized_svg();
}
