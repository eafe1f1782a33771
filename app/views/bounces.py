"""A dropped body that bounces to rest, for the page: every bounce, and its height over time."""

from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np
import param

from solvers import METHODS, bounces
from solvers.accuracy.reference import exact_solution
from solvers.bodies.drop import STANDARD_GRAVITY
from solvers.methods.base import Method, SceneNotSupported, never
from solvers.provenance import clock

from ..choices.questions import Question
from ..choices.request import Request
from ..messages.fall import flights
from ..messages.transverse import method_at_impact
from ..text.refusals import Refused
from .answering import answering

CUT, MOST = 1e-4, 100  # of the first height; impacts that are solved
BUDGET_SECONDS = 8.0  # after which no other impact is begun
QUESTIONS = {
    "bounce_gravity": Question(
        param.Number(default=STANDARD_GRAVITY, bounds=(0.01, 1e3), doc="under which it falls [m/s2]"), "gravity"
    )
}


@answering
def bounces_data(request: Request, cancelled: Callable[[], bool] = never) -> dict[str, Any]:
    """The table of `solvers.bounces`, `path_time` [s] and `path_height` [m] of the flights, and `stopped`: it was
    cancelled, or took too long.
    """
    latest = clock() + BUDGET_SECONDS
    stopped = False

    def enough() -> bool:
        nonlocal stopped
        stopped = cancelled() or clock() > latest
        return stopped

    try:
        found = bounces(request.scene, method_of(request), CUT, MOST, request.chosen["bounce_gravity"], enough)
    except SceneNotSupported as refusal:
        raise Refused("bounces.refused") if refusal.key == "target.kind" else refusal from None
    time, height = flights(found)
    return {
        **{name: getattr(found, name) for name in ("height", "gravity", "cut", "ended", "rest_time", "path")},
        "bounces": [asdict(bounce) for bounce in found.bounces],
        "stopped": stopped,
        "path_time": _listed(time),
        "path_height": _listed(height),
        "method": found.method["name"],
        "notes": [note.table() for note in found.notes],
    }


def method_of(request: Request) -> Method:
    """By which the page shows the impact: the exact one on an axis, the chosen one of a beam."""
    if not request.exact:
        return method_at_impact(request).without_estimate()
    options = dict(exact_solution(request.scene, request.restitution).method)
    return METHODS[options.pop("name")].read(options).without_estimate()


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values.tolist()]
