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
from .words import family, text

COLUMNS = {  # and how wide they are
    "contacts": 8,
    "impulse": 13,
    "peak-force": 15,
    "leaves": 15,
    "restitution": 11,
    "energy": 15,
    "error": 14,
}
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_RANGE = re.compile(
    rf"(?P<key>[^=]+)=(?P<low>{_NUMBER})\.\.(?P<high>{_NUMBER})(?::(?P<count>\d{{1,9}}))?(?::(?P<spacing>log|linear))?"
)


def parse_range(given: str) -> tuple[str, np.ndarray]:
    """The key and the values of `KEY=LOW..HIGH[:COUNT][:log|:linear]`."""
    found = _RANGE.fullmatch(given.strip())
    if found is None:
        raise SceneError("--vary", given, text("wanted.range"))
    count = 21 if found["count"] is None else int(found["count"])
    try:
        values = spaced(float(found["low"]), float(found["high"]), count, found["spacing"])
    except SceneError as refused:
        raise SceneError(f"--vary {refused.key}", refused.value, refused.reason) from None
    return found["key"].strip(), values


def print_sweep(scene: solvers.Scene, vary: str, as_json: bool) -> int:
    """Print the sweep as a table, or as a list of tables in JSON; after an interrupt what is solved by then."""
    key, values = parse_range(vary)
    with interruptible() as interrupted:
        rows = sweep(scene, key, values, cancel=interrupted)
    print(json.dumps(rows, indent=1, allow_nan=False) if as_json else table(key, rows))
    if interrupted():
        print(text("sweep.stopped", done=len(rows), most=len(values)), file=sys.stderr)
    return 130 if interrupted() else 0


def table(key: str, rows: list[dict[str, Any]]) -> str:
    width = max(len(key), 12)
    heads = family("sweep.head")
    head = "  ".join([f"  {key:>{width}}", *(f"{heads[name]:>{size}}" for name, size in COLUMNS.items())])
    return "\n".join([head, *(_line(row, width) for row in rows)])


def _line(row: dict[str, Any], width: int) -> str:
    velocity = row["impactor"]["final_velocity"]
    if isinstance(velocity, list):  # of a body in space
        velocity = "(" + ", ".join(f"{part + 0.0:.4g}" for part in velocity) + ")"
    peak = None if row["peak_force"] is None else row["peak_force"] / 1e3
    cells = [
        (row["contacts"], "d"), (row["impulse"], ".6g"), (peak, ".6g"), (velocity, "+.6f"),
        (row["restitution"]["newton"], ".6f"), (row["energy_error"], "+.1e"), (row["estimated_error"], ".1e"),
    ]  # fmt: skip
    sized = (shown(*cell).rjust(size) for cell, size in zip(cells, COLUMNS.values(), strict=True))
    return "  ".join([f"  {shown(row['value'], '.8g'):>{width}}", *sized])


def shown(value: object, form: str) -> str:
    if value is None:
        return "-"
    return value if isinstance(value, str) else f"{value:{form}}"
