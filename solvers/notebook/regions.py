"""Arrays of a study in a zarr store, written region by region, by whichever process has one.

A region is a stretch of points that follow each other, and one chunk of each array: two that write never share a file.

>>> blocks = blocks_of((4, 300, 70), 7000)
>>> blocks.chunk, blocks.of(20_999)
((1, 100, 70), (14000, 21000))
>>> blocks.region((14_000, 21_000))
(slice(0, 1, None), slice(200, 300, None), slice(0, 70, None))
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

NOT_SOLVED = "not-solved"  # of a point of a study that was interrupted
WORDS = {  # of a point of a study
    "refused": "code of the refusal; empty where it is solved",
    "reason": "why it is refused",
    "notes": "codes of its notes",
}
Span = tuple[int, int]  # of points, from the first up to the second
Region = tuple[slice, ...]


@dataclass(frozen=True)
class Blocks:
    """Points, numbered so that the last axis runs first, in blocks: `count` places on one axis, all on later ones."""

    shape: tuple[int, ...]
    axis: int
    count: int

    @property
    def chunk(self) -> tuple[int, ...]:
        """Shape of a block."""
        return *(1,) * self.axis, self.count, *self.shape[self.axis + 1 :]

    def of(self, point: int) -> Span:
        """The block in which a point lies; the last along its axis may be smaller."""
        row = math.prod(self.shape[self.axis + 1 :])
        plane, block = self.shape[self.axis] * row, self.count * row
        first = point // plane * plane
        start = first + (point - first) // block * block
        return start, min(start + block, first + plane)

    def region(self, span: Span) -> Region:
        """Where a whole block stands in the arrays."""
        places = [int(place) for place in np.unravel_index(span[0], self.shape)]
        count = (span[1] - span[0]) // math.prod(self.shape[self.axis + 1 :])
        ones = (slice(place, place + 1) for place in places[: self.axis])
        whole = (slice(0, size) for size in self.shape[self.axis + 1 :])
        return *ones, slice(places[self.axis], places[self.axis] + count), *whole

    def __iter__(self) -> Iterator[Span]:
        """All, in order."""
        point, size = 0, math.prod(self.shape)
        while point < size:
            span = self.of(point)
            yield span
            point = span[1]


def blocks_of(shape: tuple[int, ...], most: int) -> Blocks:
    """Of at most so many points, and as even as can be."""
    axis = len(shape) - 1
    row = 1  # points of one place on the axis
    while axis > 0 and row * shape[axis] <= most:
        row *= shape[axis]
        axis -= 1
    pieces = math.ceil(shape[axis] / max(1, most // row))
    return Blocks(shape, axis, math.ceil(shape[axis] / pieces))


def add_arrays(path: Path, dimensions: tuple[str, ...], blocks: Blocks, figures: Mapping[str, str]) -> None:
    """Arrays without values yet, to a store that has their coordinates: `figures` with their units, and `WORDS`."""
    import zarr

    group = zarr.open_group(path, mode="r+")
    common: dict[str, Any] = {"shape": blocks.shape, "chunks": blocks.chunk, "dimension_names": dimensions}
    for name, unit in figures.items():
        said: dict[str, Any] = {"units": unit, "long_name": name.replace("_", " ")}
        group.create_array(name, dtype="float64", fill_value=np.nan, attributes=said, **common)
    for name, meaning in WORDS.items():
        fill = NOT_SOLVED if name == "refused" else ""  # what is lost or not there yet is no solved point
        about: dict[str, Any] = {"long_name": meaning}
        group.create_array(name, dtype=np.dtypes.StringDType(), fill_value=fill, attributes=about, **common)


def write_region(path: Path, region: Region, columns: Mapping[str, np.ndarray]) -> None:
    """Values of all arrays (points,) at a region. Raises OSError where they cannot be written."""
    import zarr

    group = zarr.open_group(path, mode="r+")
    shape = tuple(each.stop - each.start for each in region)
    for name, values in columns.items():
        group[name][region] = values.reshape(shape)  # pyright: ignore[reportArgumentType]


def add_attributes(path: Path, about: Mapping[str, Any]) -> None:
    """To those that the store has."""
    import zarr

    zarr.open_group(path, mode="r+").attrs.update(dict(about))
