"""Repeated balances of impulse and momentum between a striker and a body that can ring."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from .. import checks
from ..bodies import Rods
from ..doubts import bodies_that_bend, doubts_of_a_rigid_blow
from ..machine import clock
from ..method import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..motion import SampledMotion, ShapeField, stress_source
from ..numerics import balances
from ..numerics.balances import Bank, Events, Joined
from ..numerics.elements import mesh_modes, two_sided
from ..numerics.free_motion import Turn, exact_turn, newmark_turn
from ..numerics.modes import Modes
from ..scene import Scene
from ..solution import ContactPeriod, Solution, summary

VARIANTS = ("event-located", "step-end", "step-halving")
LOOKS_PER_PERIOD = 16  # of the highest mode, at which the faces are looked at
SOFT = 1e-4  # of that period: shorter flights between balances are taken as staying together
MOST_BALANCES = 20_000
MOST_NUMBERS = 4_000_000  # doubles kept: coordinates after every balance
DRAWN = 1500  # instants at which fields are known
HALVINGS = 40
HEAVY = 1.5  # times the mass: a free rod from which it parts with hardly any force
FADED = 0.13  # measured there, mass ratios 1.5 to 30, 7 to 185 elements: 0.12 to 0.16 of the speed of approach
MODES_OF_BEAMS = 20  # of a mesh, where none are asked for: the highest swing ten thousand times as fast as the lowest


@dataclass(frozen=True)
class Balance(Method):
    """Impulsive balances with a restitution each, as many as it takes, and free motion in between.

    Rods struck on their end, beams struck across: meshes of `elements` (with all their modes or the lowest `modes`, 20
    of a beam unless told), or their exact modes where only `modes` is given. `variant`: "event-located" balances at the
    very instants at which the faces meet, and lets them stay together where restitution leaves endless ever smaller
    balances; "step-end", Newmark's fixed `step` with balances at step ends only; "step-halving", steps halved until the
    faces overlap by less than `tolerance`.
    Error: with restitution 1 a sequence of balances is chaotic, the rebound scatters by some 0.03 of the impact speed;
    below 1 the loss falls as 1 / elements and does not depend on it. Of "step-end" the loss is an artefact of the step.
    Source: thesis 6.3, 6.4.1 and 4.6. Differs: (6.22) speaks of halving, tables 6.2 to 6.5 follow from "step-end".
    """

    elements: int | None = None
    modes: int | None = None
    restitution: float = 1.0
    variant: str = "event-located"
    step: float | None = None  # [s]
    tolerance: float | None = None  # of overlap [m]
    estimate: bool = field(default=True, repr=False)

    NAME = "balance"
    KNOBS = ("elements",)
    BEAMS = True

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "Balance":
        given = checks.table("method", given, ("elements", "modes", "restitution", "variant", "step", "tolerance"))
        variant = checks.choice("method.variant", given.get("variant", "event-located"), VARIANTS)
        for name, variants in (("step", VARIANTS[1:]), ("tolerance", VARIANTS[2:])):
            if given.get(name) is not None and variant not in variants:
                raise checks.SceneError(f"method.{name}", given[name], f"nothing here, or variant = {variants[0]!r}")
        elements = None if given.get("modes") is not None else 100
        elements = given.get("elements", elements)
        modes, step, tolerance = (given.get(name) for name in ("modes", "step", "tolerance"))
        return cls(
            None if elements is None else checks.whole_number("method.elements", elements, 1, 2000),
            None if modes is None else checks.whole_number("method.modes", modes, 1, 2000),
            checks.number("method.restitution", given.get("restitution", 1.0), 0.0, 1.0),
            variant,
            None if step is None else checks.number("method.step", step, 1e-15, 1e3, "s"),
            None if tolerance is None else checks.number("method.tolerance", tolerance, 1e-30, 1.0, "m"),
        )

    def why_not(self, scene: Scene) -> str | None:
        for body in (scene.impactor, scene.target):
            if body.kind == "half-space" or getattr(body, "support", "") == "anechoic":
                return "both bodies must have natural modes, which nothing has that waves run away in; use 'waves'"
            if isinstance(body, Rods) and not all(joint.bonded for joint in body.joints):
                return "the rods of a chain must be bonded; for rods that only touch use 'waves'"
            rings = body.time_unit is not None
            if rings and self._elements is None and (isinstance(body, Rods) or (body.kind == "rod" and body.end_mass)):
                return "exact modes know uniform rods without a mass at their end only; give elements"
        return None

    def _knob(self, scene: Scene) -> str | None:
        return None if bodies_that_bend(scene) else super()._knob(scene)

    def _recount(self) -> str:
        return "So few elements or modes do not tell slight gaps and contacts: take more, or use 'waves'."

    @property
    def _elements(self) -> int | None:
        return 100 if self.elements is None and self.modes is None else self.elements

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        run = self._run(scene, duration)
        motion = BalanceMotion(scene, run)
        contacts = motion.contacts()
        wall_time = clock() - begun
        found = summary(scene, motion, contacts, run.duration, wall_time)
        found["diagnostics"] |= {
            "steps": run.steps,
            "estimated_error": self._estimated_error(scene, run) if self.estimate else None,
            "balances": int(run.balances.sum()),
            "resolved_time": run.pair.resolved_time,
        }
        peaks = [contact.peak_force for contact in contacts if contact.peak_force is not None]
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=run.duration,
            motion=motion,
            peak_force=max(peaks, default=None),
            peak_indentation=None,
            residual_indentation=None,
            notes=self._notes(scene, run),
            **found,
        )

    def _notes(self, scene: Scene, run: "Run") -> list[str]:
        notes = []
        if run.full:
            other = "the variant 'event-located'"
            if self.variant == "event-located":
                other = "a restitution below 1, which lets the faces stay together"
            notes.append(
                f"The solution stopped at {run.duration:.3g} s, at its limit of {run.balances.sum()} balances, before "
                f"the bodies had parted for good: take fewer elements or modes, or {other}."
            )
        if scene.contact.NAME != "rigid":
            notes.append("A balance knows no contact law: of the contact only the restitution counts.")
        if self._elements is None:
            notes += [doubt for body in bodies_that_bend(scene) for doubt in body.doubts_of_modes(self.modes)]
        kind, count = ("modes", self.modes) if self._elements is None else ("elements", self._elements)
        notes += doubts_of_a_rigid_blow(scene, run.pair.shortest_period, count, kind)
        many = run.pair.resolved_time > 0.0 and run.balances.sum() > 2
        bends = bool(bodies_that_bend(scene))
        if many and (bends or self.restitution == 1.0):
            notes.append(
                f"With restitution {self.restitution:g} a sequence of balances is chaotic: the rebound scatters with "
                f"elements, modes and masses by some {0.03 if self.restitution == 1.0 else 0.01:g} of the impact speed."
                f" With a restitution below 1 it {'does so less' if bends else 'does not'}."
            )
        if many and self.restitution < 1.0 and self.variant != "event-located":
            notes.append(
                "The energy lost is that of the time step, not of the restitution: it vanishes with the step. Use the "
                "variant 'event-located'."
            )
        return notes

    def _estimated_error(self, scene: Scene, run: "Run") -> float | None:
        """Of the final velocity, relative to the impact speed: against half and a third of the elements or modes, as
        one coarse answer may agree with the fine one by chance; None where a contact law is left out.

        A free rod heavier than the mass is left before its front is back, by a force that has all but faded: the
        velocity is then off by how long the first balances take beside the blow, and alike for all numbers of them.
        """
        if scene.contact.NAME != "rigid":
            return None
        if run.pair.resolved_time == 0.0:
            return 0.0 if self.variant == "event-located" else None
        others = [self._coarser(scene, parts)._run(scene, run.duration) for parts in (2, 3)]
        if run.full or any(other.full for other in others):
            return None
        estimated = max(abs(run.final_velocity - other.final_velocity) for other in others) / scene.speed
        if scene.target.kind == "rod" and not scene.target.held and scene.mass_ratio > HEAVY:
            estimated = max(estimated, FADED * math.sqrt(run.pair.shortest_period / scene.blow))
        # shorter than these modes can tell: all numbers of them are wrong alike
        return max(estimated, 1.0) if scene.blow < run.pair.shortest_period else estimated

    def _coarser(self, scene: Scene, parts: int) -> "Balance":
        given = {"elements": self._elements, "modes": self.modes}
        if self.modes is None and "beam" in (scene.impactor.kind, scene.target.kind):
            given["modes"] = MODES_OF_BEAMS
        return replace(self, **{name: max(1, count // parts) for name, count in given.items() if count})

    def _run(self, scene: Scene, duration: float | None) -> "Run":
        """From the first touch until the bodies part for good, or for `duration` [s]."""
        pair = Pair.of(scene, self._modes_of)
        bank, room = pair.bank, max(100, min(MOST_BALANCES, MOST_NUMBERS // pair.bank.closing.size))
        found = balances.events(room, bank.closing.size)
        q, p = np.zeros(bank.closing.size), pair.start.copy()
        end = MAX_ROUND_TRIPS * scene.time_unit if duration is None else duration
        period = pair.shortest_period or scene.time_unit
        joined, flight, step = Joined(*(np.zeros((0,) * n) for n in (1, 2, 1))), bank.frequencies, self.step
        if self.variant == "event-located":
            joined, step = balances.joined(bank), period / LOOKS_PER_PERIOD
            count, reached = balances.event_located(
                bank, joined, exact_turn(bank.frequencies, step), step, self.restitution, SOFT * period, end,
                pair.patience, q, p, found,
            )  # fmt: skip
        elif self.variant == "step-end":
            step = period / LOOKS_PER_PERIOD if step is None else step
            flight = balances.newmark_frequencies(bank.frequencies, step)
            turn = newmark_turn(bank.frequencies, step)
            count, reached = balances.at_step_ends(bank, turn, self.restitution, step, end, pair.patience, q, p, found)
        else:
            step = period / LOOKS_PER_PERIOD if step is None else step
            tolerance = 1e-4 * scene.speed * scene.time_unit if self.tolerance is None else self.tolerance
            turns = [exact_turn(bank.frequencies, step / 2.0**level) for level in range(HALVINGS)]
            turns = Turn(*(np.array(part) for part in zip(*turns, strict=True)))
            count, reached = balances.by_halving(
                bank, turns, self.restitution, step, tolerance, end, pair.patience, q, p, found
            )
        events = Events(*(values[:count] for values in found))
        if duration is None:
            duration = float(events.time[-1]) + AFTERGLOW * scene.time_unit
        full = count + 2 > room and reached < end
        return Run(pair, joined, flight, events, duration, full, 0 if step is None else int(np.ceil(duration / step)))

    def _modes_of(self, body) -> Modes:
        if body.time_unit is None or self._elements is None:
            return body.modes(self.modes)
        kept = MODES_OF_BEAMS if body.kind == "beam" and self.modes is None else self.modes
        return mesh_modes(body.mesh(self._elements), kept)


@dataclass(frozen=True)
class Pair:
    """Both bodies as one bank of oscillators; the first `split` are the impactor's."""

    bank: Bank
    start: np.ndarray  # rates at the first touch
    bodies: tuple[object, object]
    modes: tuple[Modes, Modes]
    split: int
    shortest_period: float
    resolved_time: float  # [s] apart for less is still in contact, as far as these modes can tell
    patience: float  # [s] apart for so long and moving apart: for good

    @classmethod
    def of(cls, scene: Scene, modes_of) -> "Pair":
        bodies = (scene.impactor, scene.target)
        modes = tuple(modes_of(body) for body in bodies)
        frequencies, closing, start, places = [], [], [], []
        for body, own, sign in zip(bodies, modes, (1.0, -1.0), strict=True):
            places.append(sum(part.size for part in frequencies))
            if np.isfinite(own.rigid_mass):
                root = np.sqrt(own.rigid_mass)
                frequencies.append(np.zeros(1)), closing.append(np.full(1, sign / root))
                start.append(np.full(1, root * body.velocity))
            else:
                places[-1] = -1 if sign < 0.0 else 0
            frequencies.append(own.frequencies), closing.append(sign * own.at_contact)
            start.append(np.zeros(own.frequencies.size))
        bank = Bank(np.concatenate(frequencies), np.concatenate(closing), places[1])
        highest = float(bank.frequencies.max())
        shortest = 2.0 * np.pi / highest if highest > 0.0 else 0.0
        rings = [(own, body) for own, body in zip(modes, bodies, strict=True) if body.time_unit is not None]
        split = modes[0].frequencies.size + 1
        patience = 2.0 * max((body.time_unit for _, body in rings), default=scene.time_unit)
        # bending waves disperse: no front runs through a beam
        resolved = (own.shortest_period if body.kind == "beam" else own.front_time for own, body in rings)
        return cls(bank, np.concatenate(start), bodies, modes, split, shortest, max(resolved, default=0.0), patience)

    def fields(self) -> dict[str, Callable[[np.ndarray], np.ndarray]]:
        """Shapes, slopes (stress in tension), moments and shears, (modes + 2, x); the impactor is where x is negative.

        The last two rows are how far each body has come untouched, of which a motion as a whole that turns is told.
        """
        drifts = two_sided(*((lambda x, own=own: 1.0 - own.rigid_shape(x)[None, :]) for own in self.modes), 1.0)

        def with_drift(own, moved):
            return lambda x: np.vstack((own(x), drifts(x) if moved else np.zeros((2, np.size(x)))))

        stresses = (_stresses(body, own) for body, own in zip(self.bodies, self.modes, strict=True))
        found = {"shapes": with_drift(two_sided(*(own.with_rigid() for own in self.modes), 1.0), True)}
        found["slopes"] = with_drift(two_sided(*stresses, -1.0), False)
        for name in ("moments", "shears"):
            found[name] = with_drift(two_sided(*(own.with_rigid(name) for own in self.modes), 1.0), False)
        return found


def _stresses(body: object, modes: Modes) -> Callable[[np.ndarray], np.ndarray]:
    """Tension per 1 of each coordinate [Pa], with that as a whole."""
    name, factor = stress_source(body)
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

    @property
    def balances(self) -> np.ndarray:
        """Which events are balances, and not the end of a stretch in which the faces moved as one."""
        return ~np.append(False, self.events.stuck[:-1])

    @property
    def final_velocity(self) -> float:
        struck = float(self.pair.bank.closing[0] * self.events.rates[-1, 0])
        return float(self.pair.modes[0].mean_velocity(self.pair.bodies[0].velocity, struck))

    def states(self, after: np.ndarray, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates and rates at `times`, each later than the event named by `after`; -1: before the first."""
        delay = times - self.events.time[np.maximum(after, 0)]
        q, p = balances.course(self.pair.bank, self.flight, self.joined, self.events, np.maximum(after, 0), delay)
        q[after < 0], p[after < 0] = 0.0, self.pair.start
        return q, p


class BalanceMotion(SampledMotion):
    """A motion of blows without duration; `impulses` holds their times [s] and impulses [N s].

    The force shown is the impulse of one shortest period about each instant over that period: no finer detail is
    known. It is zero where the target does not ring, as nothing tells how long a blow lasts.
    """

    def __init__(self, scene: Scene, run: Run):
        self.scene, self.run = scene, run
        events, pair = run.events, run.pair
        self.impulses = events.time[run.balances], events.impulse[run.balances]
        drawn = np.linspace(0.0, run.duration, DRAWN)
        number = np.arange(events.time.size)
        times = np.concatenate((drawn, events.time, events.time))
        after = np.concatenate((np.searchsorted(events.time, drawn, "right") - 1, number - 1, number))
        order = np.lexsort((after, times))
        times, after = times[order], after[order]
        found = np.concatenate(
            [self._histories(after[i : i + 2000], times[i : i + 2000]) for i in range(0, times.size, 2000)]
        ).T
        (
            impactor_position, impactor_velocity, end_position, end_velocity, rigid_velocity, *energies, face, impulse
        ) = found  # fmt: skip
        lost = np.append(0.0, np.cumsum(events.lost))[after + 1]
        super().__init__(
            time=times,
            force=np.zeros(times.size),
            impulse=impulse,
            impactor_position=impactor_position,
            impactor_velocity=impactor_velocity,
            end_position=end_position,
            end_velocity=end_velocity,
            rigid_velocity=rigid_velocity,
            energies=dict(zip(("impactor", "target_rigid", "target_vibration"), energies, strict=True))
            | {"local": np.zeros(times.size), "dissipated": lost},
            field=self._shape_field(times, after, drawn) if scene.target.length else None,
            face_velocity=face,
        )
        if pair.resolved_time:
            self._force = self._averaged(times, pair.shortest_period)

    def _histories(self, after: np.ndarray, times: np.ndarray) -> np.ndarray:
        """Positions, velocities, energies and impulse, (times, 10)."""
        pair, bank, q, p = self.run.pair, self.run.pair.bank, *self.run.states(after, times)
        energy = 0.5 * (p * p + (bank.frequencies * q) ** 2)
        split, target, (first, second), (impactor, other) = pair.split, bank.target, pair.modes, pair.bodies
        face, face_rate = bank.closing[0] * q[:, 0], bank.closing[0] * p[:, 0]
        ringing, rate, rigid = energy[:, split:].sum(1), np.full(times.size, other.velocity), np.zeros(times.size)
        if target >= 0:
            rate = -bank.closing[target] * p[:, target]
            ringing, rigid = ringing - energy[:, target], second.moving_energy(other.mass, other.velocity, rate)
        mean = second.mean_velocity(other.velocity, rate)
        if second.means is not None:
            mean = mean + p[:, p.shape[1] - second.means.size :] @ second.means
        return np.column_stack(
            (
                first.mean_velocity(impactor.velocity * times, face),
                first.mean_velocity(impactor.velocity, face_rate),
                -q[:, split:] @ bank.closing[split:],
                -p[:, split:] @ bank.closing[split:],
                mean,
                first.moving_energy(impactor.mass, impactor.velocity, face_rate) + energy[:, 1:split].sum(1),
                rigid,
                ringing,
                face_rate,
                (pair.start[0] - p[:, 0]) / bank.closing[0],
            )
        )

    def _shape_field(self, times: np.ndarray, after: np.ndarray, drawn: np.ndarray) -> ShapeField:
        """At all instants of the histories, or, where these are too many, at those that are drawn."""
        pair, events = self.run.pair, self.run.events
        if times.size * pair.bank.closing.size > MOST_NUMBERS:
            times, after = drawn, np.searchsorted(events.time, drawn, "right") - 1
        q, p = self.run.states(after, times)
        drift = np.array([body.velocity for body in pair.bodies])
        q, p = np.hstack((q, np.multiply.outer(times, drift))), np.hstack((p, np.tile(drift, (times.size, 1))))
        return ShapeField(times, q, p, young=1.0, **pair.fields())

    def _averaged(self, times: np.ndarray, period: float) -> np.ndarray:
        """Impulse of the period about each instant over the part of it that is after the first touch."""
        first, last = np.maximum(times - 0.5 * period, 0.0), times + 0.5 * period
        gained = self._at(last, self._impulse) - np.where(first > 0.0, self._at(first, self._impulse), 0.0)
        return gained / (last - first)

    def contacts(self) -> list[ContactPeriod]:
        """Balances that follow each other closely make one contact."""
        events, apart = self.run.events, self.run.pair.resolved_time
        begins = np.flatnonzero(self.run.balances)
        ends = begins + events.stuck[begins]
        ends = np.minimum(ends, events.time.size - 1)
        parts = events.time[begins[1:]] - events.time[ends[:-1]] > apart
        firsts, lasts = begins[np.append(True, parts)], ends[np.append(parts, True)]
        found = []
        for first, last in zip(firsts.tolist(), lasts.tolist(), strict=True):
            start, end = float(events.time[first]), float(events.time[last])
            near = (self.time >= start) & (self.time <= end)
            peak = float(self._force[near].max()) if apart else None
            found.append(ContactPeriod(start, end, float(events.impulse[first : last + 1].sum()), peak))
        return found
