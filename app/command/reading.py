"""How commands read a table of measured values."""

from argparse import ArgumentParser, Namespace
from typing import Any

from solvers import SceneError, validation

from .words import text

MOST_SKIPPED = 10_000  # lines


def add_arguments(parser: ArgumentParser) -> None:
    """The options of a table."""
    parser.add_argument("--columns", metavar="NAMES", help=text("help.record.columns"))
    parser.add_argument("--decimal", metavar="SIGN", help=text("help.record.decimal"))
    parser.add_argument("--sign", default="1", help=text("help.record.sign"))
    parser.add_argument("--skip", metavar="N", default="0", help=text("help.record.skip"))
    scale = "NAME=FACTOR[:OFFSET]"
    parser.add_argument("--scale", action="append", default=[], metavar=scale, help=text("help.record.scale"))


def how(options: Namespace) -> dict[str, Any]:
    """Of `records.read_record`. Raises SceneError naming the option."""
    columns = None if options.columns is None else tuple(name.strip() for name in options.columns.split(","))
    validation.choice("--sign", options.sign, ("1", "-1"))
    try:
        skip = int(options.skip)
    except ValueError:
        skip = options.skip
    skip = validation.whole_number("--skip", skip, 0, MOST_SKIPPED)
    found = {"kind": options.kind, "columns": columns, "sign": int(options.sign), "decimal": options.decimal}
    return found | {"skip": skip, "scale": _scale(options.scale)}


def _scale(words: list[str]) -> dict[str, tuple[float, float]]:
    found: dict[str, tuple[float, float]] = {}
    for word in words:
        name, equals, numbers = word.rpartition("=")
        factor, _, offset = numbers.partition(":")
        try:
            given = float(factor), float(offset or "0")
        except ValueError:
            raise SceneError("--scale", word, text("wanted.scale")) from None
        if not equals or not name.strip():
            raise SceneError("--scale", word, text("wanted.scale"))
        if name.strip() in found:
            raise SceneError("--scale", word, text("wanted.one-value", before=repr(found[name.strip()])))
        found[name.strip()] = given
    return found
