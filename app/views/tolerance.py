"""A tolerance or a time instead of a method, on the page: what was chosen, why, and how near it really is."""

from collections.abc import Callable
from typing import Any

import param

from solvers import METHODS, Auto, Scene, SceneError, Solution, Waves
from solvers.accuracy.auto import ASKABLE
from solvers.accuracy.quantities import Metrics, Reference
from solvers.accuracy.reference import exact_waves
from solvers.accuracy.report import CHOSEN
from solvers.methods.base import never
from solvers.text.notes import Note

from ..choices.choices import accepts
from ..choices.questions import Question
from ..choices.request import Request
from .answering import answering

BUDGET_SECONDS = 6.0  # s that one visitor may keep the others waiting
WITHIN = ("tolerance", "time")
QUESTIONS = {  # in an address a budget goes before a tolerance
    "auto_within": Question(param.Selector(default=WITHIN[0], objects=list(WITHIN), doc="what the answer keeps to")),
    "auto_quantity": Question(param.Selector(default=ASKABLE[0], objects=list(ASKABLE)), "quantity"),
    "auto_tolerance": Question(
        param.Number(default=0.01, bounds=(1e-6, 0.5)), "tolerance", needs=("auto_within", "tolerance")
    ),
    "auto_budget": Question(
        param.Number(default=0.05, bounds=(1e-4, BUDGET_SECONDS), doc="computing time that may be spent [s]"),
        "budget",
        needs=("auto_within", "time"),
    ),
    "auto_waves": Question(param.Boolean(default=True, doc="whether exact travelling waves may be chosen"), "waves"),
    "auto_follows": Question(
        param.Boolean(default=False, doc="whether the page shows the method that is chosen"), "follow", sent=False
    ),
}


@answering
def auto_data(request: Request, cancelled: Callable[[], bool] = never) -> dict[str, Any]:
    """The cheapest solution within `auto_tolerance` of `auto_quantity`, or the finest within `auto_budget` [s].

    What was found, and its estimated and true error. Once `cancelled`, the best so far.
    """
    scene, asked = request.scene, request.chosen
    among = None if asked["auto_waves"] else tuple(name for name in METHODS if name != Waves.NAME)
    in_time = asked["auto_within"] == "time"
    tolerance, budget = (None, asked["auto_budget"]) if in_time else (asked["auto_tolerance"], BUDGET_SECONDS)
    auto = Auto(tolerance, asked["auto_quantity"], budget, among, cancelled)
    found = _found(auto.solve(scene, scene.method.get("duration")), scene, asked["auto_quantity"])
    return found | {"cancelled": cancelled()}


def _found(solution: Solution, scene: Scene, quantity: str) -> dict[str, Any]:
    found = solution.diagnostics["chosen"]
    chosen = next(row for row in found["tried"] if row["method"] == solution.method)
    proof = next((row["label"] for row in found["tried"] if row["method"] == found["proof"]), None)
    return {
        "label": chosen["label"],
        "exact": solution.method["name"] == Waves.NAME,
        "choices": nearest_choices(solution.method),
        "cost": chosen["cost"],
        "estimate": found["estimated_error"],
        "true": true_error(solution, scene, quantity),
        "met": found["met"],
        "notes": [note.table() for note in _of_the_choice(solution.notes)],
        "proof": proof,
        "tried": [{key: row[key] for key in ("label", "cost", "estimated_error")} for row in found["tried"]],
        "wall_time": found["wall_time"],
    }


def _of_the_choice(notes: list[Note]) -> list[Note]:
    """Why this one was chosen, and what the search adds to it."""
    return notes[[note.code for note in notes].index(CHOSEN) :]


def nearest_choices(method: dict[str, Any]) -> dict[str, Any] | None:
    """The choices of the page that show a method, its other options being as the page has them; None if it is finer."""
    found = {"method": method["name"]}
    found |= {name: method[name] for name in ("modes", "elements") if method.get(name) is not None}
    return found if all(accepts(name, value) for name, value in found.items()) else None


def true_error(solution: Solution, scene: Scene, quantity: str) -> float | None:
    """By the exact travelling waves, where they can solve the scene."""
    exact = exact_waves(scene)
    if exact is None:
        return None
    try:
        error = Reference.of(exact.solve(scene, scene.method.get("duration"))).errors(Metrics.of(solution))[quantity]
    except SceneError:
        return None
    return None if error is None else abs(error)
