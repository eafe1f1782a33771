// Scenes of the visitor's own: the name of one is the text of its file, packed, so that a link needs nothing else.
import { keep, kept } from '../browser/store.js';

const MARK = 'own.'; // with which their names begin
const KEPT = 'scenes'; // under which the browser keeps them
const MOST = 8; // of these
export const LONGEST = 3000; // letters of a name
export const MOST_BYTES = 20_000; // of its file

/** @typedef {{ title: string, name: string }} Own */

/** @param {unknown} scene  the name of any */
export const isOwn = (scene) => String(scene).startsWith(MARK);

/**
 * What a file with a scene is called.
 * @param {unknown} scene
 */
export const fileOf = (scene) => (isOwn(scene) ? 'own-scene' : String(scene));

/**
 * @param {BlobPart} content
 * @param {CompressionStream | DecompressionStream} way
 */
const through = async (content, way) =>
  new Uint8Array(await new Response(new Blob([content]).stream().pipeThrough(way)).arrayBuffer());

/**
 * The name of a scene by the text of its file.
 * @param {string} toml
 */
export async function nameOf(toml) {
  const packed = await through(toml, new CompressionStream('deflate-raw'));
  const base = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(''));
  return MARK + base.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/**
 * The text of its file.
 * @param {string} name
 */
export async function textOf(name) {
  const packed = atob(name.slice(MARK.length).replaceAll('-', '+').replaceAll('_', '/'));
  const bytes = Uint8Array.from(packed, (letter) => letter.charCodeAt(0));
  return new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw')));
}

/** @returns {Own[]}  the newest first */
export const ownScenes = () => kept(KEPT, /** @type {Own[]} */ ([])).filter(({ name }) => isOwn(name));

/** @param {Own} scene */
export const keepOwn = (scene) =>
  keep(KEPT, [scene, ...ownScenes().filter(({ name }) => name !== scene.name)].slice(0, MOST));

/** @param {string} name */
export const forget = (name) => keep(KEPT, ownScenes().filter((scene) => scene.name !== name)); // prettier-ignore
