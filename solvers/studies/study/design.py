"""The points of a study: each value with each of the others', or drawn by chance."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ... import validation
from ...scene import Scene
from ...validation import SceneError, allowed
from .axes import Axis, axes_of

SAMPLES = ("grid", "random", "lhs", "sobol")
PAIRED = "saltelli"  # two samples, and those between them: see `paired_design`
MOST_POINTS = 10_000_000  # whose figures are held all at once, in some 2 GB
MOST_STORED = 10_000_000_000  # that nobody holds at once
BULK = 50_000  # points a second that a processor solves where it is quickest
USUAL_DRAWN = 1_000
LEAST_PAIRED = 8  # of which there is something to estimate


@dataclass(frozen=True)
class Design:
    """Points, numbered from 0 on; on a grid the last axis runs first."""

    axes: tuple[Axis, ...]
    sample: str
    size: int
    seed: int | None = None  # of what is drawn

    @property
    def keys(self) -> tuple[str, ...]:
        """All that are varied."""
        return tuple(key for axis in self.axes for key in axis.keys)

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the arrays of results."""
        return tuple(len(axis.rows) for axis in self.axes) if self.sample == "grid" else (self.size,)

    def rows(self, start: int, stop: int) -> list[tuple[Any, ...]]:
        """The values of all keys at the points from `start` on, up to `stop`."""
        if self.sample != "grid":
            drawn = self._drawn
            return [sum((column[point] for column in drawn), ()) for point in range(start, stop)]
        places = np.unravel_index(np.arange(start, stop), self.shape)
        columns = [
            [axis.rows[place] for place in found.tolist()] for axis, found in zip(self.axes, places, strict=True)
        ]
        return [sum(row, ()) for row in zip(*columns, strict=True)]

    @cached_property
    def _drawn(self) -> list[list[tuple[Any, ...]]]:
        """Of each axis the values at every point."""
        from scipy.stats import qmc

        count = len(self.axes)
        if self.sample == PAIRED:
            samples = self.size // (count + 2)
            both = qmc.Sobol(2 * count, rng=self.seed, bits=64).random_base2(samples.bit_length() - 1)
            first, second = both[:, :count], both[:, count:]
            whole = [first, second, *(np.where(np.arange(count) == of, second, first) for of in range(count))]
            shares = np.concatenate(whole)
        elif self.sample == "random":
            shares = np.random.default_rng(self.seed).random((self.size, count))
        elif self.sample == "lhs":
            shares = qmc.LatinHypercube(count, rng=self.seed).random(self.size)
        else:
            whole = qmc.Sobol(count, rng=self.seed).random_base2(max(0, math.ceil(math.log2(self.size))))
            shares = whole[: self.size]
        return [axis.at(shares[:, number]) for number, axis in enumerate(self.axes)]

    def table(self) -> dict[str, Any]:
        """As plain lists and words: what makes another design of it."""
        return {
            "vary": [axis.table() for axis in self.axes],
            "sample": self.sample,
            "points": self.size,
            "seed": self.seed,
        }


def design_of(
    scene: Scene, vary: Mapping[Any, Any], sample: str | None, points: int | None, seed: int, stored: bool = False
) -> Design:
    """Of `study`'s arguments. Raises SceneError for those that do not fit together, or give too many points: more than
    can be held, or on a grid that is `stored` by region, than can be written."""
    seed = validation.whole_number("seed", seed, 0, 2**32 - 1)
    sample = validation.choice("sample", sample or ("grid" if points is None else "lhs"), SAMPLES)
    axes = axes_of(scene, vary, sample != "grid")
    if sample != "grid":
        points = USUAL_DRAWN if points is None else points
        return Design(axes, sample, validation.whole_number("points", points, 1, MOST_POINTS), seed)
    if points is not None:
        raise SceneError("points", points, allowed("points-of-grid"))
    drawn = next((axis for axis in axes if axis.law), None)
    if drawn is not None and drawn.law is not None:
        raise SceneError(drawn.name, drawn.law.text, allowed("drawn-samples", options=list(SAMPLES[1:])))
    size = math.prod(len(axis.rows) for axis in axes)
    if size > (MOST_STORED if stored else MOST_POINTS):
        cost = {"terabytes": 8e-12 * size, "days": size / BULK / 86_400.0}
        reason = allowed("study-points", most=MOST_POINTS, stored=MOST_STORED, **cost)
        raise SceneError("vary", f"{size:.3g} points", reason)
    longest = max(axes, key=lambda axis: len(axis.rows))
    if len(longest.rows) > MOST_POINTS:
        raise SceneError(longest.name, f"{len(longest.rows):.3g} values", allowed("study-axis", most=MOST_POINTS))
    return Design(axes, sample, size)


def paired_design(scene: Scene, vary: Mapping[Any, Any], samples: int, seed: int) -> Design:
    """Drawn for indices of variance: so many points A, as many B, then for each axis A with its values of B alone.

    `samples` is rounded up to a power of two, as Sobol sequences are even then. Raises SceneError as `design_of` does.
    """
    seed = validation.whole_number("seed", seed, 0, 2**32 - 1)
    axes = axes_of(scene, vary, True)
    samples = validation.whole_number("points", samples, LEAST_PAIRED, MOST_POINTS // (len(axes) + 2))
    return Design(axes, PAIRED, 2 ** (samples - 1).bit_length() * (len(axes) + 2), seed)
