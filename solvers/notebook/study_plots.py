"""The Dataset of a study as HoloViews objects: curves, maps, or points where they were drawn by chance."""

import json
import math
import tomllib
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..validation import SceneError, allowed, choice
from . import study_points
from .looks import dressed, headed
from .plots import LONG_LEGEND, WIDTH, Drawn, draw_with_bokeh, edges_of, hv
from .study_parts import (
    APART,
    CHANGED,
    MANY,
    MISSING,
    REFUSED,
    WORDS,
    blocks,
    by_factor,
    dimension,
    marks,
    outline,
    rows,
    wordy,
)

KINDS = ("curves", "map", "points", "parallel", "matrix", "bars")
OF_GRIDS, OF_ALL = ("curves", "map"), ("parallel", "matrix", "bars")  # and those that draw all keys
LEVELS = 8  # contour lines of a map


def study(found: Any, figure: str | None, x: str | None, y: str | None, kind: str | None) -> Drawn:
    """See `solvers.plot_study`."""
    figure = choice(
        "figure",
        figure or found.attrs["figures"].split()[0],
        [str(name) for name in found.data_vars if name not in WORDS],
    )
    found = gridded(found)
    keys = [str(key) for key in found.coords if key != "point"]
    if kind is not None:
        _possible(found, choice("kind", kind, KINDS), x, y)
    for name, key in (("x", x), ("y", y)):
        if key is not None:
            choice(name, key, keys)
    if x is not None and x == y:
        raise SceneError("y", y, allowed("another-key", key=x))
    draw_with_bokeh()
    title, named = _title(found), figure.replace("_", " ")
    if kind in OF_ALL:
        return getattr(study_points, kind)(rows(found), figure, title)
    if kind == "points" or "point" in found.sizes:
        return study_points.points(rows(found), figure, keys, x, y, title)
    drawn, about = _grid(found, figure, x, y, kind)
    return headed(drawn, title, named + about, WIDTH + LONG_LEGEND)


def _possible(found: Any, kind: str, x: str | None, y: str | None) -> None:
    """Raises SceneError where a study has no picture of this kind."""
    if kind in OF_GRIDS and "point" in found.sizes:
        others = [each for each in KINDS if each not in OF_GRIDS]
        raise SceneError("kind", kind, allowed("kinds-of-points", kinds=others))
    if kind in OF_ALL:
        for name, key in (("x", x), ("y", y)):
            if key is not None:
                raise SceneError(name, key, allowed("kind-of-all-keys", kind=kind))


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


# --- grids ------------------------------------------------------------------------------------------------------------


def _grid(found: Any, figure: str, x: str | None, y: str | None, kind: str | None) -> tuple[Any, str]:
    """And what is said of it: at which values of the other keys."""
    wide = [str(name) for name, size in found.sizes.items() if size > 1] or [str(name) for name in found.sizes][:1]
    of = {key: str(found[key].dims[0]) for key in (x, y) if key is not None}
    if len(set(of.values())) < len(of):
        raise SceneError("y", y, allowed("another-key", key=x or ""))
    left = sorted((name for name in wide if name not in of.values()), key=lambda name: wordy(found[name]))
    if x is None:
        x = left.pop(0) if left else str(next(name for name in found.sizes if name not in of.values()))
    if y is None and left:
        y = left.pop(0)
    across = str(found[x].dims[0])
    down = None if y is None else str(found[y].dims[0])
    others = [str(name) for name in found.sizes if name not in (across, down)]
    at = "".join(f", {name} = {_plain(found[name].values[0])}" for name in others)
    cut = found.isel(dict.fromkeys(others, 0)).transpose(*filter(None, (down, across)))
    numbers = [key is not None and not wordy(found[key]) for key in (x, y)]
    if kind != "curves" and y is not None and all(numbers) and min(np.unique(found[key]).size for key in (x, y)) > 1:
        return _map(cut, figure, x, y), at
    if kind == "map":
        raise SceneError("kind", kind, allowed("kind-of-two-keys"))
    return _curves(cut, figure, x, y, down), at


def _plain(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value)


def _curves(found: Any, figure: str, x: str, y: str | None, down: str | None) -> Any:
    """One, or one for each value of `y`."""
    known = found[figure].values[np.isfinite(found[figure].values)]
    lowest = float(known.min()) if known.size else 0.0
    if y is None or down is None:
        return _labelled(hv.Overlay(list(_curve(found, figure, x, lowest, "", REFUSED))), found, x, figure)
    drawn = []
    for number, value in enumerate(found[y].values):
        label = f"{y} = {_plain(value)}"
        drawn += _curve(found.isel({down: number}), figure, x, lowest, label, f"{REFUSED}: {label}")
    return _labelled(hv.Overlay(drawn), found, x, figure)


def _labelled(drawn: Any, found: Any, x: str, figure: str) -> Any:
    """With its axes named, as lines across have no name for one of them."""
    return dressed(drawn, xlabel=dimension(found[x]).pprint_label, ylabel=dimension(found[figure]).pprint_label)


def _curve(found: Any, figure: str, x: str, lowest: float, label: str, without: str) -> Iterator[Any]:
    """With a gap where the number of contacts changes, a line there, and marks where it is refused."""
    axis, value = dimension(found[x]), dimension(found[figure])
    refused = found.refused.values != ""
    heights = found[figure].values
    if wordy(found[x]):
        words = np.array([str(each) for each in found[x].values])
        yield dressed(hv.Scatter((words[~refused], heights[~refused]), axis, value, label=label), size=8)
        if refused.any():
            yield marks(words[refused], np.full(refused.sum(), lowest), [axis], value, without)
        return
    order = np.argsort(found[x].values, kind="stable")
    contacts = found.contacts.values[order] if "contacts" in found else None
    drawn = outline(heights[order], contacts)
    log, order = by_factor(found[x].values.astype(float)), order[drawn]
    places, heights, refused = found[x].values[order].astype(float), heights[order], refused[order]
    breaks = np.empty(0) if contacts is None else _breaks(places, contacts[drawn], log)
    where = np.searchsorted(places, breaks)
    joined = np.insert(places, where, breaks), np.insert(heights, where, np.nan)
    yield dressed(hv.Curve(joined, axis, value, label=label), logx=log)
    if np.isfinite(heights).sum() == 1:  # which no line shows
        yield dressed(hv.Scatter((places, heights), axis, value, label=label), size=6, logx=log)
    if breaks.size:
        yield dressed(hv.VLines(breaks, kdims=[axis], label=CHANGED), color="grey", logx=log, dashed=1)
    if refused.any():
        yield dressed(marks(places[refused], np.full(refused.sum(), lowest), [axis], value, without), logx=log)


def _breaks(places: np.ndarray, contacts: np.ndarray, log: bool) -> np.ndarray:
    """Between places with other numbers of contacts, both of which are known."""
    changes = np.nonzero((np.diff(contacts) != 0) & np.isfinite(np.diff(contacts)))[0]
    low, high = places[changes], places[changes + 1]
    return np.sqrt(low * high) if log else 0.5 * (low + high)


def _map(found: Any, figure: str, x: str, y: str) -> Any:
    """Coloured cells, contour lines, where the number of contacts changes, and marks where there is no value."""
    columns, rows = (np.unique(found[key].values, return_index=True)[1] for key in (x, y))
    keys, value = [dimension(found[key]) for key in (x, y)], dimension(found[figure])
    across, up = found[x].values[columns].astype(float), found[y].values[rows].astype(float)
    values, refused = found[figure].values[np.ix_(rows, columns)], found.refused.values[np.ix_(rows, columns)] != ""
    logs = {"logx": by_factor(across), "logy": by_factor(up)}
    edges = edges_of(across, logs["logx"]), edges_of(up, logs["logy"])
    look = {"colorbar": True, "cmap": "viridis", "clipping_colors": {"NaN": "#dddddd"}}
    shown, (high, wide) = blocks(values)
    sides = (np.append(edges[0][:-1:wide], edges[0][-1]), np.append(edges[1][:-1:high], edges[1][-1]))
    drawn = [dressed(hv.QuadMesh((*sides, shown), keys, value), **logs, **look)]
    known = values[np.isfinite(values)]
    if known.size and known.min() < known.max():
        drawn.append(dressed(_contours(across, up, values, keys, value), color="white", **logs))
    if "contacts" in found:
        path = _borders(found.contacts.values[np.ix_(rows, columns)], *edges)
        drawn += [dressed(hv.Curve(path, *keys, label=CHANGED), color="red", **logs)] if path[0].size else []
    for cells, label in ((refused, REFUSED), (~refused & ~np.isfinite(values), MISSING)):
        row, column = np.nonzero(cells)
        if cells.size > MANY:  # the first of those in a larger block
            across_block = column // (APART * wide)
            one = np.unique(row // (APART * high) * cells.shape[1] + across_block, return_index=True)[1]
            row, column = row[one], column[one]
        drawn += [dressed(marks(across[column], up[row], keys, value, label), **logs)] if row.size else []
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
    row, column = np.nonzero(_differ(contacts[:, :-1], contacts[:, 1:]))
    gap = np.full(row.size, np.nan)
    across, up = [x[column + 1], x[column + 1], gap], [y[row], y[row + 1], gap]
    row, column = np.nonzero(_differ(contacts[:-1], contacts[1:]))
    beside, gap = [x[column], x[column + 1]], np.full(row.size, np.nan)
    above = [y[row + 1], y[row + 1], gap]
    return (
        np.concatenate([np.stack(across, 1).ravel(), np.stack([*beside, gap], 1).ravel()]),
        np.concatenate([np.stack(up, 1).ravel(), np.stack(above, 1).ravel()]),
    )


def _differ(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return (one != other) & np.isfinite(one) & np.isfinite(other)
