"""Exact waves in a chain of rods, by the kernel `numerics.waves.network`."""

import math

import numpy as np

from ...numerics.waves import network as wave_network
from ...numerics.waves.events import NO_PULL
from ...numerics.waves.laws import law_function, new_work
from ...numerics.waves.nodes import new_state
from ...numerics.waves.parts import BONDED
from ...numerics.waves.record import (
    DEPTH,
    FORCE,
    IMPULSE,
    OUT_LEFT,
    OUT_RIGHT,
    highest,
    new_record,
    pushed,
    sample,
    square_integral,
)
from ...solution.solution import ContactPeriod
from ...text.notes import Note, Severity
from ..base import MAX_ROUND_TRIPS
from .chain_scene import CONTACT_ROUNDING, MILLIONTH, ChainHistory, ChainScene

STRETCHES = 4_000  # of a node, to begin with
MAX_STRETCHES = 200_000  # of all nodes together
MAX_ECHO_GROWTH = 1.5  # the power of time with which echoes are expected to multiply, at most: they fade, too


class ExactHistory(ChainHistory):
    """Every node followed from event to event."""

    def __init__(self, given: ChainScene, until: float, tolerance: float, instead_of: float | None = None):
        """Solve up to `until` [T], or until the impactor has parted for good if that is infinite.

        instead_of: the tolerance that was wanted, where it is not affordable.
        """
        super().__init__(given)
        self.tolerances = tolerance, instead_of
        self.asked, self.faded = math.isfinite(until), False
        most = MAX_STRETCHES // len(self.laws)
        capacity = min(STRETCHES, most)
        while True:
            self.record, self.state = new_record(len(self.laws), capacity), new_state(self.chain, capacity)
            status = self._follow(min(until, MAX_ROUND_TRIPS), tolerance)
            if (
                status != wave_network.FULL
                or capacity >= most
                or (self.asked and self._needed(until) > most / capacity)
            ):
                break
            capacity = min(8 * capacity, most)
        self.reach = float(self.state.time.min())
        self.steps = int(self.record.count.sum())
        self.contacts = self.periods(self.contact)
        self.gave_up = status in (wave_network.FULL, wave_network.FAILED)
        self.cut = self.gave_up or (status == wave_network.STOPPED and not self.asked and not self.faded)
        self.error = max(tolerance, MILLIONTH if self.faded else 0.0)
        self.touching = bool(self.contacts[-1].end >= self.reach * self.trip * (1.0 - 1e-12))

    def _follow(self, limit: float, tolerance: float) -> int:
        """Run the kernel; how it ended. Before a rod without end, look now and then whether anything is left."""
        endless = not self.asked and self.rods[-1].support == "anechoic"
        wait = math.inf if self.asked else 2.0 * sum(rod.round_trip_time for rod in self.rods) / self.trip
        struck, joints, constants = self.given.kernel_laws()
        memory = self.given.plastic, self.given.lossy
        laws = law_function(struck), law_function(joints), constants, *memory
        ends = wait, MILLIONTH if endless else NO_PULL
        rooms, stop = (self.record, self.state, new_work()), self._fading() if endless else limit
        while True:
            stop = min(stop, limit)
            status = wave_network.solve(
                self.chain, *rooms, *laws, self.given.pulse, self.given.masses, *ends, stop, tolerance
            )
            if not endless or status in (wave_network.FULL, wave_network.FAILED):
                return status
            parted = status == wave_network.PARTED
            self.faded = not self._apart() if parted else self._nothing_left()
            if self.faded or parted or stop >= limit:
                return status
            stop *= 1.5

    def _needed(self, until: float) -> float:
        """How many times the room that is filled it would take to get to `until`, as stretches have multiplied."""
        reached, counts = float(self.state.time.min()), self.record.count.tolist()
        starts = (self.record.start[node, :count] for node, count in enumerate(counts))
        half = sum(int(np.searchsorted(start, 0.5 * reached)) for start in starts)
        return (until / reached) ** min(MAX_ECHO_GROWTH, max(1.0, math.log2(sum(counts) / half)))

    def _fading(self) -> float:
        """Time [T] by which a mass on one rod without an end has given off all its speed but a millionth."""
        slowest = min(rod.impedance for rod in self.scene.target.rods)
        return 2.0 * len(self.rods) + 14.0 * self.scene.impactor.mass / slowest / self.trip

    def _nothing_left(self) -> bool:
        return self.energy_left(float(self.state.time.min())) < MILLIONTH**2

    def _apart(self) -> bool:
        """Whether no part will ever catch up with the one before it, however slowly."""
        through = np.array([pushed(self.record, node) for node in range(len(self.laws))])
        return wave_network.separate(self.chain, self.given.masses, through, NO_PULL)

    def notes(self) -> list[Note]:
        followed, wanted = self.tolerances
        if wanted is None:
            return self.end_notes()
        return [
            Note("looser-tolerance", Severity.REMARK, followed=followed, wanted=wanted),
            *self.end_notes(),
        ]

    def sampled(self, node: int, quantity: int, t: np.ndarray, after: bool = True) -> np.ndarray:
        t = np.asarray(t, float)
        out = np.empty(t.size)
        sample(self.record, node, quantity, np.ascontiguousarray(t.ravel()), after, out)
        return out.reshape(t.shape)

    def squares(self, node: int, quantity: int, begin: float, end: float) -> float:
        return square_integral(self.record, node, quantity, begin, end)

    def periods(self, node: int) -> list[ContactPeriod]:
        """Stretches of time in which the faces at a node press on each other.

        Faces that stay together without force, as two equal rods do, do not press; openings no larger than rounding,
        from the dent that is left, part nothing. Of a bonded joint from its first force to its last, tension too.
        """
        count = int(self.record.count[node])
        values, start = self.record.values[node, :count], self.record.start[node]
        force, closed = values[:, FORCE], self.record.closed[node, :count]
        waves = np.maximum(np.abs(values[:, OUT_LEFT]), np.abs(values[:, OUT_RIGHT]))
        arriving = np.maximum(np.abs(force - values[:, OUT_LEFT]), np.abs(force - values[:, OUT_RIGHT]))
        felt = np.abs(force) if self.chain.kind[node] == BONDED else force  # these bear tension, too
        presses = closed & (felt.max(axis=1) > CONTACT_ROUNDING * np.maximum(waves, arriving).max(axis=1))
        together = closed | (values[:, DEPTH].min(axis=1) - self._dents(node) > -CONTACT_ROUNDING)
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

    def deepest_at(self, node: int, t: np.ndarray) -> np.ndarray:
        count = int(self.record.count[node])
        ends = self.record.values[node, :count, DEPTH, -1]
        before = np.concatenate(([0.0], np.maximum.accumulate(np.maximum(ends, 0.0))))
        cells = np.clip(np.searchsorted(self.record.start[node, 1:count], t, "right"), 0, count)
        return np.maximum(before[cells], self.sampled(node, DEPTH, t))

    def largest_depth(self) -> float:
        count = int(self.record.count[self.contact])
        t = self.record.start[self.contact, : count + 1]
        fine = np.unique((t[:-1, None] + np.diff(t)[:, None] * np.linspace(0.0, 1.0, 9)).ravel())
        depth = self.sampled(self.contact, DEPTH, fine)
        k = int(np.argmax(depth))
        near = np.linspace(fine[max(k - 1, 0)], fine[min(k + 1, fine.size - 1)], 201)
        return float(self.sampled(self.contact, DEPTH, near).max())

    def jumps(self) -> np.ndarray:
        count = int(self.record.count[self.contact])
        breaks = self.state.breaks[self.contact, : int(self.state.break_count[self.contact])]
        closed = self.record.closed[self.contact, :count]
        events = self.record.start[self.contact, 1:count][closed[1:] != closed[:-1]]
        return np.unique(np.concatenate(([0.0], events, breaks[breaks <= self.reach])))

    def sent_jumps(self, node: int, quantity: int) -> np.ndarray:
        count = int(self.record.count[node])
        values, start = self.record.values[node, :count, quantity], self.record.start[node, :count]
        jumped = np.abs(values[1:, 0] - values[:-1, -1]) > 1e-6
        first = start[:1] if abs(values[0, 0]) > 1e-6 else start[:0]
        return np.concatenate([first, start[1:][jumped]])
