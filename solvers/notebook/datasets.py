"""A solution as labelled arrays.

>>> import solvers
>>> data = solvers.solve(solvers.load("fixed-rod")).dataset()
>>> data.stress.dims, data.stress.units
(('time', 'x'), 'Pa')
>>> float(data.impulse[-1]) == float(data.impulse.max())
True
>>> [str(part) for part in data.energy_part.values][:2]
['impactor', 'target_rigid']
"""

import json
from typing import Any

import numpy as np

from ..provenance import version
from .figures import PARTS, Figure, fields_of, histories_of, origin, reach

try:
    from xarray import Dataset
except ImportError as missing:
    raise ImportError("dataset() needs xarray: pip install 'strikewave[notebook]'") from missing

INSTANTS, PLACES = 401, 201  # enough to draw, and some 600 kB a field


def dataset(solution: Any, time: Any = None, x: Any = None) -> Dataset:
    """See `Solution.dataset`."""
    motion, scene = solution.known_motion, solution.scene
    first, last = reach(solution)
    time = np.linspace(0.0, solution.duration, INSTANTS) if time is None else np.asarray(time, float)
    if x is None:
        x = np.linspace(first, last, PLACES) if last > first else np.zeros(1)
    x = np.asarray(x, float)
    found = {name: _variable(("time",), figure, motion, time) for name, figure in histories_of(scene).items()}
    energies = motion.energies(time)
    values = np.stack(list(energies.values()))
    found["energy"] = (("energy_part", "time"), values, {"units": "J", "long_name": "energy"})
    found |= {name: _variable(("time", "x"), figure, motion, time, x) for name, figure in fields_of(scene).items()}
    coordinates = {
        "time": ("time", time, {"units": "s", "long_name": "time since first touch"}),
        "x": ("x", x, {"units": "m", "long_name": f"place from {origin(scene)}"}),
        "energy_part": ("energy_part", list(energies), {"long_name": "; ".join(f"{k}: {PARTS[k]}" for k in energies)}),
    }
    return Dataset(found, coordinates, _attributes(solution))


def _variable(dimensions: tuple[str, ...], figure: Figure, motion: Any, *at: np.ndarray) -> tuple[Any, ...]:
    return dimensions, figure.of(motion, *at), {"units": figure.unit, "long_name": figure.long_name}


def _attributes(solution: Any) -> dict[str, str]:
    """Text alone, so that every file format takes it; tables as JSON."""
    scene = solution.scene
    return {
        "title": scene.title,
        "source": scene.source,
        "version": f"Strikewave {version()}",
        "conventions": f"SI units; time zero at first touch; x from {origin(scene)}; compression positive",
        "method": json.dumps(solution.method),
        "scene": json.dumps(scene.table()),
        "diagnostics": json.dumps(solution.diagnostics),
        "notes": "\n".join(map(str, solution.notes)),
    }


def figures(found: Any, units: Any) -> Dataset:
    """See `Figures.dataset`; `units` by figure."""
    about = {name: {"units": units[name], "long_name": name.replace("_", " ")} for name in found.columns}
    version_of = {"version": f"Strikewave {version()}"}
    filled = found.grid()
    if filled is not None:
        axes, arrays = filled
        places = {key: (key, values, {"units": found.units.get(key, "")}) for key, values in axes.items()}
        columns = {name: (tuple(axes), values, about[name]) for name, values in arrays.items()}
        return Dataset(columns, places, version_of)
    scene = {"scene": ("scene", np.arange(len(found)), {"long_name": "number of the scene"})}
    varied = {key: ("scene", values, {"units": found.units.get(key, "")}) for key, values in found.varied.items()}
    columns = {name: ("scene", values, about[name]) for name, values in found.columns.items()}
    return Dataset(columns, scene | varied, version_of)
