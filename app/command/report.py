"""The command `impact report`: one impact as a page of paper to hand on."""

import json
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import solvers
from solvers import SceneError
from solvers.studies.report.report import checked
from solvers.studies.uncertain import USUAL_SAMPLES

from .study import by_key, show, whole
from .words import text

OPTIONS = {"tolerances": "--tolerance", "vary": "--tolerance", "figures": "--figure", "out": "--out", "page": "--page"}
OPTIONS |= {name: f"--{name}" for name in ("points", "seed", "workers")}


def add_arguments(parser: ArgumentParser) -> None:
    """What the command takes beside the scene."""
    law = "KEY=5%%|LAW(...)|LOW..HIGH"
    parser.add_argument("--tolerance", action="append", default=[], metavar=law, help=text("help.report.tolerance"))
    parser.add_argument("--figure", action="append", metavar="NAME", help=text("help.report.figure"))
    parser.add_argument("--method", metavar="NAME", help=text("help.report.method"))
    parser.add_argument("--points", default=str(USUAL_SAMPLES), metavar="N", help=text("help.report.points"))
    parser.add_argument("--seed", default="0", metavar="N", help=text("help.study.seed"))
    parser.add_argument("--workers", metavar="N", help=text("help.study.workers"))
    parser.add_argument("--page", default="", metavar="URL", help=text("help.report.page"))
    parser.add_argument("--out", metavar="FILE.html", help=text("help.report.out"))


def print_report(scene: solvers.Scene, changes: Mapping[str, Any], options: Namespace) -> int:
    """Write it, and print where it is; `scene`: with the changes, already checked."""
    try:
        out = checked(f"{options.scene}.html" if options.out is None else options.out)
        tolerances = by_key("--tolerance", options.tolerance) if options.tolerance else None
        found = solvers.report(
            options.scene,
            tolerances,
            options.figure,
            options.method,
            changes=changes,
            points=whole("--points", options.points) or 0,
            seed=whole("--seed", options.seed) or 0,
            workers=whole("--workers", options.workers),
            page=options.page,
            progress=show,
        )
    except SceneError as refused:
        raise _by_option(refused) from None
    return _written(found, out, options)


def _written(found: Any, out: Path, options: Namespace) -> int:
    """Save it and say where; with --json all that is in it."""
    try:
        found.save(out)
    except OSError as error:
        raise SceneError("--out", str(out), text("wanted.writable", why=error.strerror or str(error))) from None
    if options.json:
        print(json.dumps(found.table() | {"out": str(out)}, indent=1, allow_nan=False))
    else:
        print(text("plot.written", out=str(out)))
    return 0


def _by_option(refused: SceneError) -> SceneError:
    """Named as it was typed."""
    if refused.key in OPTIONS:
        return SceneError(OPTIONS[refused.key], refused.value, refused.reason)
    return refused
