"""The command `impact solve SCENE --find KEY=LOW..HIGH --such-that FIGURE=VALUE`: a scene turned round."""

import argparse
import json

import solvers
from solvers import SceneError
from solvers.studies.seek import USUAL_SAMPLES, seek
from solvers.validation import allowed

from .sweep import read_span
from .words import text

OPTIONS = {"between": "--find", "samples": "--find", "spacing": "--find", "key": "--find", "such_that": "--such-that"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--find", metavar="KEY=LOW..HIGH[:COUNT][:log|:linear]", help=text("help.solve.find"))
    parser.add_argument("--such-that", metavar="FIGURE=VALUE", help=text("help.solve.such-that"))


def turned_round(options: argparse.Namespace) -> bool:
    """Whether a key is sought. Raises SceneError for one of both options without the other, or beside a file."""
    if options.find is None and options.such_that is None:
        return False
    if options.such_that is None:
        raise SceneError("--find", options.find, text("wanted.beside-find"))
    if options.find is None:
        raise SceneError("--such-that", options.such_that, text("wanted.beside-such-that"))
    for option, given in (("--series", options.series), ("--at", options.at)):
        if given:
            raise SceneError(option, given, allowed("nothing-beside", other="--find"))
    return True


def print_sought(scene: solvers.Scene, find: str, such_that: str, as_json: bool) -> int:
    """Print all values of the key as a table, or in JSON."""
    span, such = read_span("--find", find, USUAL_SAMPLES), _such_that(such_that)
    try:
        found = seek(scene, span.key, (span.low, span.high), such, span.count, span.spacing)
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
