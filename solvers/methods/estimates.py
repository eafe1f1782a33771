"""The error that is left in a figure, from how it differs at other resolutions."""

import math
from collections.abc import Callable, Iterable
from typing import Any

from ..solution.solution import Later

# Of what twice as many modes of links, or more, change: first order and better; see `tests/random_estimates.py`.
LEFT_BY_MODES = 2.0


def error_left(differences: Iterable[tuple[float, float]], order: float) -> float:
    """Of a figure at a resolution: the root mean square of what each of its differences leaves, if the error falls as
    resolution^-order.

    differences: pairs of the other resolution, as a share of this one, and the difference to it. Finer ones have shares
    above 1; one of just 1 tells nothing. Two or more are asked for, as one may agree with this one by chance.
    """
    left = [difference / (share**-order - 1.0) for share, difference in differences if share != 1.0]
    return math.sqrt(sum(part * part for part in left) / len(left)) if left else 0.0


def with_error(figures: dict[str, Any], error: Callable[[], float | None]) -> dict[str, Any]:
    """The figures of `summary`, with the estimated error in the diagnostics when these are read: it takes other solves,
    which nothing else needs."""
    known = figures["diagnostics"]
    work = known.work if isinstance(known, Later) else lambda _: known
    return figures | {"diagnostics": Later(lambda solved: work(solved) | {"estimated_error": error()})}
