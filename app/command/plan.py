"""The command `impact plan`: the smallest adequate model, its expected error, why, and what would do better."""

import json
import math
import textwrap

import solvers
from solvers import Plan, SceneError
from solvers.regimes.models import QUESTIONS

NAMES = {
    "mass_ratio": "mass ratio (target / impactor)",
    "contact_time": "local contact time / round trip or period",
    "impact_parameter": "speed / speed of first yield",
    "slenderness": "length / depth",
    "rotation": "share of turning in the impact",
}


def add_arguments(parser) -> None:
    parser.add_argument("--question", default=QUESTIONS[0], help=f"one of {', '.join(QUESTIONS)}; default: the first")
    parser.add_argument("--tolerance", default="0.05", help="largest error allowed; default: 0.05")


def print_plan(scene: solvers.Scene, options) -> int:
    """Print the plan, or all of it as JSON."""
    try:
        tolerance = float(options.tolerance)
    except ValueError:
        raise SceneError("--tolerance", options.tolerance, "a number from 1e-06 to 1") from None
    found = solvers.plan(scene, options.question, tolerance)
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else report(found))
    return 0


def report(found: Plan) -> str:
    title = found.scene.title or "Untitled scene"
    lines = [f"{title}: {found.question} within {100 * found.tolerance:.3g} %", ""]
    lines += [f"  {NAMES[name]:44}{value:.4g}" for name, value in found.groups.items()]
    lines += ["", f"  {'model':48}expected error"]
    for candidate in found.candidates:
        mark = "->" if candidate is found.chosen else "  "
        lines.append(f"{mark}{candidate.model:48}{_shown(candidate.expected_error)}")
    lines += ["", *textwrap.wrap(found.reason, 118, initial_indent="  ", subsequent_indent="  ")]
    if found.next_better is not None:
        lines.append(f"  Next better: {found.next_better.model}, {_shown(found.next_better.expected_error)}.")
    if found.modes is not None:
        lines.append(f"  Modes that would do, too: {found.modes}.")
    lines.append("  Solve it so: impact solve SCENE " + " ".join(_settings(found.chosen.changes)))
    return "\n".join(lines)


def _shown(error: float) -> str:
    if math.isnan(error):
        return "not measured"
    return "does not tell" if math.isinf(error) else f"{100 * error:.2g} %"


def _settings(changes: dict) -> list[str]:
    settings = []
    for key, value in changes.items():
        pairs = {f"{key}.{name}": item for name, item in value.items()} if isinstance(value, dict) else {key: value}
        settings += [f"--set {name}={item}" for name, item in pairs.items() if item is not None]
    return settings
