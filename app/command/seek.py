"""The command `impact solve SCENE --find KEY=LOW..HIGH --such-that FIGURE=VALUE`: a scene turned round."""

import argparse
import json
from collections.abc import Sequence

import solvers
from solvers import SceneError
from solvers.studies import contour, seek
from solvers.validation import allowed

from .sweep import read_span
from .words import text

OPTIONS = {"between": "--find", "samples": "--find", "spacing": "--find", "key": "--find", "such_that": "--such-that"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    span = "KEY=LOW..HIGH[:COUNT][:log|:linear]"
    parser.add_argument("--find", action="append", metavar=span, help=text("help.solve.find"))
    parser.add_argument("--such-that", metavar="FIGURE=VALUE", help=text("help.solve.such-that"))


def turned_round(options: argparse.Namespace) -> bool:
    """Whether keys are sought. Raises SceneError for one of both options without the other, or beside a file."""
    find, such_that = options.find or [], options.such_that
    if not find and such_that is None:
        return False
    if such_that is None:
        raise SceneError("--find", find[0], text("wanted.beside-find"))
    if not find:
        raise SceneError("--such-that", such_that, text("wanted.beside-such-that"))
    for option, given in (("--series", options.series), ("--at", options.at)):
        if given:
            raise SceneError(option, given, allowed("nothing-beside", other="--find"))
    return True


def print_sought(scene: solvers.Scene, find: Sequence[str], such_that: str, as_json: bool) -> int:
    """Print all values of a key, or the lines over two, as a table or in JSON."""
    if len(find) > 2:
        raise SceneError("--find", find[2], text("wanted.two-finds"))
    usual = seek.USUAL_SAMPLES if len(find) == 1 else contour.USUAL_SAMPLES
    spans, such = [read_span("--find", each, usual) for each in find], _such_that(such_that)
    if len(spans) == 2 and spans[0].key == spans[1].key:
        raise SceneError("--find", find[1], text("wanted.another-find"))
    one, *others = spans
    try:
        if others:
            (other,) = others
            between = {span.key: (span.low, span.high) for span in spans}
            counts, spacings = (one.count, other.count), (one.spacing, other.spacing)
            found = solvers.contour(scene, between, such, counts, spacings)
        else:
            found = solvers.seek(scene, one.key, (one.low, one.high), such, one.count, one.spacing)
    except SceneError as refused:
        name, _, figure = refused.key.partition(".")
        if name not in OPTIONS:
            raise
        raise SceneError(f"{OPTIONS[name]} {figure}".strip(), refused.value, refused.reason) from None
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else found)
    return 0


def _such_that(given: str) -> dict[str, float]:
    """The figure and its value."""
    figure, equals, value = given.partition("=")
    try:
        if equals and figure.strip():
            return {figure.strip(): float(value)}
    except ValueError:
        pass
    raise SceneError("--such-that", given, text("wanted.figure"))
