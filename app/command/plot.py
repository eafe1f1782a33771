"""The command `impact plot FILE`: one figure of a study as a page that needs nothing else."""

from argparse import ArgumentParser, Namespace
from html import escape
from pathlib import Path
from typing import Any

import solvers
from solvers import SceneError

from .words import text

PAGE = "<!DOCTYPE html><meta charset='utf-8'><title>{title}</title>"
WIDEST, HEIGHT = 1_100, 480  # px of a single picture, which is as wide as its window


def add_command(commands: Any) -> None:
    """With its options."""
    parser: ArgumentParser = commands.add_parser("plot", help=text("help.plot.about"))
    parser.add_argument("file", metavar="FILE", help=text("help.plot.file"))
    parser.add_argument("--figure", metavar="NAME", help=text("help.plot.figure"))
    parser.add_argument("--x", metavar="KEY", help=text("help.plot.x"))
    parser.add_argument("--y", metavar="KEY", help=text("help.plot.y"))
    parser.add_argument("--out", metavar="FILE.html", help=text("help.plot.out"))
    parser.set_defaults(run=print_plot)


def print_plot(options: Namespace) -> int:
    """Draw it, write it, and print where it is."""
    from solvers.studies.study.plot import study_of

    out = Path(f"{options.file}.html" if options.out is None else options.out)
    if out.suffix != ".html":
        raise SceneError("--out", options.out, text("wanted.page-file"))
    found = study_of(options.file)
    try:
        drawn = solvers.plot_study(found, options.figure, options.x, options.y)
    except SceneError as refused:
        if refused.key in ("figure", "x", "y"):
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    try:
        _write(drawn, str(options.file), out)
    except OSError as error:
        raise SceneError("--out", str(out), text("wanted.writable", why=error.strerror or str(error))) from None
    print(text("plot.written", out=str(out)))
    return 0


def _write(drawn: Any, title: str, out: Path) -> None:
    """All scripts are in the file, those of Bokeh alone. Raises OSError where it cannot be written."""
    from bokeh.embed import components
    from bokeh.models import Plot
    from bokeh.resources import Resources

    from solvers.notebook.plots import rendered

    shown = rendered(drawn)
    if isinstance(shown, Plot):
        shown.update(sizing_mode="stretch_width", max_width=WIDEST, height=HEIGHT)
    begin, place = components(shown, wrap_script=False)
    scripts = [*Resources(mode="inline", components=["bokeh"]).js_raw, begin]
    page = "\n".join([PAGE.format(title=escape(title)), place, *(f"<script>{each}</script>" for each in scripts)])
    out.write_text(page, "utf-8")
