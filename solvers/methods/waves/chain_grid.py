"""Waves in a chain of rods on a grid of times, by the kernel `numerics.waves.grid`: for chains with too many echoes."""

import math

import numpy as np

from ...bodies import Pulse
from ...numerics.law_functions import MEMORY, step_function
from ...numerics.waves import grid as wave_grid
from ...numerics.waves.events import NO_PULL
from ...numerics.waves.followed import MILLIONTH
from ...numerics.waves.network import separate
from ...numerics.waves.parted import alike, patience
from ...numerics.waves.parts import ABSORBING, BONDED, RIGID_FACES, Chain
from ...numerics.waves.periods import ROUNDING
from ...numerics.waves.record import (
    DEPTH,
    FORCE,
    IMPULSE,
    LOST,
    OUT_LEFT,
    OUT_RIGHT,
    PLACE,
    SPEED,
    TOTAL_LEFT,
    TOTAL_RIGHT,
)
from ...solution.solution import ContactPeriod
from ...text.notes import Note, Severity
from ..base import MAX_ROUND_TRIPS
from ..weight import ENDLESS, GOES_ON
from .chain_scene import UNKNOWN, ChainHistory, ChainScene
from .grid_parted import clear
from .weight import Falling

NODE_STEPS = 2_000_000  # of all nodes together: some tenths of a second, 80 MB
PARTING_CHECKS = 40  # over the time followed, whether the bodies have parted; more cost time, fewer a longer tail
TRIALS = 20_000  # numbers of steps among which is looked for the one that suits the lengths of the rods best
MUCH_OFF = 0.01  # of a first contact, which is said
COARSER = 0.45  # steps of the second solve, as a share of those of the first: their difference gives the error


class GridHistory(ChainHistory):
    """Every node followed step by step.

    The rods are a little longer or shorter than given, by no more than half a step's way, so that waves arrive at the
    end of a step; of the numbers of steps that are affordable the one is taken for which this is least. Mass is kept.
    """

    def __init__(self, given: ChainScene, until: float, horizon: float, share: float = 1.0, trials: int = TRIALS):
        """Solve up to `until` [T] or, if that is infinite, until the impactor has parted for good.

        horizon [T]: how far to look for that at first; share: of the steps that are affordable; trials: see `TRIALS`.
        """
        super().__init__(given)
        self.asked, self.share, self.trials, self.doubtful = math.isfinite(until), share, trials, False
        limit = min(until, MAX_ROUND_TRIPS)
        self.reach, self.parted, self.faded = min(limit, horizon), False, False
        while True:
            self._march()
            swings_on = self.falls is not None and self.falls.how == ENDLESS
            if self.parted or self.faded or swings_on or self.reach >= limit:
                break
            self.reach = min(4.0 * self.reach, limit)
        self.cut = not (self.parted or self.faded or self.asked)
        self.contacts = self.periods(self.contact)
        self.touching = bool(self.contacts) and self.contacts[-1].end >= self.reach * self.trip * (1.0 - 1e-12)
        self.error = MILLIONTH if self.faded else 0.0
        self.first_off = 0.0  # by how much the first contact was off, see `chain_solve`

    def _march(self) -> None:
        self._integrals: dict[tuple[int, int], np.ndarray] = {}
        self.falls = Falling(self.given) if self.given.chain.fall and not self.asked else None
        affordable = int(self.share * NODE_STEPS) // len(self.laws)
        self._end = affordable
        count, lags = best_steps(self.given.chain, self.reach, affordable, self.trials)
        self.step, self.chain = self.reach / count, rounded(self.given.chain, lags, self.reach / count)
        nodes = len(self.laws)
        self.left, self.right, self.force = (np.zeros((nodes, count)) for _ in range(3))
        self.depth, self.lost = np.zeros((nodes, count + 1)), np.zeros((nodes, count + 1))
        self.depth[:, 0] = -self.chain.gap
        memory = np.zeros((nodes, MEMORY))
        for node, law in enumerate(self.laws):
            if law is not None:
                memory[node, 2:4] = law.unloading(0.0)
        speed, deepest = self.chain.mass_drift.copy(), np.zeros(nodes)
        struck, joints, constants = self.given.kernel_laws()
        laws = step_function(struck), step_function(joints), constants
        kept = self.left, self.right, self.force, self.depth, self.lost
        state, pulse = (speed, deepest, memory), self._pulse(count)
        edges = np.linspace(0, count, 2 if self.asked else PARTING_CHECKS + 1).astype(int)
        for first, last in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
            wave_grid.march(self.chain, lags, self.step, first, last, *laws, pulse, *state, *kept)
            if not self.asked and (self._has_parted(last) or self._has_faded(last)):
                last = min(last, self._end)
                self.reach = last * self.step
                self.left, self.right, self.force = self.left[:, :last], self.right[:, :last], self.force[:, :last]
                self.depth, self.lost = self.depth[:, : last + 1], self.lost[:, : last + 1]
                break
        self.steps = self.force.size
        self._integrals.clear()

    def _has_parted(self, last: int) -> bool:
        """Whether the impactor has been apart for a while, and for good: see `numerics.parting`."""
        if self.falls:
            return self._falls_no_more(last)
        wait, longest = patience(self.chain)
        quiet = last - 1 - int(np.flatnonzero(self.force[self.contact, :last])[-1])
        if quiet * self.step < wait:
            return False
        through = self.step * self.force[:, :last].sum(axis=1)
        apart = separate(self.chain, self.given.masses, through, NO_PULL)
        sure = apart and (alike(self.chain) or clear(self, last))
        self.parted = sure or (apart and quiet * self.step >= longest)
        self.doubtful = self.parted and not sure
        return self.parted

    def _falls_no_more(self, last: int) -> bool:
        """Whether it is seen how what its weight brings back goes on: it flies, or never leaves."""
        assert self.falls
        self._integrals.clear()
        how = self.falls.look(self, last * self.step)
        self.parted = how not in (GOES_ON, ENDLESS)
        if self.falls.comes_back:
            self._end = math.ceil(self.falls.stop / self.step)
        return how != GOES_ON

    def _has_faded(self, last: int) -> bool:
        """Before a rod without end: whether nothing is left to come."""
        looked, before = last * PARTING_CHECKS // self.force.shape[1], self.chain.kind[-1] == ABSORBING
        if before and not self.falls and looked % (PARTING_CHECKS // 4) == 0:
            self._integrals.clear()
            self.faded = self.energy_left(last * self.step) < MILLIONTH**2
        return self.faded

    def _pulse(self, count: int) -> np.ndarray:
        """Mean of a prescribed force over every step."""
        pulse = self.scene.impactor
        if not isinstance(pulse, Pulse):
            return np.zeros(count)
        pushed = pulse.pushed(self.trip * self.step * np.arange(count + 1))
        return np.diff(pushed) / (self.trip * self.step * self.force_unit)

    def estimated_error(self, residual: float, unbalanced: float, tolerance: float) -> float:
        """Without what energies miss: that is first order in the step, and does not come back to the velocities."""
        return UNKNOWN if self.cut else max(unbalanced, self.error, tolerance)

    def change(self) -> float:
        """Of the lengths of the rods, the largest share."""
        return float(np.abs(self.chain.transit / self.given.chain.transit - 1.0)[lengths_matter(self.chain)].max())

    def notes(self) -> list[Note]:
        times, change = self.force.shape[1], self.change()
        found = [Note("stepped-on-grid", Severity.REMARK, times=times, change=change)]
        if self.first_off > MUCH_OFF:
            found.append(Note("grid-too-coarse", Severity.WARNING, share=100.0 * self.first_off))
        if self.unresolved() > 0.01:
            found.append(Note("fronts-unresolved", Severity.WARNING, share=100.0 * self.unresolved()))
        return found + self.end_notes()

    def unresolved(self) -> float:
        """Share of the energy at first that means over steps do not show, lost where rigid faces met within a step."""
        if not self.scene.initial_energy:
            return 0.0
        rigid = self.chain.kind == RIGID_FACES
        lost = float((self.force[rigid] * np.diff(self.depth[rigid], axis=1)).sum())
        return lost * self.force_unit * self.speed * self.trip / self.scene.initial_energy

    def _known(self, node: int, quantity: int) -> np.ndarray:
        """At the ends of the steps, (steps + 1,): of a mean what it adds up to; `-quantity - 1`: of its square."""
        if (node, quantity) not in self._integrals:
            self._integrals[node, quantity] = self._integral(node, quantity)
        return self._integrals[node, quantity]

    def _integral(self, node: int, quantity: int) -> np.ndarray:
        if quantity == LOST:
            return self.lost[node]
        if quantity == DEPTH:
            return self.depth[node]
        if quantity in (SPEED, PLACE):
            left = self.chain.mass_left[node] > 0.0
            mass = self.chain.mass_left[node] if left else self.chain.mass_right[node]
            gain = self._known(node, IMPULSE) / mass if mass > 0.0 else np.zeros(self.depth.shape[1])
            speed = self.chain.mass_drift[node] + (-gain if left else gain)
            return speed if quantity == SPEED else _sum(0.5 * self.step * (speed[1:] + speed[:-1]))
        if quantity < 0:
            return _sum(self.step * self._mean(node, -quantity - 1) ** 2)
        return _sum(self.step * self._mean(node, {TOTAL_LEFT: OUT_LEFT, TOTAL_RIGHT: OUT_RIGHT}.get(quantity, FORCE)))

    def _mean(self, node: int, quantity: int) -> np.ndarray:
        return {OUT_LEFT: self.left, OUT_RIGHT: self.right, FORCE: self.force}[quantity][node]

    def _places(self, t: np.ndarray) -> np.ndarray:
        """Times in steps; those that only rounding parts from the end of a step are it."""
        places = np.asarray(t, float) / self.step
        whole = np.rint(places)
        return np.where(np.abs(places - whole) < 1e-7, whole, places)

    def sampled(self, node: int, quantity: int, t: np.ndarray, after: bool = True) -> np.ndarray:
        places, last = self._places(t), self.force.shape[1]
        if quantity in (OUT_LEFT, OUT_RIGHT, FORCE):
            cell = np.floor(places) if after else np.ceil(places) - 1.0
            values = self._mean(node, quantity)[np.clip(cell, 0, last - 1).astype(int)]
            return np.where(places >= 0.0 if after else places > 0.0, values, 0.0)
        kept = self._known(node, quantity)
        cell = np.clip(np.floor(places), 0, last - 1).astype(int)
        values = kept[cell] + np.clip(places - cell, 0.0, 1.0) * (kept[cell + 1] - kept[cell])
        return np.where(places >= 0.0, values, 0.0)

    def integrated(self, node: int, quantity: int, t: np.ndarray) -> np.ndarray:
        kept, places = self._known(node, quantity), self._places(t)
        sums = _sum(0.5 * self.step * (kept[1:] + kept[:-1]))
        cell = np.clip(np.floor(places), 0, self.force.shape[1] - 1).astype(int)
        part, here = places - cell, kept[cell]
        return sums[cell] + self.step * part * (here + 0.5 * part * (kept[cell + 1] - here))

    def squares(self, node: int, quantity: int, begin: float, end: float) -> float:
        places = np.clip(self._places(np.array([begin, end])), 0.0, self.force.shape[1])
        at = np.interp(places, np.arange(self.force.shape[1] + 1), self._known(node, -quantity - 1))
        return float(at[1] - at[0])

    def periods(self, node: int) -> list[ContactPeriod]:
        """Faces that part by no more than they may come closer in one step stay together."""
        force, law = self.force[node], self.laws[node]
        waves = np.maximum(np.abs(self.left[node]), np.abs(self.right[node]))
        felt = np.abs(force) if self.chain.kind[node] == BONDED else force  # these bear tension, too
        presses = felt > ROUNDING * np.maximum(waves, np.abs(force - self.left[node])).max()
        dents = np.zeros(force.size)
        if law is not None and law.PLASTIC:
            deepest, where = np.unique(np.maximum.accumulate(self.depth[node]), return_inverse=True)
            dents = np.array([law.dent(max(depth, 0.0)) for depth in deepest.tolist()])[where][1:]
        together = presses | (self.depth[node, 1:] - dents > -self.step)
        edges = np.flatnonzero(np.diff(np.concatenate(([0], together.astype(np.int8), [0]))))
        impulse, found = self._known(node, IMPULSE), []
        for first, beyond in edges.reshape(-1, 2).tolist():
            pressing = first + np.flatnonzero(presses[first:beyond])
            if pressing.size:
                begins, ends = int(pressing[0]), int(pressing[-1]) + 1
                found.append(
                    ContactPeriod(
                        start=self.trip * self.step * begins,
                        end=min(self.trip * self.step * ends, self.trip * self.reach),
                        impulse=self.force_unit * self.trip * float(impulse[ends] - impulse[begins]),
                        peak_force=self.force_unit * float(force[begins:ends].max()),
                    )
                )
        return found

    def deepest_at(self, node: int, t: np.ndarray) -> np.ndarray:
        so_far = np.maximum.accumulate(np.maximum(self.depth[node], 0.0))
        cell = np.clip(np.floor(self._places(t)), 0, so_far.size - 1).astype(int)
        return np.maximum(so_far[cell], self.sampled(node, DEPTH, t))

    def largest_depth(self) -> float:
        return float(self.depth[self.contact].max())

    def jumps(self) -> np.ndarray:
        edges = [edge / self.trip for period in self.contacts for edge in (period.start, period.end)]
        return np.unique(np.concatenate(([0.0], edges)))

    def sent_jumps(self, node: int, quantity: int) -> np.ndarray:
        values = self._mean(node, quantity)
        steps = np.abs(np.diff(values, prepend=0.0))
        return self.step * np.flatnonzero(steps > 1e-2 * max(float(np.abs(values).max()), 1e-300))


def _sum(values: np.ndarray) -> np.ndarray:
    return np.concatenate(([0.0], np.cumsum(values)))


def best_steps(chain: Chain, reach: float, most: int, trials: int = TRIALS) -> tuple[int, np.ndarray]:
    """The number of steps up to `reach`, at most `most`, on which the rods change their lengths least; transit times
    in these steps (rods,).
    """
    counts = np.unique(np.linspace(most, 0.7 * most, trials).astype(int))
    matters = lengths_matter(chain)
    exact = np.outer(counts, chain.transit[matters]) / reach
    change = np.abs(np.maximum(np.rint(exact), 1.0) / exact - 1.0)
    count = int(counts[np.argmin((change**2).sum(axis=1))])
    return count, np.maximum(np.rint(count * chain.transit / reach), 1.0).astype(np.int64)


def lengths_matter(chain: Chain) -> np.ndarray:
    """Of which rods (rods,): not of one without end, but for it being the only one."""
    matters = np.ones(chain.transit.size, bool)
    matters[-1] = chain.kind[-1] != ABSORBING or chain.transit.size == 1
    return matters


def rounded(chain: Chain, lags: np.ndarray, step: float) -> Chain:
    """The chain with transit times of so many steps, and the masses of its rods unchanged."""
    transit = lags * step
    impedance = chain.impedance * chain.transit / transit
    if chain.kind[-1] == ABSORBING:
        impedance[-1] = chain.impedance[-1]
    return chain._replace(transit=transit, impedance=impedance)
