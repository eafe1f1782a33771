// The message of an impact on a beam or a mechanism, as types; see ../shell/message.js.

/** @import { Note } from '../text/catalogue.js' */
/** @import { BeamFigures, Common, Contact, CycleTold, Numbers, Striking } from '../shell/message.js' */

/**
 * An impact on a beam: SI units, but times in milliseconds. What is optional depends on the method.
 * @typedef {object} BeamOnly
 * @property {'beam'} kind
 * @property {string} head  of saved histories
 * @property {Note | null} refused  why the chosen method is not shown
 * @property {number} trip
 * @property {number} speed
 * @property {BeamTold} beam
 * @property {MechanismTold | null} mechanism
 * @property {MovingTold | null} moving  of a mechanism that moves on as far as it goes
 * @property {Numbers} [linkPoints]  (links, link places, 2), flat; unbent if it moves on
 * @property {Numbers} [linkTime]
 * @property {Numbers} [linkMoves]  (link instants, links, link places, 2), flat
 * @property {Numbers} [massPlaces]  (link instants, 2), flat
 * @property {Numbers} [normals]  (2, edges), flat: as contacts begin and end, time and angle of the normal [rad]
 * @property {Numbers} [bendTime]  of what each link that bends says besides, under its number
 * @property {Numbers} [energyTime]
 * @property {Numbers} [energies]  (energy instants, parts), flat
 * @property {Numbers} [reactionTime]
 * @property {Numbers} [reactions]  (reaction instants, joints, 3), flat
 * @property {Striking} impactor
 * @property {{ name: string, damps: boolean, yields: boolean, exponent: number }} law
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
 * @property {Numbers} [referenceReactionTime]
 * @property {Numbers} [referenceReactions]
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
/**
 * A mechanism, of which the struck link stands for the beam. Links reach from their first end to their second.
 * @typedef {object} MechanismTold
 * @property {LinkTold[]} links
 * @property {JointTold[]} joints
 * @property {number} struck  which link is
 * @property {number} at  share of its length
 * @property {[number, number]} contact  [m]
 * @property {[number, number]} normal  from impactor to link
 * @property {number} mass  of all links [kg]
 */
/**
 * Nodes are those of finite elements, as shares of its length.
 * @typedef {{ name: string, flexible: boolean, nodes: number[], depth: number }} LinkTold
 */
/**
 * A mechanism that moves on.
 * @typedef {object} MovingTold
 * @property {number | null} restitution  none: by the contact law
 * @property {Note | null} rigid  why links that bend are followed as rigid ones
 * @property {boolean} cut  it was to be followed for longer
 * @property {string[]} energies  names of the parts
 * @property {number[][]} jolts  size of the impulse at every joint in the first impacts [N s]
 */
/**
 * @typedef {object} JointTold
 * @property {string} kind
 * @property {[string, string]} links  by name; ground
 * @property {number} link  on which it is drawn
 * @property {number} share  of its length
 * @property {[number, number] | null} axis  along which it slides
 * @property {boolean} driven
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
/** @typedef {Common & BeamOnly & CycleTold & Partial<ModalTold> & Partial<SampledTold>} BeamFrame */

export {};
