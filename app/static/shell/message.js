// The message of the server: a header and arrays of numbers. app/messages/schema.py says what each field is; these are
// the same fields as types, and a test compares the two.

/** @typedef {Record<string, number | string>} Chosen  a value for every choice */
/** @typedef {Float64Array} Numbers */
/** @import { Note } from '../text/catalogue.js' */
/** @typedef {[rod: number, closes: number, opens: number]} Gap  before a rod of a chain [T, T] */
/** @typedef {[start: number, end: number, impulse: number, peak: number | null]} Contact */

/**
 * What a message of any kind says.
 * @typedef {object} Common
 * @property {Record<string, number[]>} shapes  of the arrays, by name
 * @property {Chosen} chosen
 * @property {Chosen} own  the same, as the page opens the scene
 * @property {boolean} draft  whether it is solved by fewer modes and elements than chosen
 * @property {[start: number, end: number] | null} stretch  of time that histories are of [s]; null: all of it
 * @property {string[]} acting  choices that act on this scene
 * @property {Record<string, Note | null>} refusals  by method: why it cannot solve the scene, or nothing
 * @property {string} title
 * @property {string} source
 * @property {string} note
 * @property {PartTold[]} parts  bodies, and rods, links and joints one by one
 * @property {string[]} unshown  keys that the scene sets and that have no control
 * @property {Opens} opens  what the scene is opened with
 * @property {number} duration  axial: in round trips; beam: in milliseconds; bodies: seconds on either side of it
 */
/**
 * What a scene is opened with.
 * @typedef {object} Opens
 * @property {string[]} charts  by name
 * @property {number | null} place  at which the stress is told [m]
 * @property {number | null} until  from the first touch on, what is looked at [s]
 * @property {Question[]} compare  that can be asked of it by a comparison
 * @property {Try[]} trials  what can be tried
 */
/**
 * Settings: other than what is chosen now, or, `alone`, than the scene has them. All but the second are kept.
 * @typedef {object} Question
 * @property {string} question  its key in the catalogue
 * @property {Partial<Chosen>} first
 * @property {Partial<Chosen>[]} [between]
 * @property {Partial<Chosen>} second
 * @property {boolean} [alone]
 */
/** @typedef {[say: string, choice: string, value: number | string]} Try  words of the catalogue, a choice, its value */
/**
 * A body, or a rod of a chain, a link or a joint.
 * @typedef {object} PartTold
 * @property {string} key  of its table: impactor, target, target.rods.2
 * @property {string} name  of a link or joint; else empty
 * @property {string} kind
 * @property {boolean} strikes  whether it is the body that strikes
 * @property {ValueTold[]} values  that can be set
 * @property {[name: string, value: number][]} derived  what follows from them, SI units
 */
/**
 * A value of a body, SI units.
 * @typedef {object} ValueTold
 * @property {string} quantity  the rest of its key: length, material.young
 * @property {number | string | null} value  as it is; null: not given
 * @property {number | string | null} own  as the scene has it
 * @property {number | null} low  that it may be; null of a material
 * @property {number | null} high
 */
/**
 * @typedef {object} Cushion
 * @property {string} name
 * @property {number} modulus  E [Pa]
 * @property {number} thickness  h [m]
 * @property {number} stiffness  k = E A / h [N/m]
 */
/** @typedef {{ initial: number, [part: string]: number }} Energies  [J]; `initial` is what the others are shares of */
/** @typedef {{ newton: number | null, poisson: number | null, newton_at_contact: number | null }} Restitution */

/**
 * @typedef {object} Diagnostics
 * @property {number} wall_time  [s]
 * @property {number} energy_error  as a share
 * @property {number | null} estimated_error
 * @property {number} [resolved_time]  the finest that modes can tell [s]
 * @property {number} [raw_contacts]
 * @property {number} [balances]  of impulse and momentum
 * @property {number} [energy_drift]  the largest, as a share
 * @property {number} [constraint_error]  [m]
 * @property {number} [steps]
 * @property {number} [pivot_moment]  of a pendulum that bends [N m]
 * @property {number} [contact_moment]
 */
/**
 * What a solution says of itself. Velocities of axial messages in impact speeds, of beams in m/s.
 * @typedef {object} Figures
 * @property {string} name  of the method
 * @property {string | null} model  of a method that has several
 * @property {boolean} sudden  whether the impact takes no time in it
 * @property {boolean} waves  whether anything rings in it
 * @property {boolean} byLaw  whether the contact law acts in it
 * @property {boolean} stillTouching
 * @property {number | null} final  velocity of the impactor, as a whole
 * @property {number} targetFinal
 * @property {number | null} peakForce  [N]
 * @property {number | null} peakIndentation  [m]
 * @property {number | null} residualIndentation  [m]
 * @property {Restitution} restitution
 * @property {Energies} energy
 * @property {Diagnostics} diagnostics
 * @property {Note[]} notes
 */
/**
 * @typedef {object} OfContacts
 * @property {Contact[]} contacts  [T, T, N s, N]
 * @property {boolean[]} cutOff  whether a wave ended the contact at once
 * @property {number[]} left  velocities of the impactor after each contact
 * @property {(number | null)[]} spins  of impactor and target, of those on a pivot [rad/s]
 */
/** @typedef {Figures & OfContacts} AxialFigures */
/**
 * @typedef {object} OfResolution
 * @property {number | null} modes
 * @property {number | null} elements
 * @property {number} contacts
 * @property {number} impulse
 * @property {JointImpulse[] | null} joints
 */
/**
 * What the first link of a joint does to the second; of balances what is sudden, and beside it all up to the parting.
 * @typedef {{ impulse: [number, number], moment_impulse: number, impulse_to_parting?: [number, number],
 *   moment_impulse_to_parting?: number }} JointImpulse
 */
/** @typedef {Figures & OfResolution} BeamFigures */

/**
 * @typedef {object} RodTold  places in m from the struck face, the rest in units of the message
 * @property {number} from
 * @property {number} to
 * @property {number} transit
 * @property {number} impedance
 * @property {number} drift  velocity before the impact
 * @property {number} area
 * @property {'bonded' | 'touching' | null} joint
 * @property {-1 | 0 | 1} mirror  what its far end makes of a wave: turns it over, sends one of its own, sends it back
 */
/**
 * @typedef {object} Striking
 * @property {string} kind
 * @property {number} mass  [kg]
 * @property {number | null} [radius]  of its face [m]
 * @property {number} [length]  of a pendulum [m]
 * @property {number} [place]  from its pivot to the contact [m]
 * @property {number} [ownMass]  of all of it, where `mass` is what is felt at the contact [kg]
 */
/**
 * @typedef {object} TargetTold
 * @property {string} kind
 * @property {'ball' | 'block'} shape  of a compact body
 * @property {number | null} radius  [m]
 * @property {number} mass
 * @property {number} length
 * @property {string | null} support
 * @property {boolean} held
 * @property {number} endMass
 * @property {Rotation} [rotation]  of a rod that turns
 * @property {number[]} [row]  radii of a row of balls [m]
 */
/**
 * What its rotation does to a rod.
 * @typedef {object} Rotation
 * @property {number} at  where it is struck, of its length from the axis
 * @property {number} speed  [rad/s]
 * @property {number} critical  speed at which its stretch has no end [rad/s]
 * @property {number} stretch  of its end, steadily [m]
 * @property {number} strain  of its root, steadily
 * @property {number[]} axial  lowest frequencies along it [rad/s]
 * @property {number[]} bending  and across, in the plane of rotation
 * @property {(number | null)[]} simplified  the same by (5.56), without the tension; null where unstable
 */

/**
 * The path of force over indentation: slowly by the law, and in this impact [m, N].
 * @typedef {object} CycleTold
 * @property {Numbers} [cycleDepth]
 * @property {Numbers} [cycleLoading]
 * @property {Numbers} [cycleUnloading]
 * @property {Numbers} [blowDepth]
 * @property {Numbers} [blowForce]
 */

/**
 * An impact along one axis. Times in round trips T, velocities in the impact speed v, displacements in v T, forces in
 * `forceUnit`, stresses in `stressUnit`.
 * @typedef {object} AxialOnly
 * @property {'axial'} kind
 * @property {string} head  of saved histories
 * @property {number} trip  T [s]
 * @property {RodTold[]} rods
 * @property {Striking} impactor
 * @property {TargetTold} target
 * @property {number} speed  v [m/s]
 * @property {number} forceUnit  [N]
 * @property {number} stressUnit  [Pa]
 * @property {number} modes
 * @property {number | null} step  of the modal force, or that on the modes
 * @property {boolean} attached  whether these modes are those of a frame fixed to the struck end
 * @property {AxialFigures} exact
 * @property {AxialFigures | null} other
 * @property {Gap[]} gaps  between rods
 * @property {[time: number, velocity: number] | null} lastBall  of a row, as it has parted for good [T, v]
 * @property {{ impactor: number, target: number } | null} prediction  velocities by rigid-body theory
 * @property {number | null} match  restitution that would have matched
 * @property {boolean} rigid  whether nothing gives way at the contact itself
 * @property {boolean} damps
 * @property {boolean} yields
 * @property {number} exponent  of the indentation, with which the force of the law begins
 * @property {number | null} nominal
 * @property {number} leastRestitution
 * @property {Cushion[]} cushions  sheets that can lie on the struck face
 * @property {Numbers} motionTime  of what follows
 * @property {Numbers} exactMass
 * @property {Numbers} exactEnd
 * @property {Numbers} [exactWhole]  displacement of the mass centre of a rod that nothing holds
 * @property {Numbers} [exactRow]  of every ball of a row, (instant, ball), flat
 * @property {Numbers} [exactRowVelocity]  velocity of the impactor and of every ball, (instant, body), flat [v]
 * @property {Numbers} [exactRowForce]  force of every contact, from the impactor's on, (instant, contact), flat
 * @property {Numbers} exactTime
 * @property {Numbers} exactForce
 * @property {Numbers} [otherMass]
 * @property {Numbers} [otherEnd]
 * @property {Numbers} [otherTime]
 * @property {Numbers} [otherForce]
 * @property {Numbers} [modalForce]  one for each step
 * @property {Numbers} [fieldForce]  likewise, for the fields alone
 * @property {Numbers} [exactBar]  (motion, bar places), flat: of a pendulum that bends, from its pivot on [v T]
 * @property {Numbers} [otherBar]
 * @property {Numbers} [momentTime]
 * @property {Numbers} [exactMoments]  (instant, 3), flat: of a bar that bends, at its pivot or axis, half way, contact
 * @property {Numbers} [otherMoments]
 * @property {Numbers} [balanceTime]
 * @property {Numbers} [balanceForce]
 * @property {Numbers} [turningBar]  (motion, bar places), flat: of a rod that turns and is struck across
 * @property {Numbers} [exactStress]  (instant, place), flat: of a rod that turns
 * @property {Numbers} [exactVelocity]
 * @property {Numbers} [exactDisplacement]
 * @property {Numbers} [fieldStress]  (instant, place), flat
 * @property {Numbers} [fieldVelocity]
 * @property {Numbers} [fieldDisplacement]
 * @property {{ time: number[], force: number[] }} [record]  not of the message: a measured force laid over the others
 */
/** @typedef {Common & AxialOnly & CycleTold} AxialFrame */

/** @typedef {import('../beam/message.js').BeamFrame} BeamFrame */
/** @typedef {import('../beam/message.js').BeamTold} BeamTold */
/** @typedef {import('../mechanism/message.js').BendingFrame} BendingFrame */
/** @typedef {import('../mechanism/message.js').MechanismFrame} MechanismFrame */
/** @typedef {import('../mechanism/message.js').MechanismTold} MechanismTold */
/** @typedef {import('../mechanism/message.js').JointTold} JointTold */
/** @typedef {import('../mechanism/message.js').LinkTold} LinkTold */
/** @typedef {import('../mechanism/message.js').MovingTold} MovingTold */
/** @typedef {import('../beam/message.js').Support} Support */

/** @typedef {[number, number, number]} Vector */
/** @typedef {{ velocity: Vector, spin: Vector }} Moving */
/** @typedef {[name: string, value: number | number[] | null, unit: string]} FigureTold */
/**
 * @typedef {object} BodyTold
 * @property {'stop' | 'point' | 'ball' | 'box'} shape
 * @property {number} [mass]
 * @property {number} [radius]
 * @property {Vector} [sides]
 * @property {Vector[]} [axes]
 * @property {Moving} before
 * @property {Moving} after
 */
/**
 * One impulse between bodies in space, SI units; places from the point of impact, times from -1 to 1 in durations.
 * @typedef {object} SpaceOnly
 * @property {'bodies'} kind
 * @property {number} size
 * @property {Vector} across
 * @property {Vector} up
 * @property {Vector} normal
 * @property {Vector[]} ownFrame  the normal as the scene has it, and two tangents, from which a tilt is told
 * @property {number} impulse
 * @property {Vector} push  the impulse on the target
 * @property {number} friction
 * @property {{ kind: 'slip' | 'stick' | 'reversal', until: number }[]} sliding  none without friction
 * @property {{ impactor: BodyTold, target: BodyTold }} bodies
 * @property {FigureTold[]} figures
 * @property {Note[]} notes
 * @property {Numbers} impactorPath  (time, 3), flat
 * @property {Numbers} targetPath
 * @property {Numbers} impactorTurn  (time, 3, 3), flat
 * @property {Numbers} targetTurn
 * @property {Numbers} [slidePress]  normal impulse as the contact slides
 * @property {Numbers} [slideParting]
 * @property {Numbers} [slideAlong]  of the impactor on the target, in the picture
 * @property {Numbers} [slideAside]  and towards who looks
 */
/** @typedef {Common & SpaceOnly} SpaceFrame */
/** @typedef {AxialFrame | BendingFrame | SpaceFrame} Frame */

/**
 * @param {ArrayBuffer} buffer
 * @returns {Frame}
 */
export function decode(buffer) {
  const bytes = new Uint8Array(buffer);
  const length = new DataView(bytes.buffer, bytes.byteOffset, 4).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  /** @type {Record<string, Numbers>} */
  const data = {};
  /** @type {Record<string, number[]>} */
  const shapes = {};
  let offset = 4 + length;
  for (const [name, shape, unit] of header.arrays) {
    shapes[name] = shape;
    const size = shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b);
    const width = unit ? 2 : 4; // with a unit: whole numbers of two bytes
    const part = bytes.slice(offset, offset + width * size).buffer;
    data[name] = new Float64Array(unit ? new Int16Array(part) : new Float32Array(part));
    if (unit) for (let k = 0; k < size; k++) data[name][k] *= unit;
    offset += 4 * Math.ceil((width * size) / 4);
  }
  const contacts = data.contacts && { contacts: rowsOf(data.contacts, shapes.contacts[1]) };
  return { ...header, ...data, shapes, ...contacts };
}

/**
 * @param {Numbers} flat
 * @param {number} columns
 */
const rowsOf = (flat, columns) =>
  Array.from({ length: flat.length / columns }, (_, k) => [...flat.subarray(columns * k, columns * (k + 1))]);

/**
 * One of the arrays that stand in a message under a number, as the waves of each rod do.
 * @param {Frame} frame
 * @param {string} name
 * @returns {Numbers}
 */
export const arrayOf = (frame, name) => given(/** @type {any} */ (frame)[name], name);

/**
 * What this kind of message must hold. Raises an error where it does not.
 * @template Value
 * @param {Value | null | undefined} value
 * @param {string} name
 * @returns {Value}
 */
export function given(value, name) {
  if (value === null || value === undefined) throw new Error(`the message has no ${name}`);
  return value;
}
