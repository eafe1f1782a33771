"""The command `impact sweep`: one key of a scene over a range, a line for each value."""

import json
import re
import sys
from typing import Any

import numpy as np

import solvers
from solvers import SceneError
from solvers.studies.sweep import spaced, sweep

from .interrupts import interruptible

ALLOWED = "KEY=LOW..HIGH[:COUNT][:log|:linear], such as impactor.mass=0.1..10:50"
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_RANGE = re.compile(
    rf"(?P<key>[^=]+)=(?P<low>{_NUMBER})\.\.(?P<high>{_NUMBER})(?::(?P<count>\d{{1,9}}))?(?::(?P<spacing>log|linear))?"
)


def parse_range(text: str) -> tuple[str, np.ndarray]:
    """The key and the values of `KEY=LOW..HIGH[:COUNT][:log|:linear]`."""
    found = _RANGE.fullmatch(text.strip())
    if found is None:
        raise SceneError("--vary", text, ALLOWED)
    count = 21 if found["count"] is None else int(found["count"])
    try:
        values = spaced(float(found["low"]), float(found["high"]), count, found["spacing"])
    except SceneError as refused:
        raise SceneError(f"--vary {refused.key}", refused.value, refused.args[0].partition("allowed: ")[2]) from None
    return found["key"].strip(), values


def print_sweep(scene: solvers.Scene, vary: str, as_json: bool) -> int:
    """Print the sweep as a table, or as a list of tables in JSON; after an interrupt what is solved by then."""
    key, values = parse_range(vary)
    with interruptible() as interrupted:
        rows = sweep(scene, key, values, cancel=interrupted)
    print(json.dumps(rows, indent=1, allow_nan=False) if as_json else table(key, rows))
    if interrupted():
        print(f"impact: stopped after {len(rows)} of at most {len(values)} values", file=sys.stderr)
    return 130 if interrupted() else 0


def table(key: str, rows: list[dict[str, Any]]) -> str:
    width = max(len(key), 12)
    head = (
        f"  {key:>{width}}  contacts  impulse [N s]  peak force [kN]  leaves at [m/s]"
        "  restitution  energy residual  error estimate"
    )
    return "\n".join([head, *(_line(row, width) for row in rows)])


def _line(row: dict[str, Any], width: int) -> str:
    velocity = row["impactor"]["final_velocity"]
    if isinstance(velocity, list):  # of a body in space
        velocity = "(" + ", ".join(f"{part + 0.0:.4g}" for part in velocity) + ")"
    peak = None if row["peak_force"] is None else row["peak_force"] / 1e3
    cells = [
        (row["value"], width, ".8g"), (row["contacts"], 8, "d"), (row["impulse"], 13, ".6g"), (peak, 15, ".6g"),
        (velocity, 15, "+.6f"), (row["restitution"]["newton"], 11, ".6f"), (row["energy_error"], 15, "+.1e"),
        (row["estimated_error"], 14, ".1e"),
    ]  # fmt: skip
    return "  " + "  ".join(shown(value, form).rjust(size) for value, size, form in cells)


def shown(value: object, form: str) -> str:
    if value is None:
        return "-"
    return value if isinstance(value, str) else f"{value:{form}}"
