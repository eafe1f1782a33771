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
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..provenance import version
from .figures import BANDS, PARTS, Figure, fields_of, histories_of, origin, reach
from .regions import NOT_SOLVED, WORDS, Blocks, add_arrays

try:
    import pandas
    import xarray
    from xarray import Dataset
except ImportError as missing:
    raise ImportError("dataset() needs xarray: pip install 'strikewave[notebook]'") from missing

HELD = 1_000_000  # points that a study in zarr may have to be read at once
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
    filled = found.grid()
    if filled is not None:
        axes, arrays = filled
        places = {key: (key, values, {"units": found.units.get(key, "")}) for key, values in axes.items()}
        columns = {name: (tuple(axes), values, about[name]) for name, values in arrays.items()}
        return Dataset(columns, places, {"version": f"Strikewave {version()}"})
    scene = {"scene": ("scene", np.arange(len(found)), {"long_name": "number of the scene"})}
    varied = {key: ("scene", values, {"units": found.units.get(key, "")}) for key, values in found.varied.items()}
    columns = {name: ("scene", values, about[name]) for name, values in found.columns.items()}
    return Dataset(columns, scene | varied, {"version": f"Strikewave {version()}"})


def ensemble(found: Any, units: Any) -> Dataset:
    """See `Ensemble.dataset`; `units` by figure, each with what it is measured by."""
    columns: dict[str, Any] = {
        name: ("change", getattr(found, name), {"units": unit, "long_name": name.replace("_", " ")})
        for name, (unit, _) in units.items()
    }
    edges = list(vars(found.force))
    for name, figure in BANDS.items():
        about = {"units": figure.unit, "long_name": figure.long_name}
        band = np.stack([getattr(getattr(found, name), edge) for edge in edges])
        columns[name] = (("band", "time"), band, about)
    places = {
        "change": ("change", found.perturbations, {"units": "", "long_name": f"relative change of {found.key}"}),
        "band": ("band", edges, {"long_name": "low, high: a twentieth of the runs is below, above"}),
        "time": ("time", found.time, {"units": "s", "long_name": "time since first touch"}),
    }
    about = {"key": found.key, "method": json.dumps(found.method), "summary": str(found.summary)}
    notes = {"notes": "\n".join(map(str, found.notes))}
    return Dataset(columns, places, _about(found.title) | about | notes)


def convergence(found: Any) -> Dataset:
    """See `Convergence.dataset`."""
    columns = {}
    for name, values in found.values.items():
        called, order = name.replace("_", " "), found.order[name]
        about = {"units": found.units[name], "long_name": called, "summary": str(found.summary[name])}
        about |= {} if order is None else {"order": order}
        columns[name] = (found.kind, values, about)
        apart = {"units": "", "long_name": f"{called}, difference to the last"}
        columns[f"{name}_difference"] = (found.kind, found.differences[name], apart)
    places = {found.kind: (found.kind, found.counts, {"units": "s" if found.kind == "step" else ""})}
    beside = {"reference": found.reference, "reference_values": json.dumps(found.reference_values)}
    about = _about(found.title) | {"method": found.method} | (beside if found.reference else {})
    return Dataset(columns, places, about)


def _about(title: str) -> dict[str, str]:
    return {"title": title, "version": f"Strikewave {version()}"}


def study(design: Any, parts: Iterable[tuple[Any, Any]], figures: Any, units: Any, about: Any) -> Dataset:
    """See `solvers.study`: of its parts, those that there are; `figures` and `units`: of figures and keys, by name."""
    columns = np.full((len(figures), design.size), np.nan)
    words = {name: np.full(design.size, "", object) for name in WORDS}
    words["refused"][:] = NOT_SOLVED
    said: dict[str, str] = {}
    for (start, stop), part in parts:
        said = part.said | said
        columns[:, start:stop] = part.figures.T
        for name, array in words.items():
            array[start:stop] = getattr(part, name)
    dimensions, places = _places(design, units)
    variables: dict[str, Any] = {
        name: (dimensions, values.reshape(design.shape), {"units": unit, "long_name": name.replace("_", " ")})
        for (name, unit), values in zip(figures.items(), columns, strict=True)
    }
    variables |= {
        name: (dimensions, values.reshape(design.shape), {"long_name": WORDS[name]}) for name, values in words.items()
    }
    return Dataset(variables, places, about | {"sentences": json.dumps(said, sort_keys=True)})


def begin_store(path: Path, design: Any, blocks: Blocks, figures: Any, units: Any, about: Any) -> None:
    """A zarr store of the same, in which no point is solved yet. Raises OSError where it cannot be written."""
    dimensions, places = _places(design, units)
    Dataset(coords=places, attrs=about).to_zarr(path, mode="w", consolidated=False)
    add_arrays(path, dimensions, blocks, figures)


def _places(design: Any, units: Any) -> tuple[tuple[str, ...], dict[str, Any]]:
    """Dimensions, and coordinates of all keys along them."""
    if design.sample != "grid":
        rows = design.rows(0, design.size)
        columns = zip(design.keys, zip(*rows, strict=True), strict=True)
        places = {key: ("point", _values(column), {"units": units[key]}) for key, column in columns}
        return ("point",), {"point": np.arange(design.size)} | places
    places = {
        key: (axis.name, _values(column), {"units": units[key]})
        for axis in design.axes
        for key, column in zip(axis.keys, zip(*axis.rows, strict=True), strict=True)
    }
    return tuple(axis.name for axis in design.axes), places


def _values(column: Sequence[Any]) -> np.ndarray:
    """Numbers; or words, which may be of any length, and tables as words."""
    if all(isinstance(value, (int, float)) for value in column):
        return np.array(column)
    said = [value if isinstance(value, str) else json.dumps(value) for value in column]
    return np.array(said, object)


def write_study(found: Dataset, path: Path) -> None:
    """As the ending of its name says, .nc, .csv or .parquet: there wholly or not at all. Raises OSError."""
    written = path.with_name(f"{path.name}.new")
    if path.suffix == ".nc":
        found.to_netcdf(written)
    else:
        rows = found.to_dataframe().reset_index()
        if path.suffix == ".csv":
            rows.to_csv(written, index=False)
            path.with_name(f"{path.name}.json").write_text(json.dumps(found.attrs, indent=1), "utf-8")
        else:
            rows.attrs = dict(found.attrs)
            rows.to_parquet(written, index=False)
    written.replace(path)


def read_study(path: Path) -> Dataset:
    """What `write_study` wrote: with its dimensions from .nc and .zarr, along `point` from rows.

    Of .zarr figures are read when they are asked for; so are words of more than 1e6 points, which are no objects then.
    """
    if path.suffix == ".nc":
        with xarray.open_dataset(path) as found:
            return found.load()
    if path.suffix == ".zarr":
        found = xarray.open_zarr(path, chunks=None, consolidated=False)
        names = [name for name in (*str(found.attrs.get("figures", "")).split(), *WORDS) if name in found]
        found = found[names] if len(names) == len(found.data_vars) else found  # a folder has no order of its own
        words = {
            name: array.astype(object)
            for name, array in found.variables.items()
            if array.dtype.kind == "T" and array.size <= HELD
        }
        return found.assign(words)
    if path.suffix == ".csv":  # numbers as they were written, by any pandas
        rows = pandas.read_csv(path, keep_default_na=True, float_precision="round_trip")
    else:
        rows = pandas.read_parquet(path)
    for name in WORDS:
        rows[name] = rows[name].fillna("").astype(object)
    about = study_in(path)
    keys = [key for axis in json.loads(about["design"])["vary"] for key in axis["keys"]]
    rows = rows.set_index("point") if "point" in rows else rows.rename_axis("point")
    return Dataset.from_dataframe(rows).set_coords(keys).assign_attrs(about)


def held_study(path: Path) -> Dataset:
    """Of a zarr store, all at once if it has at most 1e6 points."""
    found = read_study(path)
    return found.load() if found.refused.size <= HELD else found


def study_in(path: Path) -> dict[str, Any]:
    """Which study a file is of: its attributes; none if it is of no study. Raises OSError where it cannot be read."""
    try:
        if path.suffix == ".csv":
            return json.loads(path.with_name(f"{path.name}.json").read_text("utf-8"))
        if path.suffix == ".parquet":
            return {str(name): value for name, value in pandas.read_parquet(path, columns=[]).attrs.items()}
        if path.suffix == ".zarr":
            return dict(xarray.open_zarr(path, chunks=None, consolidated=False).attrs)
        with xarray.open_dataset(path) as found:
            return dict(found.attrs)
    except (ValueError, KeyError, TypeError, FileNotFoundError):
        return {}
