"""The points of a study, one after another: scatters, all scatters at once, lines over all keys, ranked bars."""

import json
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..validation import SceneError, allowed
from .looks import dressed, headed, small
from .plots import WIDTH, hv
from .study_parts import (
    CELLS,
    MANY,
    REFUSED,
    WORDS,
    by_factor,
    cells_of,
    counted,
    dimension,
    known,
    marks,
    numbers,
    varied,
    wordy,
)

FEW_CELLS = 60, 45  # of one of many scatters
CROSSES = 500  # of refused points, of so many
LINES = 2_000  # of parallel coordinates, beyond which they are counted in cells
COLUMNS = 30  # of cells between two axes
LEAST_RANKED, LEAST_EACH = 10, 4  # points of which ranks say something, and for each key or word
MOST_NUMBERS = 50_000_000  # of a plane over all keys
SMALL = 300, 220  # pixels of one of many scatters
PAIRED = "saltelli"  # points of `solvers.uncertain`


# --- scatters ---------------------------------------------------------------------------------------------------------


def points(found: Any, figure: str, keys: list[str], x: str | None, y: str | None, title: str) -> Any:
    """The figure over each key, or over the one chosen; coloured by the next key, or by the one chosen."""
    about = figure.replace("_", " ")
    if x is not None:
        others = [key for key in keys if key != x]
        return headed(_cloud(found, figure, x, y or (others[0] if others else None), y), title, about)
    after = dict(zip(keys, [*keys[1:], keys[0]], strict=True))
    drawn = [_cloud(found, figure, key, y if y is not None and y != key else after[key], y) for key in keys]
    return headed(drawn[0] if len(drawn) == 1 else hv.Layout(drawn).cols(2), title, about)


def _cloud(found: Any, figure: str, x: str, colour: str | None, chosen: str | None = None) -> Any:
    """Beyond `MANY` points: how many there are in cells, or there the mean of the key that is `chosen` as colour."""
    axis, value = dimension(found[x]), dimension(found[figure])
    there, refused = known(found, figure), found.refused.values != ""
    heights = found[figure].values
    if there.sum() > MANY:
        number = chosen is not None and chosen != x and not wordy(found[chosen])
        drawn = counted(found, x, figure, CELLS, chosen if number else None)
        if not refused.any():
            return drawn
        at = np.unique(numbers(found[x].values)[0][refused])
        at = at[:: max(1, at.size // CROSSES)]
        crosses = marks(at, np.full(at.size, heights[there].min()), [axis], value, REFUSED)
        return hv.Overlay([drawn, dressed(crosses, logx=not wordy(found[x]) and by_factor(found[x].values))])
    places = found[x].values
    places = np.array([str(each) for each in places]) if wordy(found[x]) else places.astype(float)
    logs = {} if wordy(found[x]) else {"logx": by_factor(places)}
    if colour is None or colour == x:
        drawn = hv.Scatter((places[there], heights[there]), axis, value)
    else:
        shade = found[colour].values[there]
        shade = np.array([str(each) for each in shade]) if wordy(found[colour]) else shade.astype(float)
        drawn = hv.Scatter((places[there], heights[there], shade), axis, [value, dimension(found[colour])])
        map_of = "Category10" if wordy(found[colour]) else "viridis"
        drawn = dressed(drawn, color=colour, colorbar=not wordy(found[colour]), cmap=map_of)
    drawn = dressed(drawn, size=4, **logs)
    if not refused.any():
        return drawn
    lowest = float(heights[there].min()) if there.any() else 0.0
    crosses = marks(places[refused], np.full(refused.sum(), lowest), [axis], value, REFUSED)
    return hv.Overlay([drawn, dressed(crosses, **logs)])


def matrix(found: Any, figure: str, title: str) -> Any:
    """Each figure (down) over each key (across)."""
    figures, keys = _figures(found), [str(key) for key in found.coords if key != "point"]
    drawn = []
    for name in (figure, *(each for each in figures if each != figure)):
        there = known(found, name)
        if not there.any():
            continue
        for key in keys:
            if there.sum() > MANY:
                drawn.append(dressed(counted(found, key, name, FEW_CELLS), colorbar=False))
                continue
            across, words = numbers(found[key].values)
            part = hv.Scatter((across[there], found[name].values[there]), dimension(found[key]), dimension(found[name]))
            ticks = {"xticks": list(enumerate(words))} if words else {"logx": by_factor(across)}
            drawn.append(dressed(part, size=3, alpha=0.6, **ticks))
    _some(drawn, figure)
    return small(hv.Layout(drawn).cols(len(keys)), title, "figures over keys", *SMALL)


def _figures(found: Any) -> list[str]:
    return [str(name) for name in found.data_vars if name not in WORDS]


def _some(there: Any, figure: str) -> None:
    if not len(there):
        raise SceneError("figure", figure, allowed("figure-of-some"))


# --- parallel coordinates ---------------------------------------------------------------------------------------------


def parallel(found: Any, figure: str, title: str) -> Any:
    """A line for each point, over all keys and figures, coloured by one figure."""
    there = np.nonzero(known(found, figure))[0]
    _some(there, figure)
    names = [str(key) for key in found.coords if key != "point"] + [each for each in _figures(found) if each != figure]
    heights, said, ticks = [], [], []
    for place, name in enumerate([*names, figure]):
        height, below, above, log = _scaled(found[name].values[there])
        heights.append(height)
        said += [(place, -0.07, below), (place, 1.07, above)]
        ticks.append((place, dimension(found[name]).pprint_label + (", log" if log else "")))
    values, shade = np.array(heights), dimension(found[figure])
    axis, up = hv.Dimension("axis", label=" "), hv.Dimension("height", label="from the lowest to the highest")
    colours = found[figure].values[there]
    if there.size > LINES:
        drawn = _crowd(values, colours, [axis, up], shade)
    else:
        order = np.arange(len(values), dtype=float)
        lines = [
            {axis.name: order, up.name: line, figure: colour} for line, colour in zip(values.T, colours, strict=True)
        ]
        drawn = dressed(hv.Contours(lines, [axis, up], shade), color=figure, cmap="viridis", colorbar=True, line=1)
    labels = dressed(hv.Labels(said, [axis, up], "text"), text=8)
    posts = hv.Segments([(place, 0.0, place, 1.0) for place, _ in ticks], [axis, up, "x1", "y1"])
    whole = hv.Overlay([drawn, dressed(posts, color="black", line=1), labels])
    look = {"xticks": ticks, "yaxis": None, "xlim": (-0.2, len(values) - 0.4), "ylim": (-0.15, 1.15), "xrotation": 20}
    width = max(WIDTH, 130 * len(values))
    about = f"{figure.replace('_', ' ')} and all keys" + (", means of lines" if there.size > LINES else "")
    return headed(dressed(whole, **look), title, about, width, 420)


def _scaled(values: np.ndarray) -> tuple[np.ndarray, str, str, bool]:
    """Between 0 and 1; what the lowest and the highest are; and whether it is by powers, as `by_factor` says."""
    height, words = numbers(values)
    finite = height[np.isfinite(height)]
    if not finite.size:
        return height, "", "", False
    low, high = float(finite.min()), float(finite.max())
    ends = (words[int(low)], words[int(high)]) if words else (f"{low:.4g}", f"{high:.4g}")
    if low == high:
        return np.where(np.isfinite(height), 0.5, np.nan), *ends, False
    log = words is None and by_factor(finite)
    if log:
        height, low, high = np.log(height), np.log(low), np.log(high)
    return (height - low) / (high - low), *ends, log


def _crowd(heights: np.ndarray, colours: np.ndarray, keys: Sequence[Any], shade: Any) -> Any:
    """The mean of the figure over all lines (axes, points) through each cell."""
    cells = 150
    mesh = np.full((cells, COLUMNS * (len(heights) - 1)), np.nan)
    for number in range(mesh.shape[1]):
        axis, part = divmod(number, COLUMNS)
        share = (part + 0.5) / COLUMNS
        height = (1.0 - share) * heights[axis] + share * heights[axis + 1]
        there = np.isfinite(height)
        cell = np.minimum((height[there] * cells).astype(int), cells - 1)
        count = np.bincount(cell, minlength=cells).astype(float)
        mesh[:, number] = np.bincount(cell, colours[there], cells) / np.where(count > 0.0, count, np.nan)
    sides = np.linspace(0.0, len(heights) - 1.0, mesh.shape[1] + 1), np.linspace(0.0, 1.0, cells + 1)
    return cells_of(sides, mesh, keys, shade)


# --- what matters -----------------------------------------------------------------------------------------------------


def bars(found: Any, figure: str, title: str) -> Any:
    """Squared rank correlations of the figure with each key, the largest first."""
    found = _independent(found)
    there = known(found, figure)
    columns = {",".join(keys): _column(found, keys, there) for keys in varied(found)}
    slopes = sum(int(values.max(initial=0)) + 1 if grouped else 1 for values, grouped in columns.values())
    count, least = int(there.sum()), max(LEAST_RANKED, LEAST_EACH * slopes)
    if count < least:
        raise SceneError("kind", "bars", allowed("points-to-rank", least=least, count=count))
    values = found[figure].values[there]
    if np.ptp(values) <= 1e-12 * np.abs(values).max():
        raise SceneError("figure", figure, allowed("figure-that-varies"))
    up = ranks(values)
    shares = {name: _share(*column, up) for name, column in columns.items()}
    together = f", all keys together {_together(columns.values(), up):.2f}" if slopes * count <= MOST_NUMBERS else ""
    ranked = sorted(shares.items(), key=lambda each: each[1])  # bars begin below
    axis = hv.Dimension("key", label=" ")
    drawn = hv.Bars(ranked, axis, hv.Dimension("share", label="squared rank correlation (Spearman)"))
    named = figure.replace("_", " ")
    return barred(drawn, title, f"{named}: {count} points{together}")


def barred(drawn: Any, title: str, about: str) -> Any:
    """Bars that lie, with their size."""
    count = len(drawn if isinstance(drawn, hv.Bars) else next(iter(drawn)))
    return headed(dressed(drawn, invert_axes=True), title, about, WIDTH, 140 + 40 * count)


def _independent(found: Any) -> Any:
    """Of the points of `solvers.uncertain`, which repeat values, the first two samples."""
    design = json.loads(found.attrs["design"])
    if design["sample"] != PAIRED:
        return found
    return found.isel(point=slice(0, 2 * found.sizes["point"] // (len(design["vary"]) + 2)))


def _column(found: Any, keys: Sequence[str], there: np.ndarray) -> tuple[np.ndarray, bool]:
    """Ranks of a key; of words, or keys that go together, the number of their value at each point, and True."""
    if len(keys) == 1 and not wordy(found[keys[0]]):
        return ranks(found[keys[0]].values[there].astype(float)), False
    parts = np.stack([numbers(found[key].values[there])[0] for key in keys])
    return np.unique(parts, axis=1, return_inverse=True)[1].ravel(), True


def _share(values: np.ndarray, grouped: bool, up: np.ndarray) -> float:
    """Part of the variance of ranks that a line over the key has; of groups, that between their means."""
    heights = up - up.mean()
    if grouped:
        size = np.bincount(values)
        return float((np.bincount(values, heights) ** 2 / size).sum() / (heights @ heights))
    centred = values - values.mean()
    spread = float(centred @ centred)
    return float((centred @ heights) ** 2 / (spread * (heights @ heights))) if spread > 0.0 else 0.0


def _together(columns: Iterable[tuple[np.ndarray, bool]], up: np.ndarray) -> float:
    """The same of a plane over all keys."""
    parts = [values == np.arange(values.max() + 1)[:, None] if grouped else values[None] for values, grouped in columns]
    across, heights = np.concatenate(parts).astype(float), up - up.mean()
    across -= across.mean(1, keepdims=True)
    slopes = np.linalg.lstsq(across @ across.T, across @ heights, rcond=1e-12)[0]
    return float(slopes @ (across @ heights) / (heights @ heights))


def ranks(values: np.ndarray) -> np.ndarray:
    """From 1 on; equal ones have the mean of theirs."""
    _, number, count = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(count)
    return (last - 0.5 * (count - 1))[number]
