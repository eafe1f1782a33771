// What the kinds of impacts hand to the comparison, which knows none of them.
import { compared as axial } from './axial/compared.js';
import { compared as beam } from './beam/compared.js';
import { compared as bodies } from './space/compared.js';

export const COMPARED = { axial, beam, mechanism: beam, bodies };
