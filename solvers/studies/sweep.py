"""Many solves at once: scenes, or one key of a scene over a range."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .. import validation
from ..methods.base import Method, never
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..validation import SceneError, allowed
from .figures import FIGURES, Figures, asked_for
from .study import rigid_bulk
from .study.work import each
from .varied import MOST, columns_of, numbers_of, spaced, takes_whole_numbers, unit_of, with_values

__all__ = ["Sweep", "solve_many", "spaced", "sweep"]

MOST_VALUES = 2_000  # that are solved one by one
PLAIN = ("contacts", "impulse", "peak_force", "contact_time", "peak_indentation")
RESTITUTION = ("newton", "poisson", "newton_at_contact")
ERRORS = ("energy_error", "estimated_error")
ROW = (*PLAIN, "impactor_velocity", *RESTITUTION, *ERRORS)  # figures of a row


def solve_many(
    scenes: Sequence[SceneOrName] | SceneOrName,
    columns: Mapping[str, Sequence[float] | np.ndarray] | None = None,
    method: str | Method | None = None,
    workers: int | None = None,
    figures: Sequence[str] | None = None,
) -> Figures:
    """The figures of many scenes, or of one with `columns` of values for some of its keys, all of one length; only
    those named in `figures`, where it is given, and what is not asked for is not worked out.

    Where a rigid mass strikes one uniform rod, and exact waves solve it, no scene is looked at twice: 100 000 of them
    take a second or two. All others are solved one by one, and all of which largest values of fields are asked for
    (`peak_stress` and others, which take some ms each). Kernels run on `workers` threads (as many as there are
    processors). Raises SceneError for columns that do not fit together, or for a value that is not allowed;
    SceneNotSupported as `solve` does. Bodies in space have no such figures.
    """
    names = asked_for(figures)
    if isinstance(scenes, Scene | str | Path):
        scene, arrays = scene_of(scenes), columns_of(columns or {})
        units = {key: unit_of(scene, key) for key in arrays}
        if rigid_bulk.columns_fit(scene, arrays, method, names):
            return Figures(rigid_bulk.of_columns(scene, arrays, names, workers), arrays, units)
        rows = zip(*(values.tolist() for values in arrays.values()), strict=True)
        changed = [with_values(scene, dict(zip(arrays, row, strict=True))) for row in rows]
        return Figures(_solved(changed, method, workers, names), arrays, units)
    if columns is not None:
        raise SceneError("columns", sorted(columns), allowed("no-columns"))
    validation.whole_number("number of scenes", len(scenes), 1, MOST)
    return Figures(_solved([scene_of(scene) for scene in scenes], method, workers, names))


def _solved(
    scenes: list[Scene], method: str | Method | None, workers: int | None, names: Sequence[str]
) -> dict[str, Any]:
    """Columns of figures by their names."""
    if any(scene.normal is not None for scene in scenes):
        raise SceneError("scenes", "bodies in space", allowed("scenes-on-axis"))
    if all(rigid_bulk.fits(scene, method, names) for scene in scenes):
        return rigid_bulk.of_scenes(scenes, names, workers)
    return dict(zip(names, zip(*filter(None, each(scenes, method, names, workers)), strict=True), strict=True))


class Sweep(list[dict[str, Any]]):
    """The rows of a sweep, with the key that was varied and its unit; printed as a table. `asked`: the figures that
    were named, with their units."""

    def __init__(self, key: str, rows: Iterable[dict[str, Any]] = (), unit: str = "", asked: Sequence[str] = ()):
        super().__init__(rows)
        self.key, self.unit = key, unit
        self.asked = {name: FIGURES[name][0] for name in asked}

    def figures(self) -> Figures:
        """The same as columns. Raises SceneError for bodies in space, whose velocities have three components."""
        if any(isinstance(row["impactor"]["final_velocity"], list) for row in self):
            raise SceneError("scenes", "bodies in space", allowed("scenes-on-axis"))
        plain = [row | row["restitution"] | {"impactor_velocity": row["impactor"]["final_velocity"]} for row in self]
        found = {name: [row[name] for row in plain] for name in (plain[0] if plain else ()) if name in FIGURES}
        return Figures(found, {self.key: np.array([row["value"] for row in self], float)}, {self.key: self.unit})

    def dataset(self) -> Any:
        """As `Figures.dataset`: an xarray.Dataset over the key. Raises what `figures` does."""
        return self.figures().dataset()

    def plot(self, what: str | None = None) -> Any:
        """As `Figures.plot`: one figure over the key. Raises what `figures` does."""
        return self.figures().plot(what)

    def __str__(self) -> str:
        from ..notebook import tables

        return tables.sweep(self.key, self, self.asked)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.sweep_card(self)


def sweep(
    scene: SceneOrName,
    key: str,
    values: Sequence[float] | np.ndarray,
    workers: int | None = None,
    cancel: Callable[[], bool] | None = None,
    figures: Sequence[str] | None = None,
) -> Sweep:
    """The scene solved with each of the values for one of its keys, by the method it names.

    One row each: value, number of contacts, impulse [N s], peak_force [N], contact_time [s], peak_indentation [m],
    impactor velocity [m/s], restitution, energy_error, estimated_error; None where undefined; besides them those
    `figures` of `Figures` that are named, as "peak_stress". Keys that take whole numbers get rounded ones, once each.
    `cancel()` true: what has not begun is left out. Raises SceneError with the first value that cannot be solved.
    Cost: that of `solve_many` where it is quick; else the solves, shared by `workers` threads (as many as there are
    processors), and at most 2000 of them; kernels run side by side.
    """
    scene = scene_of(scene)
    more = () if figures is None else asked_for(figures)
    names = tuple(dict.fromkeys((*ROW, *more)))
    quick = rigid_bulk.columns_fit(scene, [key], None, more)
    validation.whole_number("number of values", len(values), 1, MOST if quick else MOST_VALUES)
    values = [validation.number(key, value, -math.inf, math.inf) for value in numbers_of(key, values).tolist()]
    if quick:
        found = Figures(rigid_bulk.of_columns(scene, {key: np.array(values)}, names, workers)).columns
        existing = (np.where(np.isnan(found[name]), np.array(None), found[name]).tolist() for name in names)
        solved: Iterable[Sequence[Any] | None] = zip(*existing, strict=True)
    else:
        if takes_whole_numbers(scene, key, values[0]):
            values = list(dict.fromkeys(round(value) for value in values))
        scenes = [with_values(scene, {key: value}) for value in values]  # all are read before any is solved
        solved = each(scenes, None, names, workers, cancel or never)
    rows = [
        _row(value, dict(zip(names, row, strict=True)), more)
        for value, row in zip(values, solved, strict=True)
        if row is not None
    ]
    return Sweep(key, rows, unit_of(scene, key), more)


def _row(value: float, found: Mapping[str, Any], more: Sequence[str]) -> dict[str, Any]:
    velocity = found["impactor_velocity"]
    return {
        "value": value,
        **{name: found[name] for name in PLAIN},
        "impactor": {"final_velocity": list(velocity) if isinstance(velocity, tuple) else velocity},
        "restitution": {name: found[name] for name in RESTITUTION},
        **{name: found[name] for name in (*ERRORS, *more)},
    }
