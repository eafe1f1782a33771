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
from .quantities import HISTORIES, Reference
from .refinement import Ladder
from .report import Outcome, summary
from .trial import Goal, Trial, difference, remainder

PROOF_DISTANCE = {
    "modes": 3,
    "elements": 3,
    "steps": 2,
    "tolerance": 2,
}  # levels from a solution to the one that proves it
STEADY_SHARE = 0.1  # of the error, left by one refinement: then the next is not needed to know it
HARSH = ("peak-force", "force-history")  # may converge to something else where nothing gives way: a second method asked
FIRST_METHOD_SHARE = 0.6  # of the time, for a first method that a second one is to be held against
NO_SECOND = Note("no-second-method", Severity.WARNING)
MAX_SEARCH_SECONDS = 10.0  # of all solves, where no budget says otherwise; a search that ends there says so
TIME_GROWTH = 2.5  # of a solve from one level to the next, as resolutions double; smaller, and budgets are overrun
# Of the tolerance, that an estimate may use up: the proof is not exact either. Larger, and the estimate is too small
# more often; how often is measured by `python -m bench --only automatic`.
TOLERANCE_MARGIN = 0.8
MAX_SLOWNESS = 10.0  # times slower than expected; beyond it much was done for the first time, and will not be again
MIN_CLIMB_SECONDS = 0.1  # expected, of solves before a ladder that leads nowhere is given up
FALL, RISE = 16.0, 0.7  # of errors from level to level: at best, fourth order; and at least, to go on


class Search:
    """From coarse to fine until something is proved, or until time or levels run out."""

    def __init__(self, scene: Scene, goal: Goal, own: list[Ladder], duration: float | None):
        self.scene, self.goal, self._duration = scene, goal, duration
        self._begun = clock()
        self._own = own
        self.trials: list[Trial] = []
        self.chosen: Trial | Any = None  # until the first solve
        self.proof: Trial | Any = None  # None: nothing that could be refined, or nothing proved
        self._notes: list[Note] = []
        self._unsure = self._cut_short = False

    def solution(self) -> Solution:
        """What was chosen, with the reasons in its diagnostics and notes; see `solvers.accuracy.report`."""
        self._climb()
        if self.proof not in (None, self.chosen) and self.goal.tolerance is not None:
            self._try_cheaper()
        cancelled, spent = self.goal.cancelled(), clock() - self._begun
        limit = MAX_SEARCH_SECONDS if self._cut_short and self.goal.budget is None and not cancelled else None
        finer = TIME_GROWTH * self.chosen.cost * self._slowness()
        return summary(
            Outcome(
                self.goal, self.trials, self.chosen, self.proof, self._notes, self._unsure, spent, limit, cancelled,
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
        elif self.goal.quantity in HARSH and _halts_a_slender_beam(self.scene):
            self._climb_without_limit(refinable[0])
        else:
            self._climb_any(refinable)
        if self.chosen.error is None and self._difference(self.chosen, self.chosen) is None:
            label, quantity = self.chosen.label, self.goal.quantity
            self._notes.append(Note("not-predicted", Severity.INVALID, method=label, quantity=quantity))

    def _climb_any(self, refinable: list[Ladder]) -> None:
        """One method after the other until a solution is proved; else the nearest of the finest."""
        mains = {ladder.levels[0].NAME: ladder for ladder in reversed(refinable)}  # the first of each method
        for main in sorted(mains.values(), key=refinable.index):
            if self._climb_ladder(main):
                self._ask_another(refinable)
                return
            whole = not _ends_early(self.trials[-1])
            if self.goal.tolerance is None or (main.resolution == "tolerance" and whole):
                break  # the time is up, or nothing is better than waves
            if self._cut_short and self._may_mislead(main):
                break
        last = self.trials[-1].ladder  # of the last method there may have been no time left to try anything
        if self._may_mislead(last):
            self._hold_against_another(last, refinable)
        finest = {id(trial.ladder): trial for trial in self.trials}
        self.chosen = min(finest.values(), key=lambda trial: math.inf if trial.error is None else trial.error)

    def _climb_ladder(self, main: Ladder) -> bool:
        """Whether a solution on it could be proved."""
        own: list[Trial] = []
        shared = FIRST_METHOD_SHARE if self._may_mislead(main) else 1.0
        for level in range(len(main.levels)):
            if self.trials and not self._time_for(
                TIME_GROWTH * (own or self.trials)[-1].cost * self._slowness(), shared
            ):
                self._cut_short = True
                break
            finest = self._try(main, level)
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
            own[-1].error = remainder(own, self.goal.quantity)
        return False

    def _climb_without_limit(self, main: Ladder) -> None:
        """A few levels of what has no bounded exact value."""
        for level in range(min(PROOF_DISTANCE[main.resolution] + 1, len(main.levels))):
            self._try(main, level)
        self.chosen, self._unsure = self.trials[-1], True
        self._notes.append(Note("force-without-bound", Severity.INVALID))

    def _proved(self, own: list[Trial]) -> Trial | None:
        """The coarsest solution that agrees with the finest, as do all between: two alone may agree by chance."""
        if self.goal.tolerance is None or _ends_early(own[-1]):
            return None
        found = None
        for trial in reversed(own[:-1]):
            if trial.error is None or trial.error > TOLERANCE_MARGIN * self.goal.tolerance:
                break
            found = trial
        if found is None:
            return None
        apart = own[-1].level - found.level
        steady = apart == PROOF_DISTANCE[found.ladder.resolution] - 1 and own[-2].error <= STEADY_SHARE * found.error
        return found if apart >= PROOF_DISTANCE[found.ladder.resolution] or (steady and apart > 1) else None

    def _hopeless(self, own: list[Trial]) -> bool:
        """Whether errors fall so slowly that half an order more would not meet the tolerance at the last levels."""
        known = [trial for trial in own[:-1] if trial.error]
        if self.goal.tolerance is None or len(known) < 4 or sum(trial.cost for trial in own) < MIN_CLIMB_SECONDS:
            return False
        ladder, early, late = own[-1].ladder, known[-4], known[-1]
        last = ladder.size(max(late.level, len(ladder.levels) - 1 - PROOF_DISTANCE[ladder.resolution]))
        order = abs(math.log(early.error / late.error) / math.log(late.size / early.size))
        order = 0.5 + (order if early.error > late.error else 0.0)
        return late.error * max(last / late.size, late.size / last) ** -order > self.goal.tolerance

    def _may_mislead(self, ladder: Ladder) -> bool:
        """Whether its solutions may agree with each other and still be wrong."""
        rigid = self.scene.rigid_contact
        return rigid and self.goal.quantity in HARSH and ladder.resolution != "tolerance"

    def _hold_against_another(self, main: Ladder, refinable: list[Ladder]) -> None:
        """Forces that nothing has proved: the finest that there was time for beside that of a second method.

        Its differences to coarser ones say nothing of the true error: the error is no less than the two disagree.
        """
        finest = [trial for trial in self.trials if trial.ladder is main][-1]
        name = main.levels[0].NAME
        others = [ladder for ladder in refinable if name != ladder.levels[0].NAME]
        known = [trial for trial in self.trials if trial.ladder in others]
        if not known and (not others or self.goal.cancelled()):
            finest.error, self._unsure = None, True
            self._notes.append(NO_SECOND)
            return
        other = known[-1] if known else self._as_fine_as_time_allows(others[0], finest.level)
        apart = self._difference(other, finest)
        if apart is None:
            return
        last = [self._difference(trial, other) for trial in self.trials if trial.ladder is other.ladder][-2:-1]
        # what the other has changed by at last counts, too: two that converge to different forces cross on the way
        bound = apart + last[0] if last and last[0] is not None else None
        for trial in (finest, other):
            if trial.error is not None:
                trial.error = max(trial.error, bound) if bound is not None else None
        self._notes.append(self._disagreement(other, finest, apart))

    def _as_fine_as_time_allows(self, ladder: Ladder, finest: int) -> Trial:
        """The coarsest, whatever time is left, or finer ones up to this level."""
        found = self._try(ladder, 0)
        for level in range(1, min(finest + 1, len(ladder.levels))):
            if not self._time_for(TIME_GROWTH * found.cost * self._slowness()):
                break
            found = self._try(ladder, level)
        return found

    @staticmethod
    def _disagreement(other: Trial, one: Trial, apart: float) -> Note:
        return Note("second-method-differs", Severity.WARNING, other=other.label, method=one.label, apart=apart)

    def _ask_another(self, refinable: list[Ladder]) -> None:
        """Forces where nothing gives way: modes may converge to something wrong."""
        proof = self.proof.ladder.levels[0].NAME
        others = [ladder for ladder in refinable if proof != ladder.levels[0].NAME and not self.goal.cancelled()]
        if not self._may_mislead(self.proof.ladder):
            return
        if not others:
            self._notes.append(NO_SECOND)
            self._unsure = True
            return
        other = self._try(others[0], min(self.proof.level, len(others[0].levels) - 1))
        other.error = self._difference(other, self.proof)
        if other.error is None:
            return
        if other.error > max(self.chosen.error, self.goal.tolerance):
            self._unsure = True
            self._notes.append(self._disagreement(other, self.proof, other.error))
        for trial in self.trials:
            if trial.ladder is self.chosen.ladder and trial.error is not None:
                trial.error = max(trial.error, other.error)

    def _hold_together(self) -> None:
        """Closed forms alone: the most trusted, and how far the nearest other method is from it."""
        for ladder in self._own:
            if ladder.resolution is None:
                self._try(ladder, 0)
        self.chosen, *others = self.trials
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
        waiting: dict[Ladder, tuple[float, list[Trial]]] = {}  # what the next level takes at least, and those before it
        for ladder in self._own:
            assumed = ladder.resolution is not None and not ladder.converges  # right by chance only
            if not assumed and ladder not in (self.proof.ladder, self.chosen.ladder):
                waiting[ladder] = self._expected(ladder, 0, 0), []
        climbed, allowed = len(self.trials), sum(trial.cost for trial in self.trials)
        while waiting and sum(trial.cost for trial in self.trials[climbed:]) < allowed:
            ladder = min(waiting, key=lambda ladder: waiting[ladder][0])
            least, own = waiting.pop(ladder)
            if least >= self.chosen.cost or not self._time_for(least * self._slowness()):
                break
            other = self._try(ladder, len(own))
            other.error = self._difference(other, self.proof)
            own.append(other)
            if other.error is not None and other.error <= TOLERANCE_MARGIN * self.goal.tolerance:
                self.chosen = min(self.chosen, other, key=lambda trial: trial.cost)
            elif self._promising(own):
                waiting[ladder] = self._expected(ladder, len(own), other.solution.diagnostics["steps"]), own

    def _promising(self, own: list[Trial]) -> bool:
        """Whether a finer level may keep to the tolerance and still cost less than what is chosen by now."""
        last = own[-1]
        if last.error is None or (len(own) > 1 and last.error > RISE * own[-2].error):
            return False
        enough = last.level + math.ceil(
            math.log(last.error / (TOLERANCE_MARGIN * self.goal.tolerance)) / math.log(FALL)
        )
        if enough >= len(last.ladder.levels):
            return False
        return self._expected(last.ladder, enough, last.solution.diagnostics["steps"]) < self.chosen.cost

    def _expected(self, ladder: Ladder, level: int, steps: int) -> float:
        """Cost of a level, if it takes so many steps."""
        return expected_time(ladder.levels[level].table(), steps, self.scene)

    def _try(self, ladder: Ladder, level: int) -> Trial:
        for known in self.trials:
            if known.ladder is ladder and known.level == level:
                return known
        begun = clock()
        solution = ladder.solve(level, self.scene, self._duration)
        reference = Reference.of(solution, self.goal.quantity in HISTORIES)
        self.trials.append(Trial(ladder, level, solution, reference, clock() - begun))
        return self.trials[-1]

    def _difference(self, one: Trial, other: Trial) -> float | None:
        """Of the quantity asked for, `other` being nearer to the exact solution."""
        return difference(one, other, self.goal.quantity)

    def _slowness(self) -> float:
        """How much slower this machine is now than the constants say, but for what was done for the first time."""
        return min(MAX_SLOWNESS, *(trial.wall_time / trial.cost for trial in self.trials))

    def _time_for(self, expected: float, part: float = 1.0) -> bool:
        """Whether so many seconds are left of this part of all."""
        if self.goal.cancelled():
            return False
        budget = part * (MAX_SEARCH_SECONDS if self.goal.budget is None else self.goal.budget)
        return sum(min(trial.wall_time, MAX_SLOWNESS * trial.cost) for trial in self.trials) + expected <= budget


def _ends_early(trial: Trial) -> bool:
    """Whether the impact could not be followed to its end: two that stop at the same instant agree on nothing."""
    return ended_early(trial.solution.notes)


def _halts_a_slender_beam(scene: Scene) -> bool:
    """Whether bending waves without shear, which are the faster the shorter, are all that gives way."""
    return scene.rigid_contact and any(
        isinstance(body, Bending) and body.theory == "euler-bernoulli" for body in (scene.impactor, scene.target)
    )
