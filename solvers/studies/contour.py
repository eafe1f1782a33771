"""Turned round over two keys: the lines on which a figure of a scene has the value that is wanted."""

from collections.abc import Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from .. import validation
from ..numerics.processors import all_processors
from ..scenes.library import SceneOrName, scene_of
from ..text.notes import Note, Severity, coded
from ..validation import SceneError, allowed
from .answers import Answers, middle_of, read_range, read_wanted
from .figures import FIGURES
from .noted import Noted, noted
from .squares import Line, Squares
from .study.study import crew_size
from .varied import spaced, unit_of

LEAST_SAMPLES, USUAL_SAMPLES, MOST_SAMPLES = 3, 25, 500  # for each key


@dataclass(frozen=True, repr=False)
class Contour:
    """Lines over two keys on which a figure has the value wanted; printed as a table. SI units."""

    title: str  # of the scene
    method: str
    between: dict[str, tuple[float, float]]  # by key, the first one across
    units: dict[str, str]  # by key
    figure: str
    figure_unit: str
    wanted: float
    lines: list[Line]  # each vertex solved
    jumps: list[Line]  # where the figure passes over the value and never has it, as where a contact is lost
    nearest: tuple[tuple[float, float], float] | None  # values of the keys and figure, where there is no line
    samples: tuple[int, int]
    refused: int  # of the samples
    solves: int
    warnings: list[Noted]  # on the solutions at vertices of lines
    notes: list[Note]

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        kept = ("method", "figure", "figure_unit", "wanted", "refused", "solves")
        return {name: getattr(self, name) for name in kept} | {
            "keys": [
                {"key": key, "unit": self.units[key], "low": low, "high": high, "samples": count}
                for (key, (low, high)), count in zip(self.between.items(), self.samples, strict=True)
            ],
            "lines": [{"vertices": [*map(list, line.vertices)], "closed": line.closed} for line in self.lines],
            "jumps": [
                {"vertices": [*map(list, line.vertices)], "closed": line.closed, "sides": [*map(list, line.sides)]}
                for line in self.jumps
            ],
            "nearest": self.nearest and {"values": list(self.nearest[0]), "found": self.nearest[1]},
            "warnings": [warning.table() for warning in self.warnings],
            **coded(self.notes),
        }

    def plot(self) -> Any:
        """A HoloViews object: the lines, and the jumps in red, over both keys. Raises ImportError without HoloViews."""
        from ..notebook import contour_plots  # loads HoloViews, which nothing else here needs

        return contour_plots.contour(self)

    def __str__(self) -> str:
        from ..notebook import contour_tables

        return contour_tables.contour(self)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.contour_card(self)

    def __repr__(self) -> str:
        found = f"{len(self.lines)} lines, {len(self.jumps)} jumps"
        return f"<Contour: {' and '.join(self.between)} such that {self.figure} = {self.wanted:g}: {found}>"


def contour(
    scene: SceneOrName,
    between: Mapping[str, tuple[float, float]],
    such_that: Mapping[str, float],
    samples: int | tuple[int, int] = USUAL_SAMPLES,
    spacing: str | tuple[str | None, str | None] | None = None,
    workers: int | None = None,
) -> Contour:
    """The lines over two keys of the scene on which a figure has a value, as `{"peak_force": 3e3}` [N].

    `between`: by key its ends, `{"contact.stiffness": (1e5, 1e7), "impactor.velocity": (1, 4)}`. The figure is any of
    `Figures`. The scene is solved on a grid of `samples` for each key, evenly spaced or by a constant factor (`spacing`
    "linear" or "log"; without it "log" over a hundredfold range or more), one for both keys or one each. Between two
    samples on both sides of the value the root is solved for as `seek` does; cells join the roots at their sides
    (marching squares), saddles as the side of their solved middle says. Where the figure jumps over the value there is
    no line, and the jumps are listed apart. Samples that the scene refuses end a line. What method `auto` chooses for
    the middle of both ranges solves all.
    Error: vertices to 1e-9 of themselves, besides what the method makes of them; nothing is known between two of them.
    Missed: what lies within a cell, or crosses one of its sides twice.
    Cost: the samples, ten more solves for each vertex, one for each piece between two; on `workers` threads (as many
    as there are processors). Raises SceneError for keys, a figure or ranges that are none, or if no sample is solved.
    """
    scene = scene_of(scene)
    figure, wanted = read_wanted(such_that)
    if not isinstance(between, Mapping) or len(between) != 2 or not all(isinstance(key, str) for key in between):
        raise SceneError("between", between, allowed("two-keys"))
    ranges = {key: read_range(f"between.{key}", each) for key, each in between.items()}
    counts, spacings = (each if isinstance(each, tuple) else (each, each) for each in (samples, spacing))
    for name, given in (("samples", counts), ("spacing", spacings)):
        if len(given) != 2:
            raise SceneError(name, given, allowed("one-for-each-key"))
    workers = crew_size(workers)
    xs, ys = (_spaced(*each) for each in zip(ranges.items(), counts, spacings, strict=True))
    answers = Answers(scene, tuple(ranges), figure)
    answers.settle(tuple(middle_of(*ends) for ends in ranges.values()))
    answers.solve([(x, y) for y in ys for x in xs], workers)
    missing = dict(sorted(answers.missing.items()))
    with _threads(workers) as side_by_side:
        squares = Squares(answers.at, answers.kind, wanted, xs, ys, side_by_side)
        lines, jumps = squares.search()
        vertices = [vertex for line in lines for vertex in line.vertices]
        warnings = noted(side_by_side(answers.warnings, vertices))
    nearest = None if lines else answers.nearest(wanted)
    return Contour(
        scene.title, answers.name, ranges, {key: unit_of(scene, key) for key in ranges}, figure, FIGURES[figure][0],
        wanted, lines, jumps, nearest and ((nearest[0][0], nearest[0][1]), nearest[1]), (len(xs), len(ys)),
        len(missing), len(answers.known), warnings, _notes(answers, missing, squares),
    )  # fmt: skip


@contextmanager
def _threads(workers: int | None) -> Any:
    """What `map` does, on threads."""
    with all_processors(workers) as pool:
        yield pool.map


def _spaced(named: tuple[str, tuple[float, float]], count: Any, spacing: Any) -> list[float]:
    key, (low, high) = named
    validation.whole_number("samples", count, LEAST_SAMPLES, MOST_SAMPLES)
    try:
        return spaced(low, high, count, spacing).tolist()
    except SceneError as refused:
        name = "spacing" if refused.key == "spacing" else f"between.{key}"
        raise SceneError(name, refused.value, refused.reason) from None


def _notes(answers: Answers, missing: Mapping[tuple[float, ...], SceneError], squares: Squares) -> list[Note]:
    """How finely it was sought, what was refused, and what `auto` chose."""
    count, areas = len(squares.xs) * len(squares.ys), squares.areas()
    notes = [Note("contour-on-grid", Severity.REMARK, across=len(squares.xs), up=len(squares.ys))]
    if areas:
        notes.append(Note("contour-over-areas", Severity.WARNING, cells=areas))
    if missing:
        point, refused = next(iter(missing.items()))
        said = {"refused": len(missing), "samples": count, **_at(answers.keys, point)}
        notes.append(Note("contour-with-holes", Severity.WARNING, **said, **answers.why(refused)))
    if answers.chosen is not None:
        said = {"method": answers.chosen.NAME, **_at(answers.keys, answers.chosen_at)}
        notes.append(Note("contour-by-one-method", Severity.REMARK, **said))
    return notes


def _at(keys: Sequence[str], point: Sequence[float]) -> dict[str, Any]:
    """For a note."""
    return {"one": keys[0], "first": point[0], "other": keys[1], "second": point[1]}
