"""What a search has found, in figures and in words."""

import math
from dataclasses import replace
from typing import Any, NamedTuple

from ..solution.solution import Solution
from ..text.notes import Note, Severity
from .trial import Goal, Trial, difference, remainder

CHOSEN = "chosen"  # the code of the note that says so
HARDLY = 0.2  # order of convergence that is none


class Outcome(NamedTuple):
    """What was asked for, all that was solved, and what of it is the answer."""

    goal: Goal
    trials: list[Trial]
    chosen: Trial
    proof: Trial | None  # None: nothing that could be refined, or nothing proved
    notes: list[Note]
    unsure: bool  # whether no estimate can be believed
    spent: float  # [s]
    limit: float | None  # s at which the search was ended, though no budget was given
    cancelled: bool
    finer: float  # s that one more solve, the next finer, is expected to take

    @property
    def met(self) -> bool | None:
        """Whether the tolerance is kept to, proved; None if only a budget was given."""
        tolerance, error = self.goal.tolerance, self.chosen.error
        if tolerance is None:
            return None
        # without a proof the error is only what is left of the last differences, which may mislead
        unproved = self.proof is None and self.chosen.ladder.converges
        return error is not None and error <= tolerance and not unproved and not self.unsure


def summary(found: Outcome) -> Solution:
    """What was chosen, with the reasons in its diagnostics and notes.

    `diagnostics["chosen"]`, all a page needs to show and prove the choice: quantity, tolerance, budget as asked for;
    estimated_error of that quantity; met, None if only a budget was given; why, a sentence; proof, the table `[method]`
    of the solution it was held against; tried, each with method, label, cost (expected time of a warm solve [s]),
    wall_time (of this one) and estimated_error; wall_time of everything.
    """
    chosen, goal = found.chosen, found.goal
    why = _why(found)
    reasons = {
        "quantity": goal.quantity,
        "tolerance": goal.tolerance,
        "budget": goal.budget,
        "estimated_error": chosen.error,
        "met": found.met,
        "why": str(why),
        "proof": None if found.proof is None else found.proof.solution.method,
        "tried": [trial.row() for trial in found.trials],
        "wall_time": found.spent,
    }
    diagnostics = chosen.solution.diagnostics | {"estimated_error": _rebound_error(found), "chosen": reasons}
    return replace(chosen.solution, diagnostics=diagnostics, notes=[*chosen.solution.notes, why, *found.notes])


def _rebound_error(found: Outcome) -> float | None:
    """Of the very solution returned, relative to the impact speed, whatever was asked for."""
    chosen, proof = found.chosen, found.proof
    if found.goal.quantity == "rebound":
        return chosen.error
    if proof is not None and proof is not chosen:
        return difference(chosen, proof, "rebound")
    if chosen.ladder.converges:
        return remainder([trial for trial in found.trials if trial.ladder is chosen.ladder], "rebound")
    return chosen.solution.diagnostics["estimated_error"]


def _why(found: Outcome) -> Note:
    """What was chosen, and how well it does what was asked."""
    chosen, goal, proof = found.chosen, found.goal, found.proof
    other, outcome = None if proof is chosen else proof, _outcome(found)
    return Note(
        CHOSEN,
        Severity.WARNING if found.met is False else Severity.REMARK,
        cancelled=found.cancelled,
        method=chosen.label,
        known=chosen.error is not None,
        error=chosen.error,
        quantity=goal.quantity,
        compared=other is not None,
        proof=None if other is None else other.label,
        outcome=outcome,
        solved=len(found.trials),
        tolerance=goal.tolerance,
        budget=goal.budget,
        spent=found.spent,
        finer=_finer(found) if outcome in ("within", "over") else None,
        limit=found.limit if outcome in ("unproved", "missed") else None,
        resolution=chosen.ladder.resolution,
        **_needed(found),
    )


def _outcome(found: Outcome) -> str:
    """An option of the note: how what was chosen stands to what was asked."""
    error, goal = found.chosen.error, found.goal
    if found.met:
        return "met"
    if found.met is None:
        return (
            "stopped" if found.cancelled else "within" if goal.budget is None or goal.budget >= found.spent else "over"
        )
    return "unproved" if error is not None and error <= goal.tolerance else "missed"


def _finer(found: Outcome) -> float | None:
    """Seconds that it would take to know an error that the time was too short for."""
    known = found.chosen.error is not None or not found.chosen.ladder.converges or found.unsure
    return None if known else found.finer


def _needed(found: Outcome) -> dict[str, Any]:
    """What the tolerance would take, by how the errors have fallen so far."""
    chosen = found.chosen
    nothing = {"size": None, "seconds": None}
    if found.goal.tolerance is None:
        return {"needed": None, **nothing}
    own = [trial for trial in found.trials if trial.ladder is chosen.ladder and trial.error]
    if not chosen.ladder.converges:
        return {"needed": "nothing", **nothing}
    if found.unsure or chosen.error is None or len(own) < 3:
        return {"needed": "unknown", **nothing}
    order = math.log(own[0].error / own[-1].error) / math.log(own[-1].size / own[0].size)
    if abs(order) < HARDLY or (order > 0.0) != (own[-1].size > own[0].size):
        return {"needed": "slow", **nothing}
    times = (own[-1].error / found.goal.tolerance) ** (1.0 / order)
    seconds = own[-1].cost * times * max(1.0, times)
    return {"needed": "known", "size": own[-1].size * times, "seconds": seconds}
