// Texts and the list of panels: the document has loaded them, or, as somebody else's, has not.
import { placeOf } from '../place.js';

const all = /** @type {any} */ (globalThis);
if (!all.strikewaveTexts) await import(placeOf('text/en.js'));
/** @type {{ language: string, others?: Record<string, string>, texts: Record<string, string> }} */
export const CATALOGUE = all.strikewaveTexts;
/** @type {[name: string, module: string, kinds: string[]][]} */
export const LISTED = all.strikewavePanels;
