// The library's own kernels, compiled for browsers: what they are given, and what they give.
import { Memory } from './memory.js';
import { DASHPOTS, LAWS, ROOM } from './room.js';

// numbers of a contact: as in solvers/numerics/waves/rigid.py and law_drawn.py, and modal_drawn.py
const CONTACT = { rod: 7, law: 5, modes: 5 };
const MODES = { own: 0, stiff: 1, given: 2 }; // as in app/wasm/modal_entries.py
const BESIDE = { power: 0, sine: 1, path: 2, damped: 3 }; // two compact bodies: solvers/numerics/compact_drawn.py

// of a beam: as in solvers/numerics/modal_drawn.py
const HISTORIES = /** @type {const} */ (['time', 'impactor', 'struck', 'impactorRate', 'struckRate']);

/** @import { LawRecord, MarchRecord } from '../messages.js' */

/**
 * @typedef {object} Contact
 * @property {number} start  [T], as is the end
 * @property {number} end
 * @property {number} push  impulse [Z v T]
 * @property {number} after  velocity of the mass [v]
 * @property {number} peak  force [Z v]
 */
/**
 * What a contact law adds, in units v T and Z v.
 * @typedef {object} Cycle
 * @property {number} deepest
 * @property {number} dent
 * @property {Float64Array} depths  of the impact, and its forces
 * @property {Float64Array} presses
 * @property {Float64Array} [widths]  square of the radius of contact over that of the faces, as a crater widens
 * @property {Float64Array} loading  force by the law, slowly to the greatest indentation, and back
 * @property {Float64Array} unloading
 */
/**
 * An impact of a mass on a uniform rod, in units T, v and Z v; of energies Z v v T.
 * @typedef {object} Impact
 * @property {number} duration
 * @property {number} impulse
 * @property {number} final  velocity of the mass
 * @property {number} target  velocity of the centre of the rod
 * @property {number} apart  with which the faces part
 * @property {number} compressing  impulse up to the end of compression
 * @property {number} energy  of the rod
 * @property {number} dissipated
 * @property {Contact[]} contacts
 * @property {Record<'waveTime' | 'wave' | 'forceTime' | 'force' | 'mass' | 'end' | 'whole', Float64Array>} histories
 * @property {Cycle | null} cycle
 */

/**
 * Figures of one alone, in the same units.
 * @typedef {object} RodFigures
 * @property {number} duration
 * @property {number} final
 * @property {number} target
 * @property {number} energy
 * @property {number} dissipated
 * @property {number} deepest  indentation [v T]
 * @property {number} contacts  how many
 * @property {number} parting  when the last one ends [T]
 * @property {number} touching  all of them together [T]
 * @property {number} peak  force [Z v]
 * @property {number} stress  the largest along the rod, times its area [Z v]; NaN where it is not known
 */

/**
 * An impact by modes, in the same units.
 * @typedef {object} ModalImpact
 * @property {number} duration
 * @property {number} impulse
 * @property {number} final  velocity of the mass
 * @property {number} target  velocity of the centre of the rod
 * @property {number} apart  with which the faces part
 * @property {number} compressing  impulse up to the end of compression
 * @property {number} energy  of the rod
 * @property {number} local  energy of the contact, and of what the modes left out give way
 * @property {number} dissipated
 * @property {number} deepest
 * @property {number} dent
 * @property {number} window  shortest kept period
 * @property {number} touches  contacts with all chatter
 * @property {number} highest  the largest force of these
 * @property {Contact[]} contacts
 * @property {Float64Array} force  over each step
 * @property {Float64Array} mass  positions at even times, as are those of the struck end
 * @property {Float64Array} end
 */

/**
 * What is struck across, and by what [s, kg].
 * @typedef {object} Struck
 * @property {number} mass  of what strikes
 * @property {number} rigidMass  of what is struck, as far as it moves at once
 * @property {number} whole  mass of that
 * @property {number} duration  0: as long as is usual
 * @property {MarchRecord} march
 * @property {number} damping
 */
/**
 * An impact across, in s, kg and the speed of the impact.
 * @typedef {Omit<ModalImpact, 'mass' | 'end'> & { half: number | null, step: number, steps: number } &
 *   Record<'time' | 'impactor' | 'struck' | 'impactorRate' | 'struckRate' | 'rates', Float64Array> &
 *   { cycle: Cycle }} BentImpact
 */

/**
 * A mass on a rod that bends as a spring, in units T, v and Z v; the fields row by row, stress in Z v over the area.
 * @typedef {Omit<Impact, 'cycle' | 'histories' | 'target'> & { atOnce: number, root: number, steps: number } &
 *   Record<'mass' | 'end' | 'forceTime' | 'force' | 'stress' | 'velocity' | 'displacement', Float64Array>} SprungImpact
 */

export class Kernels extends Memory {
  /**
   * What a kernel of waves in a rod has left.
   * @param {'rod' | 'law'} name
   * @param {ReturnType<Memory['call']>} called
   */
  #waves(name, called) {
    if (!called) return null;
    const { figures, read } = called;
    const { compressing, duration, energy, forcePoints, impulse, target, wavePoints } = figures;
    const rows = rowsOf(CONTACT[name], figures.contacts, read);
    const histories = {
      ...{ waveTime: read('waveTime', wavePoints), wave: read('wave', wavePoints) },
      ...{ forceTime: read('forceTime', forcePoints), force: read('force', forcePoints) },
      ...{ mass: read('mass'), end: read('end'), whole: read('whole') },
    };
    return { common: { compressing, duration, energy, impulse, target, histories }, figures, rows, read };
  }
  /**
   * What delivers a restitution by a damped law: its damping number, and what the usual formula says of that.
   * @param {string} name
   * @param {number} restitution
   */
  dashpot(name, restitution) {
    const { number = NaN, nominal = NaN } = this.call('dashpot', DASHPOTS.indexOf(name), restitution)?.figures ?? {};
    return { number, nominal };
  }
  /**
   * A rigid mass on a rod.
   * @param {number} beta  mass of the rod over that of the striker
   * @param {1 | -1} reflection  of a fixed or a free far end
   * @returns {Impact | null}
   */
  rod(beta, reflection) {
    const run = this.#waves('rod', this.call('rod', beta, reflection));
    if (!run) return null;
    const contacts = run.rows.map(([start, end, before, after, peak]) => {
      return { start, end, push: (0.5 / beta) * (before - after), after, peak };
    });
    const [, , , final, , , face] = run.rows[run.rows.length - 1];
    return { ...run.common, contacts, final, apart: face - final, dissipated: 0, cycle: null };
  }
  /**
   * One that strikes it through a contact law.
   * @param {number} beta
   * @param {1 | -1} reflection
   * @param {Pick<LawRecord, 'name' | 'constants'>} law  with its constants in units T, v and Z v
   * @param {number} asked  for how long [T]; 0: until they have parted for good
   * @returns {Impact | null}
   */
  law(beta, reflection, { name, constants }, asked = 0) {
    if (!this.roomFor('law')) return null;
    this.#giveBothEnds('law', { name, constants });
    const run = this.#waves('law', this.call('law', beta, reflection, asked));
    if (!run) return null;
    const { common, figures, read, rows } = run;
    const { apart, deepest, dent, dissipated, final } = figures;
    const contacts = rows.map(([start, end, push, peak, after]) => ({ start, end, push, after, peak }));
    const path = { depths: read('depths'), presses: read('presses') };
    const curve = { loading: read('loading'), unloading: read('unloading') };
    return { ...common, contacts, final, apart, dissipated, cycle: { deepest, dent, ...path, ...curve } };
  }
  /**
   * Figures alone of either.
   * @param {number} beta
   * @param {1 | -1} reflection
   * @param {Pick<LawRecord, 'name' | 'constants'>} law  rigid without constants
   * @param {number} asked
   * @param {number} tolerance  of a step through a law; 0: as what is drawn
   * @returns {RodFigures | null}
   */
  figures(beta, reflection, law, asked = 0, tolerance = 0) {
    if (!law.constants.length) {
      return asked ? null : /** @type {any} */ (this.call('rod_figures', beta, reflection)?.figures ?? null);
    }
    if (!this.roomFor('law_figures')) return null;
    this.#giveBothEnds('law_figures', law);
    return /** @type {any} */ (this.call('law_figures', beta, reflection, asked, tolerance)?.figures ?? null);
  }
  /**
   * Either by the lowest modes of the rod.
   * @param {number} beta
   * @param {1 | -1} reflection
   * @param {Pick<LawRecord, 'name' | 'constants'>} law  likewise; rigid without constants
   * @param {number} count  of modes
   * @param {number} touching  [T], until the last parting by waves
   * @param {number} duration  [T]
   * @param {keyof typeof MODES} kind  its own, of which those left out give way or not, or given ones
   * @param {{ frequencies: Float64Array, atContact: Float64Array }} [of]  given ones
   * @returns {ModalImpact | null}
   */
  modes(beta, reflection, law, count, touching, duration, kind, of) {
    if (!this.roomFor('modes')) return null;
    this.#give('modes', law);
    if (of) this.array('modes', 'shapes', 2 * count).set([...of.frequencies, ...of.atContact]);
    const called = this.call('modes', beta, reflection, count, touching, duration, MODES[kind]);
    if (!called) return null;
    const { figures, read } = called;
    const force = read('histories', figures.steps);
    return { ...marched(figures, read), duration, force, mass: read('mass'), end: read('end') };
  }
  /**
   * A mass on a spring that is held, as a fixed rod may bend.
   * @param {number} mass  [Z T]
   * @param {number} moving  that goes with the end of the spring [Z T]
   * @param {number} stiffness  [Z / T]
   * @param {number} duration  [T]; none where the bodies then still touch
   * @returns {SprungImpact | null}
   */
  spring(mass, moving, stiffness, duration) {
    const called = this.call('spring', mass, moving, stiffness, duration);
    if (!called) return null;
    const { figures, read } = called;
    const { apart, atOnce, compressing, dissipated, energy, final, impulse, parting, peak, root, steps } = figures;
    const contacts = [{ start: 0, end: parting, push: impulse, after: final, peak }];
    return {
      ...{ apart, atOnce, compressing, contacts, dissipated, duration, energy, final, impulse, root, steps },
      ...{ mass: read('mass'), end: read('end'), forceTime: read('forceTime'), force: read('force') },
      ...{ stress: read('stress'), velocity: read('velocity'), displacement: read('displacement') },
    };
  }
  /**
   * A mass on another at rest, or on one that is held, marched through a law, and by its closed form or its path.
   * @param {number} mass
   * @param {number} whole  of the other, or infinity
   * @param {LawRecord} law  in s, kg and the speed
   * @param {boolean} sine  whether by the half sine
   */
  compact(mass, whole, law, sine) {
    if (!this.roomFor('compact')) return null;
    this.#give('compact', law);
    const undamped = law.yields ? BESIDE.path : sine ? BESIDE.sine : BESIDE.power;
    const called = this.call('compact', mass, whole, law.exponent, law.damps ? BESIDE.damped : undamped);
    if (!called) return null;
    const { figures, read } = called;
    const { compressing, contacts, deepest, dent, dented, depth, end, gone, left, lost } = figures;
    const [depths, presses, widths] = partsOf(read, 'cycle', 3);
    const [loading, unloading] = partsOf(read, 'lawCycle', 2);
    const { apart, dissipated, final, highest, impulse, local, steps, target, touches, trip } = figures;
    const { parted, peak, points, pushed } = figures;
    const rows = rowsOf(CONTACT.modes, contacts, read).map(([start, until, push, most, after]) => {
      return { start, end: until, push, after, peak: most };
    });
    return {
      exact: {
        ...{ apart, compressing, dissipated, final, highest, impulse, local, steps, target, touches },
        ...{ contacts: rows, cycle: { deepest, dent } },
      },
      other: {
        ...{ apart: parted, compressing, dissipated: lost, final: left, impulse: pushed, local: 0 },
        ...{ contacts: [{ start: 0, end, push: pushed, after: left, peak }], cycle: { deepest: depth, dent: dented } },
        ...{ steps: points - 1, target: gone },
      },
      ...{ impactor: read('impactor'), face: read('face'), otherImpactor: read('otherImpactor') },
      ...{ otherFace: read('otherFace'), otherTime: read('otherTime', points) },
      ...{ otherForce: read('otherForce', points) },
      ...{ forceTime: read('forceTime', 2 * steps), force: read('force', 2 * steps) },
      cycle: { deepest: deepest * trip, dent: dent * trip, depths, presses, widths, loading, unloading },
      ...{ duration: figures.duration, trip },
    };
  }
  /**
   * A mass across what bends, by the modes of that.
   * @param {Struck} struck
   * @param {Pick<LawRecord, 'name' | 'constants'>} law  in s, kg and the speed; rigid without constants
   * @returns {BentImpact | null}
   */
  beam(struck, law) {
    const called = this.#across('beam', struck, law);
    if (!called) return null;
    const { figures, read } = called;
    const { contacts, deepest, dent, half, step, steps } = figures;
    const size = ROOM.beam.drawn / HISTORIES.length;
    const drawn = read('drawn');
    const histories = /** @type {Record<typeof HISTORIES[number], Float64Array>} */ (
      Object.fromEntries(HISTORIES.map((name, k) => [name, drawn.subarray(k * size, (k + 1) * size)]))
    );
    const [depths, presses, widths] = partsOf(read, 'cycle', 3);
    const [loading, unloading] = partsOf(read, 'lawCycle', 2);
    return {
      ...{ ...marched(figures, read), ...histories, step, steps, duration: figures.duration },
      half: half > 0 ? half : null,
      rates: read('rates', Math.min(4 * contacts, ROOM.beam.rates)),
      force: read('force', Math.ceil(figures.duration / step - 1e-6)),
      cycle: { deepest, dent, depths, presses, widths, loading, unloading },
    };
  }
  /**
   * Figures alone of the same, in the same units.
   * @param {Struck} struck
   * @param {Pick<LawRecord, 'name' | 'constants'>} law
   * @returns {RodFigures | null}
   */
  beamFigures(struck, law) {
    return /** @type {any} */ (this.#across('beam_figures', struck, law)?.figures ?? null);
  }
  /**
   * Either.
   * @param {'beam' | 'beam_figures'} kernel
   * @param {Struck} struck
   * @param {Pick<LawRecord, 'name' | 'constants'>} law
   */
  #across(kernel, { damping, duration, march, mass, rigidMass, whole }, law) {
    const { atContact, compliance, frequencies, longest, mean } = march;
    const count = frequencies.length;
    if (!this.roomFor(kernel)) return null;
    this.#give(kernel, law);
    this.array(kernel, 'shapes', 3 * count).set([...frequencies, ...atContact, ...atContact.map(() => damping)]);
    return this.call(kernel, mass, rigidMass, whole, mean, count, compliance, longest, duration);
  }
  /**
   * Write a contact law for both ends of a rod.
   * @param {'law' | 'law_figures'} kernel
   * @param {Pick<LawRecord, 'name' | 'constants'>} law
   */
  #giveBothEnds(kernel, { name, constants }) {
    const size = ROOM[kernel].constants;
    const given = this.array(kernel, 'constants', size).fill(0);
    for (const end of [0, 1]) given.set([...constants], (end * size) / 2);
    for (const end of [1, 2]) given[(end * size) / 2 - 1] = LAWS.indexOf(name);
  }
  /**
   * Write a contact law for a march.
   * @param {'modes' | 'beam' | 'beam_figures' | 'compact'} kernel
   * @param {Pick<LawRecord, 'name' | 'constants'>} law
   */
  #give(kernel, { name, constants }) {
    const given = this.array(kernel, 'constants', ROOM[kernel].constants).fill(0);
    given.set([...constants]);
    given[given.length - 1] = constants.length ? LAWS.indexOf(name) : -1;
  }
}

/**
 * What a march gives along a rod and across a beam alike.
 * @param {Record<string, number>} figures
 * @param {(array: string, size: number) => Float64Array} read
 */
function marched(figures, read) {
  const { apart, compressing, deepest, dent, dissipated, energy, final, highest, impulse, local } = figures;
  const { contacts: count, target, touches, window } = figures;
  const contacts = rowsOf(CONTACT.modes, count, read).map(([start, end, push, peak, after]) => {
    return { start, end, push, after, peak };
  });
  return {
    ...{ apart, compressing, contacts, deepest, dent, dissipated, energy, final },
    ...{ highest, impulse, local, target, touches, window },
  };
}

/**
 * Arrays that stand behind each other.
 * @param {(array: string) => Float64Array} read
 * @param {string} name
 * @param {number} count
 */
function partsOf(read, name, count) {
  const found = read(name);
  const size = found.length / count;
  return Array.from({ length: count }, (_, k) => found.subarray(k * size, (k + 1) * size));
}

/**
 * The contacts that a kernel has found.
 * @param {number} columns
 * @param {number} count
 * @param {(array: string, size: number) => Float64Array} read
 */
export function rowsOf(columns, count, read) {
  const table = read('contacts', columns * count);
  return Array.from({ length: count }, (_, k) => [...table.subarray(columns * k, columns * (k + 1))]);
}

/**
 * @param {BufferSource} bytes
 * @returns {Promise<Kernels>}
 */
export async function kernelsOf(bytes) {
  const kernels = new Kernels(await WebAssembly.compile(bytes));
  await kernels.enter();
  return kernels;
}
