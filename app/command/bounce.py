"""The command `impact bounce`: a dropped body, bounce after bounce."""

import json
from typing import Any

import solvers
from solvers import Bounce, Bounces, SceneError
from solvers.studies.bounces import MAX_BOUNCES

from .interrupts import interruptible
from .words import family, figure, text

SHOWN = 12  # bounces of a table: the first ones, and the last
WIDTHS = {"number": 7, "time": 13, "speed": 13, "restitution": 13, "height": 14, "contact": 13, "peak-force": 16}


def print_bounces(scene: solvers.Scene, cut: str, count: str, as_json: bool) -> int:
    """Print the bounces as a table, or all of them as JSON; after an interrupt those that are solved by then."""
    part, most = _number("--cut", cut, float), _number("--bounces", count, int)
    with interruptible() as interrupted:
        found = solvers.bounces(scene, cut=part, count=most, cancelled=interrupted)
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else report(found))
    return 0


def _number(name: str, given: str, kind: Any) -> Any:
    try:
        return kind(given)
    except ValueError:
        code = "wanted.whole" if kind is int else "wanted.number"
        raise SceneError(
            name, given, text(code, low=1 if kind is int else 1e-15, high=MAX_BOUNCES if kind is int else 1)
        ) from None


def report(found: Bounces) -> str:
    """A page of plain text."""
    head = family("bounce.head")
    rows = [_row(number, bounce) for number, bounce in enumerate(found.bounces, 1)]
    if len(rows) > SHOWN:
        rows[SHOWN - 1 : -1] = ["  " + text("bounce.more")]
    end = {"ended": found.ended, "count": len(found.bounces), "cut": figure(found.cut, "g")}
    if found.rest_time is None or found.path is None:
        rest = text("bounce.restless")
    else:
        rest = text("bounce.rest", time=figure(found.rest_time, ".9g"), path=figure(found.path, ".9g"))
    return "\n".join(
        [
            found.scene.title or text("printed.report.untitled"),
            "  " + text("bounce.dropped", height=figure(found.height, "g"), gravity=figure(found.gravity, "g")),
            "",
            "".join(f"{head[name]:>{width}}" for name, width in WIDTHS.items()),
            *rows,
            "",
            "  " + text("bounce.ended", **end),
            "  " + rest,
            *("  " + text("printed.report.note", note=note) for note in found.notes),
        ]
    )


def _row(number: int, bounce: Bounce) -> str:
    values = {
        "number": str(number),
        "time": figure(bounce.time, ".6g"),
        "speed": figure(bounce.speed, ".6g"),
        "restitution": figure(bounce.restitution, ".6f"),
        "height": figure(bounce.height, ".6g"),
        "contact": "-" if bounce.contact_time is None else figure(bounce.contact_time, ".6g"),
        "peak-force": "-" if bounce.peak_force is None else figure(bounce.peak_force, ".6g"),
    }
    return "".join(f"{values[name]:>{width}}" for name, width in WIDTHS.items())
