// Unpack what came with the page, where there is no server, and begin; or say why it cannot be. It is no module, and
// nothing is fetched: browsers allow neither to pages from the disk.

/** @import { Carried } from '../browser/home.js' */
/** @typedef {[header: number, arrays: number[]]} Pack  of a message: bytes, and which arrays follow */

const [FIRST, BITS] = [0x4000, 15]; // of letters: as in app/serving/folder.py

/**
 * What a script carries.
 * @param {[size: number, letters: string]} packed
 */
const unpacked = async ([size, letters]) => {
  const bytes = new Uint8Array(size);
  let [held, waiting, at] = [0, 0, 0];
  for (let k = 0; k < letters.length; k++) {
    held = (held << BITS) | (letters.charCodeAt(k) - FIRST);
    for (waiting += BITS; waiting >= 8; bytes[at++] = held >> waiting) waiting -= 8; // past the end nothing is written
    held &= (1 << waiting) - 1;
  }
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
};

/**
 * A head in JSON, and behind it the headers and the arrays of messages, as app/serving/folder.py has packed them.
 * @param {ArrayBuffer} whole
 */
const scenesOf = async (whole) => {
  let at = 4 + new DataView(whole).getUint32(0, true);
  const {
    messages: packs,
    sizes,
    texts,
    ...head
  } = JSON.parse(new TextDecoder().decode(new Uint8Array(whole, 4, at - 4)));
  const cut = (/** @type {number} */ size) => {
    at += size;
    return new Uint8Array(whole, at - size, size);
  };
  const headers = packs.map((/** @type {Pack} */ [size]) => cut(size));
  const arrays = sizes.map(cut);
  const messages = packs.map((/** @type {Pack} */ [size, numbers], /** @type {number} */ k) => {
    const begins = new Uint8Array(new Uint32Array([size]).buffer);
    return new Blob([begins, headers[k], ...numbers.map((n) => arrays[n])]).arrayBuffer();
  });
  return { texts, carried: /** @type {Carried} */ ({ ...head, messages: await Promise.all(messages) }) };
};

const begin = async () => {
  const all = /** @type {any} */ (window);
  const { carried, texts } = await scenesOf(await unpacked(all.strikewavePacked));
  const module = () => unpacked(all.strikewaveKernels);
  Object.assign(all, { strikewaveTexts: texts, strikewaveCarried: { ...carried, module }, strikewavePanels: [] });
  await all.strikewavePage();
};

const say = (/** @type {unknown} */ error) => {
  const { lost } = JSON.parse(document.getElementById('session')?.textContent ?? '{}');
  const { strikewaveTexts } = /** @type {any} */ (window);
  const code = error instanceof Error ? error.message : '';
  const textContent = strikewaveTexts?.texts[code] ?? lost;
  const closed = Object.assign(document.createElement('p'), { className: 'closed', textContent });
  document.getElementById('still')?.remove();
  document.getElementById('lab')?.replaceChildren(closed);
};

begin().catch(say);
