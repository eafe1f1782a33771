"""What the figures of analyses share.

Python says what a figure looks like; the browser fetches that once, fills its named sources and ranges from answers,
and zooms, reads and saves it by itself. So no session holds a figure, and nobody can change one on the server.
Bokeh is loaded when a figure is drawn, and not in processes that only solve.
"""

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from solvers.text.catalogue import Catalogue

HEIGHT = 300  # pixels
PLAIN_DECADES = 4  # of a logarithmic axis that are written as 0.001 to 1000
INK, FAINT, PICKED = "#1c2733", "#5b6c7d", "#c81e4a"
COLOURS = ("#0b4f8a", "#d9730d", "#2e7d4f", "#a4243b", "#7a5ea8", "#b08900", "#4f9bd8", "#7c9a54", "#6b7785", "#33475b")


def blank(name: str, title: str, x: str, y: str, beside: Any = None, height: int = HEIGHT, **axes: Any) -> Any:
    """An empty plot, its ranges called `name`-x and `name`-y, its axes `name`-across and `name`-up.

    It shares the range along x with the plot `beside`.

    A drag zooms into what it has passed; the wheel scrolls the page, and zooms with Ctrl, as does a pinch.
    """
    from bokeh.models import BoxZoomTool, PanTool, Range1d, ResetTool, SaveTool, WheelZoomTool
    from bokeh.plotting import figure

    box, wheel = BoxZoomTool(), WheelZoomTool(modifiers="ctrl")
    plot: Any = figure(
        name=name,
        title=title,
        x_axis_label=x,
        y_axis_label=y,
        x_range=beside.x_range if beside else Range1d(start=1.0, end=10.0, name=f"{name}-x"),
        y_range=Range1d(start=1.0, end=10.0, name=f"{name}-y"),
        tools=[PanTool(), box, wheel, ResetTool(), SaveTool(filename=f"strikewave-{name}")],
        active_drag=box,
        active_scroll=wheel,
        toolbar_location="above",
        height=height,
        sizing_mode="stretch_width",
        output_backend="canvas",
        **axes,
    )
    plot.toolbar.logo = None
    for axis, kind in ((plot.xaxis, "x_axis_type"), (plot.yaxis, "y_axis_type")):
        if axes.get(kind) == "log":
            axis.formatter.min_exponent = PLAIN_DECADES
    plot.title.name, plot.xaxis.name, plot.yaxis.name = f"{name}-title", f"{name}-across", f"{name}-up"
    return plot


def source(name: str, *columns: str) -> Any:
    """Columns that the browser fills."""
    from bokeh.models import ColumnDataSource

    return ColumnDataSource(name=name, data={column: [] for column in columns})


def hover(plot: Any, renderers: Iterable[Any], tooltips: Mapping[str, str], **options: Any) -> None:
    """Say the values under the pointer: for each name what is written, with columns as `@column`."""
    from bokeh.models import HoverTool

    rows = (f'<div><span style="color: {FAINT}">{name}</span> {value}</div>' for name, value in tooltips.items())
    named = {"name": f"{plot.name}-hover", "visible": False} | options
    plot.add_tools(HoverTool(renderers=list(renderers), tooltips="".join(rows), **named))


def legend(plot: Any, items: Iterable[tuple[Any, list[Any]]]) -> None:
    """Below the plot, where a phone has room for it: text, or `{"field": column}`, and the renderers of each entry."""
    from bokeh.models import Legend, LegendItem

    entries = [
        LegendItem(label=label, renderers=renderers, name=f"{plot.name}-key-{number}")
        for number, (label, renderers) in enumerate(items)
    ]
    plot.add_layout(
        Legend(items=entries, name=f"{plot.name}-legend", orientation="horizontal", location="left"), "below"
    )


def cursor(plot: Any, name: str) -> None:
    """An upright line at one place, that the browser moves."""
    from bokeh.models import Span

    plot.add_layout(Span(name=name, dimension="height", line_color=PICKED, line_width=1.5, level="overlay"))


def drawn(draw: Callable[[Catalogue], list[Any]], texts: Catalogue) -> str:
    """The plots as JSON: the document that holds them, and the id of each by its name."""
    from bokeh.document import Document

    document, plots = Document(), draw(texts)
    for plot in plots:
        document.add_root(plot)
    return json.dumps({"doc": document.to_json(deferred=False), "roots": {plot.name: plot.id for plot in plots}})
