"""A method: how a scene is solved, with its resolution. Knows nothing of the screen."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any, ClassVar

from . import checks
from .checks import SceneError
from .doubts import beside_elastic, bodies_that_bend, general_doubts
from .machine import compiled
from .scene import Scene
from .solution import Solution

AFTERGLOW = 1.0  # round trips shown after the bodies have parted for good, where no duration is asked for
MAX_ROUND_TRIPS = 20_000.0  # nothing is followed for longer
MAX_DURATION = 1e4  # [s]


class SceneNotSupported(SceneError):
    """The method cannot solve this scene; the message says what to use instead."""


class Method(ABC):
    """A frozen dataclass whose fields are its options; `NAME` is its word in scene files."""

    NAME: ClassVar[str]
    SPATIAL: ClassVar[bool] = False  # whether it knows bodies in space, beside those on an axis
    PULSES: ClassVar[bool] = False  # whether it knows a prescribed force, beside bodies that strike
    BEAMS: ClassVar[bool] = False  # whether it knows beams struck across, beside rods
    DAMPED: ClassVar[bool] = False  # whether it knows damping of their own
    KNOBS: ClassVar[tuple[str, ...]] = ()  # options that make it finer, the first that a scene allows; none: one answer

    @classmethod
    @abstractmethod
    def read(cls, given: Mapping[str, object]) -> "Method":
        """From the table `[method]` of a scene file. Raises SceneError naming the key."""

    @abstractmethod
    def why_not(self, scene: Scene) -> str | None:
        """The sentence that says why this method cannot solve the scene, or None."""

    def refusal(self, scene: Scene) -> str | None:
        """`why_not`, and before it what every method says that knows bodies on an axis only."""
        if scene.normal is not None and not self.SPATIAL:
            return "the bodies must meet on an axis; for bodies in space use 'rigid'"
        if scene.impactor.kind == "pulse" and not self.PULSES:
            return "the impactor must be a body; for a prescribed force use 'waves'"
        if not self.BEAMS and "beam" in (scene.impactor.kind, scene.target.kind):
            return "no body may be a beam; use 'modal'"
        if not self.DAMPED and any(body.damping for body in bodies_that_bend(scene)):
            return "a beam must have no damping of its own; use 'modal', or damping = 0"
        return self.why_not(scene)

    @abstractmethod
    def _solve(self, scene: Scene, duration: float | None) -> Solution: ...

    def solve(self, scene: Scene, duration: float | None = None) -> Solution:
        """Solve up to `duration` [s]; without one, until the bodies part for good and a little beyond.

        Of its diagnostics `wall_time` [s] is that of the solve alone, `compile_time` [s] what compiling kernels, or
        loading compiled ones, took besides. Raises SceneNotSupported, SceneError for a duration out of range.
        """
        reason = self.refusal(scene)
        if reason:
            raise SceneNotSupported("method.name", self.NAME, reason)
        if duration is not None:
            longest = min(MAX_ROUND_TRIPS * scene.time_unit, MAX_DURATION)
            shortest = 1e-6 * scene.time_unit
            duration = checks.number("method.duration", duration, shortest, longest, "s")
        before = compiled()
        solution = self._solve(scene, duration)
        whole, seconds = duration is None, compiled() - before
        solution.refine("diagnostics", lambda _, found: found | {"compile_time": seconds})
        solution.refine("notes", lambda solved, own: [*own, *self._general_doubts(solved, own, whole)])
        return solution

    def solve_in_full(self, scene: Scene, duration: float | None = None) -> Solution:
        """`solve`, for who reads the notes: where damping in the contact counts waves twice, they tell what the elastic
        law gives, by one more solve when they are first read.
        """

        def elastic(solved: Solution) -> Solution:
            undamped = replace(scene, contact=scene.contact._replace(damping=0.0))
            return self._again(solved).solve(undamped, duration)

        solution = self.solve(scene, duration)
        solution.refine("notes", lambda solved, notes: beside_elastic(solved, notes, elastic))
        return solution

    def _general_doubts(self, solution: Solution, own: list[str], whole: bool) -> list[str]:
        """What is to be said besides its own notes."""
        doubts = general_doubts(solution, own, whole, self._recount(), self._knob(solution.scene))
        return [doubt for doubt in doubts if doubt not in own]

    def _again(self, solution: Solution) -> "Method":
        """What has found the solution, without its estimate of the error, which costs as much again."""
        return replace(self, estimate=False) if hasattr(self, "estimate") else self

    def _recount(self) -> str | None:
        """Why the contacts may be miscounted and what to do, in a sentence; None if they cannot, or nothing counts."""
        return None

    def _knob(self, scene: Scene) -> str | None:
        """The option that makes this finer, as it is set; None where no resolution settles the velocities."""
        return next((knob for knob in self.KNOBS if getattr(self, knob) is not None), next(iter(self.KNOBS), None))

    def table(self) -> dict[str, Any]:
        """Name and options, as in a scene file."""
        return {"name": self.NAME} | {option.name: getattr(self, option.name) for option in fields(self) if option.repr}
