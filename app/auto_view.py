"""A tolerance or a time instead of a method, on the page: what was chosen, why, and how near it really is."""

import json
from collections.abc import Callable
from typing import Any

from solvers import METHODS, Auto, Scene, SceneError, Solution, Waves
from solvers.judging import Answer, Truth
from solvers.tried import never

from .questions import BUDGET
from .state import accepts, chosen_scene

TIGHT = 1e-11  # tolerance of the exact solution


def auto_data(asked: dict[str, Any], cancelled: Callable[[], bool] = never) -> str:
    """The cheapest solution within `auto_tolerance` of `auto_quantity`, or the finest within `auto_budget` [s].

    As JSON: `chosen`, which is all that was asked, what was found and its estimated and true error; or `error`, a
    sentence why there is none. Once `cancelled`, the best so far.
    """
    answer: dict[str, Any] = {"chosen": asked}
    try:
        scene = chosen_scene(asked)
        among = None if asked["auto_waves"] else tuple(name for name in METHODS if name != Waves.NAME)
        limits = (None, asked["auto_budget"]) if asked["auto_within"] == "time" else (asked["auto_tolerance"], BUDGET)
        auto = Auto(limits[0], asked["auto_quantity"], limits[1], among, cancelled)
        answer |= _found(auto.solve(scene, scene.method.get("duration")), scene, asked["auto_quantity"])
        answer["cancelled"] = cancelled()
    except ValueError as refusal:  # SceneError
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


def _found(solution: Solution, scene: Scene, quantity: str) -> dict[str, Any]:
    found = solution.diagnostics["chosen"]
    chosen = next(row for row in found["tried"] if row["method"] == solution.method)
    proof = next((row["label"] for row in found["tried"] if row["method"] == found["proof"]), None)
    return {
        "label": chosen["label"],
        "name": solution.method["name"],
        "choices": nearest_choices(solution.method),
        "cost": chosen["cost"],
        "estimate": found["estimated_error"],
        "true": true_error(solution, scene, quantity),
        "met": found["met"],
        "why": found["why"],
        "doubts": solution.notes[solution.notes.index(found["why"]) + 1 :],
        "proof": proof,
        "tried": [{key: row[key] for key in ("label", "cost", "estimated_error")} for row in found["tried"]],
        "wall_time": found["wall_time"],
    }


def nearest_choices(method: dict[str, Any]) -> dict[str, Any] | None:
    """The choices of the page that show a method, its other options being as the page has them; None if it is finer."""
    found = {"method": method["name"]}
    found |= {name: method[name] for name in ("modes", "elements") if method.get(name) is not None}
    return found if all(accepts(name, value) for name, value in found.items()) else None


def true_error(solution: Solution, scene: Scene, quantity: str) -> float | None:
    """By the exact travelling waves, where they can solve the scene."""
    exact = Waves(tolerance=TIGHT)
    if exact.refusal(scene) is not None:
        return None
    try:
        error = Truth.of(exact.solve(scene, scene.method.get("duration"))).errors(Answer.of(solution))[quantity]
    except SceneError:
        return None
    return None if error is None else abs(error)
