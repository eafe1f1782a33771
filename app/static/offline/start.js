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
  const { messages: packs, sizes, ...head } = JSON.parse(new TextDecoder().decode(new Uint8Array(whole, 4, at - 4)));
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
  return { ...head, messages: await Promise.all(messages) };
};

/** @type {{ languages: Record<string, { direction: string, name: string, lost: string }> }} */
const { languages } = JSON.parse(document.getElementById('session')?.textContent ?? '{}');

/** What the switch has kept: as app/static/frame/language.js does. */
const chosen = () => {
  try {
    return JSON.parse(window.localStorage.getItem('strikewave.language') ?? '""');
  } catch {
    return ''; // where nothing may be kept
  }
};

/** The one that the address asks for, else that of the switch, else of the browser: as app/serving/language.py. */
const languageOf = () => {
  const one = new URLSearchParams(window.location.search).getAll('language').at(-1) || chosen();
  const wanted = (one ? [String(one)] : navigator.languages).flatMap((tag) => [tag, tag.split('-')[0]]);
  const found = wanted.map((tag) => Object.keys(languages).find((each) => each.toLowerCase() === tag.toLowerCase()));
  return found.find(Boolean) ?? document.documentElement.lang;
};

const language = languageOf();
document.documentElement.lang = language;
document.documentElement.dir = languages[language].direction;

const begin = async () => {
  const all = /** @type {any} */ (window);
  const { codes, said, ...carried } = await scenesOf(await unpacked(all.strikewavePacked));
  const { lessons, listed, texts } = said[language];
  const pairs = codes.map((/** @type {string} */ code, /** @type {number} */ k) => [code, texts[k]]);
  const others = Object.entries(languages).flatMap(([code, { name }]) => (code === language ? [] : [[code, name]]));
  all.strikewaveTexts = {
    language,
    others: Object.fromEntries(others),
    texts: Object.fromEntries(pairs.filter((/** @type {[string, string | null]} */ [, text]) => text !== null)),
  };
  document.title = all.strikewaveTexts.texts['document.title'];
  const module = () => unpacked(all.strikewaveKernels);
  const worker = () => unpacked(all.strikewaveWorker);
  const gallery = { ...carried.gallery, lessons: listed };
  all.strikewaveCarried = /** @type {Carried} */ ({ ...carried, gallery, lessons, module, worker });
  all.strikewavePanels = [];
  await all.strikewavePage();
};

const say = (/** @type {unknown} */ error) => {
  const { strikewaveTexts } = /** @type {any} */ (window);
  const code = error instanceof Error ? error.message : '';
  const textContent = strikewaveTexts?.texts[code] ?? languages[language].lost;
  const closed = Object.assign(document.createElement('p'), { className: 'closed', textContent });
  document.getElementById('still')?.remove();
  document.getElementById('lab')?.replaceChildren(closed);
};

begin().catch(say);
