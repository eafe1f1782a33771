"""Two bodies as oscillators between balances, and what the balances found as a motion."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...numerics import balance_histories
from ...numerics.balance_histories import DRAWN
from ...numerics.balances import Bank, Events, Joined, Work
from ...numerics.elements.line import two_sided
from ...numerics.modes import Modes
from ...scene import Scene
from ...solution.motion import TargetState
from ...solution.sampled_motion import SampledMotion, ShapeField
from ...solution.solution import ContactPeriod
from ..parting import End, patience

ROUND_TRIPS = 2.0  # for which bodies that move apart are watched at least
MOST_NUMBERS = 4_000_000  # doubles kept: coordinates after every balance


@dataclass(frozen=True)
class Pair:
    """Both bodies as one bank of oscillators; the first `split` are the impactor's."""

    bank: Bank
    start: np.ndarray  # rates at the first touch
    bodies: tuple[Any, Any]
    modes: tuple[Modes, Modes]
    split: int
    shortest_period: float
    resolved_time: float  # [s] apart for less is still in contact, as far as these modes resolve it
    patience: float  # [s] for which bodies that move apart are watched
    weight: float  # acceleration of the impactor by it [m/s2]
    lasts: bool  # whether it takes any time: a balance of what does not ring takes none, as one impulse

    @classmethod
    def of(cls, scene: Scene, modes_of, on: bool = False) -> "Pair":
        """`on`: whether the impact is followed for a time that is asked for, whatever comes in it."""
        bodies = (scene.impactor, scene.target)
        modes = tuple(modes_of(body) for body in bodies)
        frequencies, closing, start, places = [], [], [], []
        for body, own, sign in zip(bodies, modes, (1.0, -1.0), strict=True):
            places.append(sum(part.size for part in frequencies))
            if np.isfinite(own.rigid_mass):
                root = np.sqrt(own.rigid_mass)
                frequencies.append(np.zeros(1))
                closing.append(np.full(1, sign / root))
                start.append(np.full(1, root * body.velocity))
            else:
                places[-1] = -1 if sign < 0.0 else 0
            frequencies.append(own.frequencies)
            closing.append(sign * own.at_contact)
            start.append(np.zeros(own.frequencies.size))
        lasts = on or any(own.frequencies.size for own in modes)
        # without that there is one balance, which takes no time in which anything could speed up
        fall, surge = (scene.fall, -scene.target.jerk) if lasts else (0.0, 0.0)
        weight = scene.weight_acceleration if lasts else 0.0
        bank = Bank(np.concatenate(frequencies), np.concatenate(closing), places[1], fall, surge)
        highest = float(bank.frequencies.max())
        shortest = 2.0 * np.pi / highest if highest > 0.0 else 0.0
        rings = [(own, body) for own, body in zip(modes, bodies, strict=True) if body.time_unit is not None]
        split = modes[0].frequencies.size + 1
        trips = max((body.time_unit or 0.0 for _, body in rings), default=scene.time_unit)
        # what moves on by itself is solved as it stands at first, which holds for no longer
        moves_on = scene.target.acceleration != 0.0 or scene.target.jerk != 0.0
        longest = ROUND_TRIPS * trips if moves_on else max(ROUND_TRIPS * trips, patience(scene))
        # bending waves disperse: no front runs through a beam
        resolved = (own.shortest_period if body.bends else own.front_time for own, body in rings)
        resolves = max(resolved, default=0.0)
        return cls(bank, np.concatenate(start), bodies, modes, split, shortest, resolves, longest, weight, lasts)

    def flies(self, events: Events) -> tuple[int, float]:
        """Events up to that after which the impactor flies higher than anything that still rings can reach, and how
        long that flight takes [s]: what follows, as one falls onto the other, is another impact. All of them where it
        does not.
        """
        bank = self.bank
        if bank.fall <= 0.0:
            return events.time.size, math.inf
        rings = np.arange(bank.closing.size) != bank.target
        rings[0] = False
        scale = np.where(rings, bank.frequencies, 1.0)
        bulge = np.hypot(events.coordinates, events.rates / scale) @ np.where(rings, np.abs(bank.closing), 0.0)
        rate = bank.closing[0] * events.rates[:, 0] + bank.fall * events.time
        place = bank.closing[0] * events.coordinates[:, 0] + 0.5 * bank.fall * events.time**2
        up = np.maximum(-rate, 0.0)
        rises = np.minimum(up / bank.fall, np.append(np.diff(events.time), math.inf))
        flies = np.flatnonzero((rises * (up - 0.5 * bank.fall * rises) - place > bulge) & ~events.stuck)
        if not flies.size:
            return events.time.size, math.inf
        return int(flies[0]) + 1, 2.0 * float(up[flies[0]]) / bank.fall

    def fields(self) -> dict[str, Callable[[np.ndarray], np.ndarray]]:
        """Shapes, slopes (stress in tension), moments and shears, (modes + 2, x); the impactor is where x is negative.

        The last two rows are how far each body has come untouched, by which a motion as a whole that turns is found.
        """
        first, second = self.modes
        drifts = two_sided(_drift(first), _drift(second), 1.0)

        def with_drift(own, moved):
            return lambda x: np.vstack((own(x), drifts(x) if moved else np.zeros((2, np.size(x)))))

        impactor, target = self.bodies
        stresses = two_sided(_stresses(impactor, first), _stresses(target, second), -1.0)
        found = {"shapes": with_drift(two_sided(first.with_rigid(), second.with_rigid(), 1.0), True)}
        found["slopes"] = with_drift(stresses, False)
        for name in ("moments", "shears"):
            found[name] = with_drift(two_sided(first.with_rigid(name), second.with_rigid(name), 1.0), False)
        return found


def _drift(modes: Modes) -> Callable[[np.ndarray], np.ndarray]:
    """What of a motion as a whole is none of the body's own turning, (1, x)."""
    turns = 0.0 if modes.rigid_mean == 1.0 else 1.0  # else all of it is in the motion of the struck place
    return lambda x: turns * (1.0 - modes.rigid_shape(x)[None, :])


def _stresses(body: Any, modes: Modes) -> Callable[[np.ndarray], np.ndarray]:
    """Tension per 1 of each coordinate [Pa], with that as a whole."""
    name, factor = body.stress_source
    return lambda x: factor * modes.with_rigid(name)(x)


@dataclass(frozen=True)
class Run:
    """What the kernel found."""

    pair: Pair
    joined: Joined
    flight: np.ndarray
    events: Events
    duration: float
    full: bool
    steps: int
    end: End

    @property
    def balances(self) -> np.ndarray:
        """Which events are balances, and not the end of a stretch in which the faces moved as one."""
        return ~np.append(False, self.events.stuck[:-1])

    @property
    def final_velocity(self) -> float:
        bank, last = self.pair.bank, float(self.events.time[-1])
        struck = bank.closing[0] * self.events.rates[-1, 0] + self.pair.weight * last
        before = self.pair.bodies[0].velocity + self.pair.weight * last
        return float(self.pair.modes[0].mean_velocity(before, struck))

    @property
    def known(self) -> tuple[Bank, np.ndarray, Joined, Events, np.ndarray]:
        """All that a state follows from."""
        return self.pair.bank, self.flight, self.joined, self.events, self.pair.start

    def states(self, after: np.ndarray, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates and rates at `times`, each later than the event named by `after`; -1: before the first."""
        return balance_histories.course(*self.known, after, times)


class BalanceMotion(SampledMotion):
    """A motion of impacts without duration; `impulses` holds their times [s] and impulses [N s].

    The force shown is the impulse of one shortest period about each instant over that period: no finer detail is
    known. It is zero where the target does not ring, as nothing gives the duration of an impact.
    """

    def __init__(self, scene: Scene, run: Run):
        self.scene, self.run = scene, run
        events, pair = run.events, run.pair
        self.impulses = events.time[run.balances], events.impulse[run.balances]
        count = DRAWN + 2 * events.time.size
        times, after, rows = np.empty(count), np.empty(count, np.int64), np.empty((balance_histories.COLUMNS, count))
        balance_histories.instants(events, DRAWN, run.duration, times, after)
        means = pair.modes[1].means
        balance_histories.histories(
            *run.known, pair.split, np.zeros(0) if means is None else means, times, after,
            Work.of(pair.bank.closing.size), rows,
        )  # fmt: skip
        self._after = after
        face, face_rate, end, end_rate, whole, mean, striker, ringing, impulse, lost = rows
        (first, second), (impactor, other) = pair.modes, pair.bodies
        rate, rigid = np.full(count, other.velocity), np.zeros(count)
        if pair.bank.target >= 0:
            rate, rigid = whole, second.moving_energy(other.mass, other.velocity, whole)
        moved, freely = times * (impactor.velocity + 0.5 * pair.weight * times), impactor.velocity + pair.weight * times
        place = first.mean_velocity(moved, face)
        energies = {
            "impactor": first.moving_energy(impactor.mass, freely, face_rate) + striker,
            "target_rigid": rigid,
            "target_vibration": ringing,
            "local": np.zeros(count),
            "dissipated": lost,
            **({"weight": -impactor.mass * pair.weight * place} if pair.weight else {}),
        }
        super().__init__(
            time=times,
            force=np.zeros(count),
            impulse=impulse,
            impactor_position=place,
            impactor_velocity=first.mean_velocity(freely, face_rate),
            end_position=end,
            end_velocity=end_rate,
            rigid_velocity=second.mean_velocity(other.velocity, rate) + mean,
            energies=energies,
            face_velocity=face_rate,
        )
        if pair.resolved_time:
            balance_histories.average(times, impulse, pair.shortest_period, self._force)

    @property
    def lasts(self) -> bool:
        """Whether the impact is followed for any time."""
        return self.run.pair.lasts

    @property
    def has_field(self) -> bool:
        return self.scene.target.length > 0.0

    @cached_property
    def _field(self) -> ShapeField | None:
        """At all instants of the histories, or, where these are too many, at those that are drawn.

        Worked out when it is asked for: it takes as long as the histories.
        """
        if not self.has_field:
            return None
        pair, events, times, after = self.run.pair, self.run.events, self.time, self._after
        if times.size * pair.bank.closing.size > MOST_NUMBERS:
            drawn = np.linspace(0.0, self.run.duration, DRAWN)
            times, after = drawn, np.searchsorted(events.time, drawn, "right") - 1
        q, p = self.run.states(after, times)
        drift, fall = np.array([body.velocity for body in pair.bodies]), np.array([pair.weight, 0.0])
        q[:, 0] += 0.5 * pair.weight * times**2 / pair.bank.closing[0]
        p[:, 0] += pair.weight * times / pair.bank.closing[0]
        carried = np.multiply.outer(times, drift) + np.multiply.outer(0.5 * times**2, fall)
        q, p = np.hstack((q, carried)), np.hstack((p, drift + np.multiply.outer(times, fall)))
        return ShapeField(times, q, p, young=1.0, **pair.fields())

    def target_state(self, time: np.ndarray) -> TargetState:
        """Coordinates of the target as a whole and of its modes that a balance can move."""
        times = np.asarray(time, float)
        pair, own = self.run.pair, self.run.pair.modes[1]
        q, p = self.run.states(np.searchsorted(self.run.events.time, times, "right") - 1, times)
        first, moved = q.shape[1] - own.frequencies.size, own.is_excited
        position, velocity = np.zeros((2, times.size))
        if pair.bank.target >= 0:
            factor = -pair.bank.closing[pair.bank.target]
            position, velocity = factor * q[:, pair.bank.target], factor * p[:, pair.bank.target]
        return TargetState(position, velocity, q[:, first:][:, moved], p[:, first:][:, moved])

    def contacts(self) -> list[ContactPeriod]:
        """Balances that follow each other closely make one contact."""
        events, apart = self.run.events, self.run.pair.resolved_time
        rows = np.empty((events.time.size, balance_histories.CONTACT_COLUMNS))
        count = balance_histories.contacts_of(events, self.time, self._force, apart, rows)
        return [
            ContactPeriod(start, end, impulse, peak if apart else None)
            for start, end, impulse, peak, _ in rows[:count].tolist()
        ]
