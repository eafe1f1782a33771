"""The best values for some keys of a scene: the smallest, or largest, figure within bounds on others."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import CancelledError, Future
from contextlib import closing
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import validation
from ..methods.base import Method, never
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solve import solve
from ..text.notes import Note, Severity, coded
from ..validation import SceneError, allowed
from .figures import FIGURES
from .study.axes import Axis, axes_of
from .study.crew import Crew, crew_of, with_care
from .study.study import crew_size
from .study.work import Part, Work
from .varied import unit_of

LEAST, USUAL, MOST_SOLVES = 50, 2_000, 100_000
SHARE = 0.85  # of the solves, in which all of the range is searched; the rest is spent close to the best
PEOPLE = 12  # candidates for each key
CLOSE = 1e-3  # of a bound: so near to it a limit decides
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


@dataclass(frozen=True, repr=False)
class Optimum:
    """The best that was found; printed as a table. SI units."""

    title: str  # of the scene
    goal: str  # figure
    largest: bool  # whether that is to be large
    values: dict[str, Any] | None  # by key; None: no point that was tried keeps all limits
    units: dict[str, str]  # of keys and figures
    figures: dict[str, float]  # at these values, or where the limits are violated least
    limits: list[Limit]
    deciding: list[str]  # limits, and keys whose range ends there: without them there may be better ones
    solves: int
    refused: int  # of them
    notes: list[Note]  # on the best solution, those that are warnings or worse, and on the search

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        plain = {name: value for name, value in vars(self).items() if name not in ("title", "notes")}
        figures = {name: None if math.isnan(value) else value for name, value in self.figures.items()}
        limits = [str(limit) for limit in self.limits]
        return plain | {"figures": figures, "limits": limits, **coded(self.notes)}

    def __str__(self) -> str:
        from ..notebook import search_tables

        return search_tables.optimum(self)

    def __repr__(self) -> str:
        return f"<Optimum: {self.goal} = {self.figures.get(self.goal, math.nan):.6g} at {self.values}>"


def optimise(
    scene: SceneOrName,
    vary: Mapping[Any, Any],
    *,
    minimise: str | None = None,
    maximise: str | None = None,
    such_that: Sequence[str] = (),
    solves: int = USUAL,
    seed: int = 0,
    method: str | Method | None = None,
    workers: int | None = None,
    cancelled: Callable[[], bool] = never,
) -> Optimum:
    """The values of some keys for which a figure is smallest, or largest.

    `vary`: by key a range, "LOW..HIGH[:log]" or a pair of numbers, or words and whole numbers to choose from, as in
    `study`. `such_that`: bounds on figures, "peak_stress <= 2e8". Any figures of `Figures`, without the
    estimates of their errors. Found by differential evolution over the whole range (`scipy.optimize`), which minds
    neither jumps nor several minima, then closer to the best by COBYQA; about `solves` solves in all, shared by
    `workers` processes. A better one may exist: other seeds tell. `cancelled()` true: the best by then.

    Raises SceneError for keys, figures and bounds that do not exist; where every point is refused, with the reason of
    one. Cost: the solves.
    """
    scene = scene_of(scene)
    if (minimise is None) == (maximise is None):
        raise SceneError("minimise", minimise, allowed("one-goal"))
    goal = validation.choice("minimise" if maximise is None else "maximise", minimise or maximise, FIGURES)
    limits = [_limit(bound) for bound in ([such_that] if isinstance(such_that, str) else such_that)]
    solves = validation.whole_number("solves", solves, LEAST, MOST_SOLVES)
    seed = validation.whole_number("seed", seed, 0, 2**32 - 1)
    workers = crew_size(workers)
    axes = axes_of(scene, {key: _pair(given) for key, given in _table(vary).items()}, drawn=True)
    endless = next((axis for axis in axes if axis.law and not all(map(math.isfinite, axis.law.frozen.support()))), None)
    if endless is not None and endless.law is not None:
        raise SceneError(endless.name, endless.law.text, allowed("bounded-range"))
    keys = tuple(key for axis in axes for key in axis.keys)
    figures = tuple(dict.fromkeys([goal, *(limit.figure for limit in limits), "contacts"]))
    with closing(crew_of(workers)) as crew:
        search = Search(axes, Work(scene, keys, figures, method, False), limits, maximise is not None, crew, solves)
        search.run(seed, cancelled)
    units = {key: unit_of(scene, key) for key in keys} | {name: FIGURES[name][0] for name in figures}
    return search.best(scene, units, goal, method)


def _table(vary: Any) -> Mapping[Any, Any]:
    if not isinstance(vary, Mapping) or not vary:
        raise SceneError("vary", vary or None, allowed("study-vary"))
    return vary


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
        self.axes, self.work, self.limits, self.largest = axes, work, limits, largest
        self.crew, self.solves = crew, solves
        # By the values of the keys as words, as tables may be among them:
        self.found: dict[str, np.ndarray] = {}  # figures
        self.rows: dict[str, tuple[Any, ...]] = {}  # the values themselves
        self.shares: dict[str, np.ndarray] = {}  # where they are in the cube
        self.reason = ""  # of one that was refused

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
        found = self.figures(points)[0] * (-1.0 if self.largest else 1.0)
        return np.where(np.isnan(found), np.inf, found)

    def over(self, points: np.ndarray) -> np.ndarray:
        """(limits, points) by how much each is violated."""
        return np.minimum(self._over(self.figures(points)), LARGE)

    def _over(self, figures: np.ndarray) -> np.ndarray:
        names = self.work.figures
        return np.stack([limit.over(figures[names.index(limit.figure)]) for limit in self.limits])

    def run(self, seed: int, cancelled: Callable[[], bool]) -> None:
        """Over all of the cube, then close to the best."""
        from scipy import optimize  # a third of a second, which nothing else here needs

        count = len(self.axes)
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
            callback=lambda intermediate_result: cancelled() or len(self.found) >= SHARE * self.solves,
        )
        if not cancelled():
            self._closer(optimize)

    def _closer(self, optimize: Any) -> None:
        """From the best so far, by the keys that are not words or whole numbers."""
        free = [number for number, axis in enumerate(self.axes) if axis.law]
        begin = self._best()
        left = self.solves - len(self.found)
        if begin is None or not free or left < 10:
            return
        start = self.shares[begin].copy()

        def there(x: np.ndarray) -> np.ndarray:
            point = start.copy()
            point[free] = x
            return point[None]

        names, unit = self.work.figures, abs(self.found[begin][0]) or 1.0
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

    def _best(self) -> str | None:
        """The values with the best figure that keep all limits; else those that violate them least."""
        if not self.found:
            return None
        names, figures = list(self.found), np.stack(list(self.found.values()), 1)
        goal = figures[0] * (-1.0 if self.largest else 1.0)
        over = self._over(figures).sum(0) if self.limits else np.zeros(len(names))
        rank = np.where(np.isnan(goal), np.inf, over)
        best = min(range(len(names)), key=lambda place: (rank[place], goal[place]))
        return names[best] if math.isfinite(rank[best]) else None

    def best(self, scene: Scene, units: dict[str, str], goal: str, method: str | Method | None) -> Optimum:
        """Raises SceneError where every point is refused."""
        best = self._best()
        if best is None and not self.reason:
            raise SceneError("maximise" if self.largest else "minimise", goal, allowed("figure-there"))
        if best is None:
            raise SceneError("vary", ", ".join(self.work.keys), allowed("some-solved", reason=self.reason))
        names, figures = self.work.figures, self.found[best]
        values = dict(zip(self.work.keys, self.rows[best], strict=True))
        kept = all(limit.margin(figures[names.index(limit.figure)]) <= 0.0 for limit in self.limits)
        refused = sum(math.isnan(found[0]) for found in self.found.values())
        notes = [Note("optimum-searched", Severity.REMARK, solves=len(self.found), refused=refused)]
        if kept:
            solution = solve(scene.replace(values), method)
            notes = [note for note in solution.notes if note.severity != Severity.REMARK] + notes
        return Optimum(
            scene.title,
            goal,
            self.largest,
            values if kept else None,
            units,
            dict(zip(names, figures.tolist(), strict=True)),
            self.limits,
            [*self._decides(figures), *self._ends(best)],
            len(self.found),
            refused,
            notes,
        )

    def _decides(self, figures: np.ndarray) -> list[str]:
        """Limits that the best touches."""
        names = self.work.figures
        return [str(limit) for limit in self.limits if abs(limit.margin(figures[names.index(limit.figure)])) < CLOSE]

    def _ends(self, best: str) -> list[str]:
        """Keys at an end of their range."""
        shares = zip(self.axes, self.shares[best], strict=True)
        return [axis.name for axis, share in shares if axis.law and not CLOSE < share < 1.0 - CLOSE]


def _finite(value: float) -> float:
    return float(min(max(value, -LARGE), LARGE))
