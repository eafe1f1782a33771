"""Where each integrator keeps the energy, chatters or fails, for the page: one small map each."""

import json
from collections.abc import Callable
from typing import Any

import numpy as np

from solvers import Stability, stability
from solvers.numerics.integrators import BOUND, DIVERGED, LASTING
from solvers.stability import AXES, CANNOT, NOT_RUN, USUAL_MODES, Map, check_axes
from solvers.stability_runs import INTEGRATORS, problem_of, run

from .state import chosen_scene

STEPS, ACROSS = 21, 25  # rows and columns
MODES = (1, 2, 3, 5, 8, 12, 20, 35, 60, 100, 180, 300, 550, 1000)
MOST_MODES = 40
KINDS = "ok", "slight", "error", "chatter", "stopped", "lasting", "failed", "none"
SLIGHT, LARGE = 1e-6, 1e-2  # energy errors from which a run is no longer ok, and wrong


def stability_data(asked: dict[str, Any], cancelled: Callable[[], bool], tell: Callable[[str], None]) -> str:
    """The maps over step and `stability_axis` as JSON; `tell` gets how much is done. Raises SceneError."""

    def progress(done: int, columns: int) -> None:
        tell(json.dumps({"chosen": asked, "done": done, "of": columns}))

    scene, axis = chosen_scene(asked), asked["stability_axis"]
    grid = STEPS, MODES if axis == "modes" else ACROSS
    axes = "step", axis
    found = stability(scene, None, axes, grid, modes=_modes(scene), workers=1, cancel=cancelled, progress=progress)
    return json.dumps({"chosen": asked, "cancelled": cancelled()} | _shown(found), allow_nan=False)


def stability_kernels(asked: dict[str, Any]) -> None:
    """One short run of every integrator, at the right end of the axis. Raises SceneError."""
    scene, axis = chosen_scene(asked), asked["stability_axis"]
    modes = _modes(scene)
    check_axes(scene, ("step", axis))
    problem = problem_of(scene, {axis: float(modes if axis == "modes" else AXES[axis][2])}, modes)
    for name in INTEGRATORS:
        run(name, problem, problem.usual_step, 20)


def _modes(scene: Any) -> int:
    return int(min(scene.method.get("modes", USUAL_MODES), MOST_MODES))


def _shown(found: Stability) -> dict[str, Any]:
    step, across = found.axes
    return {
        "modes": found.modes,
        "step": _listed(step.values),
        "across": {"name": across.name, "values": _listed(across.values), "log": across.log},
        "here": _listed(np.array(found.here)),
        "kinds": KINDS,
        "notes": found.notes,
        "maps": [_one(each) for each in found.maps.values()],
    }


def _one(each: Map) -> dict[str, Any]:
    """`runs`: for each step from the smallest a line with the number of the kind for each column; likewise the rest."""
    return {
        "name": each.integrator,
        "label": each.label,
        "limit_name": each.limit_name,
        "limit": None if each.limit is None else _listed(each.limit),
        "reason": each.reason,
        "runs": ["".join(map(str, row)) for row in kinds_of(each).tolist()],
        "errors": [_listed(row, 2) for row in each.energy_error],
        "velocities": [_listed(row, 3) for row in each.velocity],
        "chatter": each.chatter.tolist(),
        "steps": each.steps.tolist(),
        "failures": each.failures,
        "stopped": each.stopped,
        "chattering": int(np.sum(each.chatter > 0)),
        "worst": None if np.isnan(each.worst_energy_error) else each.worst_energy_error,
        "count": int(np.sum(each.ending < NOT_RUN)),
    }


def kinds_of(each: Map) -> np.ndarray:
    """Of every run the number of its kind in `KINDS`, the gravest that holds."""
    error, found = np.abs(np.nan_to_num(each.energy_error)), np.zeros(each.ending.shape, int)
    for kind, holds in (
        ("slight", error > SLIGHT),
        ("chatter", each.chatter > 0),
        ("error", error > LARGE),
        ("stopped", each.ending == BOUND),
        ("lasting", each.ending == LASTING),
        ("failed", each.ending == DIVERGED),
        ("none", (each.ending == NOT_RUN) | (each.ending == CANNOT)),
    ):
        found[holds] = KINDS.index(kind)
    return found


def _listed(values: np.ndarray, digits: int = 4) -> list[float | None]:
    return [float(f"{value:.{digits}g}") if np.isfinite(value) else None for value in values.tolist()]
