"""The command `impact sweep`: one key of a scene over a range, a line for each value."""

import json
import re
import sys

import numpy as np

import solvers
from solvers import SceneError
from solvers.studies.sweep import spaced, sweep

from .interrupts import interruptible
from .words import text

_NUMBER = r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?"
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


def print_sweep(scene: solvers.Scene, vary: str, figures: list[str] | None, as_json: bool) -> int:
    """Print the sweep as a table, or as a list of tables in JSON; after an interrupt what is solved by then."""
    key, values = parse_range(vary)
    with interruptible() as interrupted:
        rows = sweep(scene, key, values, cancel=interrupted, figures=figures)
    print(json.dumps(rows, indent=1, allow_nan=False) if as_json else rows)
    if interrupted():
        print(text("sweep.stopped", done=len(rows), most=len(values)), file=sys.stderr)
    return 130 if interrupted() else 0
