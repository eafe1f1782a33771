"""What the pictures of studies are made of: axes, marks, and points as rows."""

import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from .looks import dressed
from .plots import hv

WORDS = ("refused", "reason", "notes")
REFUSED, MISSING, CHANGED = "refused", "no such figure", "other number of contacts"
GREY = "#9a9a9a"
MANY = 100_000  # points, beyond which they are counted in cells, so that a page stays small
CLEAR = "#ffffff00"
CELLS = 160, 120  # of a picture, across and up
STRETCHES = 2_000  # of a curve of so many points
APART = 10  # blocks between crosses of a map of so many points
BLOCKS = 300  # of a map of so many points, up and across
BREAKS = 1_000  # most lines at other numbers of contacts, of a curve of so many points


def wordy(array: Any) -> bool:
    """Whether its values are words."""
    return array.dtype.kind not in "iuf"


def dimension(array: Any) -> Any:
    """Its axis, with name and unit."""
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


def marks(across: np.ndarray, up: np.ndarray, keys: Sequence[Any], value: Any, label: str) -> Any:
    """Grey crosses, with a legend."""
    found = hv.Scatter((across, up), keys[0], keys[1] if len(keys) > 1 else value, label=label)
    return dressed(found, color=GREY, marker="x", size=6)


def rows(found: Any) -> Any:
    """With one dimension, `point`: a grid's points one after another."""
    if "point" in found.sizes:
        return found
    like = found.refused
    flat = {
        name: ("point", array.broadcast_like(like).transpose(*like.dims).values.ravel(), array.attrs)
        for name, array in {**found.data_vars, **found.coords}.items()
    }
    places = {"point": np.arange(like.size)} | {str(key): flat.pop(key) for key in found.coords}
    return type(found)(flat, places, found.attrs)


def varied(found: Any) -> list[list[str]]:
    """Keys, those that go together in one list."""
    return [axis["keys"] for axis in json.loads(found.attrs["design"])["vary"]]


def known(found: Any, figure: str) -> np.ndarray:
    """Which points (rows) are solved and have the figure."""
    return (found.refused.values == "") & np.isfinite(found[figure].values)


def numbers(values: np.ndarray) -> tuple[np.ndarray, list[str] | None]:
    """As numbers, with the words that they stand for, if they are words."""
    if values.dtype.kind in "iuf":
        return values.astype(float), None
    words, codes = np.unique(np.array([str(each) for each in values]), return_inverse=True)
    return codes.astype(float), [str(word) for word in words]


# --- many points ------------------------------------------------------------------------------------------------------


def _sides(values: np.ndarray, words: list[str] | None, cells: int, log: bool = False) -> np.ndarray:
    """Of cells over these values, apart by a constant factor if `log`."""
    if words is not None:
        return np.arange(len(words) + 1) - 0.5
    low, high = float(values.min()), float(values.max())
    if low == high:
        half = 0.5 * abs(low) or 0.5
        return np.array([low - half, high + half])
    return (np.geomspace if log else np.linspace)(low, high, cells + 1)


def counted(found: Any, key: str, figure: str, cells: tuple[int, int], shade: str | None = None) -> Any:
    """A figure over a key in cells, coloured by how many points each has, or by the mean of the key `shade`."""
    there, (across, words) = known(found, figure), numbers(found[key].values)
    logx = words is None and by_factor(across)
    across, up = across[there], found[figure].values[there]
    right, top = _sides(across, words, cells[0], logx), _sides(up, None, cells[1])
    columns = np.clip(np.searchsorted(right, across, "right") - 1, 0, right.size - 2)
    heights = np.clip(np.searchsorted(top, up, "right") - 1, 0, top.size - 2)
    cell, size = heights * (right.size - 1) + columns, (top.size - 1) * (right.size - 1)
    counts = np.bincount(cell, minlength=size).astype(float)
    values, value = np.where(counts > 0.0, counts, np.nan), hv.Dimension(f"count of {key}, {figure}", label="points")
    if shade is not None:
        values = np.bincount(cell, found[shade].values[there].astype(float), size) / values
        value = hv.Dimension(f"mean {shade}", label=f"mean {shade}", unit=found[shade].attrs.get("units") or None)
    keys = [dimension(found[key]), dimension(found[figure])]
    mesh = cells_of((right, top), values.reshape(top.size - 1, right.size - 1), keys, value, logx)
    ticks = {"xticks": list(enumerate(words))} if words else {"logx": logx}
    return dressed(mesh, **ticks)


def cells_of(sides: tuple[np.ndarray, np.ndarray], values: np.ndarray, keys: Any, value: Any, log: bool = False) -> Any:
    """Coloured cells (rows, columns) between sides at even distances, or by a constant factor across."""
    if log:
        drawn = hv.QuadMesh((*sides, values), keys, value)
    else:  # without the seams that a browser leaves between cells
        (left, right), (low, high) = ((float(side[0]), float(side[-1])) for side in sides)
        drawn = hv.Image(values[::-1], keys, value, bounds=(left, low, right, high))
    return dressed(drawn, colorbar=True, cmap="viridis", clipping_colors={"NaN": CLEAR})


def outline(values: np.ndarray, contacts: np.ndarray | None) -> np.ndarray:
    """Which points of a long curve are drawn: of each stretch the lowest, the highest and the first without a value.

    And where the number of contacts changes, unless that is at more than `BREAKS` places.
    """
    if values.size <= MANY:
        return np.arange(values.size)
    size = math.ceil(values.size / STRETCHES)
    padded = np.pad(values, (0, -values.size % size), mode="edge").reshape(-1, size)
    start, gaps = size * np.arange(len(padded)), np.isnan(padded)
    kept = [
        start + find(np.where(gaps, other, padded), 1) for find, other in ((np.argmin, np.inf), (np.argmax, -np.inf))
    ]
    kept.append((start + gaps.argmax(1))[gaps.any(1)])  # the first of those without a value
    if contacts is not None:
        changes = np.nonzero((np.diff(contacts) != 0) & np.isfinite(np.diff(contacts)))[0]
        kept += [changes, changes + 1] if changes.size <= BREAKS else []
    return np.unique(np.minimum(np.concatenate([*kept, [0, values.size - 1]]), values.size - 1))


def blocks(values: np.ndarray) -> tuple[np.ndarray, tuple[int, int]]:
    """Means of blocks of a large map (rows, columns), of what is finite, and how many cells each has, up and across."""
    if values.size <= MANY:
        return values, (1, 1)
    up, across = (math.ceil(count / BLOCKS) for count in values.shape)
    padded = np.pad(values, ((0, -values.shape[0] % up), (0, -values.shape[1] % across)), constant_values=np.nan)
    cut = padded.reshape(padded.shape[0] // up, up, padded.shape[1] // across, across)
    there = np.isfinite(cut)
    count = there.sum((1, 3))
    return np.where(count, np.where(there, cut, 0.0).sum((1, 3)) / np.maximum(count, 1), np.nan), (up, across)
