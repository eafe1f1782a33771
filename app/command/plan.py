"""The command `impact plan`: the smallest adequate model, its expected error, why, and what would do better."""

import json
import math
import textwrap

import solvers
from solvers import Plan, SceneError
from solvers.notebook.tables import left_out
from solvers.regimes.models import QUESTIONS

from .words import figure, named, text


def add_arguments(parser) -> None:
    parser.add_argument("--question", default=QUESTIONS[0], help=text("help.plan.question", names=QUESTIONS))
    parser.add_argument("--tolerance", default="0.05", help=text("help.plan.tolerance"))
    parser.add_argument("--solve", action="store_true", help=text("help.plan.solve"))


def print_plan(scene: solvers.Scene, options) -> int:
    """Print the plan, or all of it as JSON."""
    try:
        tolerance = float(options.tolerance)
    except ValueError:
        raise SceneError("--tolerance", options.tolerance, text("wanted.number", low=1e-6, high=1)) from None
    found = solvers.plan(scene, options.question, tolerance, solve=options.solve)
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else report(found))
    return 0


def report(found: Plan) -> str:
    title = found.scene.title or text("printed.report.untitled")
    within = 100 * found.tolerance
    lines = [text("plan.head", title=title, question=found.question, within=within), ""]
    lines += [f"  {named('plan.group', name):44}{figure(value, '.4g')}" for name, value in found.groups.items()]
    lines += ["", f"  {text('plan.model'):48}{text('plan.error')}"]
    for candidate in found.candidates:
        mark = "->" if candidate is found.chosen else "  "
        lines.append(f"{mark}{text('plan.candidate', model=candidate.parts):48}{_shown(candidate.expected_error)}")
    lines += left_out({each.name: each.name.removesuffix("-quasi-static") for each in found.candidates})
    lines += ["", *textwrap.wrap(found.reason, 118, initial_indent="  ", subsequent_indent="  ")]
    if found.next_better is not None:
        better = {"model": found.next_better.parts, "error": _shown(found.next_better.expected_error)}
        lines.append("  " + text("plan.better", **better))
    if found.modes is not None:
        lines.append("  " + text("plan.modes", modes=found.modes))
    lines.append("  " + text("plan.solve", settings=" ".join(_settings(found.chosen.changes))))
    return "\n".join(lines)


def _shown(error: float) -> str:
    if math.isnan(error):
        return text("plan.not-measured")
    return text("plan.cannot-predict") if math.isinf(error) else f"{figure(100 * error, '.2g')} %"


def _settings(changes: dict) -> list[str]:
    settings = []
    for key, value in changes.items():
        pairs = {f"{key}.{name}": item for name, item in value.items()} if isinstance(value, dict) else {key: value}
        settings += [f"--set {name}={item}" for name, item in pairs.items() if item is not None]
    return settings
