"""One solve of a search, and its error as estimated from the others."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

from ..methods import METHODS
from ..methods.fronts import ripple
from ..solution.solution import Solution
from .cost_model import expected_time
from .quantities import Reference
from .refinement import Ladder, label


class Goal(NamedTuple):
    """What is asked for."""

    tolerance: float | Any  # None: as good as the budget allows
    quantity: str  # of `solvers.accuracy.quantities.QUANTITIES`
    budget: float | None  # [s]
    cancelled: Callable[[], bool]  # asked between two solves


@dataclass(eq=False)
class Trial:
    """One solve on the way."""

    ladder: Ladder
    level: int
    solution: Solution
    reference: Reference
    wall_time: float
    error: float | Any = None  # estimated, of the quantity asked for; None: nothing to hold it against

    @property
    def label(self) -> str:
        return label(self.solution.method, always=self.ladder.resolution)

    @property
    def size(self) -> float | Any:
        return self.ladder.size(self.level)

    @cached_property
    def cost(self) -> float:
        """Expected of a warm solve [s], whatever else runs on the machine."""
        return expected_time(self.solution.method, self.solution.diagnostics["steps"], self.solution.scene)

    @cached_property
    def ripple(self) -> float:
        """Share of the force of a front that its method is known to be off by, see `solvers.methods.fronts`."""
        ripples = METHODS[self.solution.method["name"]].RIPPLES
        return abs((ripple(self.solution) if ripples else None) or 0.0)

    def row(self) -> dict[str, Any]:
        return {
            "method": self.solution.method,
            "label": self.label,
            "cost": self.cost,
            "wall_time": self.wall_time,
            "estimated_error": self.error,
        }


def difference(one: Trial, other: Trial, quantity: str) -> float | None:
    """Of one from the other, which is nearer to the exact solution; two may agree on a peak that is their ripple."""
    error = other.reference.errors(one.reference.metrics)[quantity]
    if error is None:
        return None
    return max(abs(error), one.ripple) if quantity == "peak-force" else abs(error)


def remainder(own: Sequence[Trial], quantity: str) -> float | None:
    """What is left of the error of the finest, as the last two differences fall like a power."""
    last: list[Any] = [difference(one, other, quantity) for one, other in pairwise(own[-3:])]
    if not last or None in last:
        return None
    ratio = last[1] / last[0] if len(last) == 2 and last[0] > 0.0 else 0.5
    ratio = min(max(ratio, 0.1), 0.9)
    left = last[-1] * ratio / (1.0 - ratio)
    return max(left, own[-1].ripple) if quantity == "peak-force" else left
