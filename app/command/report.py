"""The command `impact report`: one impact, or a study, as a page of paper to hand on."""

import json
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import solvers
from solvers import SceneError
from solvers.studies.report.page import checked
from solvers.studies.study.study import ENDINGS
from solvers.studies.uncertain import USUAL_SAMPLES

from .study import by_key, show, whole
from .words import text

OPTIONS = {
    "tolerances": "--tolerance",
    "vary": "--tolerance",
    "figures": "--figure",
    "out": "--out",
    "page": "--page",
    "study": "file",
}
OPTIONS |= {name: f"--{name}" for name in ("points", "seed", "workers")}
OF_SCENES = {"changes": "--set", "tolerance": "--tolerance", "method": "--method"}
OF_SCENES |= {name: f"--{name}" for name in ("points", "seed", "workers")}


def add_arguments(parser: ArgumentParser) -> None:
    """What the command takes beside the scene."""
    law = "KEY=5%%|LAW(...)|LOW..HIGH"
    parser.add_argument("--tolerance", action="append", default=[], metavar=law, help=text("help.report.tolerance"))
    parser.add_argument("--figure", action="append", metavar="NAME", help=text("help.report.figure"))
    parser.add_argument("--method", metavar="NAME", help=text("help.report.method"))
    parser.add_argument("--points", metavar="N", help=text("help.report.points"))
    parser.add_argument("--seed", metavar="N", help=text("help.study.seed"))
    parser.add_argument("--workers", metavar="N", help=text("help.study.workers"))
    parser.add_argument("--page", default="", metavar="URL", help=text("help.report.page"))
    parser.add_argument("--out", metavar="FILE.html", help=text("help.report.out"))


def print_any(
    options: Namespace,
    read: Callable[[Namespace], solvers.Scene],
    parse: Callable[[list[str]], Mapping[str, Any]],
) -> int:
    """Of a study, where a file of one is named; else of the scene, which is read and its changes checked first."""
    if Path(options.scene).suffix in ENDINGS:
        return _print_study_report(options)
    read(options)
    return print_report(parse(options.changes), options)


def _print_study_report(options: Namespace) -> int:
    """Write that of a study, and print where it is."""
    from solvers.studies.report.study import study_report
    from solvers.studies.study.plot import study_of

    given = next((name for name in OF_SCENES if getattr(options, name) not in (None, [])), None)
    if given is not None:
        raise SceneError(OF_SCENES[given], getattr(options, given), text("wanted.of-scenes"))
    try:
        out = _out(options)
        name = f"{Path(options.scene).stem}.toml"
        found = study_report(study_of(options.scene), options.figure, options.page, name)
    except SceneError as refused:
        raise _by_option(refused) from None
    return _written(found, out, options)


def print_report(changes: Mapping[str, Any], options: Namespace) -> int:
    """Write it, and print where it is; `changes` of the scene are checked already."""
    points, seed = whole("--points", options.points), whole("--seed", options.seed)
    try:
        out = _out(options)
        tolerances = by_key("--tolerance", options.tolerance) if options.tolerance else None
        found = solvers.report(
            options.scene,
            tolerances,
            options.figure,
            options.method,
            changes=changes,
            points=USUAL_SAMPLES if points is None else points,
            seed=0 if seed is None else seed,
            workers=whole("--workers", options.workers),
            page=options.page,
            progress=show,
        )
    except SceneError as refused:
        raise _by_option(refused) from None
    return _written(found, out, options)


def _out(options: Namespace) -> Path:
    return checked(f"{options.scene}.html" if options.out is None else options.out)


def _written(found: Any, out: Path, options: Namespace) -> int:
    """Save it and say where; with --json all that is in it."""
    try:
        found.save(out)
    except OSError as error:
        raise SceneError("--out", str(out), text("wanted.writable", why=error.strerror or str(error))) from None
    except ImportError:  # HoloViews is always there
        raise SceneError("--out", str(out), text("wanted.matplotlib")) from None
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
