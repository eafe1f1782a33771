"""What a search has found, in figures and in words."""

import math
from dataclasses import replace
from typing import NamedTuple

from .solution import Solution
from .tried import Tried, Wish, difference, remainder

HARDLY = 0.2  # order of convergence that is none


class Outcome(NamedTuple):
    """What was asked for, all that was solved, and what of it is the answer."""

    wish: Wish
    tried: list[Tried]
    chosen: Tried
    proof: Tried | None  # None: nothing that could be refined, or nothing proved
    doubts: list[str]
    doubted: bool  # whether no estimate can be believed
    spent: float  # [s]
    limit: float | None  # s at which the search was ended, though no budget was given
    cancelled: bool
    finer: float  # s that one more solve, the next finer, is expected to take

    @property
    def met(self) -> bool | None:
        """Whether the tolerance is kept to, proved; None if only a budget was given."""
        tolerance, error = self.wish.tolerance, self.chosen.error
        if tolerance is None:
            return None
        # without a proof the error is only what is left of the last differences, which may mislead
        unproved = self.proof is None and self.chosen.ladder.converges
        return error is not None and error <= tolerance and not unproved and not self.doubted


def told(found: Outcome) -> Solution:
    """What was chosen, with the reasons in its diagnostics and notes.

    `diagnostics["chosen"]`, all a page needs to show and prove the choice: quantity, tolerance, budget as asked for;
    estimated_error of that quantity; met, None if only a budget was given; why, a sentence; proof, the table `[method]`
    of the solution it was held against; tried, each with method, label, cost (expected time of a warm solve [s]),
    wall_time (of this one) and estimated_error; wall_time of everything.
    """
    chosen, wish = found.chosen, found.wish
    why = "Cancelled. " * found.cancelled + _why(found)
    reasons = {
        "quantity": wish.quantity,
        "tolerance": wish.tolerance,
        "budget": wish.budget,
        "estimated_error": chosen.error,
        "met": found.met,
        "why": why,
        "proof": None if found.proof is None else found.proof.solution.method,
        "tried": [tried.row() for tried in found.tried],
        "wall_time": found.spent,
    }
    diagnostics = chosen.solution.diagnostics | {"estimated_error": _rebound_error(found), "chosen": reasons}
    return replace(chosen.solution, diagnostics=diagnostics, notes=[*chosen.solution.notes, why, *found.doubts])


def share(error: float) -> str:
    """An error in percent."""
    return f"{float(f'{100.0 * error:.2g}'):g} %"


def _rough(value: float) -> str:
    """To one figure, 20 rather than 2e+01."""
    return f"{float(f'{value:.1g}'):g}"


def _rebound_error(found: Outcome) -> float | None:
    """Of the very solution returned, relative to the impact speed, whatever was asked for."""
    chosen, proof = found.chosen, found.proof
    if found.wish.quantity == "rebound":
        return chosen.error
    if proof is not None and proof is not chosen:
        return difference(chosen, proof, "rebound")
    if chosen.ladder.converges:
        return remainder([tried for tried in found.tried if tried.ladder is chosen.ladder], "rebound")
    return chosen.solution.diagnostics["estimated_error"]


def _why(found: Outcome) -> str:
    chosen, wish, proof = found.chosen, found.wish, found.proof
    error = "an unknown error" if chosen.error is None else f"an estimated error of {share(chosen.error)}"
    said = f"Chosen: '{chosen.label}', {error} in the {wish.quantity.replace('-', ' ')}"
    if proof is not None and proof is not chosen:
        said += f" by comparison with '{proof.label}'"
    if found.met:
        return f"{said}, the cheapest of {len(found.tried)} solved that keeps to {share(wish.tolerance)}."
    if found.met is None and found.cancelled:
        return f"{said}, the finest by then."
    if found.met is None and wish.budget >= found.spent:
        return f"{said}, the finest that {wish.budget:g} s are enough for.{_untold(found)}"
    if found.met is None:
        return f"{said}: {wish.budget:g} s are not enough, this took {found.spent:.2g} s.{_untold(found)}"
    if chosen.error is not None and chosen.error <= wish.tolerance:
        said = f"{said}, but nothing proves that it keeps to {share(wish.tolerance)}."
    else:
        said = f"{said}, not {share(wish.tolerance)} as asked for: {_needed(found)}"
    return said + (f" The search ended at its limit of {found.limit:g} s; a budget allows more." if found.limit else "")


def _untold(found: Outcome) -> str:
    """What it would take to tell an error that the time was too short for."""
    if found.chosen.error is not None or not found.chosen.ladder.converges or found.doubted:
        return ""
    return f" To tell its error takes a finer one beside it, about {found.finer:.1g} s more."


def _needed(found: Outcome) -> str:
    """What the tolerance would take, by how the errors have fallen so far."""
    chosen = found.chosen
    own = [tried for tried in found.tried if tried.ladder is chosen.ladder and tried.error]
    if not chosen.ladder.converges:
        return "nothing here can be refined."
    if found.doubted or chosen.error is None or len(own) < 3:
        return "what it would take cannot be told."
    order = math.log(own[0].error / own[-1].error) / math.log(own[-1].size / own[0].size)
    knob = chosen.ladder.knob
    if abs(order) < HARDLY or (order > 0.0) != (own[-1].size > own[0].size):
        return f"more {knob} hardly bring it nearer."
    times = (own[-1].error / found.wish.tolerance) ** (1.0 / order)
    seconds = own[-1].cost * times * max(1.0, times)
    return f"that would take about {_rough(own[-1].size * times)} {knob}, {_rough(seconds)} s."
