"""The command `impact study`: a scene at many points of its values, into a file."""

import json
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import Any

import solvers
from solvers import SceneError
from solvers.notebook import study_tables
from solvers.studies.study.study import Progress

from .interrupts import interruptible
from .words import text

MOST_ROWS = 10_000  # that are printed where no file is written


def add_arguments(parser: ArgumentParser) -> None:
    """What the command takes beside the scene."""
    values = "KEY=LOW..HIGH[:COUNT][:log]|A,B,..."
    parser.add_argument("--vary", action="append", default=[], metavar=values, help=text("help.study.vary"))
    parser.add_argument(
        "--distribution", action="append", default=[], metavar="KEY=LAW(...)|KEY=5%%", help=text("help.study.law")
    )
    parser.add_argument("--sample", metavar="WORD", help=text("help.study.sample"))
    parser.add_argument("--points", metavar="N", help=text("help.study.points"))
    parser.add_argument("--seed", default="0", metavar="N", help=text("help.study.seed"))
    parser.add_argument("--method", metavar="NAME,...", help=text("help.study.method"))
    parser.add_argument("--figure", action="append", metavar="NAME", help=text("help.study.figure"))
    parser.add_argument("--no-notes", action="store_true", help=text("help.study.no-notes"))
    parser.add_argument("--out", metavar="FILE", help=text("help.study.out"))
    parser.add_argument("--resume", action="store_true", help=text("help.study.resume"))
    parser.add_argument("--workers", metavar="N", help=text("help.study.workers"))
    parser.add_argument("--cluster", metavar="ADDRESS|local:N", help=text("help.study.cluster"))


def print_study(scene: solvers.Scene, options: Namespace) -> int:
    """Solve it, and print how far its figures reach; after an interrupt what is solved by then."""
    methods = [] if options.method is None else [f"method.name={options.method}"]
    vary = by_key("--vary", [*options.vary, *options.distribution, *methods])
    last = Progress(0, 0, 0, 0.0)

    def progress(now: Progress) -> None:
        nonlocal last
        last = now
        show(now)

    with interruptible() as interrupted:
        try:
            found = solvers.study(
                scene,
                vary,
                sample=options.sample,
                points=whole("--points", options.points),
                seed=whole("--seed", options.seed) or 0,
                figures=options.figure,
                notes=not options.no_notes,
                out=options.out,
                resume=options.resume,
                workers=whole("--workers", options.workers),
                cluster=options.cluster,
                progress=progress,
                cancelled=interrupted,
            )
        except OSError as error:
            raise SceneError("--out", options.out, text("wanted.writable", why=error.strerror or str(error))) from None
    _print(found, last, options.out, options.json)
    if interrupted():
        print(text("study.stopped", done=last.done, points=last.points, out=options.out or "none"), file=sys.stderr)
    return 130 if interrupted() else 0


def _print(found: Any, last: Progress, out: str | None, as_json: bool) -> None:
    known = study_tables.summary(found)
    if not as_json:
        print(study_tables.lines(found, known))
        written = out if out and not known["waiting"] else "none"
        print("  " + text("study.took", seconds=last.seconds, resumed=last.resumed, out=written))
        return
    known |= {"resumed": last.resumed, "seconds": last.seconds, "out": out}
    if out is None and known["points"] <= MOST_ROWS:
        known["rows"] = study_tables.rows(found)
    print(json.dumps(known, indent=1, allow_nan=False))


def show(now: Progress) -> None:
    """On a terminal, how far it is."""
    if sys.stderr.isatty():
        known = {"known": now.left is not None, "left": now.left or 0.0}
        line = text("study.progress", done=now.done, points=now.points, **known)
        print(f"\r\033[K{line}" if now.done < now.points else "\r\033[K", end="", file=sys.stderr, flush=True)


def by_key(option: str, given: Sequence[str]) -> dict[str, str]:
    """By key, or keys with commas between them, what is said of it. Raises SceneError for a key that is given twice."""
    found: dict[str, str] = {}
    for each in given:
        key, equals, said = each.partition("=")
        if not equals or not key.strip() or not said.strip():
            raise SceneError(option, each, text("wanted.study"))
        if key.strip() in found:
            raise SceneError(option, each, text("wanted.one-value", before=repr(found[key.strip()])))
        found[key.strip()] = said
    if not found:
        raise SceneError(option, None, text("wanted.study"))
    return found


def whole(name: str, word: str | None) -> int | None:
    """Of an option. Raises SceneError for another word."""
    try:
        return None if word is None else int(word)
    except ValueError:
        raise SceneError(name, word, text("wanted.any-whole")) from None
