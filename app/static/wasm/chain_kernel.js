// The kernel for rods one behind the other: what it is given, and what it gives.
import { rowsOf } from './kernels.js';
import { ROOM } from './room.js';

/** @import { AxialFrame, RodRecord } from '../messages.js' */
/** @import { Contact, Kernels } from './kernels.js' */

const CONTACT = 5; // numbers of a contact: as in solvers/numerics/waves/law_drawn.py
const GAP = 3;

/**
 * An impact on rods, in units T, v and Z v; of energies Z v v T.
 * @typedef {object} ChainImpact
 * @property {number} duration
 * @property {number} impulse
 * @property {number} final  velocity of the mass centre of what strikes
 * @property {number} target  and of the target
 * @property {number} apart  with which the faces part
 * @property {number} compressing  impulse up to the end of compression
 * @property {number} first  energy before the impact
 * @property {number} striker  energy of what strikes
 * @property {number} energy  of the target
 * @property {number} wholes  of its parts that nothing holds, as wholes
 * @property {number} faded  whether nothing is left that could part them: 1
 * @property {number} steps
 * @property {Contact[]} contacts
 * @property {number[][]} gaps  that have been closed
 * @property {[time: Float64Array, wave: Float64Array][]} waves  of the left and the right end of each rod
 * @property {Float64Array} forceTime
 * @property {Float64Array} force
 * @property {Float64Array} mass  positions at even times: of the face of what strikes
 * @property {Float64Array} end
 * @property {Float64Array} whole
 */

/**
 * @param {Kernels} kernels
 * @param {Pick<RodRecord, 'impedance' | 'transit' | 'drift'>[]} rods
 * @param {NonNullable<AxialFrame['chain']>} chain  gaps in v T
 * @param {number} mass  [Z T] of what strikes, 0: a rod
 * @param {number} end  on the far end
 * @returns {ChainImpact | null}
 */
export function chainImpact(kernels, rods, { asked, gaps, kinds }, mass, end) {
  if (rods.length >= kinds.length || kinds.length > ROOM.chain.knots / 2 || !kernels.roomFor('chain')) return null;
  const rows = [rods.map((rod) => rod.impedance), rods.map((rod) => rod.transit), rods.map((rod) => rod.drift)];
  kernels.array('chain', 'links', ROOM.chain.links).set(rows.flat());
  kernels.array('chain', 'knots', ROOM.chain.knots).set([...kinds, ...gaps]);
  const called = kernels.call('chain', rods.length, mass ? 0 : 1, mass, end, asked);
  if (!called) return null;
  const { figures, read } = called;
  const { apart, closed, compressing, contacts, duration, energy, faded, final, first, forcePoints } = figures;
  const { impulse, steps, striker, target, wholes } = figures;
  const [sent, time, wave] = [read('sent', 2 * rods.length + 1), read('waveTime'), read('wave')];
  const touched = rowsOf(CONTACT, contacts, read);
  return {
    ...{ apart, compressing, duration, energy, faded, final, first, impulse, steps, striker, target, wholes },
    contacts: touched.map(([start, until, push, peak, after]) => ({ start, end: until, push, peak, after })),
    gaps: rowsOf(GAP, closed, (_, size) => read('gaps', size)),
    waves: Array.from({ length: 2 * rods.length }, (_, k) => [
      time.slice(sent[k], sent[k + 1]),
      wave.slice(sent[k], sent[k + 1]),
    ]),
    ...{ forceTime: read('forceTime', forcePoints), force: read('force', forcePoints) },
    ...{ mass: read('impactor'), end: read('face'), whole: read('whole') },
  };
}
