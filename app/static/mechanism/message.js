// The message of an impact on a mechanism, as types: besides those of its struck link, see ../beam/message.js.

/** @import { BeamFrame } from '../beam/message.js' */
/** @import { Note } from '../text/catalogue.js' */
/** @import { Common, CycleTold, Numbers } from '../shell/message.js' */
/** @import { ModalTold, OfBending, SampledTold } from '../beam/message.js' */

/**
 * What is told of all links and joints.
 * @typedef {object} OfLinks
 * @property {'mechanism'} kind
 * @property {MechanismTold} mechanism
 * @property {MovingTold | null} moving  of one that moves on as far as it goes
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
 * @property {Numbers} [referenceReactionTime]
 * @property {Numbers} [referenceReactions]
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
/** @typedef {Common & OfBending & CycleTold & Partial<ModalTold> & Partial<SampledTold> & OfLinks} MechanismFrame */
/** @typedef {BeamFrame | MechanismFrame} BendingFrame  of a beam, or of a link that is shown as one */

export {};
