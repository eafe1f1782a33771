"""Turned round: for which values of a key of a scene a figure has the value that is wanted."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .. import validation
from ..scenes.library import SceneOrName, scene_of
from ..text.notes import Note, Severity, coded
from ..validation import SceneError
from .answers import Answers, middle_of, read_range, read_wanted
from .crossings import Crossings
from .figures import FIGURES
from .varied import spaced, unit_of

LEAST_SAMPLES, USUAL_SAMPLES, MOST_SAMPLES = 5, 60, 2_000

STEEP = 100.0  # times the relative change of the key: a figure that changes by more is not to be relied on


@dataclass(frozen=True)
class Root:
    """A value of the key for which the figure is as wanted."""

    value: float
    slope: float | None  # of the figure over the key, in the unit of the one over that of the other
    elasticity: float | None  # relative change of the figure for one of the key; None: the figure is wanted to be 0
    notes: list[Note]  # on its solution, those that are warnings or worse

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        return {"value": self.value, "slope": self.slope, "elasticity": self.elasticity, **coded(self.notes)}


@dataclass(frozen=True)
class Jump:
    """Where the figure passes over the value that is wanted and never has it, as when a contact is lost."""

    value: float  # of the key
    below: float  # the figure at smaller values of the key
    above: float  # at larger ones


@dataclass(frozen=True, repr=False)
class Sought:
    """All values of a key found for which a figure has the value wanted; printed as a table. SI units."""

    title: str  # of the scene
    method: str
    key: str
    unit: str
    low: float
    high: float
    figure: str
    figure_unit: str
    wanted: float
    roots: list[Root]
    stretches: list[tuple[float, float]]  # from and to where the figure has the value all along, as `contacts` does
    jumps: list[Jump]
    nearest: tuple[float, float] | None  # value of the key and figure, where no value has what is wanted
    samples: int
    refused: int  # of them
    notes: list[Note]

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        plain = {name: value for name, value in vars(self).items() if name not in ("title", "notes")}
        return plain | {
            "roots": [root.table() for root in self.roots],
            "stretches": [{"from": low, "to": high} for low, high in self.stretches],
            "jumps": [vars(jump) for jump in self.jumps],
            "nearest": self.nearest and dict(zip(("value", "found"), self.nearest, strict=True)),
            **coded(self.notes),
        }

    def __str__(self) -> str:
        from ..notebook import tables

        return tables.sought(self)

    def __repr__(self) -> str:
        found = f"{len(self.roots)} roots, {len(self.stretches)} stretches, {len(self.jumps)} jumps"
        return f"<Sought: {self.key} such that {self.figure} = {self.wanted:g}: {found}>"

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.sought_card(self)


def seek(
    scene: SceneOrName,
    key: str,
    between: tuple[float, float],
    such_that: Mapping[str, float],
    samples: int = USUAL_SAMPLES,
    spacing: str | None = None,
    workers: int | None = None,
) -> Sought:
    """All values of a key of the scene `between` two such that a figure has a value, as `{"peak_force": 3e3}` [N].

    The figure is any of `Figures`. The scene is solved for `samples` values first, evenly spaced or by a constant
    factor (`spacing` "linear" or "log"; without it "log" over a hundredfold range or more), and closer where the figure
    changes sides or comes near. A jump over the value is no solution and goes by itself. Values that the scene
    refuses leave holes, which notes count. What method `auto` chooses for the middle of the range solves all.
    Error: roots to 1e-9 of themselves, 1e-6 where the figure only touches the value, besides what the method makes of
    them; two roots between two samples are missed where the samples beside them do not show a dip.
    Cost: the samples, on `workers` threads (as many as there are processors), ten more solves for each root, forty for
    each jump or dip. Raises SceneError for a key, a figure or a range that is none, or if no value can be solved.
    """
    scene = scene_of(scene)
    figure, wanted = read_wanted(such_that)
    low, high = read_range("between", between)
    validation.whole_number("samples", samples, LEAST_SAMPLES, MOST_SAMPLES)
    try:
        values = spaced(low, high, samples, spacing).tolist()
    except SceneError as refused:
        raise SceneError(
            refused.key if refused.key == "spacing" else "between", refused.value, refused.reason
        ) from None
    answers = Answers(scene, (key,), figure)
    answers.settle((middle_of(low, high),))
    answers.solve([(value,) for value in values], workers)
    missing = {value: refused for (value,), refused in sorted(answers.missing.items())}
    found = Crossings(answers.at, wanted)
    found.search(values)
    some = bool(found.roots or found.stretches)
    if not some:
        found.look_closer(values)
    roots = [_root(answers, found, root, _spacing(values, root), (low, high)) for root in found.roots]
    return Sought(
        scene.title, answers.name, key, unit_of(scene, key), low, high, figure, FIGURES[figure][0], wanted,
        roots, found.stretches, [Jump(*jump) for jump in found.jumps],
        None if some or found.roots else _nearest(answers, wanted), len(values), len(missing),
        [*_notes(values, missing, answers), *_steep(roots)],
    )  # fmt: skip


def _nearest(answers: Answers, wanted: float) -> tuple[float, float]:
    (value,), figure = answers.nearest(wanted)
    return value, figure


def _spacing(values: Sequence[float], root: float) -> float:
    """The distance of the samples on both sides of a root."""
    after = min(max(sum(value <= root for value in values), 1), len(values) - 1)
    return values[after] - values[after - 1]


def _root(answers: Answers, found: Crossings, value: float, spacing: float, ends: tuple[float, float]) -> Root:
    slope = found.slope(value, spacing, *ends)
    elasticity = None if slope is None or found.wanted == 0.0 else slope * value / found.wanted
    return Root(value, slope, elasticity, answers.warnings((value,)))


def _steep(roots: Sequence[Root]) -> list[Note]:
    """That some values are ill-conditioned."""
    steep = sum(root.elasticity is not None and abs(root.elasticity) > STEEP for root in roots)
    return [Note("sought-where-steep", Severity.WARNING, steep=steep, times=STEEP)] if steep else []


def _notes(values: Sequence[float], missing: Mapping[float, SceneError], answers: Answers) -> list[Note]:
    """How finely it was sought, what was refused, and what `auto` chose."""
    count, by_factor = len(values), not math.isclose(values[1] - values[0], values[-1] - values[-2], rel_tol=1e-6)
    step = values[1] / values[0] if by_factor else values[1] - values[0]
    unit = unit_of(answers.scene, *answers.keys) or "none"
    notes = [Note("sought-among-samples", Severity.REMARK, samples=count, by_factor=by_factor, step=step, unit=unit)]
    if missing:
        value, refused = next(iter(missing.items()))
        said = {"refused": len(missing), "samples": count, "key": answers.keys[0], "value": value}
        said |= answers.why(refused)
        notes.append(Note("sought-with-holes", Severity.WARNING, **said))
    if answers.chosen is not None:
        said = {"method": answers.chosen.NAME, "key": answers.keys[0], "value": answers.chosen_at[0]}
        notes.append(Note("sought-by-one-method", Severity.REMARK, **said))
    return notes
