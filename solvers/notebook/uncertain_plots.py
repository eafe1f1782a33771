"""What a figure's spread is owed to, as bars."""

from typing import Any

from ..validation import SceneError, allowed, choice
from .looks import dressed
from .plots import Drawn, draw_with_bokeh, hv
from .study_points import barred


def uncertain(found: Any, figure: str | None) -> Drawn:
    """See `Uncertain.plot`."""
    figure = choice("figure", figure or next(iter(found.figures)), found.figures)
    outcome = found.figures[figure]
    if not outcome.shares:
        raise SceneError("figure", figure, allowed("figure-with-indices"))
    draw_with_bokeh()
    ranked = outcome.ranking[::-1]  # bars begin below
    axis, value = hv.Dimension("input", label=" "), hv.Dimension("total", label="total index of Sobol")
    bars = hv.Bars([(key, outcome.shares[key].total) for key in ranked], axis, value)
    bars = dressed(bars, alpha=0.5)  # Bokeh draws what is within them below
    spans = []
    for key in ranked:
        share = outcome.shares[key]
        spans.append((key, share.total, share.total - share.total_within[0], share.total_within[1] - share.total))
    within = hv.ErrorBars(spans, axis, [value, "below", "above"])
    drawn = hv.Overlay([bars, dressed(within, end=4)])
    named = figure.replace("_", " ")
    return barred(drawn, found.title, f"{named}: {outcome.samples} base samples, 95 % intervals")
