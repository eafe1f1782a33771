"""The commands `impact export-static` and `impact wasm`: what browsers answer without a server."""

import argparse
import re
from pathlib import Path

from solvers import SceneError

from .parser import Refused
from .words import text


def add_export_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="FOLDER", help=text("help.export-static.folder"))
    parser.add_argument("--laboratory", default="", metavar="URL", help=text("help.export-static.laboratory"))
    parser.add_argument("--lessons", action="store_true", help=text("help.export-static.lessons"))
    parser.set_defaults(run=_export)


def add_wasm_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--list", action="store_true", required=True, help=text("help.wasm.list"))
    parser.set_defaults(run=_list)


def _export(options: argparse.Namespace) -> int:
    if options.laboratory and not re.fullmatch(r"https?://[^\s/?#]+(/[^\s?#]*)?", options.laboratory):
        raise SceneError("--laboratory", options.laboratory, text("wanted.laboratory"))
    from ..serving.folder import NotPacked, OutOfDate, export

    folder = Path(options.folder)
    try:
        done = export(folder, options.laboratory, options.lessons)
    except OutOfDate:
        raise Refused(text("run.kernels-out-of-date")) from None
    except NotPacked:
        raise Refused(text("run.not-packed")) from None
    except OSError as error:
        raise SceneError("FOLDER", options.folder, text("wanted.own-folder", why=error.strerror)) from None
    size = done.bytes / 1000
    counts = {"scenes": done.scenes, "all": done.of, "lessons": done.lessons}
    print(text("run.exported", page=str(folder / "index.html"), size=size, **counts))
    return 0


def _list(options: argparse.Namespace) -> int:
    from ..choices.choices import SCENES
    from ..wasm.covered import covered_of

    names = covered_of(SCENES)
    for name in names:
        print(name)
    print(text("run.covered", count=len(names), all=len(SCENES)))
    return 0
