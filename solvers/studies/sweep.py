"""Many solves at once: scenes, or one key of a scene over a range."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .. import validation
from ..bodies import Rod
from ..methods import Waves
from ..methods.base import AFTERGLOW, Method
from ..methods.grazing import one_front
from ..numerics.processors import all_processors
from ..numerics.waves import rigid as rigid_waves
from ..numerics.waves import rigid_figures
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.solution import Solution
from ..solve import solve
from ..validation import SceneError, allowed
from .figures import FIGURES, USUAL, Figures, asked_for, figures_of
from .mass_ratios import TERMS
from .varied import takes_whole_numbers, unit_of, with_values

WIDE = 100.0  # times the lowest value: ranges from there on are spaced by a factor
MOST_VALUES = 2_000
MOST_QUICK = 1_000_000  # of impacts of a mass on a rod
CHUNK = 500  # of them that a thread takes at once
ROOM = (64, 1_000)  # pieces of a history, tried in turn


def spaced(low: float, high: float, count: int = 21, spacing: str | None = None) -> np.ndarray:
    """`count` values from `low` to `high`; evenly, or by a constant factor if `spacing` is "log".

    Without `spacing`: "log" where the range is a hundredfold or more.
    """
    validation.whole_number("count", count, 2, MOST_QUICK)
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise SceneError("range", (low, high), allowed("range"))
    if spacing is None:
        spacing = "log" if low > 0.0 and high / low >= WIDE else "linear"
    validation.choice("spacing", spacing, ("linear", "log"))
    if spacing == "log":
        if low <= 0.0:
            raise SceneError("range", low, allowed("above-zero"))
        return np.geomspace(low, high, count)
    return np.linspace(low, high, count)


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
        return _varied(scene_of(scenes), columns or {}, method, workers, names)
    if columns is not None:
        raise SceneError("columns", sorted(columns), allowed("no-columns"))
    validation.whole_number("number of scenes", len(scenes), 1, MOST_QUICK)
    return Figures(_solved([scene_of(scene) for scene in scenes], method, workers, names))


def _varied(
    scene: Scene,
    columns: Mapping[str, Sequence[float] | np.ndarray],
    method: str | Method | None,
    workers: int | None,
    names: Sequence[str],
) -> Figures:
    """Of one scene with columns of values."""
    arrays = {key: _numbers(key, values) for key, values in columns.items()}
    _check_columns(arrays)
    units = {key: unit_of(scene, key) for key in arrays}
    if quick_columns(scene, arrays, method, names):
        bodies = _bodies_of_columns(scene, arrays)
        found = _impacts_on_rods(bodies, lambda row: with_values(scene, _row_of(arrays, row)), workers, names)
        return Figures(found, arrays, units)
    rows = zip(*(values.tolist() for values in arrays.values()), strict=True)
    scenes = [with_values(scene, dict(zip(arrays, row, strict=True))) for row in rows]
    return Figures(_solved(scenes, method, workers, names), arrays, units)


def _solved(
    scenes: list[Scene], method: str | Method | None, workers: int | None, names: Sequence[str]
) -> dict[str, Any]:
    """Columns of figures by their names."""
    if any(scene.normal is not None for scene in scenes):
        raise SceneError("scenes", "bodies in space", allowed("scenes-on-axis"))
    if all(_quick(scene, method, names) for scene in scenes):
        return _impacts_on_rods(_bodies_of(scenes), lambda row: scenes[row], workers, names)
    with all_processors(workers) as pool:
        rows = list(pool.map(lambda scene: figures_of(solve(scene, method), names), scenes))
    return dict(zip(names, zip(*rows, strict=True), strict=True))


def _quick(scene: Scene, method: str | Method | None, figures: Sequence[str]) -> bool:
    """Whether the exact waves of a rigid mass on one rod are wanted, until the bodies part for good, and no fields."""
    if not USUAL.keys() >= set(figures):
        return False
    name = scene.method.get("name", Waves.NAME) if method is None else method
    options = scene.method.keys() - {"name"} if method is None else ()
    return name in ("waves", Waves()) and not options and one_front(scene)


def quick_columns(scene: Scene, keys: Iterable[str], method: str | Method | None, figures: Sequence[str]) -> bool:
    """Whether scenes that differ by these keys are not looked at one by one."""
    return _quick(scene, method, figures) and set(keys) <= QUICK_KEYS and scene.impactor.kind == "mass"


def _numbers(key: str, values: Any) -> np.ndarray:
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):  # words, or rows of unequal length
        raise SceneError(key, values, allowed("list", low=1, high=MOST_QUICK, of="numbers")) from None


def _check_columns(columns: Mapping[str, np.ndarray]) -> None:
    for key, values in columns.items():
        first = next(iter(columns))
        if values.ndim != 1 or not 1 <= values.size <= MOST_QUICK:
            reason = allowed("list", low=1, high=MOST_QUICK, of="numbers")
            raise SceneError(key, f"an array of shape {values.shape}", reason)
        if values.size != columns[first].size:
            reason = allowed("as-many-values", key=first, count=columns[first].size)
            raise SceneError(key, f"{values.size} values", reason)
    if not columns:
        raise SceneError("columns", "nothing", allowed("some-columns"))


# Keys of scenes that follow from no other, by what they change: mass and speed of the impactor, length and area.
QUICK_KEYS = {"impactor.mass", "impactor.velocity", "target.length", "target.area"}


def _bodies_of_columns(scene: Scene, columns: Mapping[str, np.ndarray]) -> np.ndarray:
    """As `_bodies_of`. Every extreme is read as a scene of its own: what lies between is allowed as well."""
    rod, size = scene.target.known_as(Rod), next(iter(columns.values())).size
    given = {"impactor.mass": scene.impactor.mass, "impactor.velocity": scene.impactor.velocity}
    given |= {"target.length": rod.length, "target.area": rod.area}
    mass, speed, length, area = (columns.get(key, np.full(size, value)) for key, value in given.items())
    rod_mass = rod.material.density * area * length
    with np.errstate(divide="ignore", invalid="ignore"):
        looked_at = (*columns.values(), rod_mass / mass)
    bad = [np.flatnonzero(~np.isfinite(values))[:1] for values in looked_at]
    rows = {int(row) for values in looked_at for row in (np.nanargmin(values), np.nanargmax(values))}
    for row in sorted(rows.union(*(found.tolist() for found in bad))):
        with_values(scene, _row_of(columns, row))
    held = np.full(size, 1.0 if rod.fixed else -1.0)
    return np.stack((mass, speed, rod_mass, area * (rod.impedance / rod.area), 2.0 * length / rod.wave_speed, held))


def _row_of(columns: Mapping[str, np.ndarray], row: int) -> dict[str, float]:
    return {key: float(values[row]) for key, values in columns.items()}


def _bodies_of(scenes: Sequence[Scene]) -> np.ndarray:
    """(6, scenes): mass and speed of the impactor; mass, impedance, round trip time and reflection of the rod."""
    found = np.empty((6, len(scenes)))
    for i, scene in enumerate(scenes):
        rod, striker = scene.target.known_as(Rod), scene.impactor
        reflection = 1.0 if rod.fixed else -1.0
        found[:, i] = striker.mass, striker.velocity, rod.mass, rod.impedance, rod.round_trip_time, reflection
    return found


def _impacts_on_rods(
    bodies: np.ndarray, scene_of: Callable[[int], Scene], workers: int | None, names: Sequence[str]
) -> dict[str, np.ndarray]:
    """Of `bodies` as `_bodies_of` gives them; `scene_of` a row: for impacts so long that each is solved alone."""
    mass, speed, rod_mass, impedance, trip, reflection = bodies
    beta, found = rod_mass / mass, np.empty((mass.size, rigid_figures.COLUMNS))
    with all_processors(workers) as pool:
        parts = [slice(start, start + CHUNK) for start in range(0, mass.size, CHUNK)]
        list(pool.map(lambda part: _strike_all(beta[part], reflection[part], found[part]), parts))
    kernel = found.T
    final, force = speed * kernel[rigid_figures.FINAL], impedance * speed
    impulse = force * trip * kernel[rigid_figures.IMPULSE]
    target = np.where(reflection > 0.0, 0.0, speed * kernel[rigid_figures.TARGET])
    lost, initial = mass * (speed - final), 0.5 * mass * speed**2
    energy = 0.5 * mass * final**2 + force * speed * trip * kernel[rigid_figures.ROD]
    off = np.where(reflection > 0.0, 0.0, rod_mass * target - lost), lost - impulse
    momentum = np.where(np.abs(off[0]) > np.abs(off[1]), *off) / (mass * speed)
    compressing = np.where(kernel[rigid_figures.COMPRESSING] > 0.0, kernel[rigid_figures.COMPRESSING], np.nan)
    energy_error = energy / initial - 1.0
    nothing = np.full(mass.size, np.nan)  # rigid faces do not give way
    figures = {
        "contacts": kernel[rigid_figures.CONTACTS],
        "contact_time": trip * kernel[rigid_figures.TOUCHING],
        "duration": trip * (kernel[rigid_figures.PARTING] + AFTERGLOW),
        "impulse": impulse,
        "peak_force": force * kernel[rigid_figures.PEAK],
        "peak_indentation": nothing,
        "residual_indentation": nothing.copy(),
        "impactor_velocity": final,
        "target_velocity": target,
        "newton": (target - final) / speed,
        "poisson": kernel[rigid_figures.IMPULSE] / compressing - 1.0,
        "newton_at_contact": kernel[rigid_figures.FACE] - kernel[rigid_figures.FINAL],
        "dissipated": np.zeros(mass.size),
        "energy_error": energy_error,
        "momentum_error": momentum,
        "estimated_error": np.maximum(np.abs(energy_error) + np.abs(momentum), 1e-15),
    }
    figures = {name: figures[name] for name in names}
    for row in np.flatnonzero(kernel[rigid_figures.FOLLOWED] == 0.0).tolist():
        for name, value in zip(names, figures_of(solve(scene_of(row), Waves()), names), strict=True):
            figures[name][row] = np.nan if value is None else value
    return figures


def _strike_all(beta: np.ndarray, reflection: np.ndarray, out: np.ndarray) -> None:
    left = np.arange(beta.size)
    for pieces in ROOM:
        found = np.empty((left.size, rigid_figures.COLUMNS))
        sent = rigid_waves.Pieces.of(pieces, TERMS, pieces)
        rigid_figures.strike_all(beta[left], reflection[left], AFTERGLOW, sent, found)
        out[left] = found
        left = left[found[:, rigid_figures.FOLLOWED] == 0.0]


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

    def plot(self, what: str = "impactor_velocity") -> Any:
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
    quick = quick_columns(scene, [key], None, more)
    validation.whole_number("number of values", len(values), 1, MOST_QUICK if quick else MOST_VALUES)
    values = [validation.number(key, value, -math.inf, math.inf) for value in _numbers(key, values).tolist()]
    if quick:
        found = solve_many(scene, {key: values}, workers=workers)
        return Sweep(key, _rows(values, found, more), found.units[key], more)
    if takes_whole_numbers(scene, key, values[0]):
        values = list(dict.fromkeys(round(value) for value in values))
    scenes = [with_values(scene, {key: value}) for value in values]  # all are read before any is solved
    first = _row(values[0], solve(scenes[0]), more)  # alone: if kernels must be compiled, then once
    rows = Sweep(key, [first], unit_of(scene, key), more)

    def row(value: float, changed: Scene) -> dict[str, Any] | None:
        return None if cancel is not None and cancel() else _row(value, solve(changed), more)

    with all_processors(workers) as pool:
        rows += filter(None, pool.map(row, values[1:], scenes[1:]))
    return rows


def _rows(values: list[float], found: Figures, more: Sequence[str]) -> list[dict[str, Any]]:
    """As `_row` gives them."""
    known = {
        name: np.where(np.isnan(column), np.array(None), column).tolist() for name, column in found.columns.items()
    }
    plain = ("contacts", "impulse", "peak_force", "contact_time", "peak_indentation")
    return [
        {
            "value": value,
            **{name: known[name][row] for name in plain},
            "impactor": {"final_velocity": known["impactor_velocity"][row]},
            "restitution": {name: known[name][row] for name in ("newton", "poisson", "newton_at_contact")},
            **{name: known[name][row] for name in ("energy_error", "estimated_error", *more)},
        }
        for row, value in enumerate(values)
    ]


def _row(value: float, solution: Solution, more: Sequence[str]) -> dict[str, Any]:
    found: Mapping[str, Any] = solution.diagnostics
    velocity = solution.impactor_velocity
    return {
        "value": value,
        "contacts": len(solution.contacts),
        "impulse": solution.impulse,
        "peak_force": solution.peak_force,
        "contact_time": solution.contact_time,
        "peak_indentation": solution.peak_indentation,
        "impactor": {"final_velocity": list(velocity) if isinstance(velocity, tuple) else velocity},
        "restitution": solution.restitution,
        "energy_error": found["energy_error"],
        "estimated_error": found["estimated_error"],
        **dict(zip(more, figures_of(solution, more), strict=True)),
    }
