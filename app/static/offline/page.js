// The page without a server: its kernels, and what stands for the component of Panel. An error says by its code why
// there is no page.
import { Page } from '../page.js';
import { carried } from '../browser/home.js';
import { answersOf } from '../wasm/answers.js';
import { Offline } from './model.js';

/** @import { Carried } from '../browser/home.js' */

const SECTION = 'fingerprint'; // in which a module names its sources: as in app/wasm/module.py

/**
 * The answers of kernels that are of the same sources as the page.
 * @param {Carried} carried
 */
async function kernelsOf({ kernels: sources, module: unpacked }) {
  const bytes = await unpacked().catch(() => new ArrayBuffer(0));
  const module = await WebAssembly.compile(bytes).catch(() => null);
  if (!module) throw new Error('offline.no-module');
  const [named] = WebAssembly.Module.customSections(module, SECTION);
  if (!named || new TextDecoder().decode(named) !== sources) throw new Error('offline.other-version');
  return answersOf(bytes).catch(() => {
    throw new Error('offline.no-module');
  });
}

const came = /** @type {Carried} */ (carried);
const { model } = new Offline(came, await kernelsOf(came), window.location.search);
new Page(model, /** @type {HTMLElement} */ (document.getElementById('lab')));
