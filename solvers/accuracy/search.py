"""The search for the cheapest solution that is proved to be good enough."""

import math
from typing import Any

from ..bodies import Bending
from ..methods.validity import ended_early
from ..provenance import clock
from ..scene import Scene
from ..solution.solution import Solution
from ..text.notes import Note, Severity
from .cost_model import expected_time
from .quantities import HISTORIES, Truth
from .refinement import Ladder
from .report import Outcome, summary
from .trial import Tried, Wish, difference, remainder

PROOF_DISTANCE = {
    "modes": 3,
    "elements": 3,
    "steps": 2,
    "tolerance": 2,
}  # rungs from a solution to the one that proves it
STEADY_SHARE = 0.1  # of the error, left by one refinement: then the next is not needed to know it
HARSH = ("peak-force", "force-history")  # may converge to something else where nothing gives way: a second method asked
FIRST_METHOD_SHARE = 0.6  # of the time, for a first method that a second one is to be held against
NO_SECOND = Note("no-second-method", Severity.WARNING)
MAX_SEARCH_SECONDS = 10.0  # of all solves, where no budget says otherwise; a search that ends there says so
TIME_GROWTH = 2.5  # of a solve from one level to the next, as resolutions double; smaller, and budgets are overrun
# Of the tolerance, that an estimate may use up: the proof is not exact either. Larger, and the estimate is too small
# more often; how often is measured by `python -m bench --only automatic`.
TOLERANCE_MARGIN = 0.8
MAX_SLOWNESS = 10.0  # times slower than foretold; beyond it much was done for the first time, and will not be again
MIN_CLIMB_SECONDS = 0.1  # foretold, of solves before a ladder that leads nowhere is given up
FALL, RISE = 16.0, 0.7  # of errors from rung to rung: at best, fourth order; and at least, to go on


class Search:
    """From coarse to fine until something is proved, or until time or rungs run out."""

    def __init__(self, scene: Scene, wish: Wish, own: list[Ladder], duration: float | None):
        self.scene, self.wish, self._duration = scene, wish, duration
        self._begun = clock()
        self._own = own
        self.tried: list[Tried] = []
        self.chosen: Tried | Any = None  # until the first solve
        self.proof: Tried | Any = None  # None: nothing that could be refined, or nothing proved
        self._notes: list[Note] = []
        self._unsure = self._cut_short = False

    def answer(self) -> Solution:
        """What was chosen, with the reasons in its diagnostics and notes; see `solvers.accuracy.report`."""
        self._climb()
        if self.proof not in (None, self.chosen) and self.wish.tolerance is not None:
            self._try_cheaper()
        cancelled, spent = self.wish.cancelled(), clock() - self._begun
        limit = MAX_SEARCH_SECONDS if self._cut_short and self.wish.budget is None and not cancelled else None
        finer = TIME_GROWTH * self.chosen.cost * self._slowness()
        return summary(
            Outcome(
                self.wish, self.tried, self.chosen, self.proof, self._notes, self._unsure, spent, limit, cancelled,
                finer,
            )
        )  # fmt: skip

    def _climb(self) -> None:
        """The best method that can be refined, until a coarse solution is proved by a fine one."""
        exact = next((ladder for ladder in self._own if ladder.exact), None)
        refinable = [ladder for ladder in self._own if ladder.converges]
        if exact is not None:
            self.chosen = self.proof = self._try(exact, 0)
            if self._difference(self.chosen, self.chosen) is not None:
                self.chosen.error = self.chosen.solution.diagnostics["estimated_error"]
        elif not refinable:
            self._hold_together()
        elif self.wish.quantity in HARSH and _halts_a_slender_beam(self.scene):
            self._climb_without_limit(refinable[0])
        else:
            self._climb_any(refinable)
        if self.chosen.error is None and self._difference(self.chosen, self.chosen) is None:
            label, quantity = self.chosen.label, self.wish.quantity
            self._notes.append(Note("not-predicted", Severity.INVALID, method=label, quantity=quantity))

    def _climb_any(self, refinable: list[Ladder]) -> None:
        """One method after the other until a solution is proved; else the nearest of the finest."""
        mains = {ladder.rungs[0].NAME: ladder for ladder in reversed(refinable)}  # the first of each method
        for main in sorted(mains.values(), key=refinable.index):
            if self._climb_ladder(main):
                self._ask_another(refinable)
                return
            whole = not _ends_early(self.tried[-1])
            if self.wish.tolerance is None or (main.knob == "tolerance" and whole):
                break  # the time is up, or nothing is better than waves
            if self._cut_short and self._may_mislead(main):
                break
        last = self.tried[-1].ladder  # of the last method there may have been no time left to try anything
        if self._may_mislead(last):
            self._hold_against_another(last, refinable)
        finest = {id(tried.ladder): tried for tried in self.tried}
        self.chosen = min(finest.values(), key=lambda tried: math.inf if tried.error is None else tried.error)

    def _climb_ladder(self, main: Ladder) -> bool:
        """Whether a solution on it could be proved."""
        own: list[Tried] = []
        shared = FIRST_METHOD_SHARE if self._may_mislead(main) else 1.0
        for rung in range(len(main.rungs)):
            if self.tried and not self._time_for(TIME_GROWTH * (own or self.tried)[-1].cost * self._slowness(), shared):
                self._cut_short = True
                break
            finest = self._try(main, rung)
            for coarser in own:
                coarser.error = self._difference(coarser, finest)
            own.append(finest)
            self.chosen = self._proved(own)
            if self.chosen is not None:
                self.proof = finest
                return True
            if self._hopeless(own):
                break
        if own and not _ends_early(own[-1]):
            own[-1].error = remainder(own, self.wish.quantity)
        return False

    def _climb_without_limit(self, main: Ladder) -> None:
        """What the truth itself has no value of, some rungs up."""
        for rung in range(min(PROOF_DISTANCE[main.knob] + 1, len(main.rungs))):
            self._try(main, rung)
        self.chosen, self._unsure = self.tried[-1], True
        self._notes.append(Note("force-without-bound", Severity.INVALID))

    def _proved(self, own: list[Tried]) -> Tried | None:
        """The coarsest solution that agrees with the finest, as do all between: two alone may agree by chance."""
        if self.wish.tolerance is None or _ends_early(own[-1]):
            return None
        found = None
        for tried in reversed(own[:-1]):
            if tried.error is None or tried.error > TOLERANCE_MARGIN * self.wish.tolerance:
                break
            found = tried
        if found is None:
            return None
        apart = own[-1].rung - found.rung
        steady = apart == PROOF_DISTANCE[found.ladder.knob] - 1 and own[-2].error <= STEADY_SHARE * found.error
        return found if apart >= PROOF_DISTANCE[found.ladder.knob] or (steady and apart > 1) else None

    def _hopeless(self, own: list[Tried]) -> bool:
        """Whether errors fall so slowly that half an order more would not bring the last rungs within the tolerance."""
        known = [tried for tried in own[:-1] if tried.error]
        if self.wish.tolerance is None or len(known) < 4 or sum(tried.cost for tried in own) < MIN_CLIMB_SECONDS:
            return False
        ladder, early, late = own[-1].ladder, known[-4], known[-1]
        last = ladder.size(max(late.rung, len(ladder.rungs) - 1 - PROOF_DISTANCE[ladder.knob]))
        order = abs(math.log(early.error / late.error) / math.log(late.size / early.size))
        order = 0.5 + (order if early.error > late.error else 0.0)
        return late.error * max(last / late.size, late.size / last) ** -order > self.wish.tolerance

    def _may_mislead(self, ladder: Ladder) -> bool:
        """Whether its solutions may agree with each other, and not with the truth."""
        rigid = self.scene.rigid_contact
        return rigid and self.wish.quantity in HARSH and ladder.knob != "tolerance"

    def _hold_against_another(self, main: Ladder, refinable: list[Ladder]) -> None:
        """Forces that nothing has proved: the finest that there was time for beside that of a second method.

        Its differences to coarser ones say nothing of the truth: the error is no less than the two disagree.
        """
        finest = [tried for tried in self.tried if tried.ladder is main][-1]
        name = main.rungs[0].NAME
        others = [ladder for ladder in refinable if name != ladder.rungs[0].NAME]
        known = [tried for tried in self.tried if tried.ladder in others]
        if not known and (not others or self.wish.cancelled()):
            finest.error, self._unsure = None, True
            self._notes.append(NO_SECOND)
            return
        other = known[-1] if known else self._as_fine_as_time_allows(others[0], finest.rung)
        apart = self._difference(other, finest)
        if apart is None:
            return
        last = [self._difference(tried, other) for tried in self.tried if tried.ladder is other.ladder][-2:-1]
        # what the other has changed by at last counts, too: two that converge to different forces cross on the way
        bound = apart + last[0] if last and last[0] is not None else None
        for tried in (finest, other):
            if tried.error is not None:
                tried.error = max(tried.error, bound) if bound is not None else None
        self._notes.append(self._disagreement(other, finest, apart))

    def _as_fine_as_time_allows(self, ladder: Ladder, finest: int) -> Tried:
        """The coarsest, whatever time is left, or finer ones up to this rung."""
        found = self._try(ladder, 0)
        for rung in range(1, min(finest + 1, len(ladder.rungs))):
            if not self._time_for(TIME_GROWTH * found.cost * self._slowness()):
                break
            found = self._try(ladder, rung)
        return found

    @staticmethod
    def _disagreement(other: Tried, one: Tried, apart: float) -> Note:
        return Note("second-method-differs", Severity.WARNING, other=other.label, method=one.label, apart=apart)

    def _ask_another(self, refinable: list[Ladder]) -> None:
        """Forces where nothing gives way: modes may converge to something else than the truth."""
        proof = self.proof.ladder.rungs[0].NAME
        others = [ladder for ladder in refinable if proof != ladder.rungs[0].NAME and not self.wish.cancelled()]
        if not self._may_mislead(self.proof.ladder):
            return
        if not others:
            self._notes.append(NO_SECOND)
            self._unsure = True
            return
        other = self._try(others[0], min(self.proof.rung, len(others[0].rungs) - 1))
        other.error = self._difference(other, self.proof)
        if other.error is None:
            return
        if other.error > max(self.chosen.error, self.wish.tolerance):
            self._unsure = True
            self._notes.append(self._disagreement(other, self.proof, other.error))
        for tried in self.tried:
            if tried.ladder is self.chosen.ladder and tried.error is not None:
                tried.error = max(tried.error, other.error)

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
        if self.chosen.error is None and self._difference(self.chosen, self.chosen) is not None:
            self.chosen.error = self.chosen.solution.diagnostics["estimated_error"]
        self._notes.append(Note("closed-forms-only", Severity.REMARK))

    def _try_cheaper(self) -> None:
        """Other methods whose solve costs less, cheapest first, held against the same proof until the rest costs more.

        For no longer than the proof itself has taken.
        """
        waiting: dict[Ladder, tuple[float, list[Tried]]] = {}  # what the next rung takes at least, and those before it
        for ladder in self._own:
            assumed = ladder.knob is not None and not ladder.converges  # right by chance only
            if not assumed and ladder not in (self.proof.ladder, self.chosen.ladder):
                waiting[ladder] = self._foretold(ladder, 0, 0), []
        climbed, allowed = len(self.tried), sum(tried.cost for tried in self.tried)
        while waiting and sum(tried.cost for tried in self.tried[climbed:]) < allowed:
            ladder = min(waiting, key=lambda ladder: waiting[ladder][0])
            least, own = waiting.pop(ladder)
            if least >= self.chosen.cost or not self._time_for(least * self._slowness()):
                break
            other = self._try(ladder, len(own))
            other.error = self._difference(other, self.proof)
            own.append(other)
            if other.error is not None and other.error <= TOLERANCE_MARGIN * self.wish.tolerance:
                self.chosen = min(self.chosen, other, key=lambda tried: tried.cost)
            elif self._promising(own):
                waiting[ladder] = self._foretold(ladder, len(own), other.solution.diagnostics["steps"]), own

    def _promising(self, own: list[Tried]) -> bool:
        """Whether a finer rung may keep to the tolerance and still cost less than what is chosen by now."""
        last = own[-1]
        if last.error is None or (len(own) > 1 and last.error > RISE * own[-2].error):
            return False
        enough = last.rung + math.ceil(math.log(last.error / (TOLERANCE_MARGIN * self.wish.tolerance)) / math.log(FALL))
        if enough >= len(last.ladder.rungs):
            return False
        return self._foretold(last.ladder, enough, last.solution.diagnostics["steps"]) < self.chosen.cost

    def _foretold(self, ladder: Ladder, rung: int, steps: int) -> float:
        """Cost of a rung, if it takes so many steps."""
        return expected_time(ladder.rungs[rung].table(), steps, self.scene.contact)

    def _try(self, ladder: Ladder, rung: int) -> Tried:
        for known in self.tried:
            if known.ladder is ladder and known.rung == rung:
                return known
        begun = clock()
        solution = ladder.rungs[rung].solve(self.scene, self._duration)
        truth = Truth.of(solution, self.wish.quantity in HISTORIES)
        self.tried.append(Tried(ladder, rung, solution, truth, clock() - begun))
        return self.tried[-1]

    def _difference(self, one: Tried, other: Tried) -> float | None:
        """Of the quantity asked for, `other` being nearer to the truth."""
        return difference(one, other, self.wish.quantity)

    def _slowness(self) -> float:
        """How much slower this machine is now than the constants say, but for what was done for the first time."""
        return min(MAX_SLOWNESS, *(tried.wall_time / tried.cost for tried in self.tried))

    def _time_for(self, expected: float, part: float = 1.0) -> bool:
        """Whether so many seconds are left of this part of all."""
        if self.wish.cancelled():
            return False
        budget = part * (MAX_SEARCH_SECONDS if self.wish.budget is None else self.wish.budget)
        return sum(min(tried.wall_time, MAX_SLOWNESS * tried.cost) for tried in self.tried) + expected <= budget


def _ends_early(tried: Tried) -> bool:
    """Whether the blow could not be followed to its end: two that stop at the same instant agree on nothing."""
    return ended_early(tried.solution.notes)


def _halts_a_slender_beam(scene: Scene) -> bool:
    """Whether bending waves without shear, which are the faster the shorter, are all that gives way."""
    return scene.rigid_contact and any(
        isinstance(body, Bending) and body.theory == "euler-bernoulli" for body in (scene.impactor, scene.target)
    )
