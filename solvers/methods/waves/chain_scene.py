"""A scene of rods in the units and arrays of the kernels `numerics.waves.network` and `numerics.waves.grid`.

Units inside: time in the scene's T, velocity in the speed of approach v, force in Z v of the struck rod, length in v T.
"""

import math
from abc import ABC, abstractmethod
from typing import Any, NamedTuple

import numpy as np

from ...bodies import AnyBody, Joint, Pulse, Rod, SpringMass, Waveguide
from ...contact import Linear, Rigid
from ...numerics.law_functions import constants_of
from ...numerics.waves.collocation import NODES
from ...numerics.waves.parts import ABSORBING, BONDED, FREE, LAW, PRESSED, RIGID_FACES, Chain
from ...numerics.waves.record import (
    DEPTH,
    FORCE,
    IMPULSE,
    LOST,
    OUT_LEFT,
    OUT_RIGHT,
    PLACE,
    POINTS,
    SPEED,
    TOTAL_LEFT,
    TOTAL_RIGHT,
)
from ...scene import Scene
from ...solution.solution import ContactPeriod
from ...text.notes import Note, Severity
from ..base import MAX_ROUND_TRIPS
from ..parting import MAY_TOUCH_AGAIN
from ..validity import MAX_TRUSTED_ERROR, NEVER_PART, STILL_TOUCHING, TOUCH_ON, cut_short
from .weight import Falling

NO_LAW = Linear(1.0)  # where no law is asked for
UNKNOWN = 2.0  # error of a velocity of which one knows only that it lies between -v and v


def end_notes(parted: bool, touching: bool, asked: bool, full: Note | None = None) -> list[Note]:
    """What to say of the end of a solution; `full`: of the limit that it has come to, beside that of round trips."""
    if full or (not parted and not asked):
        return [full or cut_short(MAX_ROUND_TRIPS, "trips")]
    return [STILL_TOUCHING] if touching else []


class End(NamedTuple):
    """What is at an outer end of a chain, where nothing else meets it."""

    kind: int  # as of a node of `numerics.waves.parts`
    mass: float  # [kg] that moves with it: 0 for none, infinite where it is held
    velocity: float  # before the impact [m/s]
    spring: float = 0.0  # on which it stands [N/m]


def end_of(body: AnyBody) -> End:
    """The outer end of a body, on whichever side of the contact: of rods the far one, of a mass or a wall itself."""
    if isinstance(body, Pulse):
        return End(PRESSED, 0.0, 0.0)
    if not body.rods:
        return End(BONDED, body.mass, body.velocity, body.stiffness if isinstance(body, SpringMass) else 0.0)
    last: Rod = body.rods[-1]
    if last.support == "anechoic":
        return End(ABSORBING, 0.0, 0.0)
    if last.support == "fixed":
        return End(BONDED, math.inf, 0.0)
    return End(BONDED if last.end_mass else FREE, last.end_mass, last.velocity)


def all_bonded(scene: Scene) -> bool:
    """Whether no rod of either body can come apart from the next: else each would fall, and rest, by itself."""
    bodies = [body for body in (scene.impactor, scene.target) if isinstance(body, Waveguide)]
    return all(joint.bonded for body in bodies for joint in body.joints)


class ChainScene:
    """What the kernels take of a scene."""

    def __init__(self, scene: Scene):
        self.scene = scene
        self.trip, self.speed = scene.time_unit, scene.speed
        self.force_unit = scene.impedance * self.speed
        self.rods: list[Rod] = [*scene.impactor.rods[::-1], *scene.target.rods]
        self.contact = len(scene.impactor.rods)
        self.ends = end_of(scene.impactor), end_of(scene.target)
        self.laws = self._laws()
        self.chain = self._chain()
        self.masses = self._masses()
        self.striker = scene.impactor.mass / self._mass_unit
        self.pulse = self._pulse()

    @property
    def _mass_unit(self) -> float:
        return self.force_unit * self.trip / self.speed

    @property
    def joints(self) -> dict[int, tuple[Joint, Any]]:
        """Joint and law, None if bonded, at every node between two rods of one body."""
        scene, found = self.scene, {}
        for body, laws, way in ((scene.impactor, scene.striker_laws, -1), (scene.target, scene.joint_laws, 1)):
            if body.rods:
                pairs = zip(body.known_as(Waveguide).joints, laws or (None,) * len(body.rods), strict=False)
                found |= {self.contact + way * number: pair for number, pair in enumerate(pairs, 1)}
        return found

    def _laws(self) -> list[Any]:
        """The scaled law of every node, or None."""
        laws: list[Any] = [None] * (len(self.rods) + 1)
        laws[self.contact] = self.scene.contact
        for node, (_, law) in self.joints.items():
            laws[node] = law
        units = self.speed * self.trip, self.speed, self.force_unit
        return [None if law is None or isinstance(law, Rigid) else law.scaled(*units) for law in laws]

    def kernel_laws(self) -> tuple[type, type, np.ndarray]:
        """Sort of law at the contact, and at the joints; constants of each node's."""
        laws = [law or NO_LAW for law in self.laws]
        joints = [law for node, law in enumerate(self.laws) if law is not None and node != self.contact]
        return type(laws[self.contact]), type(joints[0] if joints else NO_LAW), constants_of(laws)

    @property
    def plastic(self) -> np.ndarray:
        """Whether the law of each node remembers."""
        return np.array([(law or NO_LAW).PLASTIC for law in self.laws])

    @property
    def lossy(self) -> np.ndarray:
        """Whether the law of each node has damping."""
        return np.array([(law or NO_LAW).LOSSY for law in self.laws])

    def _chain(self) -> Chain:
        """The scene as nodes and rods."""
        nodes, scene = len(self.rods) + 1, self.scene
        kind, gap = np.full(nodes, BONDED), np.zeros(nodes)
        masses, drift = np.zeros((2, nodes)), np.zeros(nodes)  # masses: left and right of a node
        for side, (node, end) in enumerate(zip((0, -1), self.ends, strict=True)):
            kind[node], masses[side, node] = end.kind, end.mass / self._mass_unit
            drift[node] = end.velocity / self.speed
        for node, (joint, _) in self.joints.items():
            gap[node] = joint.gap / (self.speed * self.trip)
            if not joint.bonded:
                kind[node] = RIGID_FACES if self.laws[node] is None else LAW
        if not scene.prescribed_force:
            kind[self.contact] = RIGID_FACES if self.laws[self.contact] is None else LAW
        return Chain(
            np.array([rod.impedance for rod in self.rods]) / scene.impedance,
            np.array([0.5 * rod.round_trip_time for rod in self.rods]) / self.trip,
            np.array([rod.velocity for rod in self.rods]) / self.speed,
            kind,
            masses[0],
            masses[1],
            drift,
            gap,
            self.contact,
            self.ends[1].spring * self.speed * self.trip / self.force_unit,
            scene.weight_acceleration * self.trip / self.speed if all_bonded(scene) else 0.0,
        )

    def _pulse(self) -> np.ndarray:
        """The smooth pieces of a prescribed force, as `network.solve` takes them."""
        pulse = self.scene.impactor
        if not isinstance(pulse, Pulse):
            return np.zeros((1, 2 + POINTS))
        edges, forces = pulse.pieces(NODES)
        return np.column_stack((edges / self.trip, forces / self.force_unit))

    def _masses(self) -> np.ndarray:
        """Of the part to the right of every joint that can open, the contact being one; of the first part at last."""
        nodes, part = len(self.rods) + 1, -1
        masses = np.full(nodes + 1, math.inf)
        masses[-1] = self.ends[0].mass
        for node in range(nodes):
            joint = self.joints.get(node)
            if node == self.contact or (joint and not joint[0].bonded):
                part = node
                masses[part] = 0.0
            if node < nodes - 1:
                masses[part] += self.rods[node].mass - self.rods[node].end_mass
        masses[part] += math.inf if self.scene.target.held else self.ends[1].mass
        return masses / self._mass_unit


class ChainHistory(ABC):
    """What a kernel found for a scene, in its units; `chain_motion` makes a motion of it.

    chain: as it was solved; reach [T]: how far; steps: of all nodes; cut: ended before all was over; error: of the
    final velocity of the impactor [v], beside what the balances of energy and momentum show.
    """

    chain: Chain
    reach: float
    steps: int
    cut: bool
    error: float
    contacts: list[ContactPeriod]
    touching: bool
    faded: bool  # before a rod without end: nothing is left to come
    doubtful: bool  # the bodies have moved apart, but may touch again
    falls: Falling | None = None  # how an impact under weight goes, where no end was asked for

    def __init__(self, given: ChainScene):
        self.given, self.scene, self.chain = given, given.scene, given.chain
        self.trip, self.speed, self.force_unit = given.trip, given.speed, given.force_unit
        self.rods, self.contact, self.laws = given.rods, given.contact, given.laws

    # --- what falls, seen from the ground: its waves are those in the frame that falls with it ------------------------

    def fallen(self, t: np.ndarray) -> np.ndarray:
        """By how much its weight alone has moved the impactor [v T]."""
        return 0.5 * self.chain.fall * t * t

    def gained(self, t: np.ndarray) -> np.ndarray:
        """By how much its weight alone has sped it up [v]."""
        return self.chain.fall * t

    def velocity_as_whole(self, t: np.ndarray) -> np.ndarray:
        """Of the impactor [v], which its weight changes and the contact force."""
        first = self.chain.drift[0] if self.contact else self.chain.mass_drift[0]
        return first + self.gained(t) - self.sampled(self.contact, IMPULSE, t) / self.given.striker

    def middle(self, t: np.ndarray) -> np.ndarray:
        """How far the centre of mass of the impactor has come [v T]."""
        if not self.contact:
            return self.sampled(0, PLACE, t) + self.fallen(t)
        pushed = self.integrated(self.contact, IMPULSE, t) / self.given.striker
        return self.chain.drift[0] * t + self.fallen(t) - pushed

    def pressing(self, t: float) -> float:
        """The contact force at the end of the time solved [Z v]."""
        return float(self.sampled(self.contact, FORCE, np.array([t]), False)[0])

    def estimated_error(self, residual: float, unbalanced: float, tolerance: float) -> float:
        """Of the final velocity of the impactor [v]; residual: what energies and momenta miss, unbalanced: momenta."""
        return UNKNOWN if self.cut else max(residual, self.error, tolerance)

    def end_notes(self) -> list[Note]:
        """What to say of the end of the solution."""
        found = []
        if not self.cut and self.error >= MAX_TRUSTED_ERROR:
            found.append(Note("sensitive-chain", Severity.INVALID, error=self.error))
        if self.faded:
            return [*found, NEVER_PART if self.touching else TOUCH_ON]
        if self.doubtful:
            return [*found, MAY_TOUCH_AGAIN]
        if self.falls and not self.cut:
            return [*found, *self.falls.notes()]
        return found + end_notes(not self.cut, self.touching, False)

    @abstractmethod
    def notes(self) -> list[Note]:
        """What to say of the end of the solution, and of how it was found."""

    @abstractmethod
    def sampled(self, node: int, quantity: int, t: np.ndarray, after: bool = True) -> np.ndarray:
        """A kept quantity of a node at times [T]; beyond the end of the time solved, its last value."""

    @abstractmethod
    def integrated(self, node: int, quantity: int, t: np.ndarray) -> np.ndarray:
        """A kept quantity of a node, integrated from the beginning to each time [T]."""

    @abstractmethod
    def squares(self, node: int, quantity: int, begin: float, end: float) -> float:
        """Integral of the square of a wave that a node sends."""

    @abstractmethod
    def periods(self, node: int) -> list[ContactPeriod]:
        """Stretches of time in which the faces at a node press on each other."""

    @abstractmethod
    def deepest_at(self, node: int, t: np.ndarray) -> np.ndarray:
        """Largest indentation of a node so far [v T]; where it has a law."""

    @abstractmethod
    def jumps(self) -> np.ndarray:
        """Times [T] at which the contact force may jump or bend."""

    @abstractmethod
    def sent_jumps(self, node: int, quantity: int) -> np.ndarray:
        """Times [T] at which a wave that a node sends jumps."""

    @abstractmethod
    def largest_depth(self) -> float:
        """Of the contact [v T], between the points kept too."""

    def deepest(self) -> float | None:
        """Largest indentation of the contact [m]; None for rigid faces."""
        return None if self.laws[self.contact] is None else self.speed * self.trip * self.largest_depth()

    def dent(self) -> float | None:
        """Indentation left behind [m]."""
        law = self.laws[self.contact]
        if law is None:
            return None
        deepest = float(self.deepest_at(self.contact, np.array([self.reach]))[0])
        return self.speed * self.trip * float(law.dent(deepest))

    def rod_energy(self, rod: int, t: np.ndarray) -> np.ndarray:
        """Kinetic and strain energy of a rod [Z v^2 T], without what is fixed to its end, at times (instants,) [T]."""
        lag, z, drift = self.chain.transit[rod], self.chain.impedance[rod], self.chain.drift[rod]
        ends = (rod, OUT_RIGHT, TOTAL_RIGHT), (rod + 1, OUT_LEFT, TOTAL_LEFT)
        held = [sum(self.squares(node, sent, max(now - lag, 0.0), now) for node, sent, _ in ends) for now in t.tolist()]
        inside = [self.sampled(node, total, t) - self.sampled(node, total, t - lag) for node, _, total in ends]
        return 0.5 * z * lag * drift**2 + drift * (inside[0] - inside[1]) + np.array(held) / z

    def energy_left(self, t: float) -> float:
        """Share of the energy at first that is still in bodies, rods and contacts at a time [T]."""
        now, energy = np.array([t]), 0.0
        for node, mass in enumerate(self.chain.mass_left + self.chain.mass_right):
            if 0.0 < mass < math.inf:
                energy += 0.5 * mass * float(self.sampled(node, SPEED, now)[0]) ** 2
        energy += sum(float(self.rod_energy(rod, now)[0]) for rod in range(len(self.rods)))
        unit = self.force_unit * self.speed * self.trip
        return (energy + float(np.sum(self.stored(now)))) * unit / self.scene.initial_energy

    def stored(self, t: np.ndarray) -> np.ndarray:
        """Energy stored in the contact laws [Z v^2 T], where faces press on each other."""
        found = np.zeros(t.size)
        for node, law in enumerate(self.laws):
            if law is not None:
                found += np.where(self.sampled(node, FORCE, t) > 0.0, self._held(node, t), 0.0)
        return found

    def dissipated(self, t: np.ndarray) -> np.ndarray:
        """Energy that the contact laws have lost so far [Z v^2 T].

        Once faces press on each other no more, a damped law gives what it still stores back to nobody, as dents go
        down by themselves: all is lost that was not given back when they parted.
        """
        found = np.zeros(t.size)
        for node, law in enumerate(self.laws):
            if law is not None:
                presses, at = self.sampled(node, FORCE, t) > 0.0, self._pressed_last(node, t)
                at = np.where(presses, t, at)
                found += self.sampled(node, LOST, at) + np.where(presses, 0.0, self._held(node, at))
        return found

    def _pressed_last(self, node: int, t: np.ndarray) -> np.ndarray:
        """The times themselves within a contact of a node, and after one its end [T]."""
        periods = np.array([(period.start, period.end) for period in self.periods(node)]).reshape(-1, 2) / self.trip
        if not periods.size:
            return t
        begun, ended = (np.searchsorted(edges, t, "right") for edges in periods.T)
        return np.where((ended == 0) | (begun > ended), t, periods[ended - 1, 1])

    def _held(self, node: int, t: np.ndarray) -> np.ndarray:
        """Energy in the indentation of a node [Z v^2 T]."""
        law, depth, deepest = self.laws[node], self.sampled(node, DEPTH, t), self.deepest_at(node, t)
        return np.array([law.stored(a, d) for a, d in zip(depth.tolist(), deepest.tolist(), strict=True)])
