"""A study as a picture, and its file."""

from typing import Any

from ...validation import SceneError, allowed
from .study import file_of


def plot_study(dataset: Any, figure: str | None = None, x: str | None = None, y: str | None = None) -> Any:
    """A HoloViews object: one figure of the Dataset of a `study`, its first one by default, over its keys.

    Over one key a curve, with a gap and a line where the number of contacts changes (if `contacts` is among the
    figures); over two a map with contour lines, and lines between other numbers of contacts; words, as those of laws
    and methods, have a curve each. `x` and `y`: keys of the axes, of which those with numbers come first; further ones
    are at their first values, which the title names. Of points drawn by chance a scatter over each key, or over `x`,
    coloured by the next key, or by `y`. Axes are of powers where values are a constant factor apart. Points that are
    refused, or have no such figure, are grey crosses. SI units.
    Raises SceneError for a figure or a key that the study does not have.
    """
    from ...notebook import study_plots  # loads HoloViews, which nothing else here needs

    return study_plots.study(dataset, figure, x, y)


def study_of(name: str) -> Any:
    """The Dataset of a file that `study` has written. Raises SceneError if it is none; ImportError without xarray."""
    from ...notebook import datasets

    path = file_of(name, "file")
    try:
        if "design" in datasets.study_in(path):
            return datasets.read_study(path)
    except (OSError, ValueError, KeyError):
        pass
    raise SceneError("file", name, allowed("study-there"))
