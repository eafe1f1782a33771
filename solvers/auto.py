"""A question instead of a method: the cheapest solution that is good enough, and how good it is."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace

from . import checks
from .judging import QUANTITIES
from .ladders import Ladder, ladders, ranked, refusals
from .method import Method
from .methods import METHODS
from .scene import Scene
from .search import Search
from .solution import Solution
from .tried import Wish, never

TOLERANCE_RANGE = (1e-9, 0.5)
BUDGET_RANGE = (1e-6, 3600.0)  # s
ASKABLE = tuple(name for name in QUANTITIES if name not in ("energy", "resolved-force"))


@dataclass(frozen=True)
class Auto(Method):
    """The cheapest of all methods and resolutions that answers one question within a tolerance.

    The best method that can be refined climbs its ladder until a coarse solution, and all between, agree with one that
    is much finer; closed forms that cost less are held against the same proof. Of all that agree the cheapest is given,
    by measured constants of cost, with its difference from the proof as its estimated error. `diagnostics.chosen` says
    why. With `budget` [s] the ladder is climbed as long as the time lasts; without `tolerance` the finest is given. The
    force of a rigid contact is held against a second method: modes may agree with each other, and not with the truth.
    Error: the estimate; see the README for how often it is right.
    Cost: some five times the proof; at most 10 s of solves, which is said, unless a budget allows more.
    """

    tolerance: float | None = None  # relative; 0.01 if there is no budget
    quantity: str = "rebound"
    budget: float | None = None  # [s] of everything, kernels compiled
    among: tuple[str, ...] | None = None  # methods that may be chosen; all
    cancelled: Callable[[], bool] = field(default=never, repr=False)  # asked between two solves: enough of it?

    NAME = "auto"

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "Auto":
        given = checks.table("method", given, ("tolerance", "quantity", "budget", "among"))
        tolerance, budget, among = (given.get(name) for name in ("tolerance", "budget", "among"))
        if among is not None:
            if not isinstance(among, (list, tuple)) or not among:
                raise checks.SceneError("method.among", among, "a list of methods: " + ", ".join(METHODS))
            among = tuple(checks.choice("method.among", name, METHODS) for name in among)
        return cls(
            None if tolerance is None else checks.number("method.tolerance", tolerance, *TOLERANCE_RANGE),
            checks.choice("method.quantity", given.get("quantity", "rebound"), ASKABLE),
            None if budget is None else checks.number("method.budget", budget, *BUDGET_RANGE, "s"),
            among,
        )

    @property
    def goal(self) -> float | None:
        """The tolerance; None: as good as the budget allows."""
        return 0.01 if self.tolerance is None and self.budget is None else self.tolerance

    def refusal(self, scene: Scene) -> str | None:
        """What any of the methods knows, it knows."""
        return self.why_not(scene)

    def why_not(self, scene: Scene) -> str | None:
        if self._ladders(scene):
            return None
        asked = self.among or tuple(METHODS)
        reasons = "; ".join(f"'{name}': {reason}" for name, reason in refusals(scene).items() if name in asked)
        return f"no method can solve this scene ({reasons})"

    def _ladders(self, scene: Scene) -> list[Ladder]:
        """Of the methods that may be chosen, without their own estimates of error, which cost as much again."""
        found = [ladder for ladder in ladders(scene) if self.among is None or ladder.rungs[0].NAME in self.among]
        return [replace(ladder, rungs=tuple(map(bare, ladder.rungs))) for ladder in ranked(found)]

    def _again(self, solution: Solution) -> Method:
        options = {name: value for name, value in solution.method.items() if name != "name" and value is not None}
        return bare(METHODS[str(solution.method["name"])].read(options))

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        wish = Wish(self.goal, self.quantity, self.budget, self.cancelled)
        return Search(scene, wish, self._ladders(scene), duration).answer()


def bare(method: Method) -> Method:
    return replace(method, estimate=False) if "estimate" in {option.name for option in fields(method)} else method
