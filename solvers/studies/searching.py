"""Searching the values of some keys of a scene for the best figures, within bounds on others."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import CancelledError, Future
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import validation
from ..scene import Scene
from ..validation import SceneError, allowed
from .figures import FIGURES
from .study.axes import Axis, axes_of
from .study.crew import Crew, with_care
from .study.work import Part, Work

SHARE = 0.85  # of the solves, in which all of the range is searched; the rest is spent close to the best
PEOPLE = 12  # candidates for each key
LEAST_LEFT = 10  # solves, for which going closer is worth it
BOUND = re.compile(r"\s*(?P<figure>\w+)\s*(?P<sign><=|>=)\s*(?P<value>[^\s<>=]+)\s*")
LARGE = 1e100  # in place of infinity, of which searches make nothing; its square is a number


@dataclass(frozen=True)
class Limit:
    """A bound on a figure."""

    figure: str
    sign: str  # <= or >=
    value: float

    def over(self, figures: np.ndarray) -> np.ndarray:
        """By how much it is violated, as a share of the bound; 0 where it is kept, inf where there is no figure."""
        found = np.maximum(self.margin(figures), 0.0)
        return np.where(np.isnan(found), np.inf, found)

    def margin(self, figures: Any) -> Any:
        """How far it is from being kept, as a share of the bound; negative where it is."""
        beyond = (figures - self.value) if self.sign == "<=" else (self.value - figures)
        return beyond / (abs(self.value) or 1.0)

    def __str__(self) -> str:
        return f"{self.figure} {self.sign} {self.value:g}"


def bounded_axes(scene: Scene, vary: Any) -> tuple[Axis, ...]:
    """An axis for each entry. Raises SceneError for what is none, or goes on without end."""
    if not isinstance(vary, Mapping) or not vary:
        raise SceneError("vary", vary or None, allowed("study-vary"))
    axes = axes_of(scene, {key: _pair(given) for key, given in vary.items()}, drawn=True)
    endless = next((axis for axis in axes if axis.law and not all(map(math.isfinite, axis.law.frozen.support()))), None)
    if endless is not None and endless.law is not None:
        raise SceneError(endless.name, endless.law.text, allowed("bounded-range"))
    return axes


def limits_of(such_that: str | Sequence[str]) -> list[Limit]:
    """Bounds as they are written. Raises SceneError."""
    return [_limit(bound) for bound in ([such_that] if isinstance(such_that, str) else such_that)]


def _pair(given: Any) -> Any:
    """A pair of numbers is a range."""
    numbers = isinstance(given, tuple) and len(given) == 2 and all(isinstance(each, (int, float)) for each in given)
    return f"{float(given[0])!r}..{float(given[1])!r}" if numbers else given


def _limit(bound: str) -> Limit:
    found = BOUND.fullmatch(bound) if isinstance(bound, str) else None
    try:
        value = float(found["value"]) if found else math.nan
    except ValueError:
        value = math.nan
    if found is None or not math.isfinite(value):
        raise SceneError("such_that", bound, allowed("figure-bound"))
    return Limit(validation.choice("such_that", found["figure"], FIGURES), found["sign"], value)


class Search:
    """Points of a unit cube, an edge for each axis, with what came of each."""

    def __init__(self, axes: Sequence[Axis], work: Work, limits: list[Limit], largest: bool, crew: Crew, solves: int):
        self.axes, self.work, self.crew = axes, work, crew
        self.aim(0, largest, limits, solves)
        # By the values of the keys as words, as tables may be among them:
        self.found: dict[str, np.ndarray] = {}  # figures
        self.rows: dict[str, tuple[Any, ...]] = {}  # the values themselves
        self.shares: dict[str, np.ndarray] = {}  # where they are in the cube
        self.reason = ""  # of one that was refused

    def aim(self, place: int, largest: bool, limits: list[Limit], solves: int) -> None:
        """The figure at this place of those of the work is to be large, or small, after so many solves in all."""
        self.place, self.largest, self.limits, self.solves = place, largest, limits, solves

    def row(self, point: np.ndarray) -> tuple[Any, ...]:
        """The values of all keys there."""
        return sum((axis.at(np.array([share]))[0] for axis, share in zip(self.axes, point, strict=True)), ())

    def figures(self, points: np.ndarray) -> np.ndarray:
        """(figures, points), each solved once."""
        points = np.clip(points, 0.0, 1.0)
        rows = [self.row(point) for point in points]
        names = [repr(row) for row in rows]
        self.rows |= dict(zip(names, rows, strict=True))
        self.shares |= dict(zip(names, points, strict=True))
        new = [name for name in dict.fromkeys(names) if name not in self.found]
        size = -(-len(new) // self.crew.workers) or 1
        parts = [new[start : start + size] for start in range(0, len(new), size)]
        begun = [self.crew.submit(self.work, [self.rows[name] for name in part]) for part in parts]
        for part, future in zip(parts, begun, strict=True):
            solved = self._answer(part, future)
            self.found |= dict(zip(part, solved.figures, strict=True))
            self.reason = self.reason or next((str(reason) for reason in solved.reason if reason), "")
        found = [self.found[name] for name in names]
        return np.stack(found, 1) if found else np.empty((len(self.work.figures), 0))

    def _answer(self, part: list[str], future: "Future[Part]") -> Part:
        """Of one part, by other processes where that of its own has ended."""
        try:
            return future.result()
        except self.crew.broken:
            self.crew.renew()
        except CancelledError:  # as another part's process has ended
            pass
        return with_care(self.work, [self.rows[name] for name in part], self.crew)

    def goal(self, points: np.ndarray) -> np.ndarray:
        """What is to be small; inf where it is refused."""
        found = self.figures(points)[self.place] * (-1.0 if self.largest else 1.0)
        return np.where(np.isnan(found), np.inf, found)

    def over(self, points: np.ndarray) -> np.ndarray:
        """(limits, points) by how much each is violated."""
        return np.minimum(self._over(self.figures(points)), LARGE)

    def violated(self, figures: np.ndarray) -> np.ndarray:
        """(points,) by how much all limits together are."""
        return self._over(figures).sum(0) if self.limits else np.zeros(figures.shape[1])

    def _over(self, figures: np.ndarray) -> np.ndarray:
        names = self.work.figures
        return np.stack([limit.over(figures[names.index(limit.figure)]) for limit in self.limits])

    def run(self, seed: int, cancelled: Callable[[], bool]) -> None:
        """Over all of the cube, then close to the best."""
        from scipy import optimize  # a third of a second, which nothing else here needs

        count, until = len(self.axes), len(self.found) + SHARE * (self.solves - len(self.found))
        limits = optimize.NonlinearConstraint(
            lambda x: self.over(x.T) if x.ndim > 1 else self.over(x[None])[:, 0], 0.0, 0.0
        )
        optimize.differential_evolution(
            lambda x: np.minimum(self.goal(np.atleast_2d(x.T)), LARGE),
            [(0.0, 1.0)] * count,
            constraints=(limits,) if self.limits else (),
            maxiter=self.solves,
            popsize=PEOPLE,
            rng=seed,
            polish=False,
            init="sobol",
            tol=1e-9,
            vectorized=True,
            updating="deferred",
            callback=lambda intermediate_result: cancelled() or len(self.found) >= until,
        )
        if not cancelled():
            self.closer()

    def closer(self) -> None:
        """From the best so far, by the keys that are not words or whole numbers."""
        from scipy import optimize  # likewise

        free = [number for number, axis in enumerate(self.axes) if axis.law]
        begin = self.best()
        left = self.solves - len(self.found)
        if begin is None or not free or left < LEAST_LEFT:
            return
        start = self.shares[begin].copy()

        def there(x: np.ndarray) -> np.ndarray:
            point = start.copy()
            point[free] = x
            return point[None]

        names, unit = self.work.figures, abs(self.found[begin][self.place]) or 1.0
        bounds = [(limit, names.index(limit.figure)) for limit in self.limits]
        margins = optimize.NonlinearConstraint(
            lambda x: [_finite(limit.margin(self.figures(there(x))[place, 0])) for limit, place in bounds], -np.inf, 0.0
        )
        optimize.minimize(
            lambda x: _finite(self.goal(there(x))[0] / unit),
            start[free],
            method="COBYQA",
            bounds=[(0.0, 1.0)] * len(free),
            constraints=(margins,) if bounds else (),
            options={"maxfev": left, "initial_tr_radius": 0.02, "final_tr_radius": 1e-9},
        )

    def best(self) -> str | None:
        """The values with the best figure that keep all limits; else those that violate them least."""
        if not self.found:
            return None
        names, figures = list(self.found), np.stack(list(self.found.values()), 1)
        goal = figures[self.place] * (-1.0 if self.largest else 1.0)
        over = self.violated(figures)
        rank = np.where(np.isnan(goal), np.inf, over)
        best = min(range(len(names)), key=lambda place: (rank[place], goal[place]))
        return names[best] if math.isfinite(rank[best]) else None


def _finite(value: float) -> float:
    return float(min(max(value, -LARGE), LARGE))
