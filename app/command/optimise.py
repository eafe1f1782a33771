"""The command `impact optimise`: the best values for some keys of a scene."""

import json
from argparse import ArgumentParser, Namespace

import solvers
from solvers import SceneError

from .interrupts import interruptible
from .study import by_key, whole
from .words import text

OPTIONS = {"minimise": "--minimise", "maximise": "--maximise", "such_that": "--such-that", "solves": "--solves"}


def add_arguments(parser: ArgumentParser) -> None:
    """What the command takes beside the scene."""
    parser.add_argument(
        "--vary", action="append", default=[], metavar="KEY=LOW..HIGH[:log]|A,B,...", help=text("help.optimise.vary")
    )
    parser.add_argument("--minimise", metavar="FIGURE", help=text("help.optimise.minimise"))
    parser.add_argument("--maximise", metavar="FIGURE", help=text("help.optimise.maximise"))
    parser.add_argument(
        "--such-that", action="append", default=[], metavar="FIGURE<=VALUE", help=text("help.optimise.such-that")
    )
    parser.add_argument("--solves", default="2000", metavar="N", help=text("help.optimise.solves"))
    parser.add_argument("--seed", default="0", metavar="N", help=text("help.optimise.seed"))


def print_optimum(scene: solvers.Scene, options: Namespace) -> int:
    """Print the best values and what they give; after an interrupt the best by then."""
    with interruptible() as interrupted:
        try:
            found = solvers.optimise(
                scene,
                by_key("--vary", options.vary),
                minimise=options.minimise,
                maximise=options.maximise,
                such_that=options.such_that,
                solves=whole("--solves", options.solves) or 0,
                seed=whole("--seed", options.seed) or 0,
                cancelled=interrupted,
            )
        except SceneError as refused:
            raise SceneError(OPTIONS.get(refused.key, refused.key), refused.value, refused.reason) from None
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else found)
    return 130 if interrupted() else 0
