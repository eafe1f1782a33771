"""The search for the cheapest solution that is proved to be good enough."""

import math
import time
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

from .costs import expected_time
from .judging import Truth
from .ladders import Ladder, label
from .scene import Scene
from .solution import Solution

APART = {"modes": 3, "elements": 3, "steps": 2, "tolerance": 2}  # rungs from a solution to the one that proves it
HARSH = ("peak-force", "force-history")  # may converge to something else where nothing gives way: a second method asked
LONGEST = 10.0  # s of all solves, where no budget says otherwise
GROWTH = 2.5  # of the time from one rung to the next
MARGIN = 0.8  # of the tolerance that an estimate may use up: the proof is not exact either
SLOW = 10.0  # times slower than foretold: then kernels were compiled
HARDLY = 0.2  # order of convergence that is none


class Wish(NamedTuple):
    """What is asked for."""

    tolerance: float | None  # None: as good as the budget allows
    quantity: str  # of `solvers.judging.QUANTITIES`
    budget: float | None  # [s]


@dataclass(eq=False)
class Tried:
    """One solve on the way."""

    ladder: Ladder
    rung: int
    solution: Solution
    truth: Truth
    wall_time: float
    error: float | None = None  # estimated, of the quantity asked for; None: nothing to hold it against

    @property
    def label(self) -> str:
        return label(self.solution.method, always=self.ladder.knob)

    @property
    def cost(self) -> float:
        """Expected of a warm solve [s], the same wherever it runs."""
        return expected_time(self.solution.method, self.solution.diagnostics["steps"])

    def row(self) -> dict[str, Any]:
        return {
            "method": self.solution.method,
            "label": self.label,
            "cost": self.cost,
            "wall_time": self.wall_time,
            "estimated_error": self.error,
        }


class Search:
    """From coarse to fine until something is proved, or until time or rungs run out."""

    def __init__(self, scene: Scene, wish: Wish, own: list[Ladder], duration: float | None):
        self.scene, self.wish, self._duration = scene, wish, duration
        self._begun = time.perf_counter()
        self._own = own
        self.tried: list[Tried] = []
        self.chosen: Tried | None = None
        self.proof: Tried | None = None  # None: nothing that could be refined, or nothing proved
        self._doubts: list[str] = []

    def _climb(self) -> None:
        """The best method that can be refined, until a coarse solution is proved by a fine one."""
        exact = next((ladder for ladder in self._own if ladder.exact), None)
        if exact is not None:
            self.chosen = self.proof = self._try(exact, 0)
            self.chosen.error = self.chosen.solution.diagnostics["estimated_error"]
            return
        refinable = [ladder for ladder in self._own if ladder.converges]
        if not refinable:
            self._hold_together()
            return
        mains = {ladder.rungs[0].NAME: ladder for ladder in reversed(refinable)}  # the first of each method
        for main in sorted(mains.values(), key=refinable.index):
            if self._climb_ladder(main):
                self._ask_another(refinable)
                return
            if self.wish.tolerance is None or main.knob == "tolerance":
                break  # the time is up, or nothing is better than waves
        finest = {id(tried.ladder): tried for tried in self.tried}
        self.chosen = min(finest.values(), key=lambda tried: math.inf if tried.error is None else tried.error)

    def _climb_ladder(self, main: Ladder) -> bool:
        """Whether a solution on it could be proved."""
        own: list[Tried] = []
        for rung in range(len(main.rungs)):
            if self.tried and not self._time_for(GROWTH * (own or self.tried)[-1].cost * self._slowness()):
                break
            finest = self._try(main, rung)
            for coarser in own:
                coarser.error = self._difference(coarser, finest)
            own.append(finest)
            self.chosen = self._proved(own)
            if self.chosen is not None:
                self.proof = finest
                return True
        if own:
            own[-1].error = _remainder(own, self.wish.quantity)
        return False

    def _proved(self, own: list[Tried]) -> Tried | None:
        """The coarsest solution that agrees with the finest, as do all between: two alone may agree by chance."""
        if self.wish.tolerance is None:
            return None
        found = None
        for tried in reversed(own[:-1]):
            if tried.error is None or tried.error > MARGIN * self.wish.tolerance:
                break
            found = tried
        return found if found is not None and own[-1].rung - found.rung >= APART[found.ladder.knob] else None

    def _ask_another(self, refinable: list[Ladder]) -> None:
        """Forces where nothing gives way: modes may converge to something else than the truth."""
        others = [ladder for ladder in refinable if ladder.rungs[0].NAME != self.proof.ladder.rungs[0].NAME]
        if (
            self.wish.quantity not in HARSH
            or self.scene.contact.NAME != "rigid"
            or self.proof.ladder.knob == "tolerance"
        ):
            return
        if not others:
            self._doubts.append("No second method can tell whether this force converges to the true one.")
            return
        other = self._try(others[0], min(self.proof.rung, len(others[0].rungs) - 1))
        other.error = self._difference(other, self.proof)
        self.chosen.error = max(self.chosen.error, other.error or 0.0)

    def _hold_together(self) -> None:
        """Closed forms alone: the most trusted, and how far the nearest other method is from it."""
        for ladder in self._own:
            if ladder.knob is None:
                self._try(ladder, 0)
        self.chosen, *others = self.tried
        names = {other.solution.method["name"] for other in others} - {self.chosen.solution.method["name"]}
        differences = [
            self._difference(other, self.chosen) for other in others if other.solution.method["name"] in names
        ]
        self.chosen.error = min((error for error in differences if error is not None), default=None)
        if self.chosen.error is None:
            self.chosen.error = self.chosen.solution.diagnostics["estimated_error"]
        self._doubts.append("Nothing that can solve this scene can be refined: closed forms are all there is.")

    def _try_cheaper(self) -> None:
        """Other methods whose solve costs less, held against the same proof."""
        for ladder in self._own:
            assumed = ladder.knob is not None and not ladder.converges  # right by chance only
            if assumed or ladder is self.proof.ladder or ladder is self.chosen.ladder:
                continue
            for rung in range(len(ladder.rungs)):
                least = expected_time(ladder.rungs[rung].table(), 0)
                if least >= self.chosen.cost or not self._time_for(least * self._slowness()):
                    break
                other = self._try(ladder, rung)
                other.error = self._difference(other, self.proof)
                if other.cost >= self.chosen.cost:
                    break
                if other.error is not None and other.error <= MARGIN * self.wish.tolerance:
                    self.chosen = other
                    break

    def _try(self, ladder: Ladder, rung: int) -> Tried:
        begun = time.perf_counter()
        solution = ladder.rungs[rung].solve(self.scene, self._duration)
        self.tried.append(Tried(ladder, rung, solution, Truth.of(solution), time.perf_counter() - begun))
        return self.tried[-1]

    def _difference(self, one: Tried, other: Tried) -> float | None:
        """Of the quantity asked for, `other` being nearer to the truth."""
        return _difference(one, other, self.wish.quantity)

    def _slowness(self) -> float:
        """How much slower this machine is now than the constants say; what was compiled on the way does not count."""
        return min(SLOW, *(tried.wall_time / tried.cost for tried in self.tried))

    def _time_for(self, expected: float) -> bool:
        budget = LONGEST if self.wish.budget is None else self.wish.budget
        return sum(min(tried.wall_time, SLOW * tried.cost) for tried in self.tried) + expected <= budget

    # --- the answer in words ------------------------------------------------------------------------------------------

    def answer(self) -> Solution:
        """What was chosen, with the reasons in its diagnostics and notes.

        `diagnostics["chosen"]`, all a page needs to show and prove the choice: quantity, tolerance, budget as asked
        for; estimated_error of that quantity; met, None if only a budget was given; why, a sentence; proof, the table
        `[method]` of the solution it was held against; tried, each with method, label, cost (expected time of a warm
        solve [s]), wall_time (of this one) and estimated_error; wall_time of everything.
        """
        self._climb()
        if self.proof not in (None, self.chosen) and self.wish.tolerance is not None:
            self._try_cheaper()
        chosen, wish = self.chosen, self.wish
        spent = time.perf_counter() - self._begun
        kept = chosen.error is not None and wish.tolerance is not None and chosen.error <= wish.tolerance
        met = None if wish.tolerance is None else kept and not self._unproved
        why = self._why(met, spent)
        found = {
            "quantity": wish.quantity,
            "tolerance": wish.tolerance,
            "budget": wish.budget,
            "estimated_error": chosen.error,
            "met": met,
            "why": why,
            "proof": None if self.proof is None else self.proof.solution.method,
            "tried": [tried.row() for tried in self.tried],
            "wall_time": spent,
        }
        diagnostics = chosen.solution.diagnostics | {"estimated_error": self._rebound_error(), "chosen": found}
        return replace(chosen.solution, diagnostics=diagnostics, notes=[*chosen.solution.notes, why, *self._doubts])

    def _rebound_error(self) -> float | None:
        """Of the very solution returned, relative to the impact speed, whatever was asked for."""
        if self.wish.quantity == "rebound" or self.chosen is self.proof:
            return self.chosen.error
        if self.proof is not None:
            return _difference(self.chosen, self.proof, "rebound")
        own = [tried for tried in self.tried if tried.ladder is self.chosen.ladder]
        return _remainder(own, "rebound") if self.chosen.ladder.converges else None

    def _why(self, met: bool | None, spent: float) -> str:
        chosen, wish = self.chosen, self.wish
        error = "an unknown error" if chosen.error is None else f"an estimated error of {chosen.error:.1e}"
        told = f"Chosen: '{chosen.label}', {error} in the {wish.quantity}"
        if self.proof is not None and self.proof is not chosen:
            told += f" by comparison with '{self.proof.label}'"
        if met:
            return f"{told}, the cheapest of {len(self.tried)} solved that keeps to {wish.tolerance:g}."
        if met is None and wish.budget >= spent:
            return f"{told}, the finest that {wish.budget:g} s are enough for."
        if met is None:
            return f"{told}: {wish.budget:g} s are not enough, the quickest answer with a proof took {spent:.2g} s."
        if chosen.error is not None and chosen.error <= wish.tolerance:
            return f"{told}, but nothing finer proves that it keeps to {wish.tolerance:g}."
        return f"{told}, not {wish.tolerance:g} as asked for: {self._needed()}"

    @property
    def _unproved(self) -> bool:
        """Whether the error is only what is left of the last differences, which may mislead."""
        return self.proof is None and self.chosen.ladder.converges

    def _needed(self) -> str:
        """What the tolerance would take, by how the errors have fallen so far."""
        own = [tried for tried in self.tried if tried.ladder is self.chosen.ladder and tried.error]
        if not self.chosen.ladder.converges or len(own) < 3:
            return "nothing here can be refined."
        sizes, errors = ([f(tried) for tried in own] for f in (lambda t: t.ladder.size(t.rung), lambda t: t.error))
        order = math.log(errors[0] / errors[-1]) / math.log(sizes[-1] / sizes[0])
        knob = self.chosen.ladder.knob
        if abs(order) < HARDLY or (order > 0.0) != (sizes[-1] > sizes[0]):
            return f"more {knob} hardly bring it nearer."
        times = (errors[-1] / self.wish.tolerance) ** (1.0 / order)
        seconds = own[-1].cost * times * max(1.0, times)
        return f"that would take about {sizes[-1] * times:.1g} {knob}, {seconds:.1g} s."


def _difference(one: Tried, other: Tried, quantity: str) -> float | None:
    error = other.truth.errors(one.truth.answer)[quantity]
    return None if error is None else abs(error)


def _remainder(own: list[Tried], quantity: str) -> float | None:
    """What is left of the error of the finest, as the last two differences fall like a power."""
    last = [_difference(one, other, quantity) for one, other in pairwise(own[-3:])]
    if not last or None in last:
        return None
    ratio = last[1] / last[0] if len(last) == 2 and last[0] > 0.0 else 0.5
    ratio = min(max(ratio, 0.1), 0.9)
    return last[-1] * ratio / (1.0 - ratio)
