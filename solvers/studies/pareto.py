"""The best compromises between two figures of a scene: of what was solved, all that nothing else beats in both."""

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import Any

from .. import validation
from ..methods.base import Method, never
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solve import solve
from ..text.notes import Note, Severity, coded
from ..validation import SceneError, allowed
from .figures import FIGURES
from .front import Front
from .noted import Noted, noted
from .optimum import MOST_SOLVES
from .searching import Limit, Search, bounded_axes, limits_of
from .study.crew import crew_of
from .study.study import crew_size
from .study.work import Work
from .varied import unit_of

LEAST, USUAL = 200, 4_000
FEWEST_POINTS, USUAL_POINTS, MOST_POINTS = 2, 25, 500
SMALLEST, LARGEST = "smallest", "largest"


@dataclass(frozen=True)
class Compromise:
    """A point that was solved, and that no other beats in both figures."""

    values: dict[str, Any]  # by key
    figures: dict[str, float]

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        figures = {name: None if math.isnan(value) else value for name, value in self.figures.items()}
        return {"values": self.values, "figures": figures}


@dataclass(frozen=True, repr=False)
class Pareto:
    """The best compromises between two figures; printed as a table. SI units."""

    title: str  # of the scene
    goals: dict[str, str]  # by figure, whether it is to be "smallest" or "largest"
    points: list[Compromise]  # in rising order of the first figure; none where nothing that was tried keeps all limits
    units: dict[str, str]  # of keys and figures
    limits: list[Limit]
    solves: int
    refused: int  # of them
    warnings: list[Noted]  # on the solutions of these points
    notes: list[Note]

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        return {
            "goals": self.goals,
            "points": [point.table() for point in self.points],
            "units": self.units,
            "limits": [str(limit) for limit in self.limits],
            "solves": self.solves,
            "refused": self.refused,
            "warnings": [warning.table() for warning in self.warnings],
            **coded(self.notes),
        }

    def __str__(self) -> str:
        from ..notebook import search_tables

        return search_tables.pareto(self)

    def __repr__(self) -> str:
        goals = ", ".join(f"{which} {figure}" for figure, which in self.goals.items())
        return f"<Pareto: {len(self.points)} compromises of {goals}>"


def pareto(
    scene: SceneOrName,
    vary: Mapping[Any, Any],
    goals: Mapping[str, str],
    *,
    such_that: Sequence[str] = (),
    points: int = USUAL_POINTS,
    solves: int = USUAL,
    seed: int = 0,
    method: str | Method | None = None,
    workers: int | None = None,
    cancelled: Callable[[], bool] = never,
) -> Pareto:
    """The best compromises between two figures: of all that was solved, points that no other beats in both.

    `goals`: two figures with "smallest" or "largest", `{"peak_force": "smallest", "target_energy": "largest"}`.
    `vary`, `such_that` and the figures are those of `optimise`, which is also how the best of each figure alone is
    found, with a quarter of the solves each: these are the ends. Another half spreads a population along the whole
    front (GDE3), then goes for the middle of the widest gap, by the best of one figure within a bound on the other,
    until there are `points`, or no gap in which there is another. Only points that were solved are given, so a front
    that jumps keeps its gaps; figures that differ by less than 1e-9 of themselves count as the same. About `solves`
    solves, shared by `workers` processes, whose number changes nothing. Better ones may exist: other seeds tell.
    `cancelled()` true: those by then.

    Raises SceneError for keys, figures and bounds that do not exist; where every point is refused, with the reason of
    one. Cost: the solves, and one in full for each point.
    """
    scene = scene_of(scene)
    wanted = _goals(goals)
    limits = limits_of(such_that)
    points = validation.whole_number("points", points, FEWEST_POINTS, MOST_POINTS)
    solves = validation.whole_number("solves", solves, LEAST, MOST_SOLVES)
    seed = validation.whole_number("seed", seed, 0, 2**32 - 1)
    workers = crew_size(workers)
    axes = bounded_axes(scene, vary)
    keys = tuple(key for axis in axes for key in axis.keys)
    figures = tuple(dict.fromkeys([*wanted, *(limit.figure for limit in limits), "contacts"]))
    aims = [(place, which == LARGEST) for place, which in enumerate(wanted.values())]
    with closing(crew_of(workers)) as crew:
        search = Search(axes, Work(scene, keys, figures, method, False), limits, aims[0][1], crew, solves)
        front = Front(search, aims)
        names = front.run(points, seed, cancelled)
    _allow(search, wanted)
    units = {key: unit_of(scene, key) for key in keys} | {name: FIGURES[name][0] for name in figures}
    return _answer(search, scene, wanted, names, units, method)


def _goals(goals: Any) -> dict[str, str]:
    if not isinstance(goals, Mapping) or len(goals) != 2:
        raise SceneError("goals", goals, allowed("two-goals"))
    for figure, which in goals.items():
        validation.choice("goals", figure, FIGURES)
        validation.choice(f"goals.{figure}", which, (SMALLEST, LARGEST))
    return dict(goals)


def _allow(search: Search, goals: Mapping[str, str]) -> None:
    """Raises SceneError where every point is refused, or has none of a figure."""
    found = list(search.found.values())
    if any(not math.isnan(each[0] + each[1]) for each in found):
        return
    missing = next((figure for place, figure in enumerate(goals) if all(math.isnan(each[place]) for each in found)), "")
    if search.reason or not missing:
        raise SceneError("vary", ", ".join(search.work.keys), allowed("some-solved", reason=search.reason))
    raise SceneError("goals", missing, allowed("figure-there"))


def _answer(
    search: Search,
    scene: Scene,
    goals: dict[str, str],
    names: Sequence[str],
    units: dict[str, str],
    method: str | Method | None,
) -> Pareto:
    """These points in rising order of the first figure, and warnings on their solutions."""
    found = [
        Compromise(
            dict(zip(search.work.keys, search.rows[name], strict=True)),
            dict(zip(search.work.figures, search.found[name].tolist(), strict=True)),
        )
        for name in names
    ]
    found.sort(key=lambda point: [point.figures[figure] for figure in goals])
    grave = (Severity.WARNING, Severity.INVALID)
    solved = [solve(scene.replace(point.values), method) for point in found]
    warnings = noted([note for note in solution.notes if note.severity in grave] for solution in solved)
    refused = sum(math.isnan(figures[0]) for figures in search.found.values())
    said = {"points": len(found), "solves": len(search.found), "refused": refused}
    return Pareto(
        scene.title, goals, found, units, search.limits, len(search.found), refused, warnings,
        [Note("pareto-searched", Severity.REMARK, **said)],
    )  # fmt: skip
