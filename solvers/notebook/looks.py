"""How elements look: one set of words for Bokeh, of pages, and for Matplotlib, of PNG and SVG."""

import textwrap
from collections.abc import Callable, Mapping
from typing import Any

from .plots import CLEAR, HEIGHT, LETTERS, WIDTH, hv

PER_INCH = 100  # pixels of a page
POINTS = 72  # of Matplotlib, in an inch
COMMON = ("color", "cmap", "colorbar", "logx", "logy", "alpha")  # which other backends know, too
SINGLE = ("Curve", "Area", "Scatter", "Points", "QuadMesh", "Image", "Bars", "Contours")
BARRED = ("Scatter", "QuadMesh", "Image", "Contours")  # with a bar of colours
Words = Mapping[str, Callable[[Any], Mapping[str, Any]]]

BOKEH: Words = {
    "dashed": lambda width: {"line_width": width, "line_dash": "dashed"},
    "line": lambda width: {"line_width": width},
    "box": lambda pixels: {"width": pixels[0], "height": pixels[1]},
    "small": lambda size: {"fontsize": {"title": f"{size}pt"} if size > 10 else f"{size}pt"},
    "end": lambda pixels: {},  # of a bar of error: its own are wide enough
    "text": lambda size: {
        "text_font_size": f"{size}pt",
        "text_align": "left",
        "text_baseline": "middle",
        "text_color": "black",
    },
}
MATPLOTLIB: Words = {
    "size": lambda pixels: {"s": (pixels * POINTS / PER_INCH) ** 2},
    "marker": lambda name: {"marker": {"square": "s"}.get(name, name), "linewidth": 1.0, "edgecolors": None},
    "cmap": lambda name: {"cmap": {"Category10": "tab10"}.get(name, name)},
    "dashed": lambda width: {"linewidth": width, "linestyle": "--"},
    "line": lambda width: {"linewidth": width},
    "box": lambda pixels: {"fig_inches": (pixels[0] / PER_INCH, pixels[1] / PER_INCH), "aspect": "auto"},
    "small": lambda size: {"fontsize": {"title": size, "labels": min(size, 10), "ticks": min(size, 9)}},
    "end": lambda pixels: {"capsize": pixels},
    "text": lambda size: {"size": size, "horizontalalignment": "left", "verticalalignment": "center", "color": "black"},
}
WORDS = {"bokeh": BOKEH, "matplotlib": MATPLOTLIB}


def dressed(drawn: Any, **look: Any) -> Any:
    """With this look under each backend that is loaded, as pictures may be drawn by another one than the current."""
    for backend in hv.Store.renderers:
        given = _said(backend, look)
        drawn = drawn.opts(**given, backend=backend) if given else drawn
    return drawn


def _said(backend: str, look: Mapping[str, Any]) -> dict[str, Any]:
    """In the words of a backend."""
    if backend not in WORDS:
        return {name: value for name, value in look.items() if name in COMMON}
    words, given = WORDS[backend], {}
    for name, value in look.items():
        given |= words[name](value) if name in words else {name: value}
    return given


def headed(drawn: Any, title: str, about: str, width: int = WIDTH, height: int = HEIGHT) -> Any:
    """One picture with its title and size in pixels, the legend beside it; of a Layout each part."""
    label = f"{title or 'Scene'}, {about}"
    drawn = drawn.relabel(label)
    look = {"title": _filled(label, width), "box": (width, height), "small": 11}
    return _each(drawn, look)


def small(drawn: Any, title: str, about: str, width: int, height: int) -> Any:
    """Many small pictures (a Layout) below one title."""
    look = {"title": "", "box": (width, height), "small": 8}
    whole = _each(drawn, look)
    for backend in hv.Store.renderers:
        if backend in WORDS:
            said = {"title": _filled(f"{title or 'Scene'}, {about}", 2 * width), "backend": backend}
            shown = {"show_title": True, "fontsize": {"title": "11pt"}} if backend == "bokeh" else {}
            whole = whole.opts(hv.opts.Layout(**said, **shown))
    return whole


def _filled(label: str, width: int) -> str:
    lines = textwrap.fill(label, LETTERS * width // WIDTH)
    return lines.replace("{", "{{").replace("}", "}}")  # HoloViews fills in what is in braces


def _each(drawn: Any, look: Mapping[str, Any]) -> Any:
    for backend in hv.Store.renderers:
        if backend not in WORDS:
            continue
        known = {**_said(backend, look), "backend": backend}
        drawn = drawn.opts(*(getattr(hv.opts, kind)(**known) for kind in SINGLE))
        drawn = drawn.opts(hv.opts.Overlay(**known, legend_position="right"))
        if backend == "bokeh":
            bar = {"colorbar_opts": {"title_standoff": CLEAR}, "backend": backend}
            drawn = drawn.opts(*(getattr(hv.opts, kind)(**bar) for kind in BARRED))
            drawn = drawn.opts(hv.opts.Layout(show_title=False, backend=backend))
    return drawn
