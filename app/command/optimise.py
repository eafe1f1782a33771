"""The command `impact optimise`: the best values for some keys of a scene, or the best compromises of two figures."""

import json
from argparse import ArgumentParser, Namespace
from typing import Any

import solvers
from solvers import SceneError

from .interrupts import interruptible
from .study import by_key, whole
from .words import text

OPTIONS = {
    name: f"--{name.replace('_', '-')}" for name in ("minimise", "maximise", "such_that", "points", "solves", "seed")
}
WAYS = {"minimise": "smallest", "maximise": "largest"}


def add_arguments(parser: ArgumentParser) -> None:
    """What the command takes beside the scene."""
    parser.add_argument(
        "--vary", action="append", default=[], metavar="KEY=LOW..HIGH[:log]|A,B,...", help=text("help.optimise.vary")
    )
    helps = {"minimise": text("help.optimise.minimise"), "maximise": text("help.optimise.maximise")}
    for way, said in helps.items():  # one list of both, as the first figure that is named leads
        parser.add_argument(
            f"--{way}",
            action="append",
            default=[],
            dest="goals",
            type=lambda figure, way=way: (way, figure),
            metavar="FIGURE",
            help=said,
        )
    parser.add_argument(
        "--such-that", action="append", default=[], metavar="FIGURE<=VALUE", help=text("help.optimise.such-that")
    )
    parser.add_argument("--points", metavar="N", help=text("help.optimise.points"))
    parser.add_argument("--solves", metavar="N", help=text("help.optimise.solves"))
    parser.add_argument("--seed", default="0", metavar="N", help=text("help.optimise.seed"))


def print_optimum(scene: solvers.Scene, options: Namespace) -> int:
    """Print the best values and what they give, or the compromises of two figures; after an interrupt those by then."""
    figures = [figure for _, figure in options.goals]
    if len(figures) > 2:
        raise SceneError(f"--{options.goals[2][0]}", figures[2], text("wanted.two-goals"))
    if len(figures) == 2 and figures[0] == figures[1]:
        raise SceneError(f"--{options.goals[1][0]}", figures[1], text("wanted.another-goal"))
    if len(figures) < 2 and options.points is not None:
        raise SceneError("--points", options.points, text("wanted.beside-points"))
    given = {name: whole(f"--{name}", getattr(options, name)) for name in ("points", "solves", "seed")}
    asked: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    with interruptible() as interrupted:
        asked |= {"such_that": options.such_that, "cancelled": interrupted}
        try:
            vary = by_key("--vary", options.vary)
            if len(figures) == 2:
                goals = {figure: WAYS[way] for way, figure in options.goals}
                found = solvers.pareto(scene, vary, goals, **asked)
            else:
                found = solvers.optimise(scene, vary, **dict(options.goals), **asked)
        except SceneError as refused:
            way = next((way for way, figure in options.goals if figure == refused.value), "minimise")
            key = f"--{way}" if refused.key == "goals" else OPTIONS.get(refused.key, refused.key)
            raise SceneError(key, refused.value, refused.reason) from None
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else found)
    return 130 if interrupted() else 0
