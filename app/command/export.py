"""Histories and fields as a file, to plot elsewhere."""

import io
import os
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from solvers import SceneError, Solution
from solvers.scenes.saved import commented, saved_head

from .words import text

SERIES_POINTS = 2_000
FIELD_INSTANTS, FIELD_PLACES = 401, 201


def _histories(solution: Solution) -> dict[str, tuple[str, np.ndarray]]:
    """Name: unit and values; at a jump of the force the time stands twice."""
    motion = solution.known_motion
    time, force = motion.force_history()
    kept = time <= solution.duration
    time, force = time[kept], force[kept]
    if time.size > 10 * SERIES_POINTS:
        time = np.linspace(0.0, solution.duration, SERIES_POINTS)
        force = motion.force(time)
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


def write_series(solution: Solution, path: Path) -> None:
    """Histories as comma-separated values below the scene that they are of, or histories and fields as NetCDF, by the
    ending of the name.

    Raises OSError if the file cannot be written, SceneError if the solution has no histories.
    """
    if solution.motion is None:
        raise SceneError("--series", str(path), text("wanted.no-history"))
    histories = _histories(solution)
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
