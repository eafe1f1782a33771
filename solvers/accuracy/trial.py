"""One solve of a search, and its error as estimated from the others."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

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

    def row(self) -> dict[str, Any]:
        return {
            "method": self.solution.method,
            "label": self.label,
            "cost": self.cost,
            "wall_time": self.wall_time,
            "estimated_error": self.error,
        }


def difference(one: Trial, other: Trial, quantity: str) -> float | None:
    """Of one from the other, which is nearer to the exact solution."""
    error = other.reference.errors(one.reference.metrics)[quantity]
    return None if error is None else abs(error)


def remainder(own: Sequence[Trial], quantity: str) -> float | None:
    """What is left of the error of the finest, as the last two differences fall like a power."""
    last: list[Any] = [difference(one, other, quantity) for one, other in pairwise(own[-3:])]
    if not last or None in last:
        return None
    ratio = last[1] / last[0] if len(last) == 2 and last[0] > 0.0 else 0.5
    ratio = min(max(ratio, 0.1), 0.9)
    return last[-1] * ratio / (1.0 - ratio)
