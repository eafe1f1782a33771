// Messages of the server as types, from app/messages/schema.py: `python -m app.messages.declarations`.
import type { Note } from './text/catalogue.js';

/** an array, the last index fastest */
export type Numbers = Float64Array;

/** a value for every choice */
export type Chosen = Record<string, number | string>;

/** before a rod of a chain [T, T] */
export type Gap = [rod: number, closes: number, opens: number];

export type Contact = [start: number, end: number, impulse: number, peak: number | null];

/** [J]; `initial` is what the others are shares of */
export type Energies = { initial: number; [part: string]: number };

export type Restitution = Record<'newton' | 'poisson' | 'newton_at_contact', number | null>;

/** of a beam, or of a link of a mechanism */
export type Support = 'joined' | 'cantilever' | 'pinned-pinned' | 'clamped-clamped' | 'free-free' | 'pinned-free';

/** words of the catalogue, a choice, its value */
export type Try = [say: string, choice: string, value: number | string];

export type Vector = [number, number, number];

export type Moving = { velocity: Vector; spin: Vector };

export type FigureRecord = [name: string, value: number | number[] | null, unit: string];

/** of a beam, or of a link that is shown as one */
export type BendingFrame = BeamFrame | MechanismFrame;

export interface Diagnostics {
  /** [s] */ wall_time: number;
  /** as a share */ energy_error: number;
  estimated_error: number | null;
  /** the finest that modes can tell [s] */ resolved_time?: number;
  raw_contacts?: number;
  /** of impulse and momentum */ balances?: number;
  /** the largest, as a share */ energy_drift?: number;
  /** [m] */ constraint_error?: number;
  steps?: number;
  /** on a spring that carries a mass, of the first instant [N s] */ initial_impulse?: number;
  /** on what holds it [N] */ peak_root_force?: number;
  /** by a contact law */ delivered_restitution?: number;
  /** of a pendulum that bends [N m] */ pivot_moment?: number;
  contact_moment?: number;
}

export interface JointImpulse {
  /** [N s] */ impulse: [number, number];
  /** [N m s] */ moment_impulse: number;
  /** [N s] */ impulse_to_parting?: [number, number];
  /** [N m s] */ moment_impulse_to_parting?: number;
}

export interface MechanismRecord {
  /** from their first end to their second */ links: LinkRecord[];
  joints: JointRecord[];
  /** which link is */ struck: number;
  /** share of its length */ at: number;
  /** [m] */ contact: [number, number];
  /** from impactor to link */ normal: [number, number];
  /** of all links [kg] */ mass: number;
}

export interface LinkRecord {
  name: string;
  flexible: boolean;
  /** of finite elements, as shares of its length */ nodes: number[];
  /** [m] */ depth: number;
}

export interface JointRecord {
  kind: string;
  /** by name; ground */ links: [string, string];
  /** on which it is drawn */ link: number;
  /** of its length */ share: number;
  /** along which it slides */ axis: [number, number] | null;
  driven: boolean;
  /** whether what it does to waves is known */ scatters: boolean;
}

export interface BodyRecord {
  shape: 'stop' | 'point' | 'ball' | 'box';
  /** [kg] */ mass?: number;
  /** [m] */ radius?: number;
  /** [m] */ sides?: Vector;
  axes?: Vector[];
  before: Moving;
  after: Moving;
}

export interface Cushion {
  name: string;
  /** E [Pa] */ modulus: number;
  /** h [m] */ thickness: number;
  /** k = E A / h [N/m] */ stiffness: number;
  /** that put it there */ settings: Chosen;
}

export interface AxialFigures extends Figures {
  /** start, end [T], impulse [N s], peak force [N] */ contacts: Contact[];
  /** whether a wave ended the contact at once */ cutOff: boolean[];
  /** velocity of the impactor after each contact [v] */ left: number[];
  /** angular velocities of impactor and target, of those on a pivot [rad/s] */ spins: (number | null)[];
}

export interface BeamFigures extends Figures {
  modes: number | null;
  elements: number | null;
  /** how many */ contacts: number;
  /** [N s] */ impulse: number;
  /** of a mechanism */ joints: JointImpulse[] | null;
}

export interface MovingRecord {
  /** none: by the contact law */ restitution: number | null;
  /** why links that bend are followed as rigid ones */ rigid: Note | null;
  /** whether it was to be followed for longer */ cut: boolean;
  /** names of the parts */ energies: string[];
  /** size of the impulse at every joint in the first impacts [N s] */ jolts: number[][];
}

export interface Opens {
  /** by name */ charts: string[];
  /** of the gauge [m] */ place: number | null;
  /** what the gauge reads, or the chart of the contact law shows */ read: string | null;
  /** of the dock that opens with it */ tab: string | null;
  /** that is shown, from the first touch on [s] */ time: number | null;
  /** from the first touch on, what is looked at [s] */ until: number | null;
  /** that can be asked of it as it is chosen, by a comparison */ compare: Question[];
  /** what can be tried with it, the most telling first */ trials: Try[];
}

export interface Question {
  /** its key in the catalogue */ question: string;
  first: Partial<Chosen>;
  /** kept on the way */ between: Partial<Chosen>[];
  second: Partial<Chosen>;
  /** whether other than the scene has them */ alone: boolean;
}

export interface PartRecord {
  /** of its table: impactor, target, target.rods.2 */ key: string;
  /** of a link or joint; else empty */ name: string;
  kind: string;
  /** whether it is the body that strikes */ strikes: boolean;
  /** that can be set */ values: ValueRecord[];
  /** what follows from them, SI units */ derived: [name: string, value: number][];
}

export interface ValueRecord {
  /** the rest of its key: length, material.young */ quantity: string;
  /** as it is; null: not given */ value: number | string | null;
  /** as the scene has it */ own: number | string | null;
  /** that it may be; null of a material */ low: number | null;
  high: number | null;
}

export interface FallRecord {
  /** of the release [m] */ height: number;
  /** [m/s2] */ gravity: number;
  /** when it lies still, from the release on; null: never [s] */ rest: number | null;
}

export interface LawRecord {
  name: string;
  /** that set its constants */ choices: string[];
  damps: boolean;
  yields: boolean;
  /** power of the indentation with which its force begins */ exponent: number;
  /** restitution by its usual formula */ nominal: number | null;
  /** in units of T, v and Z v, or as stated; none of a rigid contact */ constants: number[];
  /** powers with which they grow with the speed */ bySpeed: number[];
  /** with the mass that both bodies are felt with */ byMass: number[];
  /** and with the choice that sets the stiffness */ byStiffness: number[];
  /** that choice; null if it sets more than these powers tell */ stiffness: string | null;
  /** constant that a restitution sets, and its value at the number one */ damping: [place: number, unit: number] | null;
}

export interface MarchRecord {
  /** of what is struck [rad/s] */ frequencies: number[];
  /** mass-normalised amplitudes where it is struck [kg^-1/2] */ atContact: number[];
  /** of the modes left out [m/N] */ compliance: number;
  /** mass of what is struck [kg]; null if it is held */ whole: number | null;
  /** its mean velocity over that of the struck place, as a whole */ mean: number;
  /** its slowest period [s] */ longest: number;
  /** whether it turns as a whole */ turns: boolean;
  /** that the scene asks for [s] */ duration: number | null;
}

export interface RodRecord {
  /** from the struck face [m] */ from: number;
  /** [m] */ to: number;
  /** [T] */ transit: number;
  /** [Z] */ impedance: number;
  /** velocity before the impact [v] */ drift: number;
  /** by which its weight speeds it up [v / T] */ fall?: number;
  /** over that of the struck rod */ area: number;
  /** with the rod before it */ joint: 'bonded' | 'touching' | null;
  /** what its far end makes of a wave: turns over, sends its own, sends back */ mirror: -1 | 0 | 1;
}

export interface Striking {
  kind: string;
  /** [kg] */ mass: number;
  /** of its face [m] */ radius?: number | null;
  /** of a pendulum [m] */ length?: number;
  /** from its pivot to the contact [m] */ place?: number;
  /** of all of it, where `mass` is what is felt at the contact [kg] */ ownMass?: number;
}

export interface ChainRecord {
  /** what holds at every node, as the kernel counts */ kinds: number[];
  /** before it [v T] */ gaps: number[];
  /** for how long it is solved [T]; 0: until the bodies have parted for good */ asked: number;
}

export interface BalanceRecord {
  /** whether balances are, or stand at ends of steps */ located: boolean;
  /** [s] */ step: number;
  /** whether the balances themselves are */ shown: boolean;
  /** shorter flights are still contact [s] */ resolved: number;
  /** of what is struck [rad/s] */ frequencies: number[];
  /** shapes of its modes where it is struck [kg^-1/2] */ atContact: number[];
  /** and over its mass [kg^-1/2] */ means: number[];
}

export interface TargetRecord {
  kind: string;
  /** of a compact body */ shape: 'ball' | 'block';
  /** of its face [m] */ radius: number | null;
  /** [kg] */ mass: number;
  /** [m] */ length: number;
  support: string | null;
  held: boolean;
  /** [kg] */ endMass: number;
  /** of a rod that turns */ rotation?: Rotation;
  /** radii of a row of balls, from the struck one on [m] */ row?: number[];
}

export interface Rotation {
  /** where it is struck, of its length from the axis */ at: number;
  /** [rad/s] */ speed: number;
  /** speed at which its stretch has no end [rad/s] */ critical: number;
  /** of its end, steadily [m] */ stretch: number;
  /** of its root, steadily */ strain: number;
  /** lowest frequencies along it [rad/s] */ axial: number[];
  /** and across, in the plane of rotation */ bending: number[];
  /** the same by (5.56), without the tension; null where unstable */ simplified: (number | null)[];
}

export interface BeamRecord {
  /** [m] */ length: number;
  /** [kg] */ mass: number;
  support: Support;
  theory: string;
  /** that is struck [m] */ place: number;
  /** [m] */ halfDepth: number;
  /** [m^4] */ secondMoment: number;
  /** [kg] */ endMass: number;
  held: boolean;
  /** sqrt(E/rho) [m/s] */ speedLimit: number;
}

export interface Common {
  /** of saved histories: scene and methods in TOML, table `saved` last */ head: string;
  /** a value for every choice; null outside the page */ chosen: Chosen;
  /** the same, as the page opens the scene */ own: Chosen;
  /** whether it is solved by fewer modes and elements than chosen */ draft: boolean;
  /** of time that histories are of [s]; null: all of it */ stretch: [start: number, end: number] | null;
  /** choices that act on this scene */ acting: string[];
  /** by method: why it cannot solve the scene, or null */ refusals: Record<string, Note | null>;
  title: string;
  source: string;
  note: string;
  /** by which its weight accelerates the impactor towards the target [m/s2] */ weight?: number;
  /** bodies, and rods, links and joints one by one */ parts: PartRecord[];
  /** keys that the scene sets and that have no control */ unshown: string[];
  /** what the scene is opened with */ opens: Opens;
  /** axial [T], else [s]; bodies: on either side of the impact */ duration: number;
}

export interface Bending extends Common {
  /** (cycle) indentation [m] */ cycleDepth?: Numbers;
  /** (cycle) force of the law, slowly to the depth of this impact [N] */ cycleLoading?: Numbers;
  /** (cycle) and back [N] */ cycleUnloading?: Numbers;
  /** (impact) indentation in this impact [m] */ blowDepth?: Numbers;
  /** (impact) force in it [N] */ blowForce?: Numbers;
  /** (impact) of two smooth bodies that touch in a point [s] */ touchTime?: Numbers;
  /** (impact) of the circle on which they touch [m] */ touchRadius?: Numbers;
  /** (impact) the greatest there, the mean of a contact that flows [Pa] */ touchPressure?: Numbers;
  /** (impact) that mean over the yield strength */ touchFlow?: Numbers;
  /** (flow) by Tabor's law, slowly: indentation [m] */ flowDepth?: Numbers;
  /** (flow) mean pressure over the yield strength */ flowPressure?: Numbers;
  /** (flow) of the circle [m] */ flowRadius?: Numbers;
  /** (flow) the same by Hertz [m] */ flowElastic?: Numbers;
  /** (tests) of those, what Tabor's tests reach: indentation [m] */ testsDepth?: Numbers;
  /** (tests) mean pressure in the tests over the yield strength */ testsPressure?: Numbers;
  /** (tests) force in them [N] */ testsForce?: Numbers;
  /** why the chosen method is not shown */ refused: Note | null;
  /** 1: the unit of its times [s] */ trip: number;
  /** T: the slowest of the beam; where nothing rings, a millisecond [s] */ period: number;
  /** of the impact [m/s] */ speed: number;
  beam: BeamRecord;
  impactor: Striking;
  law: { name: string, damps: boolean, yields: boolean, rigid: boolean, exponent: number };
  main: BeamFigures;
  /** the same impact by another number of modes */ reference: BeamFigures | null;
  /** first touch to last parting, in contact, half a period with the impactor on the beam [s] */ span: { apparent: number, real: number, half: number | null };
  /** along the beam, of every field */ places: number;
  /** (time) [s] */ time: Numbers;
  /** (time) [m] */ impactorPath: Numbers;
  /** (time) [m] */ struckPath: Numbers;
  /** (time) [m/s] */ impactorRate: Numbers;
  /** (time) [m/s] */ struckRate: Numbers;
  /** (contacts, 4) start, end [s], impulse [N s], peak force [N]; of many the first, and the last */ contacts: Contact[];
  /** (listed, 2, 2) as each contact begins and ends: of impactor and struck place [m/s] */ rates: Numbers;
  /** (wavenumbers) [1/m] */ wavenumbers?: Numbers;
  /** (wavenumbers) angular frequency [rad/s] */ lower?: Numbers;
  /** (kept modes) [rad/s] */ modeFrequencies?: Numbers;
  /** (kept modes) [1/m] */ modeWavenumbers?: Numbers;
  /** (wavenumbers) of the shear branch [rad/s] */ upper?: Numbers;
  /** (time) [m] */ referenceImpactorPath?: Numbers;
  /** (time) [m] */ referenceStruckPath?: Numbers;
  /** (reference) [s] */ referenceTime?: Numbers;
  /** (reference) [N] */ referenceForce?: Numbers;
  /** (main) of methods without modes [s] */ mainTime?: Numbers;
  /** (main) [N] */ mainForce?: Numbers;
  /** (static) of the quasi-static estimate [s] */ staticTime?: Numbers;
  /** (static) of the struck place [m] */ staticPath?: Numbers;
  /** (places) of the beam bent at rest, 1 at the struck place */ staticShape?: Numbers;
  /** (half) of the same impact on a half-space [s] */ halfTime?: Numbers;
  /** (half) [N] */ halfForce?: Numbers;
  /** (steps) one for each step [N] */ modalForce?: Numbers;
  /** (drawnModes) [rad/s] */ modalFrequencies?: Numbers;
  /** (drawnModes) mass-normalised [kg^-1/2] */ modalAtContact?: Numbers;
  /** (drawnModes, places) deflection over its scale */ shapeRows?: Numbers;
  /** (drawnModes) [kg^-1/2] */ shapeScale?: Numbers;
  /** (drawnModes, places) bending moment over its scale */ momentRows?: Numbers;
  /** (drawnModes) [N m/(m kg^1/2)] */ momentScale?: Numbers;
  /** (drawnModes, places) shear force over its scale */ shearRows?: Numbers;
  /** (drawnModes) [N/(m kg^1/2)] */ shearScale?: Numbers;
  /** (places) of the modes left out, for a force of 1 N [N m] */ momentBeside?: Numbers;
  /** (places) [N] */ shearBeside?: Numbers;
  /** (places) movement of the beam as a whole, 1 at the struck place */ rigidShape?: Numbers;
  /** of the modal force [s] */ step?: number;
  /** over which the modes left out follow the force [s] */ smoothing?: number;
  /** of critical */ damping?: number;
  /** felt at the struck place; null if the beam is held [kg] */ rigidMass?: number | null;
  /** of the beam as a whole before the impact [m/s] */ drift?: number;
  drawnModes?: number;
  /** of the quasi-static estimate, which says nothing of some */ staticModel?: string | null;
  keptModes?: number;
  /** (instants) of methods without modes, closer together at first [s] */ fieldTime?: Numbers;
  /** (instants, places) [m] */ fieldDeflection?: Numbers;
  /** (instants, places) [m/s] */ fieldVelocity?: Numbers;
  /** (instants, places) [N m] */ fieldMoment?: Numbers;
  /** (instants, places) [N] */ fieldShear?: Numbers;
}

export interface Figures {
  /** of the method */ name: string;
  /** of a method that has several */ model: string | null;
  /** whether the impact takes no time in it */ sudden: boolean;
  /** whether anything rings in it */ waves: boolean;
  /** whether it follows waves that travel, exactly */ travelling: boolean;
  /** whether the contact law acts in it */ byLaw: boolean;
  /** at the end */ stillTouching: boolean;
  /** velocity of the impactor [v, or m/s of beams] */ final: number | null;
  /** velocity of the target [v, or m/s of beams] */ targetFinal: number;
  /** [N] */ peakForce: number | null;
  /** [m] */ peakIndentation: number | null;
  /** [m] */ residualIndentation: number | null;
  restitution: Restitution;
  /** [J] */ energy: Energies;
  diagnostics: Diagnostics;
  notes: Note[];
}

export interface AxialFrame extends Common {
  kind: 'axial';
  /** (cycle) indentation [m] */ cycleDepth?: Numbers;
  /** (cycle) force of the law, slowly to the depth of this impact [N] */ cycleLoading?: Numbers;
  /** (cycle) and back [N] */ cycleUnloading?: Numbers;
  /** (impact) indentation in this impact [m] */ blowDepth?: Numbers;
  /** (impact) force in it [N] */ blowForce?: Numbers;
  /** (impact) of two smooth bodies that touch in a point [s] */ touchTime?: Numbers;
  /** (impact) of the circle on which they touch [m] */ touchRadius?: Numbers;
  /** (impact) the greatest there, the mean of a contact that flows [Pa] */ touchPressure?: Numbers;
  /** (impact) that mean over the yield strength */ touchFlow?: Numbers;
  /** (flow) by Tabor's law, slowly: indentation [m] */ flowDepth?: Numbers;
  /** (flow) mean pressure over the yield strength */ flowPressure?: Numbers;
  /** (flow) of the circle [m] */ flowRadius?: Numbers;
  /** (flow) the same by Hertz [m] */ flowElastic?: Numbers;
  /** (tests) of those, what Tabor's tests reach: indentation [m] */ testsDepth?: Numbers;
  /** (tests) mean pressure in the tests over the yield strength */ testsPressure?: Numbers;
  /** (tests) force in them [N] */ testsForce?: Numbers;
  /** T, the round trip of a wave or the time of a contact [s] */ trip: number;
  /** from left to right; none if no wave runs */ rods: RodRecord[];
  impactor: Striking;
  target: TargetRecord;
  /** v, of the impact [m/s] */ speed: number;
  /** Z v [N] */ forceUnit: number;
  /** v sqrt(E rho) [Pa] */ stressUnit: number;
  /** chosen */ modes: number;
  /** of the modal force, or that on the modes [T] */ step: number | null;
  /** for how long the impact is followed if that is asked [T], else 0 */ asked: number;
  /** whether modes are marched in as many steps as follow from the choices */ usualSteps: boolean;
  /** whether modes that are left out do */ givesWay: boolean;
  /** whether these modes are those of a frame fixed to the struck end */ attached: boolean;
  exact: AxialFigures;
  /** the method beside it */ other: AxialFigures | null;
  /** between rods: number of the second rod, and when it is closed [T] */ gaps: Gap[];
  /** of a row, parted for good [T, v] */ lastBall: [time: number, velocity: number] | null;
  /** velocities by rigid-body theory [v] */ prediction: { impactor: number, target: number } | null;
  /** restitution that would have matched */ match: number | null;
  /** whether nothing gives way at the contact itself */ rigid: boolean;
  /** of a mass on a rod, that can be chosen: for kernels of the browser */ laws: LawRecord[];
  /** of rods one behind the other, with rigid faces: for the kernel that follows their waves */ chain: ChainRecord | null;
  /** of a mass that is balanced against a rod, or against a mass on a spring */ balance: BalanceRecord | null;
  /** of two bodies that move as wholes, by a law and its closed form, or a half sine for it */ compact: { sine: boolean } | null;
  /** share of its mass with the end of a rod that bends as a spring by the other method; else null */ springCarries: number | null;
  /** whether the contact law does */ damps: boolean;
  /** whether the contact law does */ yields: boolean;
  /** power of the indentation with which its force begins, 1 where nothing gives way */ exponent: number;
  /** restitution by the usual formula of the law */ nominal: number | null;
  /** that a damping law delivers */ leastRestitution: number;
  /** sheets that can lie on the struck face */ cushions: Cushion[];
  /** (motion) [T] */ motionTime: Numbers;
  /** (motion) displacement of the impactor [v T] */ exactMass: Numbers;
  /** (motion) and of the struck end [v T] */ exactEnd: Numbers;
  /** (motion) and of the mass centre of a rod that nothing holds [v T] */ exactWhole?: Numbers;
  /** (motion, balls) displacement of every ball of a row, gaps before it included [v T] */ exactRow?: Numbers;
  /** (motion, bodies) velocity of the impactor and of every ball of a row [v] */ exactRowVelocity?: Numbers;
  /** (motion, balls) force of every contact of a row, from the impactor's on [Z v] */ exactRowForce?: Numbers;
  /** (exact force) at a jump twice [T] */ exactTime: Numbers;
  /** (exact force) [Z v] */ exactForce: Numbers;
  /** of a body that is dropped */ fall?: FallRecord;
  /** (fallen) from its release on [s] */ fallTime?: Numbers;
  /** (fallen) parabola by parabola [m] */ fallHeight?: Numbers;
  /** (bounces, 4) time from the release on [s], impulse [N s], height after it [m], restitution */ bounces?: Numbers;
  /** (bounces, 2) how long each touches [s], and its largest force [N] */ touches?: Numbers;
  /** (bounces, touch) evenly over that [N] */ touchForce?: Numbers;
  /** (motion) [v T] */ otherMass?: Numbers;
  /** (motion) [v T] */ otherEnd?: Numbers;
  /** (other force) [T] */ otherTime?: Numbers;
  /** (other force) [Z v] */ otherForce?: Numbers;
  /** (steps) one for each step, from which the browser rebuilds the modes [Z v] */ modalForce?: Numbers;
  /** (steps) likewise, for the fields alone: its history is that of the other force [Z v] */ fieldForce?: Numbers;
  /** (motion, bar places) of a pendulum that bends, from its pivot on [v T] */ exactBar?: Numbers;
  /** (motion, bar places) likewise [v T] */ otherBar?: Numbers;
  /** (half motion, half bar places) bending moment there, of every second [N m] */ exactBend?: Numbers;
  /** (half motion, half bar places) likewise [N m] */ otherBend?: Numbers;
  /** (moments) [T] */ momentTime?: Numbers;
  /** (moments, 3) of a bar that bends: at its pivot, half way, at the contact [N m] */ exactMoments?: Numbers;
  /** (moments, 3) [N m] */ otherMoments?: Numbers;
  /** (balances) [T] */ balanceTime?: Numbers;
  /** (balances) impulse over the step [Z v] */ balanceForce?: Numbers;
  /** (balanced modes, places) and motion as a whole, of what is struck [kg^-1/2] */ balanceShapes?: Numbers;
  /** (balanced modes, places) tension per 1 of each coordinate [Pa / (m kg^1/2)] */ balanceStresses?: Numbers;
  /** (motion, bar places) of a rod that turns and is struck across, from its axis on [v T] */ turningBar?: Numbers;
  /** (exact instants, exact places) of a rod that turns [v sqrt(E rho)] */ exactStress?: Numbers;
  /** (exact instants, exact places) [v] */ exactVelocity?: Numbers;
  /** (exact instants, exact places) [v T] */ exactDisplacement?: Numbers;
  /** (instants, places) [v sqrt(E rho)] */ fieldStress?: Numbers;
  /** (instants, places) [v] */ fieldVelocity?: Numbers;
  /** (instants, places) [v T] */ fieldDisplacement?: Numbers;
  /** of the arrays, by name */ shapes: Record<string, number[]>;
  /** a measured force laid over the others */ record?: { time: number[]; force: number[] };
}

export interface BeamFrame extends Bending {
  kind: 'beam';
  /** by which a browser finds the same impact with other choices */ march: MarchRecord | null;
  /** that can be chosen there, in units of s, v and kg v/s */ laws: LawRecord[];
  /** that a damped law can deliver */ leastRestitution: number;
  /** of the arrays, by name */ shapes: Record<string, number[]>;
}

export interface MechanismFrame extends Bending {
  kind: 'mechanism';
  /** of which the struck link stands for the beam */ mechanism: MechanismRecord;
  /** of one that moves on as far as it goes */ moving: MovingRecord | null;
  /** (links, link places, 2) as the impact begins; unbent if it moves on [m] */ linkPoints?: Numbers;
  /** (link instants) closer together at first [s] */ linkTime?: Numbers;
  /** (link instants, links, link places, 2) how far they have come [m] */ linkMoves?: Numbers;
  /** (link instants, 2) of one that moves on: where the mass is [m] */ massPlaces?: Numbers;
  /** (2, edges) as contacts begin and end: time [s], angle of the normal [rad] */ normals?: Numbers;
  /** (bend instants) [s] */ bendTime?: Numbers;
  /** (energy instants) [s] */ energyTime?: Numbers;
  /** (energy instants, energy parts) [J] */ energies?: Numbers;
  /** (reaction instants) [s] */ reactionTime?: Numbers;
  /** (reaction instants, joints, 3) on the second link of each joint [N, N, N m] */ reactions?: Numbers;
  /** (reference reaction instants) [s] */ referenceReactionTime?: Numbers;
  /** (reference reaction instants, joints, 3) [N, N, N m] */ referenceReactions?: Numbers;
  /** of the arrays, by name */ shapes: Record<string, number[]>;
}

export interface SpaceFrame extends Common {
  kind: 'bodies';
  /** of what is drawn [m] */ size: number;
  /** of the picture, to the right */ across: Vector;
  /** of the picture */ up: Vector;
  /** of the contact */ normal: Vector;
  /** the normal as the scene has it, and two tangents, from which a tilt counts */ ownFrame: Vector[];
  /** its size [N s] */ impulse: number;
  /** the impulse on the target [N s] */ push: Vector;
  friction: number;
  /** of the contact; none without friction [N s] */ sliding: { kind: 'slip' | 'stick' | 'reversal', until: number }[];
  bodies: { impactor: BodyRecord, target: BodyRecord };
  /** beside the picture: name, number or vector, unit */ figures: FigureRecord[];
  notes: Note[];
  /** (samples, 3) of the centre, from the point of impact [m] */ impactorPath: Numbers;
  /** (samples, 3) [m] */ targetPath: Numbers;
  /** (samples, 3, 3) from the instant of the impact */ impactorTurn: Numbers;
  /** (samples, 3, 3) */ targetTurn: Numbers;
  /** (course) normal impulse, where there is friction [N s] */ slidePress?: Numbers;
  /** (course) velocity at which the touching points part [m/s] */ slideParting?: Numbers;
  /** (course) at which the impactor slides on the target, in the picture [m/s] */ slideAlong?: Numbers;
  /** (course) and towards who looks [m/s] */ slideAside?: Numbers;
  /** (course, 3) on the target, so far [N s] */ slideImpulse?: Numbers;
  /** (course) size of the impulse of friction [N s] */ slidePush?: Numbers;
  /** (course, 2, 3) of the impactor and of the target [rad/s] */ slideSpins?: Numbers;
  /** of the arrays, by name */ shapes: Record<string, number[]>;
}

export type Frame = AxialFrame | BeamFrame | MechanismFrame | SpaceFrame;
