"""Repeated balances of impulse and momentum between a striker and a body that can ring."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, Self

import numpy as np

from ... import validation
from ...bodies import Rod
from ...numerics import balances
from ...numerics.balances import MIN_FLIGHT, SAMPLES_PER_PERIOD, Events, Work
from ...numerics.elements.modes import mesh_modes
from ...numerics.free_motion import Turn, exact_turn, newmark_frequencies, newmark_turn
from ...numerics.modes import Modes
from ...provenance import clock
from ...scene import Scene
from ...solution.solution import Solution
from ...solution.summary import summary
from ...text.notes import Note, Severity
from ..base import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..estimates import error_left, with_error
from ..options import option, real, whole, word
from ..parting import MAY_TOUCH_AGAIN, End, may_gain, moves_alike
from ..validity import bodies_that_bend, notes_on_rigid_impact
from .motion import MOST_NUMBERS, BalanceMotion, Pair, Run

VARIANTS = ("event-located", "step-end", "step-halving")
MOST_BALANCES = 20_000
HALVINGS = 40
HEAVY_ROD_RATIO = 1.5  # times the mass: from such a free rod the mass parts with hardly any force
# Of the speed of approach: what the velocity is then off by. Measured at mass ratios 1.5 to 30, 7 to 185 elements: 0.12
# to 0.16.
FADED_FORCE_ERROR = 0.16
MODES_OF_BEAMS = 20  # of a mesh, where none are asked for: the highest swing ten thousand times as fast as the lowest


class Others(NamedTuple):
    """What an estimate holds a number of elements or modes against, and how a rebound scatters about what is left."""

    most: float  # elements or modes
    shares: tuple[float, ...]  # of them; finer ones say more, as their own scatter is less
    factor: float  # on what differences leave, for one rod alone: random impacts keep to it so
    factor_of_more: float  # for several, whose waves meet


# Finer ones where they cost a second at most. Factors: `tests/random_estimates.py`.
OTHERS = (
    Others(30, (3.0, 4.0), 2.0, 2.6),
    Others(200, (2.0, 3.0), 2.2, 2.4),
    Others(math.inf, (0.7, 0.6, 1 / 2, 2 / 5, 1 / 3, 1 / 4), 2.7, 2.9),
)
# Of beams the highest mode swings with the square of its number.
OTHERS_OF_BEAMS = (Others(60, (3 / 2, 2.0), 2.4, 2.6), OTHERS[-1])


@dataclass(frozen=True)
class Balance(Method):
    """Impulsive balances with a restitution each, as many as it takes, and free motion in between.

    Rods struck on their end, beams struck across: meshes of `elements` (with all their modes or the lowest `modes`, 20
    of a beam by default), or their exact modes where only `modes` is given; links and pendulums that bend by their own
    modes and shapes. `variant`: "event-located" balances at the
    very instants at which the faces meet, and lets them stay together where restitution leaves endless ever smaller
    balances; "step-end", Newmark's fixed `step` with balances at step ends only; "step-halving", steps halved until the
    faces overlap by less than `tolerance`.
    Error: with restitution 1 a sequence of balances is chaotic, the rebound scatters by some 0.03 of the impact speed;
    below 1 the loss falls as 1 / elements and does not depend on it. Of "step-end" the loss is an artefact of the step.
    Source: thesis 6.3, 6.4.1 and 4.6. Differs: (6.22) speaks of halving, tables 6.2 to 6.5 follow from "step-end".
    """

    elements: int | None = option(None, whole(1, 2000))
    modes: int | None = option(None, whole(1, 2000))
    restitution: float = option(1.0, real(0.0, 1.0))
    variant: str = option("event-located", word(VARIANTS))
    step: float | None = option(None, real(1e-15, 1e3, "s"))
    tolerance: float | None = option(None, real(1e-30, 1.0, "m"))  # of overlap
    estimate: bool = field(default=True, repr=False)

    NAME = "balance"
    RESOLUTIONS = ("elements",)
    BEAMS = WEIGHT = RIPPLES = True

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> Self:
        found = super().read(given)
        for name, variants in (("step", VARIANTS[1:]), ("tolerance", VARIANTS[2:])):
            if given.get(name) is not None and found.variant not in variants:
                reason = validation.allowed("only-with", key="variant", value=[variants[0]])
                raise validation.SceneError(f"method.{name}", given[name], reason)
        return replace(found, elements=found._elements)

    def why_not(self, scene: Scene) -> Note | None:
        if scene.impactor.held:
            return Note("refusals.held-striker", Severity.REFUSAL)
        for body in (scene.impactor, scene.target):
            if body.endless:
                return Note("refusals.no-natural-modes", Severity.REFUSAL)
            if not body.bonded:
                return Note("refusals.loose-chain", Severity.REFUSAL)
            if body.time_unit is None:
                continue
            if body.own_modes:
                continue
            if self._elements is None and body.no_modes is not None:
                return Note("refusals.plain-rods-only", Severity.REFUSAL)
            if self._elements is not None and not body.has_mesh:
                return Note("refusals.not-divided", Severity.REFUSAL, body=body.kind)
        return None

    def _resolution(self, scene: Scene) -> str | None:
        return None if bodies_that_bend(scene) else super()._resolution(scene)

    def _miscounts(self) -> str:
        return "elements"

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
            **with_error(found, lambda: self._error(scene, run, found)),
        )

    def _error(self, scene: Scene, run: Run, found: Mapping[str, Any]) -> float | None:
        estimated = self._estimated_error(scene, run) if self.estimate else None
        return None if estimated is None else max(estimated, may_gain(scene, found, run.end))

    def _notes(self, scene: Scene, run: Run) -> list[Note]:
        notes = []
        if run.full:
            located, count = self.variant == "event-located", run.balances.sum()
            notes.append(
                Note("balances-cut-short", Severity.WARNING, time=run.duration, balances=count, located=located)
            )
        elif run.end is End.MAY_TOUCH:
            notes.append(MAY_TOUCH_AGAIN)
        if not scene.rigid_contact:
            notes.append(Note("balance-without-law", Severity.WARNING))
        if self._elements is None and self.modes is not None:
            notes += [note for body in bodies_that_bend(scene) for note in body.notes_on_modes(self.modes)]
        count: Any
        kind, count = ("modes", self.modes) if self._elements is None else ("elements", self._elements)
        notes += notes_on_rigid_impact(scene, run.pair.shortest_period, count, kind)
        many = run.pair.resolved_time > 0.0 and run.balances.sum() > 2
        bends = scene.bends
        if many and (bends or self.restitution == 1.0):
            restitution, scatter = self.restitution, 0.03 if self.restitution == 1.0 else 0.01
            notes.append(
                Note("balances-chaotic", Severity.WARNING, restitution=restitution, scatter=scatter, bends=bends)
            )
        if many and self.restitution < 1.0 and self.variant != "event-located":
            notes.append(Note("loss-of-steps", Severity.WARNING))
        return notes

    def _estimated_error(self, scene: Scene, run: Run) -> float | None:
        """Of the final velocity, relative to the impact speed: against other numbers of elements or modes; None where a
        contact law is left out.

        A free rod heavier than the mass is left before its front is back, by a force that has all but faded: the
        velocity is then off by how long the first balances take beside the impact, and alike for all numbers of them.
        """
        if not scene.rigid_contact or scene.target.own_modes:
            return None
        if run.pair.resolved_time == 0.0:
            return 0.0 if self.variant == "event-located" else None
        count = self._elements or self.modes or 0
        choices = OTHERS_OF_BEAMS if scene.bends else OTHERS
        against = next(choice for choice in choices if count <= choice.most)
        methods = [self._with_share(scene, share) for share in against.shares]
        scenes = [replace(scene, impactor=scene.impactor.with_share_of_modes(share)) for share in against.shares]
        others = [other._run(each, run.duration) for other, each in zip(methods, scenes, strict=True)]
        if run.full or any(other.full for other in others):
            return None
        differences = [(run.final_velocity - other.final_velocity) / scene.speed for other in others]
        parts = [self._share(other) for other in methods]
        alone = len(scene.impactor.rods) + len(scene.target.rods) == 1
        factor = against.factor if alone else against.factor_of_more
        estimated = factor * error_left(zip(parts, differences, strict=True), 1.0)
        cut = scene.target.with_single_elements_cut(self._elements or 1)
        if self._elements is not None and cut is not scene.target:  # which no coarser mesh can show
            finer = self._run(replace(scene, target=cut), run.duration)
            estimated = max(estimated, 2.0 * abs(run.final_velocity - finer.final_velocity) / scene.speed)
        if isinstance(scene.target, Rod) and not scene.target.held and scene.mass_ratio > HEAVY_ROD_RATIO:
            estimated = max(estimated, FADED_FORCE_ERROR * math.sqrt(run.pair.shortest_period / scene.halting_time))
        # shorter than these modes resolve: all numbers of them are wrong alike
        return max(estimated, 1.0) if scene.halting_time < run.pair.shortest_period else estimated

    def _with_share(self, scene: Scene, share: float) -> "Balance":
        """Itself with a share of the elements and modes."""
        given = {"elements": self._elements, "modes": self.modes}
        if self.modes is None and scene.bends:
            given["modes"] = MODES_OF_BEAMS
        return replace(self, **{name: max(1, round(share * count)) for name, count in given.items() if count})

    def _share(self, other: "Balance") -> float:
        """Of the resolution that another has."""
        if self._elements is not None and other._elements is not None:
            return other._elements / self._elements
        return (other.modes or 1) / (self.modes or 1)

    def _run(self, scene: Scene, duration: float | None) -> Run:
        """From the first touch until the bodies part for good, or for `duration` [s]."""
        pair = Pair.of(scene, self._modes_of, duration is not None)
        bank, room = pair.bank, max(100, min(MOST_BALANCES, MOST_NUMBERS // pair.bank.closing.size))
        found = balances.events(room, bank.closing.size)
        q, p = np.zeros(bank.closing.size), pair.start.copy()
        end = MAX_ROUND_TRIPS * scene.time_unit if duration is None else duration
        period = pair.shortest_period or scene.time_unit
        patience = pair.patience if duration is None else math.inf
        joined, flight, step = balances.apart(), bank.frequencies, self.step
        if self.variant == "event-located":
            joined, step = balances.joined(bank), period / SAMPLES_PER_PERIOD
            count, reached = balances.event_located(
                bank, joined, exact_turn(bank.frequencies, step), step, self.restitution, MIN_FLIGHT * period, end,
                patience, q, p, found, Work.of(q.size),
            )  # fmt: skip
        elif self.variant == "step-end":
            step = period / SAMPLES_PER_PERIOD if step is None else step
            flight = newmark_frequencies(bank.frequencies, step)
            turn = newmark_turn(bank.frequencies, step)
            count, reached = balances.at_step_ends(bank, turn, self.restitution, step, end, patience, q, p, found)
        else:
            step = period / SAMPLES_PER_PERIOD if step is None else step
            tolerance = 1e-4 * scene.speed * scene.time_unit if self.tolerance is None else self.tolerance
            turns = [exact_turn(bank.frequencies, step / 2.0**level) for level in range(HALVINGS)]
            turns = Turn(*(np.array(part) for part in zip(*turns, strict=True)))
            count, reached = balances.by_halving(
                bank, turns, self.restitution, step, tolerance, end, patience, q, p, found
            )
        events = Events(*(values[:count] for values in found))
        full = count + 2 > room and reached < end
        if duration is None:
            flies, lasts = pair.flies(events)
            full, events = full and flies == count, Events(*(values[:flies] for values in events))
            duration = float(events.time[-1]) + min(AFTERGLOW * scene.time_unit, 0.5 * lasts)
        steps = 0 if step is None else int(np.ceil(duration / step))
        return Run(pair, joined, flight, events, duration, full, steps, _end(scene, pair, events, patience))

    def _modes_of(self, body) -> Modes:
        if body.time_unit is None or self._elements is None or body.own_modes:
            return body.modes(self.modes or 0)
        kept = MODES_OF_BEAMS if body.bends and self.modes is None else self.modes
        return mesh_modes(body.mesh(self._elements), kept)


def _end(scene: Scene, pair: Pair, events: Events, patience: float) -> End:
    """How a run until the bodies part has ended; `patience` [s]: for how long they were watched at most."""
    bank = pair.bank
    if math.isinf(patience) or events.stuck[-1] or bank.fall or bank.surge:
        return End.FOLLOWED
    sure = moves_alike(scene) or balances.clear_after(bank, events.coordinates[-1], events.rates[-1]) <= patience
    return End.PARTED if sure else End.MAY_TOUCH
