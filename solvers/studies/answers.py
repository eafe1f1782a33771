"""A figure of a scene over some of its keys: what is solved, and why what is not has no answer."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from .. import validation
from ..accuracy.auto import Auto
from ..methods import METHODS
from ..methods.base import Method
from ..numerics.processors import all_processors
from ..scene import Scene
from ..solution.solution import Solution
from ..solve import read_method
from ..text.notes import Note, Severity
from ..validation import SceneError, allowed
from .figures import FIGURES, only_for

Point = tuple[float, ...]  # a value for each key


class Answers:
    """The figure at points, each solved once, from any thread. Raises SceneError for bodies in space."""

    def __init__(self, scene: Scene, keys: tuple[str, ...], figure: str):
        if scene.normal is not None:
            raise SceneError("scene", "bodies in space", allowed("scenes-on-axis"))
        self.scene, self.keys, self.figure = scene, keys, figure
        self.known: dict[Point, float] = {}
        self.contacts: dict[Point, int] = {}  # how many, where it is solved
        self.missing: dict[Point, SceneError] = {}
        self.chosen: Method | None = None
        self.chosen_at: Point = ()
        self.name = ""

    def settle(self, point: Point) -> None:
        """Have what `auto` chooses for this point solve all, as its choices differ from point to point."""
        try:
            changed, method, duration = self._asked(point)
            if isinstance(method, Auto):
                table = method.solve(changed, duration).method
                options = {name: option for name, option in table.items() if name != "name" and option is not None}
                self.chosen, self.chosen_at = METHODS[str(table["name"])].read(options), point
        except SceneError:  # a hole in the middle: `auto` chooses for each
            pass

    def solve(self, points: Sequence[Point], workers: int | None) -> None:
        """All of these. Raises SceneError if none can be solved, or for a key that takes no fractions."""
        self.at(*points[0])  # alone: if kernels must be compiled, then once
        with all_processors(workers) as pool:
            list(pool.map(lambda point: self.at(*point), points[1:]))
        refused = [self.missing[point] for point in points if point in self.missing]
        whole = next((each for each in refused if each.reason.code == "allowed.whole-number"), None)
        if whole is not None:
            raise SceneError("key", whole.key, allowed("perturbed-real"))
        if len(refused) == len(points):
            raise refused[0]

    def at(self, *point: float) -> float:
        """The figure; NaN where the scene is refused, or has no such figure."""
        if point not in self.known:
            try:
                solution = self._solved(point)
                found = FIGURES[self.figure][1](solution)
                if found is None:
                    raise SceneError(self.figure, None, allowed("existing-figure"))
                self.contacts[point], self.known[point] = len(solution.contacts), float(found)
            except SceneError as refused:
                self.missing[point], self.known[point] = refused, math.nan
        return self.known[point]

    def kind(self, *point: float) -> int:
        """How many contacts there are; -1 where it has no answer."""
        self.at(*point)
        return self.contacts.get(point, -1)

    def _solved(self, point: Point) -> Solution:
        changed, method, duration = self._asked(point)
        self.name = method.NAME
        return only_for(method, [self.figure]).solve(changed, duration)

    def _asked(self, point: Point) -> tuple[Scene, Method, float | None]:
        changed = self.scene.replace(dict(zip(self.keys, point, strict=True)))
        method, duration = read_method(changed.method, changed)
        return changed, self.chosen or method, duration

    def warnings(self, point: Point) -> list[Note]:
        """On the whole solution, with its estimate of the error."""
        changed, method, duration = self._asked(point)
        grave = (Severity.WARNING, Severity.INVALID)
        return [note for note in method.solve_in_full(changed, duration).notes if note.severity in grave]

    def nearest(self, wanted: float) -> tuple[Point, float]:
        """Of all that is solved, the point whose figure is nearest, and that figure."""
        there = {point: found for point, found in self.known.items() if not math.isnan(found)}
        return min(sorted(there.items()), key=lambda each: abs(each[1] - wanted))

    def why(self, refused: SceneError) -> dict[str, Any]:
        """For a note: the reason, which names its key where that is none of those that vary."""
        own = refused.key in self.keys
        return {"own": own, "why": (refused.reason if own else refused.note).table()}


def middle_of(low: float, high: float) -> float:
    """By a factor where both are above zero."""
    return 0.5 * (low + high) if low <= 0.0 else math.sqrt(low * high)


def read_wanted(such_that: Mapping[str, float]) -> tuple[str, float]:
    """The figure and its value."""
    if not isinstance(such_that, Mapping) or len(such_that) != 1:
        raise SceneError("such_that", such_that, allowed("one-figure"))
    ((figure, value),) = such_that.items()
    figure = validation.choice("such_that", figure, FIGURES)
    return figure, _finite(f"such_that.{figure}", value)


def read_range(key: str, between: tuple[float, float]) -> tuple[float, float]:
    """Its ends. Raises SceneError."""
    try:
        low, high = between
    except (TypeError, ValueError):
        raise SceneError(key, between, allowed("range")) from None
    return _finite(key, low), _finite(key, high)


def _finite(key: str, value: float) -> float:
    try:
        return validation.number(key, value, -math.inf, math.inf)
    except SceneError as refused:
        raise SceneError(key, refused.value, allowed("finite")) from None
