"""The command `impact uncertain`: how far figures spread within tolerances, and which input each owes that to."""

import json
from argparse import ArgumentParser, Namespace

import solvers
from solvers import SceneError
from solvers.studies.uncertain import USUAL_SAMPLES

from .study import by_key, show, whole
from .words import text

OPTIONS = {"tolerances": "--tolerance", "vary": "--tolerance", "figures": "--figure"}
OPTIONS |= {name: f"--{name}" for name in ("points", "seed", "workers")}


def add_arguments(parser: ArgumentParser) -> None:
    """What the command takes beside the scene."""
    law = "KEY=5%%|LAW(...)|LOW..HIGH"
    parser.add_argument("--tolerance", action="append", default=[], metavar=law, help=text("help.uncertain.tolerance"))
    parser.add_argument("--figure", action="append", metavar="NAME", help=text("help.uncertain.figure"))
    parser.add_argument("--points", default=str(USUAL_SAMPLES), metavar="N", help=text("help.uncertain.points"))
    parser.add_argument("--seed", default="0", metavar="N", help=text("help.study.seed"))
    parser.add_argument("--method", metavar="NAME", help=text("help.uncertain.method"))
    parser.add_argument("--workers", metavar="N", help=text("help.study.workers"))


def print_uncertain(scene: solvers.Scene, options: Namespace) -> int:
    """Print spreads and indices as tables, or all but the points in JSON."""
    tolerances = by_key("--tolerance", options.tolerance)
    counts = {name: whole(f"--{name}", getattr(options, name)) for name in ("points", "seed", "workers")}
    try:
        found = solvers.uncertain(
            scene,
            tolerances,
            options.figure,
            counts["points"] or 0,
            counts["seed"] or 0,
            options.method,
            counts["workers"],
            show,
        )
    except SceneError as refused:
        if refused.key in OPTIONS:
            raise SceneError(OPTIONS[refused.key], refused.value, refused.reason) from None
        raise
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else found)
    return 0
