"""What came of each of many scenes, as columns: the usual figures, or those that were asked for."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from .. import validation
from ..methods.base import Method
from ..solution.peaks import PEAKS
from ..solution.solution import Solution
from ..validation import SceneError, allowed


def _restitution(name: str) -> Callable[[Solution], float | None]:
    return lambda solution: solution.restitution[name]


def _error(name: str) -> Callable[[Solution], float | None]:
    return lambda solution: solution.diagnostics[name]


def _peak(name: str) -> Callable[[Solution], float | None]:
    return lambda solution: None if (peak := PEAKS[name].find(solution)) is None else abs(peak.value)


def _share(part: str) -> Callable[[Solution], float | None]:
    def of(solution: Solution) -> float | None:
        initial = solution.energy["initial"]
        return solution.energy[part] / initial if initial else None

    return of


USUAL: dict[str, tuple[str, Callable[[Solution], float | None]]] = {  # unit, and how a solution gives it
    "contacts": ("", lambda solution: len(solution.contacts)),
    "contact_time": ("s", lambda solution: solution.contact_time),
    "duration": ("s", lambda solution: solution.duration),
    "impulse": ("N s", lambda solution: solution.impulse),
    "peak_force": ("N", lambda solution: solution.peak_force),
    "peak_indentation": ("m", lambda solution: solution.peak_indentation),
    "residual_indentation": ("m", lambda solution: solution.residual_indentation),
    "impactor_velocity": ("m/s", lambda solution: solution.impactor_velocity),
    "target_velocity": ("m/s", lambda solution: solution.target_velocity),
    "newton": ("", _restitution("newton")),
    "poisson": ("", _restitution("poisson")),
    "newton_at_contact": ("", _restitution("newton_at_contact")),
    "dissipated": ("J", lambda solution: solution.energy["dissipated"]),
    "energy_error": ("", _error("energy_error")),
    "momentum_error": ("", _error("momentum_error")),
    "estimated_error": ("", _error("estimated_error")),
}
ENERGIES: dict[str, tuple[str, Callable[[Solution], float | None]]] = {  # at the end; free, but seldom wanted
    "impactor_energy": ("J", lambda solution: solution.energy["impactor"]),
    "target_energy": (
        "J",
        lambda solution: solution.energy["target_rigid"] + solution.energy["target_vibration"],
    ),
    "vibration_share": ("", _share("target_vibration")),
    "dissipated_share": ("", _share("dissipated")),
}
LOOKED_FOR = {f"peak_{name}": (asked.unit, _peak(name)) for name, asked in PEAKS.items()}  # each costs some ms
FIGURES = USUAL | ENERGIES | LOOKED_FOR


class _Column:
    """A figure of every scene, where it was asked for."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, figures: Any, owner: type | None = None) -> np.ndarray:
        if self.name not in figures.columns:
            raise SceneError("figures", self.name, allowed("asked-figures", names=list(figures.columns)))
        return figures.columns[self.name]


class Columns:
    """Figures of many scenes as `columns` by their names, all arrays (scenes,), NaN where there is none.

    `kinds`: their units; `varied`: the columns of values that the scenes differ by; `units`: of these values.
    """

    def __init__(
        self,
        columns: Mapping[str, np.ndarray],
        kinds: Mapping[str, str],
        varied: Mapping[str, np.ndarray],
        units: Mapping[str, str],
    ):
        self.columns, self.kinds, self.varied, self.units = dict(columns), dict(kinds), dict(varied), dict(units)

    def __len__(self) -> int:
        return next(iter(self.columns.values())).size

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {len(self)} scenes: {', '.join([*self.varied, *self.columns])}>"

    def grid(self) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]] | None:
        """The different values of each key in rising order, and each figure as an array with a dimension for each key.

        None where the scenes do not have each value of a key with each of the others', once.
        """
        axes, where = {}, np.zeros(len(self), int)
        for key, values in self.varied.items():
            axes[key], place = np.unique(values, return_inverse=True)
            where = where * axes[key].size + place
        sizes = [axis.size for axis in axes.values()]
        if not axes or math.prod(sizes) != len(self) or np.unique(where).size != len(self):
            return None
        order = np.argsort(where)
        return axes, {name: values[order].reshape(sizes) for name, values in self.columns.items()}

    def dataset(self) -> Any:
        """An xarray.Dataset with units. Where each key takes each of its values with each of the others', once, its
        dimensions are the keys; else `scene`, a number, and what the scenes differ by are coordinates.

        Raises ImportError without the extra `notebook`.
        """
        from ..notebook import datasets  # loads xarray, which nothing else here needs

        return datasets.figures(self, self.kinds)

    def plot(self, what: str | None = None) -> Any:
        """A HoloViews object: one figure, `impactor_velocity` or else the first by default, over the key that the
        scenes differ by; over two keys a map where they form a grid, coloured points where they do not; over the number
        of the scene where there are more keys, or none. Raises SceneError for another word."""
        from ..notebook import plots  # loads HoloViews, which nothing else here needs

        usual = "impactor_velocity" if "impactor_velocity" in self.columns else next(iter(self.columns))
        return plots.figures(self, what or usual, self.kinds)

    def __str__(self) -> str:
        from ..notebook import study_tables

        return study_tables.figures(self)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.figures_card(self)


class Figures(Columns):
    """What came of each of many scenes; all arrays (scenes,), NaN where a figure does not exist. See `Solution`.

    `columns`: those that there are, by name; one that was not asked for is refused with a SceneError when it is read.
    `varied`: the columns of values that the scenes differ by; `units`: of these values.
    """

    contacts = _Column()  # how many periods of contact
    contact_time = _Column()  # all of them together [s]
    duration = _Column()  # up to which it is solved [s]
    impulse = _Column()  # [N s]
    peak_force = _Column()  # [N]
    peak_indentation = _Column()  # [m]
    residual_indentation = _Column()  # [m]
    impactor_velocity = _Column()  # [m/s]
    target_velocity = _Column()  # [m/s]
    newton = _Column()  # restitution by centre-of-mass velocities
    poisson = _Column()  # by impulses
    newton_at_contact = _Column()  # by the touching surfaces
    dissipated = _Column()  # energy [J]
    energy_error = _Column()  # of the energy before
    momentum_error = _Column()  # of the impactor's momentum
    estimated_error = _Column()  # of the impactor's velocity, of the speed of approach
    # Where they are asked for: what the bodies hold at the end, and sizes of the largest values, see `Solution.peaks`.
    impactor_energy = _Column()  # [J]
    target_energy = _Column()  # as a whole and in its waves [J]
    vibration_share = _Column()  # of the energy before, that the target vibrates with
    dissipated_share = _Column()  # of the energy before
    peak_acceleration = _Column()  # of a rigid impactor [m/s2]
    peak_displacement = _Column()  # of the struck face of what is held [m]
    peak_deflection = _Column()  # of a held beam, anywhere [m]
    peak_stress = _Column()  # along rods, or in the outer fibre of a beam [Pa]
    peak_tension = _Column()  # along rods [Pa]
    peak_moment = _Column()  # of a beam [N m]
    peak_support_force = _Column()  # [N]

    def __init__(
        self,
        found: Mapping[str, Any],
        varied: Mapping[str, np.ndarray] | None = None,
        units: Mapping[str, str] | None = None,
    ):
        """Of these columns alone, None for what does not exist."""
        columns = {
            name: np.asarray(found[name], int if name == "contacts" else float) for name in FIGURES if name in found
        }
        super().__init__(columns, {name: FIGURES[name][0] for name in columns}, varied or {}, units or {})


def asked_for(figures: Sequence[str] | None) -> tuple[str, ...]:
    """All that cost nothing, or these. Raises SceneError for a word that is none."""
    if figures is None:
        return tuple(USUAL)
    if isinstance(figures, str) or not figures:
        raise SceneError("figures", figures, allowed("choice", options=list(FIGURES)))
    return tuple(dict.fromkeys(validation.choice("figures", name, FIGURES) for name in figures))


def figures_of(solution: Solution, names: Sequence[str]) -> list[float | None]:
    """Of one solution; nothing else of it is worked out."""
    return [FIGURES[name][1](solution) for name in names]


def only_for(method: Method, names: Sequence[str]) -> Method:
    """The method without what none of these figures needs; its solutions show nothing else."""
    return method.for_figures(not LOOKED_FOR.keys().isdisjoint(names), "estimated_error" in names)
