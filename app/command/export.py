"""Histories and fields as a file, to plot elsewhere."""

import io
import os
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from solvers import SceneError, Solution, validation
from solvers.notebook.figures import fields_of, reach
from solvers.scenes.saved import commented, saved_head

from .words import text

SERIES_POINTS = 2_000
FIELD_INSTANTS, FIELD_PLACES = 401, 201


def _histories(solution: Solution, also: np.ndarray | None = None) -> dict[str, tuple[str, np.ndarray]]:
    """Name: unit and values; at a jump of the force the time stands twice. `also`: instants besides its own."""
    motion = solution.known_motion
    time, force = motion.force_history()
    kept = time <= solution.duration
    time, force = time[kept], force[kept]
    if time.size > 10 * SERIES_POINTS:
        time = np.linspace(0.0, solution.duration, SERIES_POINTS)
        force = motion.force(time)
    if also is not None:
        more = np.setdiff1d(also, time)
        order = np.argsort(np.append(time, more), kind="stable")
        time, force = np.append(time, more)[order], np.append(force, motion.force(more))[order]
    doubled = np.append(time[1:] == time[:-1], False)

    def jumping(velocity):
        return np.where(doubled, velocity(time, after=False), velocity(time))

    return {
        "time": ("s", time),
        "contact_force": ("N", force),
        "impactor_position": ("m", motion.impactor_position(time)),
        "impactor_velocity": ("m_per_s", jumping(motion.impactor_velocity)),
        "struck_end_position": ("m", motion.end_position(time)),
        "target_mean_velocity": ("m_per_s", jumping(motion.rigid_velocity)),
    }


def check_name(name: str, *endings: str) -> None:
    """Raises SceneError for what can be no file of histories, before anything is solved."""
    if not name.endswith(endings) or (os.path.exists(name) and not os.path.isfile(name)):
        raise SceneError("--series", name, text("wanted.ending", endings=text("wanted.or").join(endings)))
    if name.endswith(".nc") and find_spec("xarray") is None:
        raise SceneError("--series", name, text("wanted.no-xarray"))


def check_places(words: Sequence[str], series: str | None) -> list[float]:
    """The places [m] of `--at`. Raises SceneError for a word that is no number, and where no CSV file is written."""
    if words and not (series or "").endswith(".csv"):
        raise SceneError("--at", words[0], text("wanted.at-in-csv"))
    try:
        return [float(word) for word in words]
    except ValueError:
        raise SceneError("--at", words, text("wanted.place")) from None


def _at_places(solution: Solution, time: np.ndarray, places: Sequence[float]) -> dict[str, tuple[str, np.ndarray]]:
    """Every field at these places [m], which are within the bodies, or refused with a SceneError."""
    first, last = reach(solution)
    found = {}
    for place in places:
        x = np.array([validation.number("--at", place, first, last, "m")])
        for name, field in fields_of(solution.scene).items():
            unit = field.unit.replace("/", "_per_").replace(" ", "_")
            found[f"{name}_at_{place:.9g}_m"] = unit, field.of(solution.known_motion, time, x)[:, 0]
    return found


def write_series(solution: Solution, path: Path, places: Sequence[float] = ()) -> None:
    """Histories as comma-separated values below the scene that they are of, with the fields at these places [m], or
    histories and fields as NetCDF, by the ending of the name.

    Raises OSError if the file cannot be written, SceneError if the solution has no histories, or for a place outside.
    """
    if solution.motion is None:
        raise SceneError("--series", str(path), text("wanted.no-history"))
    histories = _histories(solution)
    if places:  # fronts pass there when nothing happens at the contact
        histories = _histories(solution, np.linspace(0.0, solution.duration, SERIES_POINTS))
        histories |= _at_places(solution, histories["time"][1], places)
    if path.suffix == ".csv":
        rows = io.StringIO()
        rows.write(commented(saved_head(solution.scene, solution.method, solution.duration)))
        rows.write(",".join(f"{name}_{unit}" for name, (unit, _) in histories.items()) + "\n")
        np.savetxt(rows, np.column_stack([values for _, values in histories.values()]), delimiter=",", fmt="%.12g")
        path.write_text(rows.getvalue(), encoding="utf-8")
        return
    _write_netcdf(solution, histories, path)


def _write_netcdf(solution: Solution, histories: dict[str, tuple[str, np.ndarray]], path: Path) -> None:
    """Histories over their own `time`, in which every jump is kept; fields over `instant` and x in the target."""
    instants = np.linspace(0.0, solution.duration, FIELD_INSTANTS)
    data = solution.dataset(instants, np.linspace(0.0, solution.scene.target.length, FIELD_PLACES))
    fields = data[[name for name, values in data.items() if values.dims == ("time", "x")]]
    file = fields.rename(time="instant").assign(
        {name: ("time", values, {"units": unit.replace("_per_", "/")}) for name, (unit, values) in histories.items()}
    )
    encoding = {name: {"_FillValue": None} for name in file.variables}  # no value is missing
    file.to_netcdf(path, format="NETCDF3_CLASSIC", engine="scipy", encoding=encoding)
