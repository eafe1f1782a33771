"""The best values for some keys of a scene: the smallest, or largest, figure within bounds on others."""

import math
from collections.abc import Callable, Mapping, Sequence
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
from .searching import Limit, Search, bounded_axes, limits_of
from .study.crew import crew_of
from .study.study import crew_size
from .study.work import Work
from .varied import unit_of

LEAST, USUAL, MOST_SOLVES = 50, 2_000, 100_000
CLOSE = 1e-3  # of a bound: so near to it a limit decides


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
    limits = limits_of(such_that)
    solves = validation.whole_number("solves", solves, LEAST, MOST_SOLVES)
    seed = validation.whole_number("seed", seed, 0, 2**32 - 1)
    workers = crew_size(workers)
    axes = bounded_axes(scene, vary)
    keys = tuple(key for axis in axes for key in axis.keys)
    figures = tuple(dict.fromkeys([goal, *(limit.figure for limit in limits), "contacts"]))
    with closing(crew_of(workers)) as crew:
        search = Search(axes, Work(scene, keys, figures, method, False), limits, maximise is not None, crew, solves)
        search.run(seed, cancelled)
    units = {key: unit_of(scene, key) for key in keys} | {name: FIGURES[name][0] for name in figures}
    return _optimum(search, scene, units, goal, method)


def _optimum(search: Search, scene: Scene, units: dict[str, str], goal: str, method: str | Method | None) -> Optimum:
    """Raises SceneError where every point is refused."""
    best = search.best()
    if best is None and not search.reason:
        raise SceneError("maximise" if search.largest else "minimise", goal, allowed("figure-there"))
    if best is None:
        raise SceneError("vary", ", ".join(search.work.keys), allowed("some-solved", reason=search.reason))
    names, figures = search.work.figures, search.found[best]
    values = dict(zip(search.work.keys, search.rows[best], strict=True))
    kept = all(limit.margin(figures[names.index(limit.figure)]) <= 0.0 for limit in search.limits)
    refused = sum(math.isnan(found[0]) for found in search.found.values())
    notes = [Note("optimum-searched", Severity.REMARK, solves=len(search.found), refused=refused)]
    if kept:
        solution = solve(scene.replace(values), method)
        notes = [note for note in solution.notes if note.severity != Severity.REMARK] + notes
    return Optimum(
        scene.title,
        goal,
        search.largest,
        values if kept else None,
        units,
        dict(zip(names, figures.tolist(), strict=True)),
        search.limits,
        [*_decides(search, figures), *_ends(search, best)],
        len(search.found),
        refused,
        notes,
    )


def _decides(search: Search, figures: np.ndarray) -> list[str]:
    """Limits that the best touches."""
    names = search.work.figures
    return [str(limit) for limit in search.limits if abs(limit.margin(figures[names.index(limit.figure)])) < CLOSE]


def _ends(search: Search, best: str) -> list[str]:
    """Keys at an end of their range."""
    shares = zip(search.axes, search.shares[best], strict=True)
    return [axis.name for axis, share in shares if axis.law and not CLOSE < share < 1.0 - CLOSE]
