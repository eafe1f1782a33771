"""Where each integrator keeps the energy, chatters or fails, for the page: one small map each."""

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import param

from solvers import Stability, stability
from solvers.stability.integrators import BOUND, DIVERGED, LASTING
from solvers.stability.maps import AXES, CANNOT, NOT_RUN, USUAL_MODES, Map, check_axes
from solvers.stability.runs import INTEGRATORS, problem_of, run
from solvers.text.catalogue import Catalogue

from ..choices.questions import Question
from ..choices.request import Request
from ..text.refusals import reason_of
from .figures import INK, PICKED, blank, hover, source

STEPS, ACROSS = 21, 25  # rows and columns
MODES = (1, 2, 3, 5, 8, 12, 20, 35, 60, 100, 180, 300, 550, 1000)
MOST_MODES = 40
KINDS = "ok", "slight", "error", "chatter", "stopped", "lasting", "failed", "none"
SLIGHT, LARGE = 1e-6, 1e-2  # energy errors from which a run is no longer ok, and wrong
ACROSS_AXES = [name for name in AXES if name != "step"]
QUESTIONS = {
    "stability_axis": Question(
        param.Selector(default=ACROSS_AXES[0], objects=ACROSS_AXES, doc="beside the step"), "axis"
    )
}


def stability_data(asked: dict[str, Any], cancelled: Callable[[], bool], report: Callable[[str], None]) -> str:
    """The maps over step and `stability_axis` as JSON, or `error`, a note why there are none.

    `report` gets how much is done.
    """

    def progress(done: int, columns: int) -> None:
        report(json.dumps({"chosen": asked, "done": done, "of": columns}))

    scene, axis = Request.of(asked).scene, asked["stability_axis"]
    grid = STEPS, MODES if axis == "modes" else ACROSS
    axes = "step", axis
    try:
        found = stability(scene, None, axes, grid, modes=_modes(scene), workers=1, cancel=cancelled, progress=progress)
    except ValueError as refusal:
        return json.dumps({"chosen": asked, "error": reason_of(refusal)})
    return json.dumps({"chosen": asked, "cancelled": cancelled()} | _shown(found), allow_nan=False)


def stability_kernels(asked: dict[str, Any]) -> None:
    """One short run of every integrator, at the right end of the axis; none of a scene that has no maps."""
    scene, axis = Request.of(asked).scene, asked["stability_axis"]
    modes = _modes(scene)
    try:
        check_axes(scene, ("step", axis))
        problem = problem_of(scene, {axis: float(modes if axis == "modes" else AXES[axis][2])}, modes)
    except ValueError:  # SceneError, which `stability_data` says
        return
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
        "rigid": found.scene.rigid_contact,
        "kinds": KINDS,
        "notes": [note.table() for note in found.notes],
        "maps": [_one(each) for each in found.maps.values()],
    }


def _one(each: Map) -> dict[str, Any]:
    """`runs`: for each step from the smallest a line with the number of the kind for each column; likewise the rest."""
    return {
        "name": each.integrator,
        "limit": None if each.limit is None else _listed(each.limit),
        "reason": each.reason and each.reason.table(),
        "runs": ["".join(map(str, row)) for row in kinds_of(each).tolist()],
        "errors": [_listed(row, 2) for row in each.energy_error],
        "velocities": [_listed(row, 3) for row in each.velocity],
        "chatter": each.chatter.tolist(),
        "steps": each.steps.tolist(),
        "failures": each.failures,
        "stopped": each.stopped,
        "chattering": int(np.sum((each.chatter > 0) & ~np.isin(each.ending, (DIVERGED, LASTING)))),  # of the rest
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


def stability_figure(texts: Catalogue, across: str = "log") -> list[Any]:
    """One map for each integrator, which share ranges, and the cells that are selected; `across`: kind of that axis."""
    from bokeh.models import Span, TapTool

    said = "kind", "error", "ending", "colour"
    columns = (f"{name}-{column}" for name in INTEGRATORS for column in said)
    cells = source("cells", "left", "right", "bottom", "top", "step", "across", *columns)
    here, maps = source("here", "across", "step"), []
    for name in INTEGRATORS:
        first = maps[0] if maps else None
        kinds = {"x_axis_type": across, "y_axis_type": "log"}
        plot = blank(name, "", "", texts.text("stability.step-axis"), first, 250, **kinds)
        if first:
            plot.y_range = first.y_range
        look = {"fill_color": {"field": f"{name}-colour"}, "line_color": {"field": f"{name}-colour"}}
        cell = plot.quad("left", "right", "top", "bottom", source=cells, line_width=0.7, selection_line_color=INK,
                         selection_line_alpha=1.0, selection_line_width=2.5, **look)  # fmt: skip
        cell.nonselection_glyph = None
        marks = source(f"{name}-marks", "across", "step", "marker")  # hatches would take a canvas for each cell
        plot.scatter("across", "step", source=marks, marker={"field": "marker"}, size=6, line_color=INK,
                     line_alpha=0.55, fill_color=INK, fill_alpha=0.2)  # fmt: skip
        limit = source(f"{name}-limit", "across", "step")
        plot.line("across", "step", source=limit, line_color=INK, line_width=2)
        for dimension in ("height", "width"):
            present = {"line_color": PICKED, "line_width": 1, "line_dash": "dotted"}  # through the present choices
            plot.add_layout(Span(name=f"here-{dimension}-{name}", dimension=dimension, **present))
        plot.scatter("across", "step", source=here, size=10, fill_color=PICKED, line_color="white", line_width=1.5)
        values = {"step": "@step{0.000}", "across": "@across{0.000a}", "run": f"@{{{name}-kind}}",
                  "energy": f"@{{{name}-error}}", "steps": f"@{{{name}-ending}}"}  # fmt: skip
        tips = {called: values[column] for column, called in texts.family("stability.tip").items()}
        hover(plot, [cell], tips)
        tap = TapTool(renderers=[cell], visible=False)
        plot.add_tools(tap)
        plot.toolbar.active_tap = tap
        maps.append(plot)
    return maps
