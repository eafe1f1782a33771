"""The command `impact sweep`: one key of a scene over a range, a line for each value."""

import json
import sys
from typing import NamedTuple

import numpy as np

import solvers
from solvers import SceneError
from solvers.studies.study.axes import RANGE
from solvers.studies.sweep import spaced, sweep

from .interrupts import interruptible
from .words import text


class Span(NamedTuple):
    """A key and what it ranges over."""

    key: str
    low: float
    high: float
    count: int
    spacing: str | None


def read_span(option: str, given: str, count: int) -> Span:
    """What `KEY=LOW..HIGH[:COUNT][:log|:linear]` says; `count` where it says none."""
    key, _, span = given.partition("=")
    found = RANGE.fullmatch(span.strip())
    if found is None or not key.strip():
        raise SceneError(option, given, text("wanted.range"))
    number = count if found["count"] is None else int(found["count"])
    return Span(key.strip(), float(found["low"]), float(found["high"]), number, found["spacing"])


def parse_range(given: str) -> tuple[str, np.ndarray]:
    """The key and the values of `KEY=LOW..HIGH[:COUNT][:log|:linear]`."""
    span = read_span("--vary", given, 21)
    try:
        return span.key, spaced(span.low, span.high, span.count, span.spacing)
    except SceneError as refused:
        raise SceneError(f"--vary {refused.key}", refused.value, refused.reason) from None


def print_sweep(scene: solvers.Scene, vary: str, figures: list[str] | None, as_json: bool) -> int:
    """Print the sweep as a table, or as a list of tables in JSON; after an interrupt what is solved by then."""
    key, values = parse_range(vary)
    with interruptible() as interrupted:
        rows = sweep(scene, key, values, cancel=interrupted, figures=figures)
    print(json.dumps(rows, indent=1, allow_nan=False) if as_json else rows)
    if interrupted():
        print(text("sweep.stopped", done=len(rows), most=len(values)), file=sys.stderr)
    return 130 if interrupted() else 0
