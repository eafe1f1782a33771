"""A method: how a scene is solved, with its resolution. Knows nothing of the screen."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, Self

from .. import validation
from ..bodies import Balls, FlexiblePendulum, Mechanism
from ..contact.own import compiling
from ..contact.protocol import Damped
from ..provenance import compiled
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.bounds import bounded
from ..solution.solution import Solution
from ..text.notes import Note, Severity
from ..validation import SceneError
from .fronts import notes_on_ripple
from .mechanisms import in_laboratory, not_followed
from .options import options_of
from .start import note_on_start
from .striking import as_striking
from .theory_limits import notes_on_theory
from .validity import MAX_TRUSTED_ESTIMATE, beside_elastic, bodies_that_bend, general_notes
from .weight import falls_along, hangs_low, leave_out_weight, weight_too_large

AFTERGLOW = 1.0  # round trips shown after the bodies have parted for good, where no duration is asked for
MAX_ROUND_TRIPS = 20_000.0  # nothing is followed for longer
MAX_DURATION = 1e4  # [s]


def never() -> bool:
    """What asks whether a work is cancelled, where nobody can cancel it."""
    return False


class SceneNotSupported(SceneError):
    """The method cannot solve this scene; the message says what to use instead."""


def no_method(reasons: Mapping[str, Note]) -> Note:
    """That none can, with the reasons of each."""
    return Note("refusals.no-method", Severity.REFUSAL, reasons={name: why.table() for name, why in reasons.items()})


@dataclass(frozen=True)
class Method(ABC):
    """A frozen dataclass whose fields are its options; `NAME` is its word in scene files."""

    NAME: ClassVar[str]
    SPATIAL: ClassVar[bool] = False  # whether it knows bodies in space, beside those on an axis
    PULSES: ClassVar[bool] = False  # whether it knows a prescribed force, beside bodies that strike
    BEAMS: ClassVar[bool] = False  # whether it knows beams struck across, beside rods
    MOVES: ClassVar[bool] = False  # whether it follows a mechanism as it moves, not its impact alone
    ROWS: ClassVar[bool] = False  # whether it knows a row of balls, beside one body
    DAMPED: ClassVar[bool] = False  # whether it knows damping of their own
    WEIGHT: ClassVar[bool] = False  # whether the weight of the impactor acts while it touches
    RIPPLES: ClassVar[bool] = False  # whether it sums up modes or elements, which ripple behind a front
    CONSERVES: ClassVar[bool] = True  # whether it keeps energy to rounding, its own steps apart
    WAVES: ClassVar[bool] = True  # whether waves run in the bodies that it solves
    TRUSTED_ERROR: ClassVar[float] = MAX_TRUSTED_ESTIMATE  # up to which its estimate is not reported
    # options that make it finer, the first that a scene allows; none: one answer
    RESOLUTIONS: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> Self:
        """From the table `[method]` of a scene file, without name and duration. Raises SceneError naming the key."""
        options = options_of(cls)
        given = validation.table("method", given, options)
        found = {}
        for name, each in options.items():
            if name in given and not given[name] is each.default is None:  # None: as if it were left out
                found[name] = each.metadata["read"](f"method.{name}", given[name])
        return cls(**found)

    @abstractmethod
    def why_not(self, scene: Scene) -> Note | None:
        """The note that says why this method cannot solve the scene, or None."""

    def refusal(self, scene: Scene) -> Note | None:
        """`why_not`, and before it what every method says that knows bodies on an axis only."""
        bends = isinstance(scene.impactor, FlexiblePendulum)
        if bends and isinstance(scene.target, Mechanism) and scene.target.frozen.rates.any():
            return Note("refusals.pendulum-on-moving-mechanism", Severity.REFUSAL)
        scene = scene.struck if self.MOVES else scene.struck.at_contact
        if scene.normal is not None and not self.SPATIAL:
            return Note("refusals.in-space", Severity.REFUSAL)
        if scene.prescribed_force and not self.PULSES:
            return Note("refusals.prescribed-force", Severity.REFUSAL)
        if isinstance(scene.target, Balls) and not self.ROWS:
            return Note("refusals.row-of-balls", Severity.REFUSAL)
        if not self.BEAMS and scene.bends:
            return Note("refusals.beam", Severity.REFUSAL)
        if not self.DAMPED and any(body.damping for body in bodies_that_bend(scene)):
            return Note("refusals.damped-beam", Severity.REFUSAL)
        return self.why_not(scene) or (None if self.takes_weight(scene) else weight_too_large(scene))

    def takes_weight(self, scene: Scene) -> bool:
        """Whether it has what weight does in this scene; one that has not says how large that is, up to a limit."""
        return self.WEIGHT

    def neglects_weight(self, scene: Scene) -> bool:
        """Whether weight acts in the scene that it leaves out."""
        return bool(scene.weight_acceleration) and not self.takes_weight(scene)

    @abstractmethod
    def _solve(self, scene: Scene, duration: float | None) -> Solution: ...

    def solve(self, scene: SceneOrName, duration: float | None = None) -> Solution:
        """Solve up to `duration` [s]; without one, until the bodies part for good and a little beyond.

        Of its diagnostics `wall_time` [s] is that of the solve alone, `compile_time` [s] what compiling kernels, or
        loading compiled ones, took besides. Raises SceneNotSupported, SceneError for a duration out of range.
        """
        scene = scene_of(scene)
        if scene.struck is not scene:
            return bounded(as_striking(self.solve(scene.struck, duration), scene))
        reason = self.refusal(scene)
        if reason:
            raise SceneNotSupported("method.name", self.NAME, reason)
        scene = scene.with_modes(getattr(self, "modes", None))
        impact = scene if self.MOVES else scene.at_contact
        if duration is not None:
            longest = MAX_DURATION if self.MOVES else min(MAX_ROUND_TRIPS * impact.time_unit, MAX_DURATION)
            shortest = 1e-6 * impact.time_unit
            duration = validation.number("method.duration", duration, shortest, longest, "s")
        before = compiled()
        with compiling((impact.contact, *impact.striker_laws, *impact.joint_laws)):
            solution = self._solve(impact, duration)
        if impact is not scene:
            solution = in_laboratory(solution, scene)
        if self.neglects_weight(impact):
            leave_out_weight(solution)
        whole, seconds = duration is None, compiled() - before
        solution.refine("diagnostics", lambda _, found: found | {"compile_time": seconds})
        solution.refine("notes", lambda solved, own: [*own, *self._general_notes(solved, own, whole)])
        return bounded(solution)

    def solve_in_full(self, scene: SceneOrName, duration: float | None = None) -> Solution:
        """`solve`, for who reads the notes: where damping in the contact counts waves twice, they say what the elastic
        law gives, by one more solve when they are first read.
        """
        scene = scene_of(scene)
        if scene.struck is not scene:
            return bounded(as_striking(self.solve_in_full(scene.struck, duration), scene))

        def elastic(solved: Solution) -> Solution:
            assert isinstance(scene.contact, Damped)
            undamped = replace(scene, contact=scene.contact._replace(damping=0.0))
            return self._again(solved).solve(undamped, duration)

        solution = self.solve(scene, duration)
        solution.refine("notes", lambda solved, notes: beside_elastic(solved, notes, elastic))
        return solution

    def _general_notes(self, solution: Solution, own: list[Note], whole: bool) -> list[Note]:
        """What is to be said besides its own notes."""
        notes = general_notes(
            solution, own, whole, self._miscounts(), self._resolution(solution.scene), self.TRUSTED_ERROR
        )
        notes = [note for note in notes if self.CONSERVES or note.code != "books-open"]
        notes += notes_on_ripple(solution) if self.RIPPLES else []
        notes += notes_on_theory(solution, self.WAVES)
        notes += self._notes_on_links(solution.scene) + falls_along(solution.scene) + hangs_low(solution)
        notes += [] if whole else not_followed(solution)
        return [note for note in notes if note not in own]

    def _notes_on_links(self, scene: Scene) -> list[Note]:
        """How a mechanism is assumed to start, and where more modes are asked for than its links have: then these are
        all that there are."""
        found = note_on_start(scene.target) if isinstance(scene.target, Mechanism) else []
        modes, most = getattr(self, "modes", None), getattr(scene.target, "most_modes", 0)
        if modes is None or modes == type(self).modes or not 0 < most < modes:  # type: ignore[attr-defined]
            return found
        return [*found, Note("links-keep-modes", Severity.REMARK, most=most, modes=modes)]

    def without_estimate(self) -> Self:
        """Itself without the estimate of its error, which costs as much again."""
        estimates = any(option.name == "estimate" for option in fields(self))
        return replace(self, **{"estimate": False}) if estimates else self

    def for_figures(self, fields: bool, estimate: bool) -> Self:
        """Itself for who reads figures and no notes, and solves many: without what only others need of its solutions.

        fields: whether those of the motion are read; estimate: whether the estimated error is."""
        return self if estimate else self.without_estimate()

    def _again(self, solution: Solution) -> "Method":
        """What has found the solution, without its estimate of the error, which costs as much again."""
        return self.without_estimate()

    def _miscounts(self) -> str | None:
        """Why contacts may be miscounted, an option of the term `recount`; None if they cannot, or nothing counts."""
        return None

    def _resolution(self, scene: Scene) -> str | None:
        """The option that makes this finer, as it is set; None where no resolution settles the velocities."""
        given = (name for name in self.RESOLUTIONS if getattr(self, name) is not None)
        return next(given, next(iter(self.RESOLUTIONS), None))

    def table(self) -> dict[str, Any]:
        """Name and options, as in a scene file."""
        options = {option.name: getattr(self, option.name) for option in fields(self) if option.repr}
        return {"name": self.NAME} | validation.plain(options)
