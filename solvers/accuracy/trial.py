"""One solve on the way to an answer, and what can be told of its error from the others."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

from ..solution.solution import Solution
from .cost_model import expected_time
from .quantities import Truth
from .refinement import Ladder, label


class Wish(NamedTuple):
    """What is asked for."""

    tolerance: float | Any  # None: as good as the budget allows
    quantity: str  # of `solvers.accuracy.quantities.QUANTITIES`
    budget: float | None  # [s]
    cancelled: Callable[[], bool]  # asked between two solves


@dataclass(eq=False)
class Tried:
    """One solve on the way."""

    ladder: Ladder
    rung: int
    solution: Solution
    truth: Truth
    wall_time: float
    error: float | Any = None  # estimated, of the quantity asked for; None: nothing to hold it against

    @property
    def label(self) -> str:
        return label(self.solution.method, always=self.ladder.knob)

    @property
    def size(self) -> float | Any:
        return self.ladder.size(self.rung)

    @property
    def cost(self) -> float:
        """Expected of a warm solve [s], the same wherever it runs."""
        return expected_time(self.solution.method, self.solution.diagnostics["steps"], self.solution.scene.contact)

    def row(self) -> dict[str, Any]:
        return {
            "method": self.solution.method,
            "label": self.label,
            "cost": self.cost,
            "wall_time": self.wall_time,
            "estimated_error": self.error,
        }


def difference(one: Tried, other: Tried, quantity: str) -> float | None:
    """Of one from the other, which is nearer to the truth."""
    error = other.truth.errors(one.truth.answer)[quantity]
    return None if error is None else abs(error)


def remainder(own: Sequence[Tried], quantity: str) -> float | None:
    """What is left of the error of the finest, as the last two differences fall like a power."""
    last: list[Any] = [difference(one, other, quantity) for one, other in pairwise(own[-3:])]
    if not last or None in last:
        return None
    ratio = last[1] / last[0] if len(last) == 2 and last[0] > 0.0 else 0.5
    ratio = min(max(ratio, 0.1), 0.9)
    return last[-1] * ratio / (1.0 - ratio)
