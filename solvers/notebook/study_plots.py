"""The Dataset of a study as HoloViews objects: curves, maps, or points where they were drawn by chance."""

import json
import math
import tomllib
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..validation import SceneError, allowed, choice
from .plots import LONG_LEGEND, WIDTH, Drawn, draw_with_bokeh, edges_of, hv, titled

WORDS = ("refused", "reason", "notes")
REFUSED, MISSING, CHANGED = "refused", "no such figure", "other number of contacts"
LEVELS = 8  # contour lines of a map
GREY = "#9a9a9a"


def study(found: Any, figure: str | None, x: str | None, y: str | None) -> Drawn:
    """See `solvers.plot_study`."""
    figure = choice(
        "figure",
        figure or found.attrs["figures"].split()[0],
        [str(name) for name in found.data_vars if name not in WORDS],
    )
    found = gridded(found)
    keys = [str(key) for key in found.coords if key != "point"]
    for name, key in (("x", x), ("y", y)):
        if key is not None:
            choice(name, key, keys)
    if x is not None and x == y:
        raise SceneError("y", y, allowed("another-key", key=x))
    draw_with_bokeh()
    if "point" in found.sizes:
        drawn, about = _points(found, figure, keys, x, y), ""
    else:
        drawn, about = _grid(found, figure, x, y)
    drawn = titled(drawn, _title(found), figure.replace("_", " ") + about)
    return drawn.opts(width=WIDTH + LONG_LEGEND) if _bokeh() and isinstance(drawn, hv.Overlay) else drawn


def gridded(found: Any) -> Any:
    """With a dimension for each axis, where its points form a grid and only come in rows, as from a table."""
    design = json.loads(found.attrs["design"])
    if design["sample"] != "grid" or "point" not in found.sizes:
        return found
    axes = design["vary"]
    sizes = {axis["keys"][0]: len(axis["values"]) for axis in axes}
    columns = {
        key: (axis["keys"][0], np.array(values, object if any(isinstance(each, str) for each in values) else None))
        for axis in axes
        for key, values in zip(axis["keys"], zip(*axis["values"], strict=True), strict=True)
    }
    variables = {
        name: (tuple(sizes), array.values.reshape(tuple(sizes.values())), array.attrs)
        for name, array in found.data_vars.items()
    }
    return type(found)(variables, columns, found.attrs)


def _title(found: Any) -> str:
    return str(tomllib.loads(found.attrs["scene"]).get("title", ""))


def _wordy(array: Any) -> bool:
    return array.dtype.kind not in "iuf"


def _dimension(array: Any) -> Any:
    name = str(array.name)
    known = {"label": array.attrs["long_name"]} if "long_name" in array.attrs else {}
    return hv.Dimension(name, unit=array.attrs.get("units") or None, **known)


def by_factor(values: np.ndarray) -> bool:
    """Whether the axis is one of powers: its values are apart by a constant factor, or unevenly over a hundredfold."""
    values = np.unique(values[np.isfinite(values)])
    if values.size < 2 or values[0] <= 0.0 or (values.size > 2 and np.allclose(np.diff(values), values[1] - values[0])):
        return False
    factors = np.diff(np.log(values))
    even = values.size > 2 and np.allclose(factors, factors[0])
    return even or bool(values[-1] >= 99.9 * values[0])


# --- grids ------------------------------------------------------------------------------------------------------------


def _grid(found: Any, figure: str, x: str | None, y: str | None) -> tuple[Any, str]:
    """And what is said of it: at which values of the other keys."""
    wide = [str(name) for name, size in found.sizes.items() if size > 1] or [str(name) for name in found.sizes][:1]
    of = {key: str(found[key].dims[0]) for key in (x, y) if key is not None}
    if len(set(of.values())) < len(of):
        raise SceneError("y", y, allowed("another-key", key=x or ""))
    left = sorted((name for name in wide if name not in of.values()), key=lambda name: _wordy(found[name]))
    if x is None:
        x = left.pop(0) if left else str(next(name for name in found.sizes if name not in of.values()))
    if y is None and left:
        y = left.pop(0)
    across = str(found[x].dims[0])
    down = None if y is None else str(found[y].dims[0])
    others = [str(name) for name in found.sizes if name not in (across, down)]
    at = "".join(f", {name} = {_plain(found[name].values[0])}" for name in others)
    cut = found.isel(dict.fromkeys(others, 0)).transpose(*filter(None, (down, across)))
    numbers = [key is not None and not _wordy(found[key]) for key in (x, y)]
    if y is not None and all(numbers) and min(np.unique(found[key]).size for key in (x, y)) > 1:
        return _map(cut, figure, x, y), at
    return _curves(cut, figure, x, y, down), at


def _plain(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value)


def _curves(found: Any, figure: str, x: str, y: str | None, down: str | None) -> Any:
    """One, or one for each value of `y`."""
    known = found[figure].values[np.isfinite(found[figure].values)]
    lowest = float(known.min()) if known.size else 0.0
    if y is None or down is None:
        return hv.Overlay(list(_curve(found, figure, x, lowest, figure.replace("_", " "), REFUSED)))
    drawn = []
    for number, value in enumerate(found[y].values):
        label = f"{y} = {_plain(value)}"
        drawn += _curve(found.isel({down: number}), figure, x, lowest, label, f"{REFUSED}: {label}")
    return hv.Overlay(drawn)


def _curve(found: Any, figure: str, x: str, lowest: float, label: str, without: str) -> Iterator[Any]:
    """With a gap where the number of contacts changes, a line there, and marks where it is refused."""
    axis, value = _dimension(found[x]), _dimension(found[figure])
    refused = found.refused.values != ""
    heights = found[figure].values
    if _wordy(found[x]):
        words = np.array([str(each) for each in found[x].values])
        yield hv.Scatter((words[~refused], heights[~refused]), axis, value, label=label).opts(**_size(8))
        if refused.any():
            yield _marks(words[refused], np.full(refused.sum(), lowest), [axis], value, without)
        return
    order = np.argsort(found[x].values, kind="stable")
    places, heights, refused = found[x].values[order].astype(float), heights[order], refused[order]
    log = by_factor(places)
    breaks = _breaks(places, found.contacts.values[order], log) if "contacts" in found else np.empty(0)
    where = np.searchsorted(places, breaks)
    joined = np.insert(places, where, breaks), np.insert(heights, where, np.nan)
    yield hv.Curve(joined, axis, value, label=label).opts(logx=log)
    if np.isfinite(heights).sum() == 1:  # which no line shows
        yield hv.Scatter((places, heights), axis, value, label=label).opts(**_size(6), logx=log)
    if breaks.size:
        yield hv.VLines(breaks, kdims=[axis], label=CHANGED).opts(color="grey", logx=log, **_thin())
    if refused.any():
        yield _marks(places[refused], np.full(refused.sum(), lowest), [axis], value, without).opts(logx=log)


def _breaks(places: np.ndarray, contacts: np.ndarray, log: bool) -> np.ndarray:
    """Between places with other numbers of contacts, both of which are known."""
    changes = np.nonzero((np.diff(contacts) != 0) & np.isfinite(np.diff(contacts)))[0]
    low, high = places[changes], places[changes + 1]
    return np.sqrt(low * high) if log else 0.5 * (low + high)


def _marks(across: np.ndarray, up: np.ndarray, keys: Sequence[Any], value: Any, label: str) -> Any:
    """Grey crosses, with a legend."""
    marks = hv.Scatter((across, up), keys[0], keys[1] if len(keys) > 1 else value, label=label)
    return marks.opts(color=GREY, marker="x", **_size(6)) if _bokeh() else marks.opts(color=GREY)


def _bokeh() -> bool:
    return hv.Store.current_backend == "bokeh"


def _thin() -> dict[str, Any]:
    return {"line_width": 1, "line_dash": "dashed"} if _bokeh() else {}


def _size(pixels: int) -> dict[str, int]:
    return {"size": pixels} if _bokeh() else {}


def _map(found: Any, figure: str, x: str, y: str) -> Any:
    """Coloured cells, contour lines, where the number of contacts changes, and marks where there is no value."""
    columns, rows = (np.unique(found[key].values, return_index=True)[1] for key in (x, y))
    keys, value = [_dimension(found[key]) for key in (x, y)], _dimension(found[figure])
    across, up = found[x].values[columns].astype(float), found[y].values[rows].astype(float)
    values, refused = found[figure].values[np.ix_(rows, columns)], found.refused.values[np.ix_(rows, columns)] != ""
    logs = {"logx": by_factor(across), "logy": by_factor(up)}
    edges = edges_of(across, logs["logx"]), edges_of(up, logs["logy"])
    look = {"colorbar": True, "cmap": "viridis", "clipping_colors": {"NaN": "#dddddd"}}
    drawn = [hv.QuadMesh((*edges, values), keys, value).opts(**logs, **look)]
    known = values[np.isfinite(values)]
    if known.size and known.min() < known.max():
        drawn.append(_contours(across, up, values, keys, value).opts(color="white", **logs))
    if "contacts" in found:
        path = _borders(found.contacts.values[np.ix_(rows, columns)], *edges)
        drawn += [hv.Curve(path, *keys, label=CHANGED).opts(color="red", **logs)] if path[0].size else []
    for cells, label in ((refused, REFUSED), (~refused & ~np.isfinite(values), MISSING)):
        row, column = np.nonzero(cells)
        drawn += [_marks(across[column], up[row], keys, value, label).opts(**logs)] if row.size else []
    return hv.Overlay(drawn)


def _contours(across: np.ndarray, up: np.ndarray, values: np.ndarray, keys: Sequence[Any], value: Any) -> Any:
    """At round values between the lowest and the highest."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    step = 10.0 ** math.floor(math.log10((high - low) / LEVELS))
    step *= next((factor for factor in (1.0, 2.0, 5.0) if (high - low) / (factor * step) <= LEVELS), 10.0)
    levels = step * np.arange(math.ceil(low / step), math.floor(high / step) + 1)
    mesh = hv.QuadMesh((across, up, np.ma.masked_invalid(values)), keys, value)
    return hv.operation.contours(mesh, levels=levels.tolist())


def _borders(contacts: np.ndarray, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sides of cells (rows, columns) that part other numbers of contacts, as one line with gaps."""
    pieces = []
    for row, column in zip(*np.nonzero(_differ(contacts[:, :-1], contacts[:, 1:])), strict=True):
        pieces.append([[x[column + 1], y[row]], [x[column + 1], y[row + 1]], [np.nan, np.nan]])
    for row, column in zip(*np.nonzero(_differ(contacts[:-1], contacts[1:])), strict=True):
        pieces.append([[x[column], y[row + 1]], [x[column + 1], y[row + 1]], [np.nan, np.nan]])
    across, up = np.array(pieces, float).reshape(-1, 2).T
    return across, up


def _differ(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return (one != other) & np.isfinite(one) & np.isfinite(other)


# --- points drawn by chance -------------------------------------------------------------------------------------------


def _points(found: Any, figure: str, keys: list[str], x: str | None, y: str | None) -> Any:
    """The figure over each key, or over the one chosen; coloured by the next key, or by the one chosen."""
    if x is not None:
        others = [key for key in keys if key != x]
        return _cloud(found, figure, x, y or (others[0] if others else None))
    after = dict(zip(keys, [*keys[1:], keys[0]], strict=True))
    drawn = [_cloud(found, figure, key, y if y is not None and y != key else after[key]) for key in keys]
    return drawn[0] if len(drawn) == 1 else hv.Layout(drawn).cols(2)


def _cloud(found: Any, figure: str, x: str, colour: str | None) -> Any:
    axis, value = _dimension(found[x]), _dimension(found[figure])
    refused, heights = found.refused.values != "", found[figure].values
    places = found[x].values
    places = np.array([str(each) for each in places]) if _wordy(found[x]) else places.astype(float)
    there = ~refused & np.isfinite(heights)
    logs = {} if _wordy(found[x]) else {"logx": by_factor(places)}
    if colour is None or colour == x:
        points = hv.Scatter((places[there], heights[there]), axis, value)
    else:
        shade = found[colour].values[there]
        shade = np.array([str(each) for each in shade]) if _wordy(found[colour]) else shade.astype(float)
        points = hv.Scatter((places[there], heights[there], shade), axis, [value, _dimension(found[colour])])
        look = {"color": colour, "colorbar": not _wordy(found[colour])}
        points = points.opts(**look, cmap="Category10" if _wordy(found[colour]) else "viridis") if _bokeh() else points
    points = points.opts(**_size(4), **logs)
    if not refused.any():
        return points
    lowest = float(heights[there].min()) if there.any() else 0.0
    marks = _marks(places[refused], np.full(refused.sum(), lowest), [axis], value, REFUSED)
    return hv.Overlay([points, marks.opts(**logs)])
