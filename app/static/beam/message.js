// The message of an impact on a beam, or on another body that is told of as one, as types; see ../shell/message.js.

/** @import { Note } from '../text/catalogue.js' */
/** @import { BeamFigures, Common, Contact, CycleTold, Numbers, Striking } from '../shell/message.js' */

/**
 * SI units, but times in milliseconds. What is optional depends on the method.
 * @typedef {object} OfBending
 * @property {string} head  of saved histories
 * @property {Note | null} refused  why the chosen method is not shown
 * @property {number} trip
 * @property {number} speed
 * @property {BeamTold} beam
 * @property {Striking} impactor
 * @property {{ name: string, damps: boolean, yields: boolean, rigid: boolean, exponent: number }} law
 * @property {BeamFigures} main
 * @property {BeamFigures | null} reference
 * @property {{ apparent: number, real: number, half: number | null }} span
 * @property {number} places  of every field
 * @property {Numbers} time
 * @property {Numbers} impactorPath
 * @property {Numbers} struckPath
 * @property {Numbers} impactorRate
 * @property {Numbers} struckRate
 * @property {Contact[]} contacts  [ms, ms, N s, N], the first of many
 * @property {Numbers} rates  (contact, begin and end, impactor and struck place), flat
 * @property {Numbers} [referenceImpactorPath]
 * @property {Numbers} [referenceStruckPath]
 * @property {Numbers} [referenceTime]
 * @property {Numbers} [referenceForce]
 * @property {Numbers} [mainTime]
 * @property {Numbers} [mainForce]
 * @property {Numbers} [staticTime]
 * @property {Numbers} [staticPath]
 * @property {Numbers} [staticShape]
 * @property {Numbers} [halfTime]
 * @property {Numbers} [halfForce]
 * @property {Numbers} [wavenumbers]
 * @property {Numbers} [lower]
 * @property {Numbers} [upper]
 * @property {Numbers} [modeFrequencies]
 * @property {Numbers} [modeWavenumbers]
 */
/**
 * @typedef {object} BeamTold
 * @property {number} length
 * @property {number} mass
 * @property {Support} support
 * @property {string} theory
 * @property {number} place
 * @property {number} halfDepth
 * @property {number} secondMoment
 * @property {number} endMass
 * @property {boolean} held
 * @property {number} speedLimit
 */
/** @typedef {'joined' | 'cantilever' | 'pinned-pinned' | 'clamped-clamped' | 'free-free' | 'pinned-free'} Support */

/**
 * Fields of a beam by its modes.
 * @typedef {object} ModalTold
 * @property {Numbers} modalForce
 * @property {Numbers} modalFrequencies
 * @property {Numbers} modalAtContact
 * @property {Numbers} shapeRows
 * @property {Numbers} shapeScale
 * @property {Numbers} momentRows
 * @property {Numbers} momentScale
 * @property {Numbers} shearRows
 * @property {Numbers} shearScale
 * @property {Numbers} momentBeside
 * @property {Numbers} shearBeside
 * @property {Numbers} [rigidShape]
 * @property {number} step
 * @property {number} smoothing
 * @property {number} damping
 * @property {number | null} rigidMass
 * @property {number} drift
 * @property {number} drawnModes
 * @property {number} keptModes
 */
/**
 * Fields of a beam as sampled by the server, (instant, place), flat.
 * @typedef {object} SampledTold
 * @property {Numbers} fieldTime
 * @property {Numbers} fieldDeflection
 * @property {Numbers} fieldVelocity
 * @property {Numbers} fieldMoment
 * @property {Numbers} fieldShear
 */
/**
 * @typedef {object} BeamKind
 * @property {'beam'} kind
 */
/** @typedef {Common & OfBending & CycleTold & Partial<ModalTold> & Partial<SampledTold> & BeamKind} BeamFrame */

export {};
