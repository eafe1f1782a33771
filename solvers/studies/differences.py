"""Derivatives by central differences: each with its error, and what follows no smooth course."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

HALVES = 3  # steps of a stencil: h, h/2, h/4
FURTHER = 16.0  # by which the step is smaller where even its quarter is too wide
CORNER, ALIKE = 1e-2, 0.2  # least difference of the slopes on the two sides; by which two looks may differ
USELESS = 0.5  # relative error from which a derivative says nothing
NOTHING = 1e-3  # of figure over key: a slope below it counts as none


@dataclass(frozen=True)
class Slopes:
    """Of several figures at once by one number; all arrays (figures,)."""

    value: np.ndarray
    error: np.ndarray
    corner: np.ndarray  # by how much the slope behind is larger than the one before, as far as differences show it
    step: np.ndarray  # the reach of the differences


def offsets(step: float) -> list[float]:
    """Where figures must be known, largest distances first, either way."""
    return [sign * step / 2**half for half in range(HALVES) for sign in (-1.0, 1.0)]


def slopes(figures: Callable[[float], np.ndarray], at: float, step: float) -> Slopes:
    """Of `figures(number)` (figures,), which is asked for at `at` and at `offsets(step)` from it.

    Order six; the error is the difference from order four by the inner points, or what remains of the second difference
    where the step goes to nought, if that is more: it is zero but for noise, a corner or a jump.
    """
    middle = figures(at)
    which = np.arange(middle.size)
    from scipy.differentiate import derivative  # half a second, which nothing else here needs

    known: dict[float, np.ndarray] = {}

    def of(numbers: np.ndarray, figure: np.ndarray) -> np.ndarray:
        numbers, figure = np.broadcast_arrays(numbers, figure)
        for number in np.unique(numbers).tolist():
            known.setdefault(number, figures(number))
        pairs = zip(numbers.ravel().tolist(), figure.ravel().tolist(), strict=True)
        return np.array([known[number][int(index)] for number, index in pairs]).reshape(numbers.shape)

    def by_order(order: int, widest: float) -> np.ndarray:
        found = derivative(of, at, args=(which,), order=order, initial_step=widest, maxiter=1)
        return np.asarray(found.df, float)

    value = by_order(6, step)
    sizes = [step / 2**half for half in range(HALVES)]
    second = [(figures(at + size) - 2.0 * middle + figures(at - size)) / size for size in sizes]
    once = [2.0 * finer - coarser for coarser, finer in pairwise(second)]
    corner = (8.0 * once[1] - once[0]) / 7.0
    rounding = 4.0 * np.finfo(float).eps * np.abs(middle) / step
    error = np.maximum(np.abs(value - by_order(4, 0.5 * step)), 0.5 * np.abs(corner)) + rounding
    return Slopes(value, error, corner, np.full(middle.size, step))


def rough(found: Slopes, scale: np.ndarray, wanted: float) -> np.ndarray:
    """Which of them are not known to a relative error `wanted`; `scale` (figures,): of figure over key."""
    return ~(found.error <= wanted * np.maximum(np.abs(found.value), NOTHING * scale))


def helps(looks: list[Slopes], scale: np.ndarray, wanted: float) -> bool:
    """Whether a smaller step is worth it: none was tried, or the last one has halved an error that is too large."""
    last = rough(looks[-1], scale, wanted) & np.isfinite(looks[-1].error)
    return bool(last.any() if len(looks) == 1 else (last & (looks[-1].error < 0.5 * looks[-2].error)).any())


def judged(looks: list[Slopes], scale: np.ndarray, wanted: float) -> tuple[Slopes, list[str]]:
    """The best of some looks, each by a smaller step, for each figure; and why a derivative does not exist: "jump",
    "corner", "unsettled", or "".
    """
    best, why = looks[0], [""] * scale.size
    for look in looks[1:]:
        better = rough(best, scale, wanted) & (look.error < best.error)
        parts = zip(vars(best).values(), vars(look).values(), strict=True)
        best = Slopes(*(np.where(better, new, old) for old, new in parts))
    if len(looks) > 1:
        first, last = looks[-2:]
        still = rough(best, scale, wanted)
        rises = first.value * first.step, last.value * last.step
        jumps = still & (np.abs(rises[1] - rises[0]) <= ALIKE * np.abs(rises[0]))
        steepest = np.abs(last.value) + 0.5 * np.abs(last.corner)
        same = np.abs(last.corner - first.corner) <= ALIKE * np.abs(last.corner)
        corners = still & same & (np.abs(last.corner) > CORNER * np.maximum(steepest, NOTHING * scale))
        why = ["corner" if c else "jump" if j else "" for c, j in zip(corners, jumps, strict=True)]
    useless = rough(best, scale, USELESS)
    return best, [each or ("unsettled" if bad else "") for each, bad in zip(why, useless, strict=True)]


def narrower(alike: list[bool], step: float) -> float:
    """The next step: half of it, or a quarter, if nothing changes within; `alike`: whether nothing does at the step,
    half and a quarter of it."""
    return next((step / 2**half for half in range(1, HALVES) if all(alike[half:])), step / FURTHER)
