"""Scenes of rods for the kernel `numerics.wave_network`, and what it found; `chain_motion` makes a motion of it.

Units inside: time in the scene's T, velocity in the speed of approach v, force in Z v of the struck rod, length in v T.
"""

import math
from typing import Any

import numpy as np

from ..bodies import Rod
from ..contact import Linear, Rigid
from ..doubts import ENDS_EARLY, NEVER_PART, STILL_TOUCHING, cut_short
from ..method import MAX_ROUND_TRIPS
from ..numerics import wave_network
from ..numerics.wave_laws import constants_of, law_function, new_work
from ..numerics.wave_nodes import ABSORBING, BONDED, FREE, LAW, PRESSED, RIGID_FACES, Chain, new_state
from ..numerics.wave_record import (
    DEPTH,
    FORCE,
    IMPULSE,
    OUT_LEFT,
    OUT_RIGHT,
    highest,
    new_record,
    sample,
)
from ..scene import Scene
from ..solution import ContactPeriod

STRETCHES = 4_000  # of a node, to begin with
MAX_STRETCHES = 200_000  # of all nodes together
ROUNDING = 1e-12  # of the waves at a contact, and of v T: less force, and less of an opening, is none
UNKNOWN = 2.0  # error of a velocity of which one knows only that it lies between -v and v
NO_LAW = Linear(1.0)  # where no law is asked for


def end_notes(parted: bool, touching: bool, asked: bool, full: str | None = None) -> list[str]:
    """What to say of the end of a solution; `full`: the limit that it has come to, beside that of round trips."""
    if full or (not parted and not asked):
        return [cut_short(full or f"{MAX_ROUND_TRIPS:.0f} round trips")]
    return [STILL_TOUCHING] if touching else []


class ChainHistory:
    """What the kernel returned for a scene."""

    def __init__(self, scene: Scene, until: float, tolerance: float):
        """Solve up to `until` [T], or until the impactor has parted for good if that is infinite."""
        self.scene = scene
        self.trip, self.speed = scene.time_unit, scene.speed
        self.force_unit = scene.target.impedance * self.speed
        self.rods: list[Rod] = ([scene.impactor] if scene.impactor.kind == "rod" else []) + list(scene.target.rods)
        self.contact = len(self.rods) - len(scene.target.rods)
        self.faded = False
        self.laws = self._laws()
        self.chain = self._chain()
        if scene.impactor.kind == "pulse":
            until = min(until, scene.impactor.end / self.trip + 2.0)
        elif self.rods[-1].support == "anechoic":
            faded = self._faded()
            self.faded, until = faded <= until, min(until, faded)
        asked, limit = math.isfinite(until), min(until, MAX_ROUND_TRIPS)
        wait = math.inf if asked else 2.0 * sum(rod.round_trip_time for rod in self.rods) / self.trip
        capacity = min(STRETCHES, MAX_STRETCHES // len(self.laws))
        while True:
            self.record, self.state = new_record(len(self.laws), capacity), new_state(self.chain, capacity)
            rooms = self.record, self.state, new_work()
            status = wave_network.solve(
                self.chain, *rooms, *self._kernel_laws(), self._pulse(), self._masses(), wait, limit, tolerance
            )
            if status != wave_network.FULL or capacity >= MAX_STRETCHES // len(self.laws):
                break
            capacity = min(8 * capacity, MAX_STRETCHES // len(self.laws))
        self.reach = float(self.state.time.min())
        self.steps = int(self.record.count.sum())
        self.contacts = self.periods(self.contact)
        self.failed = status == wave_network.FAILED
        self.full = f"{MAX_STRETCHES} stretches of waves" if status == wave_network.FULL else None
        self.cut = status in (wave_network.FULL, wave_network.FAILED) or (status == wave_network.STOPPED and not asked)
        self.touching = bool(self.contacts[-1].end >= self.reach * self.trip * (1.0 - 1e-12))

    def notes(self) -> list[str]:
        if self.failed:
            return [
                f"The equations of a contact could not be solved beyond this time: {ENDS_EARLY}; try another tolerance."
            ]
        if self.faded and self.touching and not self.cut:
            return [NEVER_PART]
        return end_notes(not self.cut, self.touching, False, self.full)

    def _laws(self) -> list[Any]:
        """The scaled law of every node, or None."""
        laws: list[Any] = [None] * (len(self.rods) + 1)
        laws[self.contact] = self.scene.contact
        for number, law in enumerate(self.scene.joint_laws, self.contact + 1):
            laws[number] = law
        units = self.speed * self.trip, self.speed, self.force_unit
        return [None if law is None or isinstance(law, Rigid) else law.scaled(*units) for law in laws]

    def _kernel_laws(self) -> tuple[Any, Any, np.ndarray, np.ndarray, np.ndarray]:
        """Law of the contact, law of the joints; constants of each node's, and whether it remembers, and loses."""
        laws = [law or NO_LAW for law in self.laws]
        joints = [law for node, law in enumerate(self.laws) if law is not None and node != self.contact]
        return (
            law_function(type(laws[self.contact])),
            law_function(type(joints[0] if joints else NO_LAW)),
            constants_of(laws),
            np.array([law.PLASTIC for law in laws]),
            np.array([law.LOSSY for law in laws]),
        )

    def _chain(self) -> Chain:
        """The scene as nodes and rods."""
        scene, nodes = self.scene, len(self.rods) + 1
        kind, gap = np.full(nodes, BONDED), np.zeros(nodes)
        mass_left, mass_right, mass_drift = np.zeros(nodes), np.zeros(nodes), np.zeros(nodes)
        mass_unit = self.force_unit * self.trip / self.speed
        if scene.impactor.kind == "rod":
            kind[0] = FREE
        elif scene.impactor.kind != "pulse":
            mass_left[0], mass_drift[0] = scene.impactor.mass / mass_unit, scene.impactor.velocity / self.speed
        for number, joint in enumerate(scene.target.joints, self.contact + 1):
            gap[number] = joint.gap / (self.speed * self.trip)
            if not joint.bonded:
                kind[number] = RIGID_FACES if self.laws[number] is None else LAW
        kind[self.contact] = RIGID_FACES if self.laws[self.contact] is None else LAW
        if scene.impactor.kind == "pulse":
            kind[0] = PRESSED
        last = self.rods[-1]
        if last.support == "free":
            kind[-1], mass_right[-1] = (BONDED, last.end_mass / mass_unit) if last.end_mass else (FREE, 0.0)
            mass_drift[-1] = last.velocity / self.speed
        elif last.support == "fixed":
            mass_right[-1] = math.inf
        else:
            kind[-1] = ABSORBING
        return Chain(
            np.array([rod.impedance for rod in self.rods]) / scene.target.impedance,
            np.array([0.5 * rod.round_trip_time for rod in self.rods]) / self.trip,
            np.array([rod.velocity for rod in self.rods]) / self.speed,
            kind,
            mass_left,
            mass_right,
            mass_drift,
            gap,
            self.contact,
        )

    def _faded(self) -> float:
        """Time [T] by which a mass on rods without an end has given off all its speed but a millionth."""
        slowest = min(rod.impedance for rod in self.scene.target.rods)
        return 2.0 * len(self.rods) + 14.0 * self.scene.impactor.mass / slowest / self.trip

    def _pulse(self) -> np.ndarray:
        """Times and values of a prescribed force."""
        pulse = self.scene.impactor
        if pulse.kind != "pulse":
            return np.zeros((2, 1))
        return np.array([pulse.times, pulse.forces]) / np.array([[self.trip], [self.force_unit]])

    def _masses(self) -> np.ndarray:
        """Of the part to the right of every joint that can open, the contact being one; of the impactor at last."""
        unit = self.force_unit * self.trip / self.speed
        masses = np.full(len(self.laws) + 1, math.inf)
        target, part = self.scene.target, self.contact
        masses[part] = 0.0
        for number, rod in enumerate(target.rods):
            if number and not target.joints[number - 1].bonded:
                part = self.contact + number
                masses[part] = 0.0
            masses[part] += rod.mass / unit
        if target.held:
            masses[part] = math.inf
        masses[-1] = self.scene.impactor.mass / unit
        return masses

    def sampled(self, node: int, quantity: int, t: np.ndarray, after: bool = True) -> np.ndarray:
        """A kept quantity of a node at times [T]; beyond the end of the time solved, its last value."""
        t = np.asarray(t, float)
        out = np.empty(t.size)
        sample(self.record, node, quantity, np.ascontiguousarray(t.ravel()), after, out)
        return out.reshape(t.shape)

    def periods(self, node: int) -> list[ContactPeriod]:
        """Stretches of time in which the faces at a node press on each other.

        Faces that stay together without force, as two equal rods do, do not press; openings no larger than rounding,
        from the dent that is left, part nothing.
        """
        count = int(self.record.count[node])
        values, start = self.record.values[node, :count], self.record.start[node]
        force, closed = values[:, FORCE], self.record.closed[node, :count]
        waves = np.maximum(np.abs(values[:, OUT_LEFT]), np.abs(values[:, OUT_RIGHT]))
        arriving = np.maximum(np.abs(force - values[:, OUT_LEFT]), np.abs(force - values[:, OUT_RIGHT]))
        presses = closed & (force.max(axis=1) > ROUNDING * np.maximum(waves, arriving).max(axis=1))
        together = closed | (values[:, DEPTH].min(axis=1) - self._dents(node) > -ROUNDING)
        edges = np.flatnonzero(np.diff(np.concatenate(([0], together.astype(np.int8), [0]))))
        found = []
        for first, beyond in edges.reshape(-1, 2):
            pressing = first + np.flatnonzero(presses[first:beyond])
            if not pressing.size:
                continue
            begins, ends = int(pressing[0]), int(pressing[-1])
            impulse = values[ends, IMPULSE, -1] - values[begins, IMPULSE, 0]
            found.append(
                ContactPeriod(
                    start=self.trip * float(start[begins]),
                    end=self.trip * float(start[ends + 1]),
                    impulse=self.force_unit * self.trip * float(impulse),
                    peak_force=self.force_unit * highest(self.record, node, begins, ends),
                )
            )
        return found

    def _dents(self, node: int) -> np.ndarray:
        """Indentation at which the faces at a node come apart, by the end of every stretch [v T]."""
        law, ends = self.laws[node], self.record.values[node, : int(self.record.count[node]), DEPTH, -1]
        if law is None or not law.PLASTIC:
            return np.zeros(ends.size)
        deepest, where = np.unique(np.maximum.accumulate(np.maximum(ends, 0.0)), return_inverse=True)
        return np.array([law.dent(depth) for depth in deepest.tolist()])[where]

    def deepest(self) -> float | None:
        """Largest indentation of the contact [m]; None for rigid faces."""
        if self.laws[self.contact] is None:
            return None
        count = int(self.record.count[self.contact])
        t = self.record.start[self.contact, : count + 1]
        fine = np.unique((t[:-1, None] + np.diff(t)[:, None] * np.linspace(0.0, 1.0, 9)).ravel())
        depth = self.sampled(self.contact, DEPTH, fine)
        k = int(np.argmax(depth))
        near = np.linspace(fine[max(k - 1, 0)], fine[min(k + 1, fine.size - 1)], 201)
        return self.speed * self.trip * float(self.sampled(self.contact, DEPTH, near).max())

    def dent(self) -> float | None:
        """Indentation left behind [m]."""
        law = self.laws[self.contact]
        if law is None:
            return None
        return self.speed * self.trip * float(law.dent(float(self.state.deepest[self.contact])))

    def jumps(self) -> np.ndarray:
        """Times [T] at which the contact force may jump or bend."""
        count = int(self.record.count[self.contact])
        breaks = self.state.breaks[self.contact, : int(self.state.break_count[self.contact])]
        closed = self.record.closed[self.contact, :count]
        events = self.record.start[self.contact, 1:count][closed[1:] != closed[:-1]]
        return np.unique(np.concatenate(([0.0], events, breaks[breaks <= self.reach])))
