"""The command `impact stability`: a map in plain text for each integrator, and what the maps teach."""

import json
import re
import textwrap

import numpy as np

import solvers
from solvers import SceneError, Stability
from solvers.stability.maps import AXES, CANNOT, NOT_RUN, Map
from solvers.stability.runs import INTEGRATORS

USUAL_GRID = "20x41"  # five columns a decade: one of them is a hundred times an element
LEGEND = (
    ". energy kept to 1e-6   o to 1 %   e worse   L never parts   X more than doubles its energy   ! stopped at the "
    "bound   | theoretical limit, stable on its left or below it"
)


def add_arguments(parser) -> None:
    parser.add_argument(
        "--axes",
        default="step,contact_stiffness",
        metavar="A,B",
        help=f"two of {', '.join(AXES)}; the step comes first",
    )
    parser.add_argument("--grid", default=USUAL_GRID, metavar="ROWSxCOLUMNS", help=f"default: {USUAL_GRID}")
    parser.add_argument("--integrators", metavar="NAMES", help=f"some of {', '.join(INTEGRATORS)}; default: all")
    parser.add_argument("--modes", help="kept by every integrator; default: as the scene's method says, or 20")


def print_stability(scene: solvers.Scene, options) -> int:
    """Print the maps, or all numbers as JSON."""
    grid = re.fullmatch(r"(\d{1,3})x(\d{1,3})", options.grid)
    if grid is None:
        raise SceneError("--grid", options.grid, "ROWSxCOLUMNS, such as 20x40")
    if options.modes is not None and not re.fullmatch(r"\d{1,5}", options.modes):
        raise SceneError("--modes", options.modes, "a whole number from 1 to 10000")
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
    title = f"{found.scene.title or 'Untitled scene'}: stability with {found.modes} modes"
    first, second = found.axes
    lines = [
        title,
        f"  down    {first.name} [{first.unit}]; the scene itself: {found.here[0]:.3g}",
        f"  across  {second.name} [{second.unit}]; the scene itself: {found.here[1]:.3g}",
        *(f"  {line}" for line in textwrap.wrap(LEGEND, 116)),
    ]
    for each in found.maps.values():
        lines += ["", *_drawn(found, each)]
    return "\n".join([*lines, "", *(line for note in found.notes for line in textwrap.wrap(f"Note: {note}", 118))])


def _drawn(found: Stability, each: Map) -> list[str]:
    head = f"  {each.integrator}: {each.label}"
    if each.reason:
        return [head, f"  cannot: {each.reason}"]
    first, second = found.axes
    lines = [head, f"  limit: {each.limit_name}"]
    for i in reversed(range(first.values.size)):
        row = [_sign(each, i, j) for j in range(second.values.size)]
        lines.append(f"  {first.values[i]:10.3g}  {''.join(row)}")
    values = second.values
    ends = f"{values[0]:.3g}", f"{values[-1]:.3g}"
    gap = max(1, values.size - len(ends[0]) - len(ends[1]))
    lines.append(f"  {'':10}  {ends[0]}{'':{gap}}{ends[1]}")
    lines.append(
        f"  runs failed {each.failures}, stopped {each.stopped}, worst energy error {each.worst_energy_error:.1e},"
        f" most chatter {int(each.chatter.max())}"
    )
    return lines


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
