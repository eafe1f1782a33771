"""Exact waves in a chain of rods, by the kernel `numerics.waves.network`."""

import math

import numpy as np

from ...numerics.waves import network as wave_network
from ...numerics.waves.followed import MILLIONTH, follow
from ...numerics.waves.laws import law_function, new_work
from ...numerics.waves.nodes import new_state, rewind
from ...numerics.waves.parts import BONDED
from ...numerics.waves.periods import SILENT, end_of, periods
from ...numerics.waves.record import (
    DEPTH,
    FORCE,
    IMPULSE,
    highest,
    integrals,
    new_record,
    sample,
    square_integral,
)
from ...solution.solution import ContactPeriod
from ...text.notes import Note, Severity
from ..base import MAX_ROUND_TRIPS
from ..weight import ENDLESS, FLIES, GOES_ON
from .chain_scene import ChainHistory, ChainScene
from .weight import Falling

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
        self.asked, self.faded, self.doubtful = math.isfinite(until), False, False
        most = MAX_STRETCHES // len(self.laws)
        capacity = min(STRETCHES, most)
        while True:
            self.record, self.state = new_record(len(self.laws), capacity), new_state(self.chain, capacity)
            status = self._follow(until, tolerance)
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
        self.gave_up = status in (wave_network.FULL, wave_network.FAILED) and not self.doubtful
        ended = self.asked or self.faded or self.doubtful
        self.cut = self.gave_up or (status == wave_network.STOPPED and not ended)
        self.error = max(tolerance, MILLIONTH if self.faded else 0.0)
        self.touching = bool(self.contacts[-1].end >= self.reach * self.trip * (1.0 - 1e-12))

    def _follow(self, until: float, tolerance: float) -> int:
        """Run the kernel; how it ended."""
        if self.chain.fall and not self.asked:
            return self._let_fall(tolerance)
        return self._run(until, tolerance)

    def _let_fall(self, tolerance: float) -> int:
        """Look now and then how it goes, as its weight always brings the impactor back."""
        falls, until, how = Falling(self.given), 0.0, GOES_ON
        while how == GOES_ON and until < MAX_ROUND_TRIPS:
            until = min(until + falls.every, MAX_ROUND_TRIPS)
            status = self._run(until, tolerance)
            if status != wave_network.STOPPED:
                return status
            how = falls.look(self, until)
        self.falls = falls
        if how in (GOES_ON, ENDLESS):
            return wave_network.STOPPED
        if how == FLIES and (falls.comes_back or falls.stop > until):
            if falls.comes_back:
                self.record.count[:] = 0
                rewind(self.chain, self.state)
            self._run(falls.stop, tolerance)
        return wave_network.PARTED

    def _run(self, until: float, tolerance: float) -> int:
        struck, joints, constants = self.given.kernel_laws()
        laws = law_function(struck), law_function(joints)
        of_law = constants, self.given.plastic, self.given.lossy, self.given.pulse, self.given.masses
        rooms = self.record, self.state, new_work()
        status, self.faded, self.doubtful = follow(self.chain, *rooms, *laws, of_law, until, MAX_ROUND_TRIPS, tolerance)
        return status

    def _needed(self, until: float) -> float:
        """How many times the room that is filled it would take to get to `until`, as stretches have multiplied."""
        reached, counts = float(self.state.time.min()), self.record.count.tolist()
        starts = (self.record.start[node, :count] for node, count in enumerate(counts))
        half = sum(int(np.searchsorted(start, 0.5 * reached)) for start in starts)
        return (until / reached) ** min(MAX_ECHO_GROWTH, max(1.0, math.log2(sum(counts) / half)))

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

    def integrated(self, node: int, quantity: int, t: np.ndarray) -> np.ndarray:
        out = np.empty(t.size)
        integrals(self.record, node, quantity, np.ascontiguousarray(t), out)
        return out

    def squares(self, node: int, quantity: int, begin: float, end: float) -> float:
        return square_integral(self.record, node, quantity, begin, end)

    def periods(self, node: int) -> list[ContactPeriod]:
        """As `numerics.waves.periods` finds them; of a bonded joint from its first force to its last, tension too."""
        struck, joints, constants = self.given.kernel_laws()
        law = law_function(struck if node == self.contact else joints)
        remembers, tension = bool(self.given.plastic[node]), bool(self.chain.kind[node] == BONDED)
        silent = SILENT * self.tolerances[0] if self.given.lossy[node] else 0.0
        found = np.empty((int(self.record.count[node]), 2), np.int64)
        count = periods(self.record, node, tension, law, constants[node], remembers, silent, np.empty(2), found)
        start, impulse = self.record.start[node], self.record.values[node, :, IMPULSE]
        return [
            ContactPeriod(
                start=self.trip * float(start[first]),
                end=self.trip * float(end_of(self.record, node, last)),
                impulse=self.force_unit * self.trip * float(impulse[last, -1] - impulse[first, 0]),
                peak_force=self.force_unit * highest(self.record, node, FORCE, first, last),
            )
            for first, last in found[:count].tolist()
        ]

    def deepest_at(self, node: int, t: np.ndarray) -> np.ndarray:
        count = int(self.record.count[node])
        ends = self.record.values[node, :count, DEPTH, -1]
        before = np.concatenate(([0.0], np.maximum.accumulate(np.maximum(ends, 0.0))))
        cells = np.clip(np.searchsorted(self.record.start[node, 1:count], t, "right"), 0, count)
        return np.maximum(before[cells], self.sampled(node, DEPTH, t))

    def largest_depth(self) -> float:
        return highest(self.record, self.contact, DEPTH, 0, int(self.record.count[self.contact]) - 1)

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
