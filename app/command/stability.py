"""The command `impact stability`: a map in plain text for each integrator, and what the maps teach."""

import json
import re
import textwrap
from typing import Any

import numpy as np

import solvers
from solvers import SceneError, Stability
from solvers.stability.maps import AXES, CANNOT, NOT_RUN, Map
from solvers.stability.runs import INTEGRATORS

from .words import figure, named, text

USUAL_GRID = "20x41"  # five columns a decade: one of them is a hundred times an element


def add_arguments(parser) -> None:
    parser.add_argument(
        "--axes",
        default="step,contact_stiffness",
        metavar="A,B",
        help=text("help.stability.axes", names=list(AXES)),
    )
    parser.add_argument(
        "--grid", default=USUAL_GRID, metavar="ROWSxCOLUMNS", help=text("help.stability.grid", grid=USUAL_GRID)
    )
    parser.add_argument(
        "--integrators", metavar="NAMES", help=text("help.stability.integrators", names=list(INTEGRATORS))
    )
    parser.add_argument("--modes", help=text("help.stability.modes"))


def print_stability(scene: solvers.Scene, options) -> int:
    """Print the maps, or all numbers as JSON."""
    grid = re.fullmatch(r"(\d{1,3})x(\d{1,3})", options.grid)
    if grid is None:
        raise SceneError("--grid", options.grid, text("wanted.grid"))
    if options.modes is not None and not re.fullmatch(r"\d{1,5}", options.modes):
        raise SceneError("--modes", options.modes, text("wanted.whole", low=1, high=10000))
    found = solvers.stability(
        scene,
        None if options.integrators is None else [name.strip() for name in options.integrators.split(",")],
        [name.strip() for name in options.axes.split(",")],
        [int(count) for count in grid.groups()],
        modes=None if options.modes is None else int(options.modes),
    )
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else report(found))
    return 0


def report(found: Stability) -> str:
    """Maps of characters, rows from the largest value down."""
    title = text("stability.head", title=found.scene.title or text("printed.report.untitled"), modes=found.modes)
    first, second = found.axes
    lines = [
        title,
        f"  {text('stability.down'):8}{_axis(first, found.here[0])}",
        f"  {text('stability.across'):8}{_axis(second, found.here[1])}",
        *(f"  {line}" for line in textwrap.wrap(text("stability.legend"), 116)),
    ]
    for each in found.maps.values():
        lines += ["", *_drawn(found, each)]
    return "\n".join(
        [
            *lines,
            "",
            *(line for note in found.notes for line in textwrap.wrap(text("printed.report.note", note=note), 118)),
        ]
    )


def _drawn(found: Stability, each: Map) -> list[str]:
    head = f"  {each.integrator}: {each.label}"
    if each.reason:
        return [head, "  " + text("stability.cannot", reason=each.reason)]
    first, second = found.axes
    limit = text("stability.limit", limit=each.limit_name)
    lines = [head, *(f"  {line}" for line in textwrap.wrap(limit, 116, subsequent_indent="  "))]
    for i in reversed(range(first.values.size)):
        row = [_sign(each, i, j) for j in range(second.values.size)]
        lines.append(f"  {figure(first.values[i], '10.3g')}  {''.join(row)}")
    values = second.values
    ends = figure(values[0], ".3g"), figure(values[-1], ".3g")
    gap = max(1, values.size - len(ends[0]) - len(ends[1]))
    lines.append(f"  {'':10}  {ends[0]}{'':{gap}}{ends[1]}")
    runs = {"failed": each.failures, "stopped": each.stopped, "worst": each.worst_energy_error}
    return [*lines, "  " + text("stability.runs", chatter=int(each.chatter.max()), **runs)]


def _axis(axis: Any, here: float) -> str:
    """What an axis of the maps shows, and where the scene itself lies on it."""
    return text("stability.axis", name=named("name.axis", axis.name), unit=axis.unit, here=here)


def _sign(each: Map, i: int, j: int) -> str:
    ending, share = each.ending[i, j], each.limit_share[i, j]
    neighbours = [each.limit_share[i, j + 1]] if j + 1 < each.limit_share.shape[1] else []
    neighbours += [each.limit_share[i + 1, j]] if i + 1 < each.limit_share.shape[0] else []
    if share <= 1.0 and any(np.isfinite(other) and other > 1.0 for other in neighbours):
        return "|"
    if ending in (NOT_RUN, CANNOT):
        return " "
    if ending:
        return " !LX"[ending]
    error = abs(each.energy_error[i, j])
    return "." if error <= 1e-6 else "o" if error <= 1e-2 else "e"
