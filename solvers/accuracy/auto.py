"""A question instead of a method: the cheapest solution that is good enough, and how good it is."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

from .. import validation
from ..methods import METHODS
from ..methods.base import Method, never, no_method
from ..methods.options import option, real, word
from ..scene import Scene
from ..solution.solution import Solution
from ..text.notes import Note
from .quantities import QUANTITIES
from .refinement import Ladder, ladders, ranked, refusals
from .search import Search
from .trial import Goal

TOLERANCE_RANGE = (1e-9, 0.5)
BUDGET_RANGE = (1e-6, 3600.0)  # s
ASKABLE = tuple(name for name in QUANTITIES if name not in ("energy", "resolved-force"))


def _methods(key: str, value: object) -> tuple[str, ...]:
    """A list of names of methods."""
    if not isinstance(value, (list, tuple)) or not value:
        raise validation.SceneError(key, value, validation.allowed("methods", names=list(METHODS)))
    return tuple(validation.choice(key, name, METHODS) for name in value)


@dataclass(frozen=True)
class Auto(Method):
    """The cheapest of all methods and resolutions that answers one question within a tolerance.

    The best method that can be refined climbs its ladder until a coarse solution, and all between, agree with one that
    is much finer; closed forms that cost less are held against the same proof. Of all that agree the cheapest is given,
    by measured constants of cost, with its difference from the proof as its estimated error. `diagnostics.chosen` says
    why. With `budget` [s] the ladder is climbed as long as the time lasts; without `tolerance` the finest is given. The
    force of a rigid contact is held against a second method: modes may agree with each other and still
    be wrong. Error: the estimate; docs/how-exact.md says how often it is right.
    Cost: some five times the proof; at most 10 s of solves, which is said, unless a budget allows more.
    """

    tolerance: float | None = option(None, real(*TOLERANCE_RANGE))  # relative; 0.01 if there is no budget
    quantity: str = option("rebound", word(ASKABLE))
    budget: float | None = option(None, real(*BUDGET_RANGE, "s"))  # of everything, kernels compiled
    among: tuple[str, ...] | None = option(None, _methods)  # that may be chosen; all
    cancelled: Callable[[], bool] = field(default=never, repr=False)  # asked between two solves: enough of it?

    NAME = "auto"
    WEIGHT = True  # the methods that it takes have it
    MOVES = True  # what it chooses sees a mechanism as it needs

    @property
    def allowed_error(self) -> float | None:
        """The tolerance; None: as good as the budget allows."""
        return 0.01 if self.tolerance is None and self.budget is None else self.tolerance

    def refusal(self, scene: Scene) -> Note | None:
        """What any of the methods knows, it knows."""
        return self.why_not(scene)

    def why_not(self, scene: Scene) -> Note | None:
        if self._ladders(scene):
            return None
        asked = self.among or tuple(METHODS)
        return no_method({name: reason for name, reason in refusals(scene).items() if name in asked})

    def _ladders(self, scene: Scene) -> list[Ladder]:
        """Of the methods that may be chosen, without their own estimates of error, which cost as much again."""
        found = [ladder for ladder in ladders(scene) if self.among is None or ladder.levels[0].NAME in self.among]
        return [
            replace(ladder, levels=tuple(method.without_estimate() for method in ladder.levels))
            for ladder in ranked(found)
        ]

    def _again(self, solution: Solution) -> Method:
        options = {name: value for name, value in solution.method.items() if name != "name" and value is not None}
        return METHODS[str(solution.method["name"])].read(options).without_estimate()

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        goal = Goal(self.allowed_error, self.quantity, self.budget, self.cancelled)
        return Search(scene, goal, self._ladders(scene), duration).solution()
