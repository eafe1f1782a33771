"""Pictures as PNG and SVG, which HoloViews draws by Matplotlib: in figures of their own, so that no window opens."""

import math
import warnings
from io import BytesIO
from typing import Any

import numpy as np

from .plots import draw_with_bokeh, hv

try:
    import matplotlib
    from matplotlib import pyplot
    from matplotlib.axis import Tick
    from matplotlib.figure import Figure
    from matplotlib.text import Text
except ImportError as missing:
    raise ImportError("PNG and SVG need matplotlib: pip install 'strikewave[plot]'") from missing

ENDINGS = (".png", ".svg")
DOTS = 200  # per inch, of a PNG
MARGINS = 0.75, 0.25, 0.75, 0.55  # inches left, right, below and above what each part draws
BESIDE = 1.1  # inches right of a part with a bar of colours
LOWER = 0.5  # inches below the axes: a legend, if there is a bar
HEAVY = 2_000  # marks or cells, beyond which they are pixels within an SVG


def ready() -> None:
    """Load HoloViews' part for Matplotlib, so that what is drawn from now on has looks for it too."""
    draw_with_bokeh()
    interactive = matplotlib.is_interactive()
    hv.renderer("matplotlib")  # which leaves the current backend, as there is one
    matplotlib.interactive(interactive)


def picture(drawn: Any, ending: str) -> bytes:
    """The file: of ".png" or ".svg". The same bytes for the same picture."""
    interactive = matplotlib.is_interactive()
    try:
        with matplotlib.rc_context({"svg.hashsalt": "strikewave", "axes.formatter.useoffset": False}):
            figure = _figure(drawn)
            _as_written(figure)
            for axes in figure.axes:
                for heavy in axes.collections:
                    values = heavy.get_array()
                    count = len(np.asarray(heavy.get_offsets())) if values is None else np.size(values)
                    heavy.set_rasterized(count > HEAVY)
            form = ending.removeprefix(".")
            metadata = {"Date": None} if form == "svg" else {"Software": None}
            written = BytesIO()
            look = {"dpi": DOTS, "bbox_inches": "tight", "pad_inches": 0.15, "facecolor": "white"}
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", "Glyph", UserWarning)  # signs that no font has stand as boxes
                figure.savefig(written, format=form, metadata=metadata, **look)
    finally:
        if interactive:
            pyplot.ion()  # which HoloViews switches off
    return written.getvalue()


def _figure(drawn: Any) -> Figure:
    """Each part of a layout on axes of its own."""
    parts = list(drawn) if isinstance(drawn, hv.Layout) else [drawn]
    columns = min(drawn._max_cols, len(parts)) if isinstance(drawn, hv.Layout) else 1
    rows = math.ceil(len(parts) / columns)
    sizes = [_inches(part) for part in parts]
    wide, high = max(width for width, _ in sizes), max(height for _, height in sizes)
    left, right, below, above = MARGINS
    right += BESIDE if len(parts) > 1 and any(map(_has_bar, parts)) else 0.0
    whole = columns * (left + wide + right), rows * (below + high + above)
    figure = Figure(figsize=whole)
    if isinstance(drawn, hv.Layout) and (title := _option(drawn, "title")):
        figure.suptitle(title, fontsize=11, y=1.0)
    for number, part in enumerate(parts):
        row, column = divmod(number, columns)
        place = column * (left + wide + right) + left, whole[1] - (row + 1) * (below + high + above) + below
        axes = figure.add_axes((place[0] / whole[0], place[1] / whole[1], wide / whole[0], high / whole[1]))
        hv.renderer("matplotlib").get_plot(part, fig=figure, axis=axes)
        legend = axes.get_legend()
        if legend is not None and _has_bar(part):  # which stands where the legend is
            legend.set_loc("upper right")
            legend.set_bbox_to_anchor((1.0, -LOWER / high), transform=axes.transAxes)
    return figure


def _as_written(figure: Figure) -> None:
    """Titles, labels and legends have their words, whatever stands between two dollars: no formulas. Numbers on axes
    of powers are formulas of Matplotlib's own."""
    numbers = {id(text) for tick in figure.findobj(Tick) for text in tick.findobj(Text)}
    for text in figure.findobj(Text):
        if id(text) not in numbers:
            text.set_parse_math(False)


def _inches(part: Any) -> tuple[float, float]:
    return _option(part, "fig_inches") or (6.0, 3.0)


def _has_bar(part: Any) -> bool:
    every = part if isinstance(part, hv.Overlay) else [part]
    return any(_option(each, "colorbar") for each in every)


def _option(drawn: Any, name: str) -> Any:
    return hv.Store.lookup_options("matplotlib", drawn, "plot").kwargs.get(name)
