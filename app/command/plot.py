"""The command `impact plot STUDY`: one figure of a study, as a page that needs nothing else, or as PNG or SVG."""

from argparse import ArgumentParser, Namespace
from html import escape
from pathlib import Path
from typing import Any

import solvers
from solvers import SceneError
from solvers.jit.cache import write_whole

from .words import text

ENDINGS = (".html", ".png", ".svg")
KINDS = ("curves", "map", "points", "parallel", "matrix", "bars")
PAGE = "<!DOCTYPE html><meta charset='utf-8'><title>{title}</title>"
WIDEST, HEIGHT = 1_100, 480  # px of a single picture, which is as wide as its window


def add_command(commands: Any) -> None:
    """With its options."""
    parser: ArgumentParser = commands.add_parser("plot", help=text("help.plot.about"))
    parser.add_argument("file", metavar="FILE", help=text("help.plot.file"))
    parser.add_argument("--figure", metavar="NAME", help=text("help.plot.figure"))
    parser.add_argument("--x", metavar="KEY", help=text("help.plot.x"))
    parser.add_argument("--y", metavar="KEY", help=text("help.plot.y"))
    parser.add_argument("--kind", metavar="|".join(KINDS), help=text("help.plot.kind"))
    parser.add_argument("--out", metavar="FILE.html|.png|.svg", help=text("help.plot.out"))
    parser.set_defaults(run=print_plot)


def print_plot(options: Namespace) -> int:
    """Draw it, write it, and print where it is."""
    from solvers.studies.study.plot import PICTURES, study_of

    out = Path(f"{options.file}.html" if options.out is None else options.out)
    if out.suffix not in ENDINGS:
        raise SceneError("--out", options.out, text("wanted.ending", endings=text("wanted.or").join(ENDINGS)))
    found = study_of(options.file)
    picture = out.suffix in PICTURES
    try:
        asked = options.figure, options.x, options.y, options.kind
        drawn = solvers.plot_study(found, *asked, out if picture else None)
        if not picture:
            write_whole(out, _page(drawn, str(options.file)))
    except SceneError as refused:
        if refused.key in ("figure", "x", "y", "kind", "out"):
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    except OSError as error:
        raise SceneError("--out", str(out), text("wanted.writable", why=error.strerror or str(error))) from None
    except ImportError:  # HoloViews is always there
        raise SceneError("--out", str(out), text("wanted.no-matplotlib")) from None
    print(text("plot.written", out=str(out)))
    return 0


def _page(drawn: Any, title: str) -> str:
    """All scripts are in it, those of Bokeh alone; its widgets have the title of many pictures."""
    from bokeh.embed import components
    from bokeh.models import Plot
    from bokeh.resources import Resources

    from solvers.notebook.plots import rendered

    shown = rendered(drawn)
    if isinstance(shown, Plot):
        shown.update(sizing_mode="stretch_width", max_width=WIDEST, height=HEIGHT)
    parts: list[Any] = ["bokeh"] if isinstance(shown, Plot) else ["bokeh", "bokeh-widgets"]
    begin, place = components(shown, wrap_script=False)
    scripts = [*Resources(mode="inline", components=parts).js_raw, begin]
    return "\n".join([PAGE.format(title=escape(title)), place, *(f"<script>{each}</script>" for each in scripts)])
