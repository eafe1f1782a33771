"""Only what an impact requires, for the page: the plan, and the map of regimes in which the present scene is a dot."""

import json
import math
import re
from functools import cache
from typing import Any

import numpy as np
import param

from solvers import METHODS, Modal, Plan, QuasiStatic, RegimeMap, RigidImpulse, Scene, Waves, plan, regime_map
from solvers.regimes.models import QUESTIONS as QUANTITIES
from solvers.regimes.models import family_of
from solvers.regimes.plan import law_of

from ..choices.choices import accepts
from ..choices.kinds import bends_alone, own_options
from ..choices.map_point import choices_at
from ..choices.questions import Question
from ..choices.request import Request
from ..choices.space import in_space
from .answering import answering

LINKS = re.compile(r"(target|impactor)\.links\.\d+\.modes")
SET_BY_THE_PAGE = {"quasi-static": ("model",), "modal": ("steps",)}  # options that the page chooses itself
QUESTIONS = {
    "question": Question(param.Selector(default=QUANTITIES[0], objects=list(QUANTITIES)), "question"),
    "plan_tolerance": Question(param.Number(default=0.05, bounds=(1e-4, 0.5)), "error"),
    "map_point": Question(
        param.String(default="", regex=r"^[0-9.e+ -]{0,40}$", doc="where the visitor wants to be, until it is so"),
        sent=False,
        leads=choices_at,
        example="0.3 1.0",
    ),
}


@answering
def plan_data(request: Request) -> dict[str, Any]:
    """The plan for these choices and this question."""
    scene = request.scene
    return _plan(plan(scene, request.chosen["question"], request.chosen["plan_tolerance"]), scene)


def _plan(found: Plan, scene: Scene) -> dict[str, Any]:
    candidates = [
        {
            "model": candidate.parts,
            "error": candidate.expected_error if math.isfinite(candidate.expected_error) else None,
            "unknown": math.isnan(candidate.expected_error),
            "choices": None
            if in_space(scene) or _by_another_model(candidate.changes["method"], scene)
            else page_choices(candidate.changes, bends_alone(scene)),
        }
        for candidate in found.candidates
    ]
    return {
        "groups": found.groups,
        "candidates": candidates,
        "picked": found.candidates.index(found.chosen),
        "why": found.why.table(),
        "measured": found.measured,
        "light": any(
            candidate.changes["method"]["name"] == RigidImpulse.NAME and candidate.expected_error <= found.tolerance
            for candidate in found.candidates
        ),
        "modes": found.modes,
    }


def _by_another_model(method: dict[str, Any], scene: Scene) -> bool:
    """Whether the page, which has no choice of it, would take the other quasi-static model than the plan."""
    if method["name"] != QuasiStatic.NAME:
        return False
    taken = QuasiStatic.read(own_options(scene, QuasiStatic.NAME)).model_of(scene)
    return QuasiStatic(model=method.get("model", "auto")).model_of(scene) != taken


def page_choices(changes: dict[str, Any], pendulum: bool = False) -> dict[str, Any] | None:
    """The choices of the page that make these changes of a scene; None where it has none for one of them. `pendulum`:
    all that rings is one that strikes, and its own modes are those that are chosen."""
    wanted: dict[str, Any] = {}
    for key, value in changes.items():
        if key == "method":
            own = _method_choices(dict(value))
        elif key == "target.theory":
            own = {"theory": value}
        elif LINKS.fullmatch(key) or (pendulum and key == "impactor.modes"):  # which the page gives all as many
            own = {"modes": value}
        elif key == "contact" and value.get("law") == "hertz":
            own = {"law": "hertz", "hertz_stiffness": value["stiffness"]}
        else:
            own = None
        if own is None:
            return None
        wanted |= own
    return wanted if all(accepts(name, value) for name, value in wanted.items()) else None


def _method_choices(table: dict[str, Any]) -> dict[str, Any] | None:
    """Of the table `[method]` of a scene."""
    name = table.pop("name")
    found, usual = {"method": name}, METHODS[name].read({}).table()
    for option, value in table.items():
        if option in ("modes", "elements", "restitution"):
            found[option] = value
        elif value != usual[option] and option not in SET_BY_THE_PAGE.get(name, ()):
            return None
    return {option: value for option, value in found.items() if value is not None}


def regimes_data(asked: dict[str, Any]) -> str:
    """The map for the family to which the scene belongs, as JSON, or an empty object for other scenes."""
    scene = Request.of(asked).scene
    family = family_of(scene)
    if family is None:
        return "{}"
    return _map_text(asked["question"], family, law_of(scene) if family.endswith("-rod") else "linear")


@cache  # some dozens of maps in all, each of some 50 kB
def _map_text(question: str, family: str, law: str) -> str:
    found = regime_map(question, family, law)
    return json.dumps(
        {
            "question": question,
            "family": family,
            "law": law,
            "models": found.models,
            "beyond": Waves.NAME if family.endswith("-rod") else Modal.NAME,  # where none of them is good enough
            "ratio": _listed(found.mass_ratio),
            "time": _listed(found.relative_time),
            "errors": [[_listed(row) for row in model] for model in found.errors],
            "contours": _contours(found),
        },
        allow_nan=False,
    )


def _contours(found: RegimeMap) -> dict[str, list[list[Any]]]:
    """By model: [level, times, ratios] of each line."""
    return {
        name: [[level, _listed(time), _listed(ratio)] for level, (time, ratio) in lines.items()]
        for name, lines in found.contours.items()
    }


def _listed(values: np.ndarray) -> list[float | None]:
    return [float(f"{value:.3g}") if math.isfinite(value) else None for value in values.tolist()]
