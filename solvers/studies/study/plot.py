"""A study as a picture, and its file."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from ...jit.cache import write_whole
from ...validation import SceneError, allowed
from .study import file_of

PICTURES = (".png", ".svg")


def plot_study(
    dataset: Any,
    figure: str | None = None,
    x: str | None = None,
    y: str | None = None,
    kind: str | None = None,
    out: str | Path | None = None,
) -> Any:
    """A HoloViews object: one figure of the Dataset of a `study`, its first one by default, over its keys.

    Over one key a curve, with a gap and a line where the number of contacts changes (if `contacts` is among the
    figures); over two a map with contour lines, and lines between other numbers of contacts; words, as those of laws
    and methods, have a curve each. `x` and `y`: keys of the axes, of which those with numbers come first; further ones
    are at their first values, which the title names. Of points drawn by chance a scatter over each key, or over `x`,
    coloured by the next key, or by `y`. Axes are of powers where values are a constant factor apart. Points that are
    refused, or have no such figure, are grey crosses. SI units.
    `kind`: "curves", "map" or "points" instead of the usual one; "parallel", a line for each point over all keys and
    figures, coloured by `figure`; "matrix", scatters of all figures over all keys; "bars", the squared rank correlation
    (Spearman) of the figure with each key, the largest first: a key with which the figure rises and falls again has
    a small one. For words, and keys that go together, it is the part of the variance of ranks between their values.
    Beyond 1e5 points scatters and maps have means or counts of cells, curves the lowest and highest of stretches.
    `out`: a file to write, too, .png or .svg, which Matplotlib draws without a window.
    Raises SceneError for a figure or a key that the study does not have, a kind that it has no picture of, and other
    files; ImportError for a file without the extra `plot`; OSError where it cannot be written.
    """
    from ...notebook import study_plots  # loads HoloViews, which nothing else here needs

    return pictured(lambda: study_plots.study(dataset, figure, x, y, kind), out)


def pictured(draw: Callable[[], Any], out: str | Path | None) -> Any:
    """What is drawn; written to a file, too, if there is one. Raises as `plot_study`."""
    if out is None:
        return draw()
    path = Path(out)
    if path.suffix not in PICTURES:
        raise SceneError("out", str(out), allowed("study-file", options=list(PICTURES)))
    if not path.parent.is_dir():
        raise SceneError("out", str(out), allowed("study-folder"))
    from ...notebook import pictures  # loads Matplotlib, which nothing else needs

    pictures.ready()
    drawn = draw()
    write_whole(path, pictures.picture(drawn, path.suffix))
    return drawn


def drawing(dataset: Any, figure: str, x: str | None = None, kind: str | None = None) -> bytes:
    """The picture of `plot_study`, as the file of an SVG. Raises as it does."""
    from ...notebook import pictures, study_plots

    pictures.ready()
    return pictures.picture(study_plots.study(dataset, figure, x, None, kind), ".svg")


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
