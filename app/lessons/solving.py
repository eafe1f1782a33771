"""The impact that a step shows, by the method that the page shows it by, and what a goal can be about."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from solvers import RigidImpulse, Solution
from solvers.accuracy.reference import exact_solution

from ..choices.request import Request
from ..choices.scene_of import own_choices
from ..messages.encoding import read_header
from ..messages.fall import fall_fields
from ..messages.mechanism.frame import mechanism_solution
from ..messages.space import bodies_frame
from ..messages.transverse import main_solution
from .events import MOST
from .lesson import Goal, Step


class Shown(NamedTuple):
    """An impact, and the kind of its scene."""

    kind: str
    solution: Solution
    request: Request


def solved(step: Step, **changes: Any) -> Shown:
    """The impact that a step shows, with other `changes` of its choices. Raises ValueError."""
    request = Request.of(own_choices(step.scene) | step.choices | changes)
    return Shown(request.kind, SOLVED[request.kind](request), request)


SOLVED: dict[str, Callable[[Request], Solution]] = {
    "axial": lambda request: exact_solution(request.scene, request.restitution),
    "beam": lambda request: main_solution(request)[0],
    "mechanism": lambda request: mechanism_solution(request)[0],
    "bodies": lambda request: RigidImpulse(request.restitution, request.chosen["restitution_model"]).solve(
        request.scene
    ),
}


def fallen(shown: Shown) -> dict[str, float]:
    """When what is dropped touches, again and again, from the release on [s]: as its scene opens on the page."""
    found = fall_fields(shown.request, shown.solution)[1].get("bounces", np.zeros((0, 4)))
    times = {f"-{number}" if number > 1 else "": float(time) for number, (time, *_) in enumerate(found[:MOST], 1)}
    return {f"{kind}{which}": time for which, time in times.items() for kind in ("touch", "part")}


Quantity = Callable[[Shown], float | None]


def _velocity(body: str) -> Quantity:
    return lambda shown: shown.solution.table()[body]["final_velocity"]


def _spin(body: str) -> Quantity:
    """About the line towards who looks at the picture."""

    def read(shown: Shown) -> float:
        header = read_header(bodies_frame(shown.solution, shown.request))
        toward = np.cross(header["across"], header["up"])
        return float(np.dot(header["bodies"][body]["after"]["spin"], toward))

    return read


def _lost(shown: Shown) -> float:
    energy = shown.solution.energy
    return (energy["dissipated"] + energy.get("friction", 0.0)) / energy["initial"]


ON_A_LINE: dict[str, Quantity] = {
    "contacts": lambda shown: len(shown.solution.contacts),
    "peak_force": lambda shown: shown.solution.peak_force,
    "impulse": lambda shown: shown.solution.impulse,
    "restitution": lambda shown: shown.solution.restitution.get("newton"),
    "contact_time": lambda shown: shown.solution.contact_time,
    "impactor_velocity": _velocity("impactor"),
    "target_velocity": _velocity("target"),
    "peak_indentation": lambda shown: shown.solution.peak_indentation,
    "energy_lost": _lost,
}
IN_SPACE: dict[str, Quantity] = {
    "impulse": lambda shown: float(np.linalg.norm(shown.solution.impulse)),
    "impactor_spin": _spin("impactor"),
    "target_spin": _spin("target"),
    "energy_lost": _lost,
    "sticks": lambda shown: sum(each.kind == "stick" for each in shown.solution.sliding or []),
}
QUANTITIES = {kind: IN_SPACE if kind == "bodies" else ON_A_LINE for kind in SOLVED}  # by kind, in SI units
COUNTED = ("contacts", "sticks")  # that can be equal to a number


SLIGHT = 1e-6  # of it, which methods may be wrong by
SIZES = {"restitution": 1.0, "energy_lost": 1.0, "impactor_spin": 1.0, "target_spin": 1.0}  # of what is zero


def meets(shown: Shown, goal: Goal) -> bool:
    """Whether an impact meets a goal, by more than its methods may be wrong: a ball that stops does not go on."""
    value = QUANTITIES[shown.kind][goal.quantity](shown)
    if value is None:
        return False
    if goal.relation == "=":
        return value == goal.value
    velocity = goal.quantity.endswith("_velocity")
    size = float(shown.request.chosen["speed"]) if velocity else SIZES.get(goal.quantity, 0.0)
    beyond = goal.value - value if goal.relation == "<" else value - goal.value
    return beyond > SLIGHT * max(abs(goal.value), abs(value), size)
